/* Surfaces through C++: every function, a table beside evaluation, errors. */
#include "check.hpp"

#include <cmath>
#include <cstdio>

static const Pyramid pyramid;

int main()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_CATMULL_CLARK});
    const carvel::Surface surface = carvel::Surface::create(mesh, scheme);
    std::uint32_t sectors = 0;
    for (std::uint32_t face = 0; face < 5; face++)
        sectors += surface.sectors(face);
    CHECK(sectors == 1 + 4 * 3);
    CHECK(surface.try_sectors(5).error().status() == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);

    const std::vector<double> control = {0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    const std::vector<carvel::Sample> samples = {{0, 0, 0.25, 0.5}, {1, 0, 0.5, 0.75}};
    std::vector<double> out(2 * 3 * 3), again(out.size());
    surface.evaluate(samples, CARVEL_DERIVATIVES_FIRST, control, carvel::values(out, 3));
    const carvel::Stencils table =
        surface.stencils(samples, CARVEL_DERIVATIVES_FIRST, CARVEL_PRECISION_F64);
    CHECK(table.counts().rows == 6 && table.counts().columns == 5);
    table.apply(control, again);
    for (std::size_t i = 0; i < out.size(); i++)
        CHECK(std::fabs(out[i] - again[i]) < 1e-13);

    const std::vector<float> single(control.begin(), control.end());
    std::vector<float> point(2 * 3);
    surface.evaluate(samples, CARVEL_DERIVATIVES_NONE, single, point);
    for (std::size_t k = 0; k < 3; k++)
        CHECK(std::fabs(point[k] - out[k]) < 1e-6);

    const carvel::Sample outside[] = {{0, 0, 2, 0}};
    const auto refused = surface.try_evaluate(outside, CARVEL_DERIVATIVES_NONE, control, again);
    CHECK(refused.error().status() == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    CHECK(!surface.try_stencils(outside, CARVEL_DERIVATIVES_NONE));

    std::vector<std::uint32_t> corners(16);
    for (std::uint32_t i = 0; i < 16; i++)
        corners[i] = i;
    const carvel::Channel channel = carvel::Channel::create(mesh, corners, 16);
    const carvel::Surface islands = carvel::Surface::create(channel, scheme);
    std::vector<double> own(16, 3.0), at_samples(2);
    islands.evaluate(samples, CARVEL_DERIVATIVES_NONE, carvel::values(own, 1),
                     carvel::values(at_samples, 1));
    CHECK(std::fabs(at_samples[0] - 3) < 1e-13 && std::fabs(at_samples[1] - 3) < 1e-13);

    const carvel::Search search = carvel::Search::create(surface, control);
    const std::vector<std::array<double, 3>> points = {{0, 0, 2}, {0, 0, 5}};
    const std::vector<carvel::Closest> nearest = search.closest(points, 3);
    CHECK(carvel::found(nearest[0]) && !carvel::found(nearest[1]));
    const std::vector<carvel::Ray> rays = {{{0, 0, 2}, {0, 0, -1}, {0, 9}},
                                           {{3, 3, 2}, {0, 0, -1}, {0, 9}}};
    const std::vector<carvel::Hit> hits = search.intersect(rays);
    CHECK(carvel::found(hits[0]) && !carvel::found(hits[1]));
    CHECK(hits[0].t >= nearest[0].distance - 1e-9);
    CHECK(!search.try_closest(points, -1));

    carvel::TessellationDesc fine;
    fine.tolerance = 0.02;
    const carvel::Tessellation made = carvel::Tessellation::create(surface, control, fine);
    const carvel::TriangleCounts sizes = made.counts();
    CHECK(sizes.triangles == 2 * (sizes.vertices - 2) && sizes.measure <= 0.02);
    const std::vector<std::uint32_t> triangles = made.triangles(), vertices = made.place_vertices();
    CHECK(triangles.size() == 3 * sizes.triangles && made.faces().size() == sizes.triangles);
    CHECK(vertices[made.triangle_places()[7]] == triangles[7]);
    CHECK(made.places().size() == sizes.places);
    std::vector<double> positions(3 * sizes.vertices);
    made.positions(positions);
    std::vector<std::array<float, 3>> normals(sizes.places);
    made.normals(normals);
    CHECK(positions[2] > -1 && std::fabs(normals[0][0]) <= 1);
    fine.tolerance = -1;
    const auto negative = carvel::Tessellation::try_create(surface, control, fine);
    CHECK(negative.error().status() == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    std::puts("surface: ok");
}
