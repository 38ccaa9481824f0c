/* Stencil tables through C++: every function, with values known from refinement. */
#include "check.hpp"

#include <cmath>
#include <cstdio>

static const Pyramid pyramid;

static bool near(const std::vector<double> &a, const std::vector<double> &b)
{
    bool good = a.size() == b.size();
    for (std::size_t i = 0; good && i < a.size(); i++)
        good = std::fabs(a[i] - b[i]) < 1e-13;
    return good;
}

int main()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Hierarchy hierarchy =
        carvel::Hierarchy::create(mesh, carvel::Scheme::create({CARVEL_SCHEME_CATMULL_CLARK}), 2);
    const std::vector<double> control = {0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    const std::vector<double> expected = hierarchy.refine(2, control);
    carvel::StencilsDesc desc;
    desc.level = 2;
    desc.precision = CARVEL_PRECISION_F64;
    const carvel::Stencils whole = carvel::Stencils::create(hierarchy, desc);
    const carvel::StencilCounts counts = whole.counts();
    CHECK(counts.rows * 3 == expected.size() && counts.columns == 5);
    std::vector<double> out(expected.size());
    whole.apply(control, out);
    CHECK(near(out, expected));
    whole.apply_add(control, out);
    for (double &x : out)
        x /= 2;
    CHECK(near(out, expected));

    desc.level = 1;
    const carvel::Stencils first = carvel::Stencils::create(hierarchy, desc);
    desc.level = 2;
    desc.from_level = 1;
    const carvel::Stencils both = first.then(carvel::Stencils::create(hierarchy, desc));
    both.apply(control, out);
    CHECK(near(out, expected));

    const carvel::Stencils limits = carvel::Stencils::limits(hierarchy, 2, CARVEL_PRECISION_F64);
    CHECK(limits.counts().rows == expected.size() && limits.counts().columns == counts.rows);
    std::vector<double> surface(3 * expected.size());
    limits.apply(expected, surface);
    CHECK(surface[0] != expected[0]);

    const carvel::Csr<float> csr = whole.csr<float>();
    CHECK(csr.offsets.size() == counts.rows + 1 && csr.offsets.back() == counts.entries);
    std::vector<double> back(control.size()), again(control.size());
    whole.apply_transpose(expected, back);
    whole.transpose().apply(expected, again);
    CHECK(back == again);

    const std::uint32_t list[] = {1};
    desc.from_level = 0;
    desc.vertices = list;
    desc.selects = true;
    const carvel::Stencils one = carvel::Stencils::create(hierarchy, desc);
    std::vector<double> point(3);
    one.apply(control, point);
    CHECK(near(point, {expected[3], expected[4], expected[5]}));

    std::vector<double> moved = control;
    moved[3] = 9;
    std::vector<double> full(expected.size());
    whole.apply(control, out);
    whole.apply(moved, full);
    whole.update(list, moved, out);
    CHECK(out == full);

    const char *path = "stencils-cpp.tmp";
    whole.save(path);
    carvel::Stencils::load(path).apply(control, out);
    CHECK(near(out, expected));
    std::remove(path);
    CHECK(!carvel::Stencils::try_load(path));
    std::puts("stencils: ok");
}
