/* Errors, thrown and returned, with every defect and its elements. */
#include "check.hpp"

#include <sys/resource.h>

#include <cstring>
#include <limits>
#include <string>

static bool names(const carvel::Entry &entry, std::uint64_t kind, std::uint64_t index,
                  std::uint64_t second = 0)
{
    for (const carvel::Element &e : entry.elements)
        if (e.kind == kind && e.index == index && e.second == second)
            return true;
    return false;
}

static void check_defects(const std::vector<carvel::Entry> &entries)
{
    CHECK(entries.size() == 2);
    bool outside = false;
    bool twice = false;
    for (const carvel::Entry &entry : entries) {
        CHECK(!entry.message.empty());
        if (entry.status == CARVEL_STATUS_INDEX_OUT_OF_RANGE)
            outside = names(entry, CARVEL_ELEMENT_VERTEX, 9) &&
                      names(entry, CARVEL_ELEMENT_FACE, 2);
        if (entry.status == CARVEL_STATUS_INCONSISTENT_ORIENTATION)
            twice = names(entry, CARVEL_ELEMENT_EDGE, 0, 1) &&
                    names(entry, CARVEL_ELEMENT_FACE, 0) && names(entry, CARVEL_ELEMENT_FACE, 1);
    }
    CHECK(outside && twice);
}

static void a_refused_mesh_names_every_defect()
{
    try {
        carvel::Mesh::create(Broken().faces());
        CHECK(false);
    } catch (const carvel::Error &error) {
        CHECK(error.status() == error.entries().front().status);
        CHECK(std::strlen(error.what()) > 10);
        check_defects(error.entries());
    }
    const carvel::Result<carvel::Mesh> result = carvel::Mesh::try_create(Broken().faces());
    CHECK(!result && !result.has_value());
    check_defects(result.error().entries());
    const carvel::Failure copy = result.error();
    CHECK(copy.message() == result.error().message());
    check_defects(copy.entries());
}

/* An error is a std::exception that can be copied, stored and thrown again. */
static void errors_outlive_the_call()
{
    std::exception_ptr stored;
    try {
        carvel::Mesh::create(Broken().faces());
    } catch (const std::runtime_error &) {
        stored = std::current_exception();
    }
    try {
        std::rethrow_exception(stored);
    } catch (carvel::Error &error) {
        const carvel::Error copy = error; // NOLINT
        check_defects(copy.entries());
        check_defects(copy.failure().entries());
    }
}

static void every_check_is_the_librarys()
{
    const Pyramid pyramid;
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create();
    carvel::SchemeDesc wrong;
    wrong.family = CARVEL_SCHEME_THREE_POINT;
    wrong.w = {1, 2};
    CHECK(THROWN(carvel::Scheme::create(wrong)) == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    wrong.w = {1, 0};
    CHECK(THROWN(carvel::Scheme::create(wrong)) == CARVEL_STATUS_INVALID_NUMBER);
    CHECK(THROWN(carvel::Mesh::create(carvel::Faces::of_size(3, 0, pyramid.corners))) ==
          CARVEL_STATUS_LENGTH_MISMATCH);
    CHECK(THROWN(carvel::Mesh::create(carvel::Faces::of_size(5, 3, pyramid.corners))) ==
          CARVEL_STATUS_LENGTH_MISMATCH);
    CHECK(THROWN(carvel::Mesh::create(
              {5, carvel::Span<const std::uint32_t>(pyramid.sizes.data(), 4), pyramid.corners})) ==
          CARVEL_STATUS_LENGTH_MISMATCH);

    std::vector<double> points = pyramid.points;
    points.push_back(0);
    CHECK(THROWN(carvel::refine(mesh, scheme, 1, points)) == CARVEL_STATUS_LENGTH_MISMATCH);
    points.resize(12);
    CHECK(THROWN(carvel::refine(mesh, scheme, 1, points)) == CARVEL_STATUS_LENGTH_MISMATCH);
    points = pyramid.points;
    points[7] = std::numeric_limits<double>::quiet_NaN();
    const auto result = carvel::try_refine(mesh, scheme, 1, points);
    CHECK(!result && result.error().status() == CARVEL_STATUS_NOT_FINITE);
    CHECK(names(result.error().entries().at(0), CARVEL_ELEMENT_VERTEX, 2));
    CHECK(!result.error().exception());

    const carvel::Hierarchy hierarchy = carvel::Hierarchy::create(mesh, scheme, 1);
    std::vector<double> small(9);
    CHECK(THROWN(hierarchy.refine_into(1, pyramid.points, small)) ==
          CARVEL_STATUS_BUFFER_TOO_SMALL);
    CHECK(THROWN(hierarchy.refine(2, pyramid.points)) == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    std::vector<double> refined = pyramid.points;
    CHECK(THROWN(hierarchy.refine_into(0, refined, refined)) == CARVEL_STATUS_OVERLAP);
}

/* Sizes are refused before a vector is made for them. */
static void what_is_too_large_is_refused_first()
{
    const Pyramid pyramid;
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create();
    CHECK(THROWN(carvel::refine(mesh, scheme, 20, pyramid.points)) == CARVEL_STATUS_TOO_LARGE);
    CHECK(THROWN(carvel::refine(mesh, scheme, 65, pyramid.points)) == CARVEL_STATUS_TOO_LARGE);
    const carvel::Context low = carvel::Context::create({1, 1000, {}});
    CHECK(THROWN(carvel::refine(mesh, scheme, 13, pyramid.points, &low)) ==
          CARVEL_STATUS_MEMORY_CEILING);
    /* A vector of a thousand million indices was never there; kilobytes. */
    rusage usage;
    CHECK(getrusage(RUSAGE_SELF, &usage) == 0 && usage.ru_maxrss < 1000000);
}

/* Vectors of this layer that the system has no memory for. */
static void a_failed_allocation_is_bad_alloc()
{
    carvel::detail::Call call;
    std::vector<double> vector;
    CHECK(!call.grow(vector, std::uint64_t(1) << 58));
    CHECK(vector.empty());
    const carvel::Result<void> result = call.result();
    CHECK(!result && result.error().status() == CARVEL_STATUS_OUT_OF_RESOURCES);
    CHECK(!result.error().message().empty() && result.error().entries().size() == 1);
    try {
        result.value();
        CHECK(false);
    } catch (const std::bad_alloc &) {
    }
    CHECK(!carvel::detail::Call().grow(vector, ~std::uint64_t(0), 3));
    CHECK(!carvel::detail::Call().grow(vector, (std::uint64_t(1) << 62) + 1, 8));
}

int main()
{
    a_refused_mesh_names_every_defect();
    errors_outlive_the_call();
    every_check_is_the_librarys();
    what_is_too_large_is_refused_first();
    a_failed_allocation_is_bad_alloc();
    std::puts("errors: ok");
}
