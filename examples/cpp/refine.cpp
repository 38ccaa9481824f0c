/*
 * Refines the faces and points below and writes the result as an OBJ file.
 *
 *   g++ -std=c++17 refine.cpp $(pkg-config --cflags --libs carvel) -o refine
 *   ./refine 3 > house.obj
 */
#include <carvel.hpp>

#include <array>
#include <cstdlib>
#include <iostream>
#include <vector>

/* A house: quads, and a pentagon at either end. */
const std::vector<std::array<float, 3>> points = {
    {0, 0, 0}, {3, 0, 0}, {3, 0, 2}, {0, 0, 2}, {0, 2, 0},
    {3, 2, 0}, {3, 2, 2}, {0, 2, 2}, {0, 3, 1}, {3, 3, 1}};
const std::vector<std::uint32_t> face_sizes = {4, 4, 4, 4, 4, 5, 5};
const std::vector<std::uint32_t> face_vertices = {
    0, 1, 2, 3,  0, 4, 5, 1,  2, 6, 7, 3,  4, 8, 9, 5,  6, 9, 8, 7,
    0, 3, 7, 8, 4,  1, 5, 9, 6, 2};

static void write_obj(const carvel::Refined<float> &smooth)
{
    std::cout.precision(9);
    for (std::size_t i = 0; i < smooth.positions.size(); i += 3)
        std::cout << "v " << smooth.positions[i] << ' ' << smooth.positions[i + 1] << ' '
                  << smooth.positions[i + 2] << '\n';
    auto vertex = smooth.face_vertices.begin();
    for (const std::uint32_t size : smooth.face_sizes) {
        std::cout << 'f';
        for (std::uint32_t i = 0; i < size; ++i)
            std::cout << ' ' << *vertex++ + 1;
        std::cout << '\n';
    }
}

int main(int argc, char **argv)
{
    const auto levels = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 2);
    try {
        const auto mesh = carvel::Mesh::create({points.size(), face_sizes, face_vertices});
        const auto scheme = carvel::Scheme::create({CARVEL_SCHEME_THREE_POINT});
        write_obj(carvel::refine(mesh, scheme, levels, points));
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
