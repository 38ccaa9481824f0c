/*
 * Evaluates a moving control mesh frame by frame, with points in Eigen's matrices:
 * the topology is refined once, and each frame costs only its points.
 *
 *   g++ -std=c++17 -O2 animate.cpp $(pkg-config --cflags --libs carvel eigen3) -o animate
 */
#include <carvel.hpp>

#include <Eigen/Core>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

constexpr int side = 33;
constexpr int frames = 24;
constexpr std::uint32_t level = 2;

/* A sheet of quads with side x side points. */
static std::vector<std::uint32_t> make_faces()
{
    std::vector<std::uint32_t> faces;
    for (std::uint32_t i = 0; i + 1 < side; ++i)
        for (std::uint32_t j = 0; j + 1 < side; ++j) {
            const std::uint32_t v = i * side + j;
            faces.insert(faces.end(), {v, v + side, v + side + 1, v + 1});
        }
    return faces;
}

/* A wave runs through the sheet; every column is a point. */
static void move_points(int frame, Eigen::Matrix3Xd &points)
{
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            points.col(i * side + j) << i, j, std::sin(0.3 * i + 0.1 * j + 0.5 * frame);
}

static void animate()
{
    using Clock = std::chrono::steady_clock;
    /* Once: threads on all cores, topology, room for the refined points. */
    const auto context = carvel::Context::create();
    const auto mesh =
        carvel::Mesh::create(carvel::Faces::of_size(side * side, 4, make_faces()), {}, &context);
    const auto scheme = carvel::Scheme::create({CARVEL_SCHEME_QUARTIC});
    const auto hierarchy = carvel::Hierarchy::create(mesh, scheme, level, &context);
    const carvel::Counts counts = hierarchy.counts(level);
    Eigen::Matrix3Xd control(3, side * side);
    Eigen::Matrix3Xd smooth(3, static_cast<Eigen::Index>(counts.vertices));
    std::cout << counts.vertices << " vertices, " << counts.faces << " faces\n";

    for (int frame = 0; frame < frames; ++frame) {
        move_points(frame, control);
        const auto start = Clock::now();
        hierarchy.refine_into(level, carvel::columns(control), carvel::columns(smooth), &context);
        const std::chrono::duration<double, std::milli> took = Clock::now() - start;
        std::cout << "frame " << frame << ": " << took.count()
                  << " ms, the first point is at height " << smooth(2, 0) << '\n';
    }
}

int main()
{
    try {
        animate();
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
