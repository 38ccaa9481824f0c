/* What the C++ programs share: checks that tell where they failed, and meshes. */
#ifndef CHECK_HPP
#define CHECK_HPP

#include <carvel.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

#define CHECK(condition)                                                                     \
    do {                                                                                     \
        if (!(condition)) {                                                                  \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);             \
            std::exit(1);                                                                    \
        }                                                                                    \
    } while (false)

/* The status that an expression throws; OK if it does not throw. */
#define THROWN(expression)                                                                   \
    [&]() -> carvel_status {                                                                 \
        try {                                                                                \
            static_cast<void>(expression);                                                   \
            return CARVEL_STATUS_OK;                                                         \
        } catch (const carvel::Error &error) {                                               \
            return error.status();                                                           \
        }                                                                                    \
    }()

using Indices = std::vector<std::uint32_t>;

/* A pyramid over a square: a quad and four triangles. */
struct Pyramid {
    Indices sizes = {4, 3, 3, 3, 3};
    Indices corners = {3, 2, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    std::vector<double> points = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 2};

    carvel::Faces faces() const { return {5, sizes, corners}; }
};

/* Two quads over an edge that runs the same way in both, and a face with vertex
 * 9 that does not exist: two defects. */
struct Broken {
    Indices sizes = {4, 4, 3};
    Indices corners = {0, 1, 2, 3, 0, 1, 4, 5, 2, 1, 9};

    carvel::Faces faces() const { return {6, sizes, corners}; }
};

#endif
