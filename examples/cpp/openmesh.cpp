/*
 * Reads a mesh with OpenMesh, refines it, and writes it with OpenMesh.
 *
 *   g++ -std=c++17 openmesh.cpp $(pkg-config --cflags --libs carvel openmesh) -o openmesh
 *   ./openmesh cow.obj smooth.off 3
 */
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <carvel.hpp>

#include <cstdlib>
#include <iostream>

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<>;

int main(int argc, char **argv)
{
    if (argc < 3 || argc > 4) {
        std::cerr << "usage: openmesh IN OUT [LEVELS]\n";
        return 2;
    }
    const auto levels = static_cast<std::uint32_t>(argc == 4 ? std::atoi(argv[3]) : 2);
    Mesh control;
    if (!OpenMesh::IO::read_mesh(control, argv[1])) {
        std::cerr << argv[1] << ": OpenMesh cannot read it\n";
        return EXIT_FAILURE;
    }
    Mesh smooth;
    try {
        const auto context = carvel::Context::create();
        const auto scheme = carvel::Scheme::create({CARVEL_SCHEME_THREE_POINT});
        carvel::openmesh::refine(control, scheme, levels, smooth, &context);
    } catch (const std::exception &error) {
        std::cerr << argv[1] << ": " << error.what() << '\n';
        return EXIT_FAILURE;
    }
    if (!OpenMesh::IO::write_mesh(smooth, argv[2])) {
        std::cerr << argv[2] << ": OpenMesh cannot write it\n";
        return EXIT_FAILURE;
    }
    std::cout << control.n_faces() << " faces became " << smooth.n_faces() << '\n';
}
