/* Every function of stencil tables: they do what a hierarchy does, in one table or
 * step by step, forth and back, for some columns, from a file; and every wrong call. */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 2, WIDTH = 3 };

/* As tests/kernel/support/tolerance.rs: the same sums in another order. */
static const double ROUNDING = 1e-13;
/* The same in single precision. */
static const double SINGLE = 2e-6;

/* ------------------------------------------------------------------ helpers */

static carvel_stencils_desc description(uint32_t from, uint32_t level, int32_t precision)
{
    carvel_stencils_desc desc;
    CHECK_OK(carvel_stencils_desc_init(&desc, sizeof desc));
    desc.from_level = from;
    desc.level = level;
    desc.precision = precision;
    return desc;
}

static carvel_stencils *stencils_of(const carvel_context *context,
                                    const carvel_hierarchy *hierarchy,
                                    const carvel_stencils_desc *desc)
{
    carvel_stencils *it = NULL;
    CHECK_OK(carvel_stencils_create(context, hierarchy, desc, &it, failure));
    return it;
}

static carvel_stencil_counts sizes_of(const carvel_stencils *it)
{
    carvel_stencil_counts counts;
    CHECK_OK(carvel_stencil_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_stencils_counts(it, &counts, failure));
    return counts;
}

/* Records one after the other. */
static carvel_const_values_f64 from64(const double *data, uint64_t count)
{
    carvel_const_values_f64 it;
    it.data = data;
    it.count = count;
    it.width = WIDTH;
    it.stride = 0;
    return it;
}

static carvel_values_f64 to64(double *data, uint64_t count)
{
    carvel_values_f64 it;
    it.data = data;
    it.count = count;
    it.width = WIDTH;
    it.stride = 0;
    return it;
}

/* Records with a gap of one value. */
static carvel_const_values_f32 from32(const float *data, uint64_t count)
{
    carvel_const_values_f32 it;
    it.data = data;
    it.count = count;
    it.width = WIDTH;
    it.stride = (WIDTH + 1) * sizeof *data;
    return it;
}

static carvel_values_f32 to32(float *data, uint64_t count)
{
    carvel_values_f32 it;
    it.data = data;
    it.count = count;
    it.width = WIDTH;
    it.stride = (WIDTH + 1) * sizeof *data;
    return it;
}

static double *randoms(uint64_t count, uint64_t seed)
{
    double *values = TAKE(double, count);
    uint64_t i;
    for (i = 0; i < count; i++)
        values[i] = random_double(&seed);
    return values;
}

static int close_by(const double *a, const double *b, uint64_t count, double tolerance)
{
    uint64_t i;
    for (i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= tolerance))
            return 0;
    return 1;
}

static double dot(const double *a, const double *b, uint64_t count)
{
    double sum = 0;
    uint64_t i;
    for (i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* A mesh, a hierarchy without the last level, and what refinement makes of positions. */
typedef struct fixture {
    poly *soup;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_hierarchy *hierarchy;
    carvel_context *context;
    uint64_t control, refined;
    double *expected;
} fixture;

static void set_up(fixture *it, int32_t family)
{
    carvel_hierarchy *whole;
    carvel_counts counts;
    carvel_const_values_f64 from;
    carvel_values_f64 to;
    it->soup = poly_grid(3, 4);
    it->mesh = poly_mesh(it->soup);
    it->scheme = scheme_of(family, CARVEL_BOUNDARY_EDGE_AND_CORNER);
    it->hierarchy = hierarchy_of(it->mesh, it->scheme, LEVELS - 1);
    it->context = context_of(2);
    whole = hierarchy_of(it->mesh, it->scheme, LEVELS);
    counts = predicted(it->mesh, it->scheme, LEVELS);
    it->control = it->soup->vertices;
    it->refined = counts.vertices;
    it->expected = TAKE(double, WIDTH * it->refined);
    from = from64(it->soup->positions, it->control);
    to = to64(it->expected, it->refined);
    CHECK_OK(carvel_hierarchy_refine_f64(whole, NULL, LEVELS, &from, &to, failure));
    carvel_hierarchy_destroy(whole);
}

static void tear_down(fixture *it)
{
    free(it->expected);
    carvel_context_destroy(it->context);
    carvel_hierarchy_destroy(it->hierarchy);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->soup);
}

/* ------------------------------------------------------------------- operators */

static void check_apply(const fixture *with, const carvel_stencils *table)
{
    uint64_t n = WIDTH * with->refined, i;
    double *out = TAKE(double, n);
    carvel_const_values_f64 from = from64(with->soup->positions, with->control);
    carvel_values_f64 to = to64(out, with->refined);
    CHECK_OK(carvel_stencils_apply_f64(table, NULL, &from, &to, failure));
    CHECK(close_by(with->expected, out, n, ROUNDING));
    CHECK_OK(carvel_stencils_apply_add_f64(table, with->context, &from, &to, failure));
    for (i = 0; i < n; i++)
        out[i] /= 2;
    CHECK(close_by(with->expected, out, n, ROUNDING));
    free(out);
}

/* Floats with gaps, which stay as they are; twice, the second time added. */
static void check_strides(const fixture *with, const carvel_stencils *table)
{
    uint64_t i, k;
    float *values = TAKE(float, (WIDTH + 1) * with->control);
    float *out = TAKE(float, (WIDTH + 1) * with->refined);
    carvel_const_values_f32 from = from32(values, with->control);
    carvel_values_f32 to = to32(out, with->refined);
    int turn, good = 1;
    for (i = 0; i < with->control; i++)
        for (k = 0; k < WIDTH; k++)
            values[i * (WIDTH + 1) + k] = (float)with->soup->positions[i * WIDTH + k];
    for (i = 0; i < with->refined; i++)
        out[i * (WIDTH + 1) + WIDTH] = 777;
    for (turn = 1; turn <= 2; turn++) {
        if (turn == 1)
            CHECK_OK(carvel_stencils_apply_f32(table, with->context, &from, &to, failure));
        else
            CHECK_OK(carvel_stencils_apply_add_f32(table, NULL, &from, &to, failure));
        for (i = 0; i < with->refined; i++) {
            good = good && out[i * (WIDTH + 1) + WIDTH] == 777;
            for (k = 0; k < WIDTH; k++)
                good = good && fabs(out[i * (WIDTH + 1) + k] -
                                    turn * with->expected[i * WIDTH + k]) < 8 * SINGLE;
        }
    }
    CHECK(good);
    free(values);
    free(out);
}

/* <Ax, y> = <x, A'y>; the transpose as a table gives the same bytes. */
static void check_transpose(const fixture *with, const carvel_stencils *table)
{
    uint64_t n = WIDTH * with->control, m = WIDTH * with->refined, i;
    double *y = randoms(m, 7), *back = TAKE(double, n), *again = TAKE(double, n);
    float *y32 = TAKE(float, (WIDTH + 1) * with->refined);
    float *back32 = TAKE(float, (WIDTH + 1) * with->control);
    carvel_stencils *turned = NULL;
    carvel_const_values_f64 from = from64(y, with->refined);
    carvel_values_f64 to = to64(back, with->control), other = to64(again, with->control);
    carvel_const_values_f32 single = from32(y32, with->refined);
    carvel_values_f32 single_to = to32(back32, with->control);
    int good = 1;
    CHECK_OK(carvel_stencils_apply_transpose_f64(table, with->context, &from, &to, failure));
    CHECK(fabs(dot(with->expected, y, m) - dot(with->soup->positions, back, n)) < 1e-10);
    CHECK_OK(carvel_stencils_transpose(NULL, table, &turned, failure));
    CHECK_UINT(with->control, sizes_of(turned).rows);
    CHECK_OK(carvel_stencils_apply_f64(turned, NULL, &from, &other, failure));
    CHECK_BYTES(back, again, n * sizeof *back);
    for (i = 0; i < m; i++)
        y32[i / WIDTH * (WIDTH + 1) + i % WIDTH] = (float)y[i];
    CHECK_OK(carvel_stencils_apply_transpose_f32(table, NULL, &single, &single_to, failure));
    for (i = 0; i < n; i++)
        good = good && fabs(back32[i / WIDTH * (WIDTH + 1) + i % WIDTH] - back[i]) < 1e-4;
    CHECK(good);
    carvel_stencils_destroy(turned);
    free(y);
    free(back);
    free(again);
    free(y32);
    free(back32);
}

/* Two columns change; the rows that know neither are not touched. */
static void check_update(const fixture *with, const carvel_stencils *table)
{
    static const uint32_t changed[3] = {5, 0, 5};
    uint64_t n = WIDTH * with->refined, i, kept = 0;
    double *values = randoms(WIDTH * with->control, 3);
    double *out = TAKE(double, n), *all = TAKE(double, n);
    float *values32 = TAKE(float, (WIDTH + 1) * with->control);
    float *out32 = TAKE(float, (WIDTH + 1) * with->refined);
    float *all32 = TAKE(float, (WIDTH + 1) * with->refined);
    carvel_const_values_f64 from = from64(values, with->control);
    carvel_values_f64 to = to64(out, with->refined), full = to64(all, with->refined);
    carvel_const_values_f32 single = from32(values32, with->control);
    carvel_values_f32 single_to = to32(out32, with->refined);
    carvel_values_f32 single_full = to32(all32, with->refined);
    uint64_t before = sizes_of(table).bytes;
    for (i = 0; i < n; i++)
        out[i] = 777;
    CHECK_OK(carvel_stencils_apply_f64(table, NULL, &from, &full, failure));
    CHECK_OK(carvel_stencils_update_f64(table, with->context, changed, 3, &from, &to, failure));
    for (i = 0; i < n; i++)
        if (out[i] == 777) {
            kept++;
            all[i] = 777;
        }
    CHECK(kept > 0 && kept < n);
    CHECK_BYTES(all, out, n * sizeof *out);
    CHECK(sizes_of(table).bytes > before);
    CHECK_OK(carvel_stencils_update_f64(table, NULL, NULL, 0, &from, &to, failure));
    CHECK_BYTES(all, out, n * sizeof *out);

    for (i = 0; i < WIDTH * with->control; i++)
        values32[i / WIDTH * (WIDTH + 1) + i % WIDTH] = (float)values[i];
    CHECK_OK(carvel_stencils_apply_f32(table, NULL, &single, &single_full, failure));
    memcpy(out32, all32, (WIDTH + 1) * with->refined * sizeof *out32);
    values32[0] = 9;
    CHECK_OK(carvel_stencils_apply_f32(table, NULL, &single, &single_full, failure));
    CHECK_OK(carvel_stencils_update_f32(table, NULL, changed, 3, &single, &single_to, failure));
    CHECK_BYTES(all32, out32, (WIDTH + 1) * with->refined * sizeof *out32);
    free(values);
    free(out);
    free(all);
    free(values32);
    free(out32);
    free(all32);
}

/* The arrays reproduce the values, and rows sum to one. */
static void check_csr(const fixture *with, const carvel_stencils *table)
{
    carvel_stencil_counts counts = sizes_of(table);
    uint64_t *offsets = TAKE(uint64_t, counts.rows + 1), row, e, k;
    uint32_t *indices = TAKE(uint32_t, counts.entries);
    double *weights = TAKE(double, counts.entries);
    float *singles = TAKE(float, counts.entries);
    int good = 1;
    CHECK_OK(carvel_stencils_csr_f64(table, offsets, counts.rows + 1, indices, weights,
                                     counts.entries, failure));
    CHECK_OK(carvel_stencils_csr_f32(table, offsets, counts.rows + 1, indices, singles,
                                     counts.entries, failure));
    CHECK_UINT(counts.entries, offsets[counts.rows]);
    for (row = 0; row < counts.rows; row++) {
        double sum[WIDTH + 1] = {0, 0, 0, 0};
        for (e = offsets[row]; e < offsets[row + 1]; e++) {
            good = good && singles[e] == (float)weights[e];
            for (k = 0; k < WIDTH; k++)
                sum[k] += weights[e] * with->soup->positions[indices[e] * WIDTH + k];
            sum[WIDTH] += weights[e];
        }
        good = good && fabs(sum[WIDTH] - 1) < ROUNDING &&
               close_by(sum, with->expected + row * WIDTH, WIDTH, ROUNDING);
    }
    CHECK(good);
    free(offsets);
    free(indices);
    free(weights);
    free(singles);
}

/* Step after step is the whole way; a product is both. */
static void check_steps(const fixture *with)
{
    carvel_stencils_desc first = description(0, 1, CARVEL_PRECISION_F64);
    carvel_stencils_desc second = description(1, LEVELS, CARVEL_PRECISION_F64);
    carvel_stencils *a = stencils_of(NULL, with->hierarchy, &first);
    carvel_stencils *b = stencils_of(with->context, with->hierarchy, &second);
    carvel_stencils *both = NULL;
    CHECK_UINT(sizes_of(a).rows, sizes_of(b).columns);
    CHECK_OK(carvel_stencils_product(with->context, a, b, &both, failure));
    check_apply(with, both);
    carvel_stencils_destroy(both);
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH,
                 carvel_stencils_product(NULL, b, a, &both, failure));
    CHECK(both == NULL);
    carvel_stencils_destroy(a);
    carvel_stencils_destroy(b);
}

/* Some vertices, in an order of one's own. */
static void check_selection(const fixture *with)
{
    uint32_t list[3];
    double out[3 * WIDTH];
    uint64_t i;
    carvel_stencils_desc desc = description(0, LEVELS, CARVEL_PRECISION_F64);
    carvel_const_values_f64 from = from64(with->soup->positions, with->control);
    carvel_values_f64 to = to64(out, 3);
    carvel_stencils *it;
    list[0] = (uint32_t)with->refined - 1;
    list[1] = 2;
    list[2] = list[0];
    desc.vertices = list;
    desc.vertex_count = 3;
    it = stencils_of(NULL, with->hierarchy, &desc);
    CHECK_UINT(3, sizes_of(it).rows);
    CHECK_OK(carvel_stencils_apply_f64(it, NULL, &from, &to, failure));
    for (i = 0; i < 3; i++)
        CHECK(close_by(with->expected + WIDTH * list[i], out + WIDTH * i, WIDTH, ROUNDING));
    carvel_stencils_destroy(it);
    desc.vertex_count = 0;
    it = stencils_of(NULL, with->hierarchy, &desc);
    CHECK_UINT(0, sizes_of(it).rows);
    to.count = 0;
    CHECK_OK(carvel_stencils_apply_f64(it, NULL, &from, &to, failure));
    carvel_stencils_destroy(it);
    list[1] = (uint32_t)with->refined;
    desc.vertex_count = 3;
    it = NULL;
    CHECK_STATUS(CARVEL_STATUS_INDEX_OUT_OF_RANGE,
                 carvel_stencils_create(NULL, with->hierarchy, &desc, &it, failure));
    CHECK(it == NULL);
}

/* ----------------------------------------------------------------------- files */

static void check_file(const fixture *with, const carvel_stencils *table, const char *path)
{
    carvel_stencils *read = NULL;
    carvel_stencil_counts before = sizes_of(table), after;
    FILE *file;
    int c;
    CHECK_OK(carvel_stencils_save(table, path, failure));
    CHECK_OK(carvel_stencils_load(path, &read, failure));
    after = sizes_of(read);
    CHECK_UINT(before.entries, after.entries);
    CHECK_UINT(before.precision, after.precision);
    check_apply(with, read);
    carvel_stencils_destroy(read);

    file = fopen(path, "r+b");
    if (CHECK(file != NULL)) {
        CHECK(fseek(file, 100, SEEK_SET) == 0 && (c = fgetc(file)) != EOF &&
              fseek(file, 100, SEEK_SET) == 0 && fputc(c ^ 1, file) != EOF);
        fclose(file);
    }
    CHECK_STATUS(CARVEL_STATUS_SYNTAX, carvel_stencils_load(path, &read, failure));
    CHECK(read == NULL);
    file = fopen(path, "wb");
    if (CHECK(file != NULL))
        fclose(file);
    CHECK_STATUS(CARVEL_STATUS_SYNTAX, carvel_stencils_load(path, &read, failure));
    remove(path);
    CHECK_STATUS(CARVEL_STATUS_IO, carvel_stencils_load(path, &read, failure));
    CHECK_STATUS(CARVEL_STATUS_IO, carvel_stencils_load(".", &read, failure));
    CHECK_STATUS(CARVEL_STATUS_IO, carvel_stencils_save(table, "/no/such/folder/x", failure));
}

/* ---------------------------------------------------------------------- misuse */

#define REFUSE(status, call) CHECK_STATUS(CARVEL_STATUS_##status, call)
/* A pointer that is not aligned. */
#define OFF(type, pointer) ((type *)(void *)((char *)(void *)(uintptr_t)(pointer) + 1))

static void check_wrong_descriptions(const fixture *with)
{
    carvel_stencils_desc right = description(0, LEVELS, CARVEL_PRECISION_F32), wrong;
    carvel_stencils *it = NULL;
    const carvel_hierarchy *h = with->hierarchy;
    REFUSE(NULL_POINTER, carvel_stencils_create(NULL, NULL, &right, &it, failure));
    REFUSE(NULL_POINTER, carvel_stencils_create(NULL, h, NULL, &it, failure));
    REFUSE(NULL_POINTER, carvel_stencils_create(NULL, h, &right, NULL, failure));
    REFUSE(MISALIGNED, carvel_stencils_create(NULL, h, &right, OFF(carvel_stencils *, &it),
                                              failure));
    REFUSE(MISALIGNED, carvel_stencils_create(NULL, h, &right, &it, OFF(carvel_error, failure)));
#define WRONG(status, field, value) \
    (wrong = right, wrong.field = (value), \
     REFUSE(status, carvel_stencils_create(NULL, h, &wrong, &it, failure)), CHECK(it == NULL))
    WRONG(STRUCT_SIZE, struct_size, 0);
    WRONG(STRUCT_SIZE, struct_size, (uint32_t)sizeof wrong + 8);
    WRONG(PARAMETER_OUT_OF_RANGE, from_level, LEVELS + 1);
    WRONG(PARAMETER_OUT_OF_RANGE, level, LEVELS + 1);
    WRONG(PARAMETER_OUT_OF_RANGE, level, UINT32_MAX);
    WRONG(PARAMETER_OUT_OF_RANGE, interpolation, 2);
    WRONG(PARAMETER_OUT_OF_RANGE, precision, 2);
    WRONG(PARAMETER_OUT_OF_RANGE, precision, -1);
    WRONG(PARAMETER_OUT_OF_RANGE, reserved, 1);
    WRONG(NULL_POINTER, vertex_count, 1);
    REFUSE(STRUCT_SIZE, carvel_stencils_desc_init(&wrong, 1));
    REFUSE(NULL_POINTER, carvel_stencils_desc_init(NULL, sizeof wrong));
    REFUSE(NULL_POINTER, carvel_stencil_counts_init(NULL, sizeof(carvel_stencil_counts)));
}

static void check_wrong_calls(const fixture *with, const carvel_stencils *table)
{
    carvel_stencil_counts counts = sizes_of(table), small;
    carvel_stencils *it = NULL;
    uint64_t *offsets = TAKE(uint64_t, counts.rows + 1);
    uint32_t *indices = TAKE(uint32_t, counts.entries);
    double *weights = TAKE(double, counts.entries);
    static const uint32_t beyond[1] = {UINT32_MAX};
    double *out = TAKE(double, WIDTH * with->refined);
    carvel_const_values_f64 from = from64(with->soup->positions, with->control), f;
    carvel_values_f64 to = to64(out, with->refined), t;
    small = counts;
    small.struct_size = 3;
    REFUSE(STRUCT_SIZE, carvel_stencils_counts(table, &small, failure));
    REFUSE(NULL_POINTER, carvel_stencils_counts(NULL, &counts, failure));
    REFUSE(NULL_POINTER, carvel_stencils_counts(table, NULL, failure));
    REFUSE(NULL_POINTER, carvel_stencils_transpose(NULL, NULL, &it, failure));
    REFUSE(NULL_POINTER, carvel_stencils_product(NULL, table, NULL, &it, failure));
    REFUSE(NULL_POINTER, carvel_stencils_save(table, NULL, failure));
    REFUSE(NULL_POINTER, carvel_stencils_load(NULL, &it, failure));
    REFUSE(BUFFER_TOO_SMALL, carvel_stencils_csr_f64(table, offsets, counts.rows, indices, weights,
                                                     counts.entries, failure));
    REFUSE(BUFFER_TOO_SMALL, carvel_stencils_csr_f64(table, offsets, counts.rows + 1, indices,
                                                     weights, counts.entries - 1, failure));
    REFUSE(OVERLAP, carvel_stencils_csr_f64(table, offsets, counts.rows + 1, indices,
                                            (double *)(void *)offsets, counts.entries, failure));
    REFUSE(NULL_POINTER, carvel_stencils_csr_f64(table, offsets, counts.rows + 1, NULL, weights,
                                                 counts.entries, failure));
#define APPLY(status, f, t) \
    (REFUSE(status, carvel_stencils_apply_f64(table, NULL, (f), (t), failure)), \
     REFUSE(status, carvel_stencils_apply_add_f64(table, NULL, (f), (t), failure)), \
     REFUSE(status, carvel_stencils_update_f64(table, NULL, NULL, 0, (f), (t), failure)))
    APPLY(NULL_POINTER, NULL, &to);
    APPLY(NULL_POINTER, &from, NULL);
    f = from, f.count--;
    APPLY(LENGTH_MISMATCH, &f, &to);
    f = from, f.width = 0;
    APPLY(PARAMETER_OUT_OF_RANGE, &f, &to);
    f = from, f.stride = 8;
    APPLY(INVALID_STRIDE, &f, &to);
    f = from, f.stride = 28;
    APPLY(MISALIGNED, &f, &to);
    t = to, t.count--;
    APPLY(BUFFER_TOO_SMALL, &from, &t);
    t = to, t.width = 2;
    APPLY(LENGTH_MISMATCH, &from, &t);
    t = to, t.data = with->soup->positions;
    APPLY(OVERLAP, &from, &t);
    /* Records of the output between those of the input. */
    f = from, f.data = out, f.stride = 2 * WIDTH * sizeof *out;
    t = to, t.data = out + WIDTH, t.stride = f.stride;
    APPLY(OVERLAP, &f, &t);
    REFUSE(LENGTH_MISMATCH, carvel_stencils_apply_transpose_f64(table, NULL, &from, &to, failure));
    REFUSE(INDEX_OUT_OF_RANGE,
           carvel_stencils_update_f64(table, NULL, beyond, 1, &from, &to, failure));
    REFUSE(NULL_POINTER, carvel_stencils_update_f64(table, NULL, NULL, 1, &from, &to, failure));
    REFUSE(NULL_POINTER, carvel_stencils_apply_f64(NULL, NULL, &from, &to, failure));
    carvel_context_cancel(with->context);
    REFUSE(CANCELLED, carvel_stencils_apply_f64(table, with->context, &from, &to, failure));
    carvel_context_reset(with->context);
    carvel_stencils_destroy(NULL);
    free(offsets);
    free(indices);
    free(weights);
    free(out);
}

/* Limits: weights of positions sum to one, those of tangents to nothing. */
static void check_limits(const fixture *with)
{
    carvel_stencils_desc desc = description(0, LEVELS - 1, CARVEL_PRECISION_F64);
    carvel_stencils *level = stencils_of(NULL, with->hierarchy, &desc), *limits = NULL, *it = NULL;
    carvel_stencils *all = NULL;
    carvel_stencil_counts counts;
    uint64_t vertices = sizes_of(level).rows, *offsets, row, entry;
    uint32_t *indices;
    double *weights;
    CHECK_OK(carvel_stencils_create_limits(with->context, with->hierarchy, LEVELS - 1,
                                           CARVEL_PRECISION_F64, &limits, failure));
    counts = sizes_of(limits);
    CHECK_UINT(3 * vertices, counts.rows);
    CHECK_UINT(vertices, counts.columns);
    offsets = TAKE(uint64_t, counts.rows + 1);
    indices = TAKE(uint32_t, counts.entries);
    weights = TAKE(double, counts.entries);
    CHECK_OK(carvel_stencils_csr_f64(limits, offsets, counts.rows + 1, indices, weights,
                                     counts.entries, failure));
    for (row = 0; row < counts.rows; row++) {
        double sum = 0;
        for (entry = offsets[row]; entry < offsets[row + 1]; entry++)
            sum += weights[entry];
        CHECK(fabs(sum - (row < vertices)) < ROUNDING);
        CHECK(offsets[row] < offsets[row + 1]);
    }
    CHECK_OK(carvel_stencils_product(NULL, level, limits, &all, failure));
    CHECK_UINT(with->control, sizes_of(all).columns);
    REFUSE(NULL_POINTER,
           carvel_stencils_create_limits(NULL, NULL, 0, CARVEL_PRECISION_F64, &it, failure));
    REFUSE(NULL_POINTER, carvel_stencils_create_limits(NULL, with->hierarchy, 0,
                                                       CARVEL_PRECISION_F64, NULL, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_stencils_create_limits(NULL, with->hierarchy, LEVELS, CARVEL_PRECISION_F64,
                                         &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_stencils_create_limits(NULL, with->hierarchy, 0, 7, &it, failure));
    carvel_context_cancel(with->context);
    REFUSE(CANCELLED, carvel_stencils_create_limits(with->context, with->hierarchy, 0,
                                                    CARVEL_PRECISION_F32, &it, failure));
    carvel_context_reset(with->context);
    CHECK(it == NULL);
    carvel_stencils_destroy(level);
    carvel_stencils_destroy(limits);
    carvel_stencils_destroy(all);
    free(offsets);
    free(indices);
    free(weights);
}

static void check_precisions(const fixture *with, const carvel_stencils *table)
{
    carvel_stencils_desc desc = description(0, 1, CARVEL_PRECISION_F32);
    carvel_stencils *single = stencils_of(NULL, with->hierarchy, &desc), *it = NULL;
    carvel_stencils_desc step = description(1, LEVELS, CARVEL_PRECISION_F64);
    carvel_stencils *next = stencils_of(NULL, with->hierarchy, &step);
    CHECK_UINT(CARVEL_PRECISION_F32, sizes_of(single).precision);
    CHECK_UINT(CARVEL_PRECISION_F64, sizes_of(table).precision);
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_stencils_product(NULL, single, next, &it, failure));
    CHECK(it == NULL);
    carvel_stencils_destroy(single);
    carvel_stencils_destroy(next);
}

static void check_varying(const fixture *with, int primal)
{
    carvel_stencils_desc desc = description(0, LEVELS, CARVEL_PRECISION_F64);
    carvel_stencils *it = NULL;
    desc.interpolation = CARVEL_INTERPOLATION_VARYING;
    CHECK_STATUS(primal ? CARVEL_STATUS_OK : CARVEL_STATUS_UNSUPPORTED,
                 carvel_stencils_create(NULL, with->hierarchy, &desc, &it, failure));
    CHECK((it != NULL) == primal);
    carvel_stencils_destroy(it);
}

int main(int count, char **arguments)
{
    static const int32_t families[3] = {CARVEL_SCHEME_CATMULL_CLARK, CARVEL_SCHEME_THREE_POINT,
                                        CARVEL_SCHEME_DOO_SABIN};
    const char *path = count > 1 ? arguments[1] : "stencils.tmp";
    fixture with;
    int i;
    check_begin();
    for (i = 0; i < 3; i++) {
        carvel_stencils_desc desc = description(0, LEVELS, CARVEL_PRECISION_F64);
        carvel_stencils *table;
        set_up(&with, families[i]);
        table = stencils_of(with.context, with.hierarchy, &desc);
        CHECK_UINT(with.refined, sizes_of(table).rows);
        CHECK_UINT(with.control, sizes_of(table).columns);
        check_apply(&with, table);
        check_strides(&with, table);
        check_transpose(&with, table);
        check_update(&with, table);
        check_csr(&with, table);
        check_steps(&with);
        check_limits(&with);
        check_selection(&with);
        check_varying(&with, i == 0);
        check_precisions(&with, table);
        check_file(&with, table, path);
        check_wrong_descriptions(&with);
        check_wrong_calls(&with, table);
        carvel_stencils_destroy(table);
        tear_down(&with);
    }
    return check_end();
}
