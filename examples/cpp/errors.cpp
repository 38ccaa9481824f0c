/*
 * Errors in both styles: thrown with everything that is wrong with a mesh, and
 * returned; and a progress function that throws.
 *
 *   g++ -std=c++17 errors.cpp $(pkg-config --cflags --libs carvel) -o errors
 */
#include <carvel.hpp>

#include <cstdlib>
#include <iostream>
#include <vector>

/* Three faces at the edge 0-1, and two cones that touch in vertex 5. */
const std::vector<std::uint32_t> triangles = {
    0, 1, 2,  1, 0, 3,  0, 1, 4,
    5, 6, 7,  5, 8, 9};

static void print(const carvel::Element &element)
{
    if (element.kind == CARVEL_ELEMENT_VERTEX)
        std::cout << " [vertex " << element.index << ']';
    else if (element.kind == CARVEL_ELEMENT_FACE)
        std::cout << " [face " << element.index << ']';
    else if (element.kind == CARVEL_ELEMENT_EDGE)
        std::cout << " [edge " << element.index << '-' << element.second << ']';
}

static void print(const std::vector<carvel::Entry> &entries)
{
    for (const carvel::Entry &entry : entries) {
        std::cout << carvel_status_string(entry.status) << ": " << entry.message;
        for (const carvel::Element &element : entry.elements)
            print(element);
        std::cout << '\n';
    }
}

/* The throwing style. */
static carvel::Mesh make_mesh(const carvel::Faces &faces)
{
    try {
        return carvel::Mesh::create(faces);
    } catch (const carvel::Error &error) {
        std::cout << "refused: " << error.what() << '\n';
        print(error.entries());
        carvel::MeshOptions options;
        options.non_manifold = CARVEL_NON_MANIFOLD_CUT;
        return carvel::Mesh::create(faces, options);
    }
}

/* The returning style, which is there without exceptions, too. */
static bool can_refine(const carvel::Mesh &mesh, std::uint32_t level)
{
    const carvel::Result<carvel::Scheme> scheme = carvel::Scheme::try_create();
    if (!scheme)
        return false;
    const auto counts = carvel::try_predict_counts(mesh, *scheme, level);
    if (!counts)
        std::cout << "level " << level << ": " << counts.error().message() << '\n';
    return counts && counts->corners < UINT32_MAX;
}

struct Enough {};

int main()
{
    try {
        const carvel::Mesh mesh = make_mesh(carvel::Faces::of_size(10, 3, triangles));
        std::cout << "cut: 10 vertices became " << mesh.counts().vertices << '\n';
        if (!can_refine(mesh, 3) || can_refine(mesh, 64))
            return EXIT_FAILURE;
        const auto context = carvel::Context::create(
            {0, 0, [](double done) { return done > 0.1 ? throw Enough() : false; }});
        carvel::Hierarchy::create(mesh, carvel::Scheme::create(), 3, &context);
    } catch (const Enough &) {
        std::cout << "the progress function had enough\n";
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
