/* Masks: polygons refined as computed by hand, what is proved of a scheme, and every
 * wrong call. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static carvel_mask *mask_of(const char *text, uint32_t arity)
{
    carvel_mask *it = NULL;
    CHECK_OK(carvel_mask_create(text, arity, &it, failure));
    return it;
}

static carvel_polygon_counts counts_after(const carvel_mask *mask, int32_t ends, uint64_t points,
                                          uint32_t steps)
{
    carvel_polygon_counts counts;
    CHECK_OK(carvel_polygon_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_mask_counts(mask, ends, points, steps, &counts, failure));
    return counts;
}

static carvel_const_values_f64 from64(const double *data, uint64_t count, uint64_t width)
{
    carvel_const_values_f64 it;
    it.data = data;
    it.count = count;
    it.width = width;
    it.stride = 0;
    return it;
}

static carvel_values_f64 to64(double *data, uint64_t count, uint64_t width)
{
    carvel_values_f64 it;
    it.data = data;
    it.count = count;
    it.width = width;
    it.stride = 0;
    return it;
}

/* ---------------------------------------------------------------- polygons */

/* Chaikin's first step on a square, all numbers exact. */
static void check_square(void)
{
    static const double square[] = {0, 0, 4, 0, 4, 4, 0, 4};
    static const double expected[] = {1, 0, 3, 0, 4, 1, 4, 3, 3, 4, 1, 4, 0, 3, 0, 1};
    carvel_mask *named = mask_of("chaikin", 0), *listed = mask_of("[1,3,3,1]/4", 2);
    const carvel_const_values_f64 from = from64(square, 4, 2);
    carvel_polygon_counts counts = counts_after(named, CARVEL_ENDS_CLOSED, 4, 1);
    double a[16], b[16];
    carvel_values_f64 to = to64(a, 8, 2);
    check_context("square");
    CHECK_UINT(8, counts.points);
    CHECK(counts.ends == CARVEL_ENDS_CLOSED);
    CHECK_OK(carvel_mask_refine_f64(named, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_BYTES(expected, a, sizeof expected);
    to.data = b;
    CHECK_OK(carvel_mask_refine_f64(listed, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_BYTES(a, b, sizeof a);
    carvel_mask_destroy(named);
    carvel_mask_destroy(listed);
}

/* Ends that stay; floats with gaps, which are left alone. */
static void check_ends(void)
{
    static const float line[] = {0, -1, 8, -1, 16, -1};
    static const float expected[] = {0, 7, 2, 7, 6, 7, 10, 7, 14, 7, 16, 7};
    carvel_mask *chaikin = mask_of("chaikin", 0);
    carvel_polygon_counts counts = counts_after(chaikin, CARVEL_ENDS_KEPT, 3, 1);
    carvel_const_values_f32 from;
    carvel_values_f32 to;
    carvel_context *context = context_of(2);
    float out[12];
    int i;
    check_context("ends");
    CHECK_UINT(6, counts.points);
    CHECK(counts.ends == CARVEL_ENDS_ANCHORED);
    counts = counts_after(chaikin, counts.ends, counts.points, 1);
    CHECK_UINT(10, counts.points);
    counts = counts_after(chaikin, CARVEL_ENDS_DROPPED, 3, 1);
    CHECK_UINT(4, counts.points);
    from.data = line;
    from.count = 3;
    from.width = 1;
    from.stride = 2 * sizeof *line;
    to.data = out;
    to.count = 6;
    to.width = 1;
    to.stride = 2 * sizeof *out;
    for (i = 0; i < 12; i++)
        out[i] = 7;
    CHECK_OK(carvel_mask_refine_f32(chaikin, context, CARVEL_ENDS_KEPT, 1, &from, &to, failure));
    CHECK_BYTES(expected, out, sizeof out);
    carvel_context_destroy(context);
    carvel_mask_destroy(chaikin);
}

/* ---------------------------------------------------------- grids and limits */

/* The limit of the cubic B-spline is (1 4 1)/6, its derivative (-1 0 1)/2. */
static void check_limits(void)
{
    static const double square[] = {0, 0, 6, 0, 6, 6, 0, 6};
    static const double points[] = {1, 1, 5, 1, 5, 5, 1, 5};
    static const double tangents[] = {3, -3, 3, 3, -3, 3, -3, -3};
    carvel_mask *cubic = mask_of("b-spline:3", 0), *linear = mask_of("[1,2,1]/2", 0);
    const carvel_const_values_f64 from = from64(square, 4, 2);
    static const float line[] = {2, 7, -1};
    float kept[3];
    const carvel_const_values_f32 single = {line, 3, 1, 0};
    const carvel_values_f32 limits = {kept, 3, 1, 0};
    carvel_polygon_counts counts;
    double out[8];
    carvel_values_f64 to = to64(out, 4, 2);
    int i;
    check_context("limits");
    CHECK_OK(carvel_polygon_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_mask_limit_counts(cubic, CARVEL_ENDS_CLOSED, 4, 0, &counts, failure));
    CHECK(counts.points == 4 && counts.ends == CARVEL_ENDS_CLOSED);
    CHECK_OK(carvel_mask_limit_counts(cubic, CARVEL_ENDS_DROPPED, 4, 1, &counts, failure));
    CHECK(counts.points == 2 && counts.ends == CARVEL_ENDS_DROPPED);
    CHECK_OK(carvel_mask_limit_f64(cubic, NULL, CARVEL_ENDS_CLOSED, 0, &from, &to, failure));
    for (i = 0; i < 8; i++)
        CHECK(fabs(out[i] - points[i]) < 1e-14);
    CHECK_OK(carvel_mask_limit_f64(cubic, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_BYTES(tangents, out, sizeof tangents);
    CHECK_OK(carvel_mask_limit_f32(linear, NULL, CARVEL_ENDS_KEPT, 0, &single, &limits, failure));
    CHECK_BYTES(line, kept, sizeof line);
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_limit_f64(linear, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_limit_counts(linear, CARVEL_ENDS_CLOSED, 4, 1, &counts, failure));
    to.count = 3;
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL,
                 carvel_mask_limit_f64(cubic, NULL, CARVEL_ENDS_CLOSED, 0, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_mask_limit_f64(cubic, NULL, 9, 0, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_limit_counts(cubic, CARVEL_ENDS_CLOSED, 4, 0, NULL, failure));
    carvel_mask_destroy(cubic);
    carvel_mask_destroy(linear);
}

/* A grid of products becomes the products of what its factors become, here exactly. */
static void check_grid(void)
{
    static const float f[] = {3, -1, 4, 1, 5}, g[] = {2, 7, -1, 8};
    carvel_mask *down = mask_of("chaikin", 0), *along = mask_of("b-spline:3", 0);
    float grid[20], a[10], b[16], out[112];
    carvel_const_values_f32 from = {NULL, 0, 1, 0};
    carvel_values_f32 to = {NULL, 0, 1, 0};
    uint64_t rows = counts_after(down, CARVEL_ENDS_CLOSED, 5, 1).points;
    uint64_t columns = counts_after(along, CARVEL_ENDS_KEPT, 4, 1).points;
    uint64_t i, j;
    check_context("grid");
    CHECK(rows == 10 && columns == 7);
    for (i = 0; i < 20; i++)
        grid[i] = f[i / 4] * g[i % 4];
    from.data = f, from.count = 5, to.data = a, to.count = 10;
    CHECK_OK(carvel_mask_refine_f32(down, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    from.data = g, from.count = 4, to.data = b, to.count = 7;
    CHECK_OK(carvel_mask_refine_f32(along, NULL, CARVEL_ENDS_KEPT, 1, &from, &to, failure));
    from.data = grid, from.count = 20, to.data = out, to.count = 70;
#define REFINE_GRID(columns) \
    carvel_mask_refine_grid_f32(down, along, NULL, CARVEL_ENDS_CLOSED, CARVEL_ENDS_KEPT, \
                                columns, 1, &from, &to, failure)
    CHECK_OK(REFINE_GRID(4));
    for (i = 0; i < rows; i++)
        for (j = 0; j < columns; j++)
            CHECK(out[i * columns + j] == a[i] * b[j]);
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE_GRID(3));
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE_GRID(0));
    to.count = 69;
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL, REFINE_GRID(4));
    carvel_mask_destroy(down);
    carvel_mask_destroy(along);
}

/* Loop's regular rule on a closed grid, which is no product; a 1 becomes the mask itself. */
static void check_bivariate(void)
{
    static const int64_t weights[25] = {1, 2, 1, 0, 0, 2, 6, 6, 2, 0, 1, 6, 10,
                                        6, 1, 0, 2, 6, 6, 2, 0, 0, 1, 2, 1};
    carvel_fraction list[25];
    carvel_grid_mask *mask = NULL;
    double grid[16] = {0}, out[64];
    float ones[16], constant[64];
    uint64_t rows = 0, columns = 0;
    int i, j;
    carvel_const_values_f64 from = from64(grid, 16, 1);
    carvel_values_f64 to = to64(out, 64, 1);
    carvel_const_values_f32 from32;
    carvel_values_f32 to32;
    check_context("bivariate");
    for (i = 0; i < 25; i++) {
        list[i].numerator = weights[i];
        list[i].denominator = 16;
    }
    CHECK_OK(carvel_grid_mask_create(list, 25, 5, 2, 2, -2, -2, &mask, failure));
    CHECK_OK(carvel_grid_mask_counts(mask, CARVEL_ENDS_CLOSED, CARVEL_ENDS_CLOSED, 4, 4, 1, &rows,
                                     &columns, failure));
    CHECK(rows == 8 && columns == 8);
#define REFINE(ends, width_of_rows) \
    carvel_grid_mask_refine_f64(mask, NULL, ends, CARVEL_ENDS_CLOSED, width_of_rows, 1, &from, \
                                &to, failure)
    /* Of point (1, 2), at (2, 4) of the refined grid: columns 2 to 6, rows 0 to 4. */
    grid[1 * 4 + 2] = 16;
    CHECK_OK(REFINE(CARVEL_ENDS_CLOSED, 4));
    for (i = 0; i < 8; i++)
        for (j = 0; j < 8; j++)
            CHECK(out[i * 8 + j] ==
                  (i < 5 && j >= 2 && j < 7 ? (double)weights[i * 5 + j - 2] : 0));
    for (i = 0; i < 16; i++)
        ones[i] = 1;
    from32.data = ones, from32.count = 16, from32.width = 1, from32.stride = 0;
    to32.data = constant, to32.count = 64, to32.width = 1, to32.stride = 0;
    CHECK_OK(carvel_grid_mask_refine_f32(mask, NULL, 0, 0, 4, 1, &from32, &to32, failure));
    for (i = 0; i < 64; i++)
        CHECK(constant[i] == 1);
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED, REFINE(CARVEL_ENDS_KEPT, 4));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, REFINE(9, 4));
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE(CARVEL_ENDS_CLOSED, 3));
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE(CARVEL_ENDS_CLOSED, 0));
    to.count = 63;
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL, REFINE(CARVEL_ENDS_CLOSED, 4));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_grid_mask_counts(mask, CARVEL_ENDS_ANCHORED, 0, 4, 4, 1, &rows, &columns,
                                         failure));
    CHECK_STATUS(CARVEL_STATUS_OVERLAP,
                 carvel_grid_mask_counts(mask, 0, 0, 4, 4, 1, &rows, &rows, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_grid_mask_counts(mask, 0, 0, 4, 4, 1, NULL, &rows, failure));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_grid_mask_counts(mask, 0, 0, UINT64_MAX, 4, 1, &rows, &columns, failure));
    carvel_grid_mask_destroy(mask);
    carvel_grid_mask_destroy(NULL);
#define CREATE(list, count, columns, arity, offset) \
    carvel_grid_mask_create(list, count, columns, arity, 2, offset, 0, &mask, failure)
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, CREATE(list, 25, 4, 2, 0));
    CHECK(mask == NULL);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, CREATE(list, 0, 5, 2, 0));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, CREATE(list, 20, 5, 2, 0));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, CREATE(list, 25, 5, 1, 0));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, CREATE(list, 25, 5, 2, 1 << 21));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE, CREATE(list, UINT64_MAX, 5, 2, 0));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, CREATE(NULL, 25, 5, 2, 0));
    list[3].denominator = 0;
    CHECK_STATUS(CARVEL_STATUS_INVALID_NUMBER, CREATE(list, 25, 5, 2, 0));
    CHECK(strstr(carvel_error_message(failure), "coefficients[3]") != NULL);
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_grid_mask_create(list, 25, 5, 2, 2, 0, 0, NULL, failure));
#undef CREATE
#undef REFINE
}

/* Six points of a circle stay on it; a scheme without a mask says so. */
static void check_tension(void)
{
    static const double half = 0.5, tall = 0.86602540378443864676;
    carvel_mask *circle = mask_of("tension-four-point:1/2", 0);
    carvel_mask *local = mask_of("tension-four-point:0.5,0.5", 0);
    carvel_mask *uneven = mask_of("non-uniform-four-point:0.5", 0);
    double hexagon[12], out[24];
    carvel_const_values_f64 from = from64(hexagon, 6, 2);
    carvel_values_f64 to = to64(out, 12, 2);
    carvel_mask_analysis analysis;
    carvel_scheme *scheme = NULL;
    carvel_fraction list[4];
    int i;
    check_context("tension");
    for (i = 0; i < 6; i++) {
        hexagon[2 * i] = i % 3 == 0 ? (i == 0 ? 1 : -1) : (i == 1 || i == 5 ? half : -half);
        hexagon[2 * i + 1] = i % 3 == 0 ? 0 : (i < 3 ? tall : -tall);
    }
    CHECK_UINT(12, counts_after(circle, CARVEL_ENDS_CLOSED, 6, 1).points);
    CHECK_OK(carvel_mask_refine_f64(circle, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    for (i = 0; i < 12; i++)
        CHECK(fabs(out[2 * i] * out[2 * i] + out[2 * i + 1] * out[2 * i + 1] - 1) < 2e-14);
    CHECK_OK(carvel_mask_refine_f64(uneven, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_BYTES(hexagon, out, 2 * sizeof *out);
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH,
                 carvel_mask_refine_f64(local, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    CHECK_OK(carvel_mask_analysis_init(&analysis, sizeof analysis));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_analyse(circle, NULL, &analysis, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED, carvel_mask_scheme(circle, &scheme, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_coefficients(circle, list, 4, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_limit_f64(circle, NULL, CARVEL_ENDS_CLOSED, 0, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_refine_grid_f64(circle, circle, NULL, 0, 0, 2, 1, &from, &to,
                                             failure));
    carvel_mask_destroy(circle);
    circle = mask_of("tension-four-point:-2", 0);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_mask_refine_f64(circle, NULL, CARVEL_ENDS_CLOSED, 1, &from, &to, failure));
    carvel_mask_destroy(circle);
    carvel_mask_destroy(local);
    carvel_mask_destroy(uneven);
}

/* ---------------------------------------------------------------- analysis */

static void check_paper(void)
{
    static const int64_t numerators[] = {1, 9, 11, 11, 9, 1}, denominators[] = {32, 32, 16, 16, 32, 32};
    carvel_mask *mask = mask_of("three-point:1/32", 0);
    carvel_scheme *scheme = NULL;
    carvel_fraction list[6];
    carvel_mask_analysis it;
    uint64_t count = 0, i;
    check_context("the paper's mask");
    CHECK_OK(carvel_mask_coefficients(mask, NULL, 0, &count, failure));
    CHECK_UINT(6, count);
    CHECK_OK(carvel_mask_coefficients(mask, list, 6, NULL, failure));
    for (i = 0; i < 6; i++)
        CHECK(list[i].numerator == numerators[i] && list[i].denominator == denominators[i]);
    CHECK_OK(carvel_mask_analysis_init(&it, sizeof it));
    CHECK_OK(carvel_mask_analyse(mask, NULL, &it, failure));
    CHECK_UINT(2, it.arity);
    CHECK(it.offset == -3 && it.continuity == 2);
    CHECK(it.parametrisation == CARVEL_PARAMETRISATION_DUAL);
    CHECK(it.is_symmetric == 1 && it.is_interpolating == 0);
    CHECK(it.proof_continuity == 2 && it.proof_power == 1);
    CHECK(it.proof_norm.numerator == 3 && it.proof_norm.denominator == 4);
    CHECK(fabs(it.holder_low - (2 - log(0.75) / log(2))) < 1e-12);
    /* No power of two: the exponent is no fraction, and the bounds are rounded away from it. */
    CHECK(it.holder_low < it.holder_high && it.holder_high - it.holder_low < 1e-13);
    CHECK(it.support.numerator == 5 && it.support.denominator == 1);
    CHECK(it.tau.numerator == -1 && it.tau.denominator == 2);
    CHECK_UINT(3, it.smoothing_factors);
    CHECK_UINT(2, it.generation_degree);
    CHECK_UINT(1, it.reproduction_degree);
    CHECK_OK(carvel_mask_scheme(mask, &scheme, failure));
    CHECK_OK(carvel_scheme_passes(scheme, list, 6, &count, failure));
    CHECK_UINT(1, count);
    CHECK(list[0].numerator == 1 && list[0].denominator == 2);
    carvel_scheme_destroy(scheme);
    carvel_mask_destroy(mask);
    mask = mask_of("[1,0,0,0,1,2]/2", 0);
    CHECK_OK(carvel_mask_analyse(mask, NULL, &it, failure));
    CHECK(it.continuity == -1 && it.proof_continuity == -1);
    CHECK(it.proof_norm.numerator == 0 && it.proof_norm.denominator == 0);
    carvel_mask_destroy(mask);
}

/* ------------------------------------------------------------------ misuse */

static void check_texts(void)
{
    static const struct {
        const char *text;
        uint32_t arity;
        carvel_status status;
    } wrong[] = {
        {"", 0, CARVEL_STATUS_INVALID_NUMBER},
        {"chakin", 0, CARVEL_STATUS_INVALID_NUMBER},
        {"1,one", 2, CARVEL_STATUS_INVALID_NUMBER},
        {"1/0,1", 2, CARVEL_STATUS_INVALID_NUMBER},
        {"nan", 0, CARVEL_STATUS_INVALID_NUMBER},
        {"[1,3,3,1", 2, CARVEL_STATUS_INVALID_NUMBER},
        {"\xff", 0, CARVEL_STATUS_INVALID_NUMBER},
        {"chaikin", 2, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE},
        {"b-spline:65", 0, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE},
        {"1,2", 2, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE},
        {"1,1", 1, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE},
        {"1,1", 65, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE},
    };
    size_t i;
    carvel_mask *it;
    check_context("texts");
    for (i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        it = (carvel_mask *)&i;
        CHECK_STATUS(wrong[i].status,
                     carvel_mask_create(wrong[i].text, wrong[i].arity, &it, failure));
        CHECK(it == NULL);
    }
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_mask_create(NULL, 0, &it, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_mask_create("chaikin", 0, NULL, failure));
    carvel_mask_destroy(NULL);
}

/* The offset moves the mask, and with it tau and the samples of the limit. */
static void check_offset(void)
{
    carvel_mask *it = NULL, *centred = mask_of("[1,2,1]/2", 2);
    carvel_mask_analysis analysis;
    double hat[7];
    int64_t first = 0;
    uint64_t count = 0;
    check_context("offset");
    CHECK_OK(carvel_mask_analysis_init(&analysis, sizeof analysis));
    CHECK_OK(carvel_mask_create_with_offset("[1,2,1]/2", 2, 3, &it, failure));
    CHECK_OK(carvel_mask_analyse(it, NULL, &analysis, failure));
    CHECK(analysis.offset == 3 && analysis.tau.numerator == 4 && analysis.tau.denominator == 1);
    CHECK_OK(carvel_mask_sample_limit(it, NULL, 0, 2, &first, NULL, 0, &count, failure));
    CHECK_UINT(7, count);
    /* From 3 to 5, the hat of the linear B-spline, in quarters. */
    CHECK(first == 13);
    CHECK_OK(carvel_mask_sample_limit(centred, NULL, 0, 2, &first, hat, 7, NULL, failure));
    CHECK(first == -3 && hat[0] == 0.25 && hat[3] == 1 && hat[6] == 0.25);
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL,
                 carvel_mask_sample_limit(it, NULL, 0, 2, &first, hat, 6, &count, failure));
    CHECK(first == -3);
    CHECK_STATUS(CARVEL_STATUS_OVERLAP,
                 carvel_mask_sample_limit(it, NULL, 0, 2, (int64_t *)(void *)hat, hat, 7, NULL,
                                          failure));
    CHECK_STATUS(CARVEL_STATUS_OVERLAP,
                 carvel_mask_sample_limit(it, NULL, 0, 2, (int64_t *)(void *)&count, NULL, 0,
                                          &count, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_sample_limit(it, NULL, 0, 2, NULL, NULL, 7, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_sample_limit(NULL, NULL, 0, 2, NULL, NULL, 0, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_sample_limit(it, NULL, 2, 2, NULL, NULL, 0, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_mask_sample_limit(it, NULL, 0, 60, NULL, NULL, 0, NULL, failure));
    carvel_mask_destroy(it);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_mask_create_with_offset("chaikin", 0, 1, &it, failure));
    CHECK(it == NULL);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_mask_create_with_offset("1,1", 2, 1 << 21, &it, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_create_with_offset(NULL, 2, 0, &it, failure));
    it = mask_of("tension-four-point", 0);
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_sample_limit(it, NULL, 0, 1, NULL, NULL, 0, NULL, failure));
    carvel_mask_destroy(it);
    carvel_mask_destroy(centred);
}

/* Every name makes a mask, and so does every default; all texts are there. */
static void check_catalogue(void)
{
    carvel_catalogue_entry entry;
    carvel_catalogue_parameter parameter;
    uint64_t i, k, stationary = 0, parameters = 0;
    check_context("catalogue");
    CHECK_OK(carvel_catalogue_entry_init(&entry, sizeof entry));
    CHECK_OK(carvel_catalogue_parameter_init(&parameter, sizeof parameter));
    CHECK_UINT(22, carvel_catalogue_count());
    for (i = 0; i < carvel_catalogue_count(); i++) {
        char with_default[128];
        carvel_mask *mask;
        CHECK_OK(carvel_catalogue_entry_at(i, &entry, failure));
        CHECK(*entry.summary && *entry.authors && *entry.year && *entry.formula);
        CHECK(*entry.attribution && !*entry.limit == entry.is_stationary);
        carvel_mask_destroy(mask_of(entry.name, 0));
        for (k = 0; k < entry.parameter_count; k++) {
            CHECK_OK(carvel_catalogue_parameter_at(i, k, &parameter, failure));
            CHECK(*parameter.name && *parameter.range);
            if (k == 0) {
                CHECK(strlen(entry.name) + strlen(parameter.default_value) < 126);
                strcpy(with_default, entry.name);
                strcat(with_default, ":");
                strcat(with_default, parameter.default_value);
                mask = mask_of(with_default, 0);
                carvel_mask_destroy(mask);
            }
        }
        CHECK_STATUS(CARVEL_STATUS_INDEX_OUT_OF_RANGE,
                     carvel_catalogue_parameter_at(i, k, &parameter, failure));
        stationary += (uint64_t)entry.is_stationary;
        parameters += entry.parameter_count;
    }
    CHECK_UINT(19, stationary);
    CHECK(parameters > 20);
    CHECK_OK(carvel_catalogue_entry_at(1, &entry, failure));
    CHECK(strcmp(entry.name, "chaikin") == 0 && entry.parameter_count == 0);
    CHECK_OK(carvel_catalogue_entry_at(4, &entry, failure));
    CHECK(strcmp(entry.name, "four-point") == 0 && entry.parameter_count == 1);
    CHECK_OK(carvel_catalogue_parameter_at(4, 0, &parameter, failure));
    CHECK(strcmp(parameter.name, "w") == 0 && parameter.is_free == 1);
    CHECK(strcmp(parameter.default_value, "1/16") == 0);
    CHECK_STATUS(CARVEL_STATUS_INDEX_OUT_OF_RANGE, carvel_catalogue_entry_at(i, &entry, failure));
    CHECK_STATUS(CARVEL_STATUS_INDEX_OUT_OF_RANGE,
                 carvel_catalogue_parameter_at(UINT64_MAX, 0, &parameter, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_catalogue_entry_at(0, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_catalogue_parameter_at(0, 0, NULL, failure));
    entry.struct_size = 3;
    CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, carvel_catalogue_entry_at(0, &entry, failure));
    CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, carvel_catalogue_parameter_init(&parameter, 3));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_catalogue_entry_init(NULL, sizeof entry));
}

static int is_between(carvel_fraction a, double value, carvel_fraction b)
{
    const double low = (double)a.numerator / (double)a.denominator;
    const double high = (double)b.numerator / (double)b.denominator;
    return low <= value && value <= high && high - low < 1e-3;
}

/* The founding paper's family: C2 for 0 < w < 1/4, C3 for 1/16 alone. */
static void check_ranges(void)
{
    const carvel_fraction low = {-1, 1}, high = {1, 1}, close = {1, 1000}, none = {0, 0};
    carvel_context *context = context_of(1);
    carvel_parameter_range found[4];
    uint64_t count = 0;
    check_context("ranges");
#define RANGES(name, parameter, k, from, tolerance, out, capacity) \
    carvel_catalogue_ranges(name, parameter, NULL, k, from, high, tolerance, out, capacity, \
                            &count, failure)
    CHECK_OK(RANGES("three-point", "w", 2, low, close, found, 4));
    CHECK_UINT(1, count);
    CHECK(is_between(found->low_outside, 0, found->low_inside));
    CHECK(is_between(found->high_inside, 0.25, found->high_outside));
    CHECK_OK(RANGES("three-point", "w", 3, low, close, NULL, 0));
    CHECK_UINT(1, count);
    CHECK_OK(RANGES("three-point", "w", 3, low, close, found, 4));
    CHECK(found->low_inside.numerator == 1 && found->low_inside.denominator == 16);
    CHECK(found->high_inside.denominator == 16 && found->high_outside.denominator == 0);
    CHECK_OK(RANGES("three-point", "w", 4, low, close, found, 4));
    CHECK_UINT(0, count);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 RANGES("three-point", "v", 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 RANGES("b-spline", "degree", 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 RANGES("three-point", "w", 0, high, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_INVALID_NUMBER, RANGES("three", "w", 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_INVALID_NUMBER, RANGES("\xff", "w", 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_INVALID_NUMBER,
                 RANGES("three-point", "w", 0, none, close, found, 4));
    CHECK(strncmp(carvel_error_message(failure), "low: ", 5) == 0);
    /* Before the search, even if it would find nothing. */
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, RANGES("three-point", "w", 4, low, close, NULL, 4));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, RANGES(NULL, "w", 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, RANGES("three-point", NULL, 0, low, close, found, 4));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, RANGES("three-point", "w", 3, low, close, NULL, 4));
    carvel_context_cancel(context);
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_catalogue_ranges("three-point", "w", context, 2, low, high, close, found, 4,
                                         NULL, failure));
    carvel_context_destroy(context);
#undef RANGES
}

static void check_refused(void)
{
    static const double line[] = {0, 1, 2, 3};
    carvel_mask *mask = mask_of("chaikin", 0), *lopsided = mask_of("[2,3,2,1]/4", 0);
    carvel_mask *ternary = mask_of("b-spline:2,3", 0);
    carvel_mask *huge = mask_of("[1,36893488147419103232,36893488147419103231,0]/"
                                "36893488147419103232", 0);
    carvel_const_values_f64 from = from64(line, 4, 1);
    double out[8];
    double nan_at_2[4];
    carvel_values_f64 to = to64(out, 8, 1);
    carvel_polygon_counts counts;
    carvel_mask_analysis analysis;
    carvel_scheme *scheme = NULL;
    carvel_fraction list[4];
    carvel_context *context = context_of(1);
    check_context("refused");
    CHECK_OK(carvel_polygon_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_mask_analysis_init(&analysis, sizeof analysis));
    CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, carvel_polygon_counts_init(&counts, 8));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_mask_analysis_init(NULL, sizeof analysis));
#define REFINE(ends, steps) \
    carvel_mask_refine_f64(mask, NULL, ends, steps, &from, &to, failure)
    CHECK_OK(REFINE(CARVEL_ENDS_CLOSED, 1));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, REFINE(4, 1));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, REFINE(CARVEL_ENDS_CLOSED, 65));
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL, REFINE(CARVEL_ENDS_CLOSED, 2));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE, REFINE(CARVEL_ENDS_CLOSED, 64));
    from.count = 0;
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE(CARVEL_ENDS_CLOSED, 1));
    from.count = 1;
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE(CARVEL_ENDS_KEPT, 1));
    from.count = 4;
    to.width = 2;
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH, REFINE(CARVEL_ENDS_CLOSED, 1));
    from.width = to.width = 0;
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, REFINE(CARVEL_ENDS_CLOSED, 1));
    from.width = to.width = 1;
    to.stride = 4;
    CHECK_STATUS(CARVEL_STATUS_INVALID_STRIDE, REFINE(CARVEL_ENDS_CLOSED, 1));
    to.stride = 0;
    from.data = out;
    CHECK_STATUS(CARVEL_STATUS_OVERLAP, REFINE(CARVEL_ENDS_CLOSED, 1));
    memcpy(nan_at_2, line, sizeof line);
    nan_at_2[2] = nan("");
    from.data = nan_at_2;
    CHECK_STATUS(CARVEL_STATUS_NOT_FINITE, REFINE(CARVEL_ENDS_CLOSED, 1));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_VERTEX, 2, 0);
    from.data = line;
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_refine_f64(NULL, NULL, 0, 1, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_refine_f64(mask, NULL, 0, 1, NULL, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_refine_f64(mask, NULL, 0, 1, &from, NULL, failure));
    carvel_context_cancel(context);
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_mask_refine_f64(mask, context, 0, 1, &from, &to, failure));
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_mask_analyse(mask, context, &analysis, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_mask_counts(lopsided, CARVEL_ENDS_KEPT, 4, 1, &counts, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_counts(mask, CARVEL_ENDS_KEPT, 4, 1, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_mask_counts(mask, CARVEL_ENDS_CLOSED, UINT64_MAX, 1, &counts, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED, carvel_mask_scheme(ternary, &scheme, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED, carvel_mask_scheme(lopsided, &scheme, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_mask_scheme(mask, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE, carvel_mask_coefficients(huge, list, 4, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_BUFFER_TOO_SMALL,
                 carvel_mask_coefficients(mask, list, 3, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_mask_analyse(mask, NULL, NULL, failure));
    carvel_context_destroy(context);
    carvel_mask_destroy(mask);
    carvel_mask_destroy(lopsided);
    carvel_mask_destroy(ternary);
    carvel_mask_destroy(huge);
}

int main(void)
{
    check_begin();
    check_square();
    check_ends();
    check_limits();
    check_grid();
    check_bivariate();
    check_tension();
    check_paper();
    check_texts();
    check_offset();
    check_catalogue();
    check_ranges();
    check_refused();
    return check_end();
}
