/* Masks through C++: every function, with values known by hand. */
#include "check.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

int main()
{
    const carvel::Mask chaikin = carvel::Mask::create("chaikin");
    const std::vector<std::array<double, 2>> square = {{{0, 0}}, {{4, 0}}, {{4, 4}}, {{0, 4}}};
    const std::vector<double> expected = {1, 0, 3, 0, 4, 1, 4, 3, 3, 4, 1, 4, 0, 3, 0, 1};
    CHECK(chaikin.refine(CARVEL_ENDS_CLOSED, 1, square) == expected);
    std::vector<std::array<double, 2>> out(8);
    chaikin.refine_into(CARVEL_ENDS_CLOSED, 1, square, out);
    CHECK(out[2][0] == 4 && out[2][1] == 1);
    CHECK(chaikin.counts(CARVEL_ENDS_CLOSED, 4, 3).points == 32);
    CHECK(chaikin.coefficients().size() == 4);

    const carvel::Mask cubic = carvel::Mask::create("b-spline:3");
    const std::vector<double> tangents = {2, -2, 2, 2, -2, 2, -2, -2};
    CHECK(cubic.limit_counts(CARVEL_ENDS_CLOSED, 4).points == 4);
    CHECK(cubic.limit(CARVEL_ENDS_CLOSED, 1, square) == tangents);
    std::vector<std::array<double, 2>> limits(4);
    cubic.limit_into(CARVEL_ENDS_CLOSED, 1, square, limits);
    CHECK(limits[3][0] == -2);
    CHECK(!chaikin.try_limit(CARVEL_ENDS_CLOSED, 2, square));
    /* A closed grid of one row is two of the polygon's. */
    std::vector<std::array<double, 2>> grid(16);
    chaikin.refine_grid_into(chaikin, CARVEL_ENDS_CLOSED, CARVEL_ENDS_CLOSED, 4, 1, square, grid);
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(grid[i] == out[i % 8]);

    const carvel::Mask paper = carvel::Mask::create("[1,9,22,22,9,1]/32", 2);
    const carvel::MaskAnalysis found = paper.analyse();
    CHECK(found.continuity == 2 && found.proof_norm.numerator == 3);
    const carvel::Scheme scheme = paper.scheme();
    CHECK(scheme.passes().size() == 1 && scheme.passes()[0].denominator == 2);

    const carvel::Mask moved = carvel::Mask::create_with_offset("[1,2,1]/2", 2, 3);
    const carvel::LimitSamples hat = moved.sample_limit(1);
    CHECK(hat.first == 7 && hat.values == (std::vector<double>{0.5, 1, 0.5}));
    CHECK(!carvel::Mask::try_create_with_offset("chaikin", 0, 1));
    CHECK(!moved.try_sample_limit(1, 2));

    /* The product of two linear splines. */
    std::vector<carvel::Fraction> tent;
    for (const std::int64_t weight : {1, 2, 1, 2, 4, 2, 1, 2, 1})
        tent.push_back({weight, 4});
    const carvel::GridMask bilinear = carvel::GridMask::create(tent, 3, {{2, 2}}, {{-1, -1}});
    const auto size = bilinear.counts(CARVEL_ENDS_CLOSED, CARVEL_ENDS_CLOSED, {2, 2}, 1);
    CHECK(size.rows == 4 && size.columns == 4);
    const std::vector<std::array<double, 1>> corners = {{{0}}, {{4}}, {{8}}, {{12}}};
    std::vector<std::array<double, 1>> patch(16);
    bilinear.refine_into(CARVEL_ENDS_CLOSED, CARVEL_ENDS_CLOSED, 2, 1, corners, patch);
    CHECK(patch[0][0] == 0 && patch[1][0] == 2 && patch[2][0] == 4);
    CHECK(patch[4][0] == 4 && patch[5][0] == 6 && patch[10][0] == 12);
    CHECK(!carvel::GridMask::try_create(tent, 2, {{2, 2}}, {{0, 0}}));

    std::size_t names = 0;
    for (std::uint64_t i = 0; i < carvel_catalogue_count(); ++i) {
        const carvel::CatalogueEntry entry = carvel::catalogue_entry(i);
        if (std::string(entry.name) != "corner-cutting")
            continue;
        ++names;
        CHECK(entry.is_stationary && entry.parameters.size() == 2);
        CHECK(std::string(entry.parameters[1].name) == "beta" && entry.parameters[1].is_free);
    }
    CHECK(names == 1 && !carvel::try_catalogue_entry(carvel_catalogue_count()));
    const auto ranges = carvel::catalogue_ranges("three-point", "w", 3, {-1, 1}, {1, 1}, {1, 100});
    CHECK(ranges.size() == 1 && ranges[0].low_inside.denominator == 16);
    CHECK(!carvel::try_catalogue_ranges("three-point", "v", 3, {-1, 1}, {1, 1}, {1, 100}));

    const auto none = carvel::Mask::try_create("chakin");
    CHECK(!none && none.error().status() == CARVEL_STATUS_INVALID_NUMBER);
    const auto few = chaikin.try_refine(CARVEL_ENDS_KEPT, 1, std::vector<double>{1, 2, 3});
    CHECK(!few && few.error().status() == CARVEL_STATUS_LENGTH_MISMATCH);
    CHECK(!carvel::Mask::create("weissman").try_scheme());
    std::puts("masks: ok");
}
