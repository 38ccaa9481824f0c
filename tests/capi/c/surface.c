/* Every function of surfaces: points known by hand, derivatives against differences,
 * tables against evaluation, any layout of values; and every wrong call. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 3, COUNT = 4 };

static const double ROUNDING = 1e-13;
static const double SINGLE = 2e-6;

/* A torus of quads, where every point has two derivatives, or an octahedron. */
typedef struct fixture {
    poly *soup;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_surface *surface;
    carvel_context *context;
    carvel_sample samples[COUNT];
} fixture;

static carvel_sample sample_at(uint32_t face, uint32_t sector, double u, double v)
{
    carvel_sample it;
    it.face = face;
    it.sector = sector;
    it.u = u;
    it.v = v;
    return it;
}

static void set_up(fixture *it, poly *soup, int32_t family)
{
    it->soup = soup;
    it->mesh = poly_mesh(soup);
    it->scheme = scheme_of(family, 0);
    it->context = context_of(2);
    it->surface = NULL;
    CHECK_OK(carvel_surface_create(it->context, it->mesh, it->scheme, &it->surface, failure));
    it->samples[0] = sample_at(0, 0, 0.25, 0.5);
    it->samples[1] = sample_at(3, 0, 0.125, 0.75);
    it->samples[2] = sample_at(5, 0, 0.375, 0.0625);
    it->samples[3] = sample_at(0, 0, 0.6, 0.3);
}

static void tear_down(fixture *it)
{
    carvel_surface_destroy(it->surface);
    carvel_context_destroy(it->context);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->soup);
}

static carvel_const_values_f64 control64(const fixture *it)
{
    carvel_const_values_f64 values;
    values.data = it->soup->positions;
    values.count = it->soup->vertices;
    values.width = WIDTH;
    values.stride = 0;
    return values;
}

static carvel_values_f64 to64(double *data, uint64_t count)
{
    carvel_values_f64 values;
    values.data = data;
    values.count = count;
    values.width = WIDTH;
    values.stride = 0;
    return values;
}

static void evaluate(const fixture *it, const carvel_sample *samples, uint64_t count,
                     int32_t derivatives, double *out, uint64_t records)
{
    carvel_const_values_f64 from = control64(it);
    carvel_values_f64 to = to64(out, records);
    CHECK_OK(carvel_surface_evaluate_f64(it->surface, it->context, samples, count, derivatives,
                                         &from, &to, failure));
}

static void check_near(const double *expected, const double *found, uint64_t count,
                       double tolerance)
{
    uint64_t i;
    for (i = 0; i < count; i++)
        if (!CHECK(fabs(expected[i] - found[i]) <= tolerance))
            return;
}

/* ------------------------------------------------------------------- by hand */

/* Values are 0 on one quad of a cube and 1 on the opposite one, which are the first two:
 * the limits at their middles add up to 1. */
static void check_cube(void)
{
    fixture with;
    carvel_sample middles[2];
    double out[2 * WIDTH], expected[WIDTH];
    uint64_t v, k;
    set_up(&with, poly_cube(), CARVEL_SCHEME_CATMULL_CLARK);
    for (v = 0; v < 8; v++)
        for (k = 0; k < WIDTH; k++)
            with.soup->positions[v * WIDTH + k] = v < 4 ? 0 : 1;
    middles[0] = sample_at(0, 0, 0.5, 0.5);
    middles[1] = sample_at(1, 0, 0.5, 0.5);
    evaluate(&with, middles, 2, CARVEL_DERIVATIVES_NONE, out, 2);
    for (k = 0; k < WIDTH; k++)
        expected[k] = 1 - out[WIDTH + k];
    check_near(expected, out, WIDTH, ROUNDING);
    CHECK(out[0] > 0 && out[0] < 0.5);
    tear_down(&with);
}

/* Values that are the same everywhere stay; their derivatives are 0. */
static void check_constants(const fixture *with)
{
    double out[6 * COUNT * WIDTH], *before = TAKE(double, WIDTH * with->soup->vertices);
    uint64_t i, n = WIDTH * with->soup->vertices;
    memcpy(before, with->soup->positions, n * sizeof *before);
    for (i = 0; i < n; i++)
        with->soup->positions[i] = 7;
    evaluate(with, with->samples, COUNT, CARVEL_DERIVATIVES_SECOND, out, 6 * COUNT);
    for (i = 0; i < 6 * COUNT * WIDTH; i++)
        CHECK(fabs(out[i] - (i / WIDTH % 6 == 0 ? 7 : 0)) < 1e-11);
    memcpy(with->soup->positions, before, n * sizeof *before);
    free(before);
}

/* Derivatives are those of the positions beside. */
static void check_derivatives(const fixture *with)
{
    static const double STEP = 1e-6;
    double all[6 * COUNT * WIDTH], near[4 * COUNT * 3 * WIDTH];
    carvel_sample around[4 * COUNT];
    uint64_t i, k;
    evaluate(with, with->samples, COUNT, CARVEL_DERIVATIVES_SECOND, all, 6 * COUNT);
    for (i = 0; i < COUNT; i++) {
        for (k = 0; k < 4; k++)
            around[4 * i + k] = with->samples[i];
        around[4 * i].u += STEP;
        around[4 * i + 1].u -= STEP;
        around[4 * i + 2].v += STEP;
        around[4 * i + 3].v -= STEP;
    }
    evaluate(with, around, 4 * COUNT, CARVEL_DERIVATIVES_FIRST, near, 12 * COUNT);
    for (i = 0; i < COUNT; i++)
        for (k = 0; k < WIDTH; k++) {
            const double *at = all + 6 * WIDTH * i + k, *by = near + 12 * WIDTH * i + k;
            /* Differences of records `a` of the samples on both sides. */
#define ACROSS(first, a) ((by[WIDTH * (3 * (first) + (a))] - \
                           by[WIDTH * (3 * ((first) + 1) + (a))]) / (2 * STEP))
            CHECK(fabs(at[WIDTH] - ACROSS(0, 0)) < 1e-6);
            CHECK(fabs(at[2 * WIDTH] - ACROSS(2, 0)) < 1e-6);
            CHECK(fabs(at[3 * WIDTH] - ACROSS(0, 1)) < 1e-5);
            CHECK(fabs(at[4 * WIDTH] - ACROSS(2, 1)) < 1e-5);
            CHECK(fabs(at[4 * WIDTH] - ACROSS(0, 2)) < 1e-5);
            CHECK(fabs(at[5 * WIDTH] - ACROSS(2, 2)) < 1e-5);
        }
}

/* ------------------------------------------------------------------- layouts */

/* Floats with gaps, which stay as they are. */
static void check_strides(const fixture *with)
{
    enum { GAP = WIDTH + 1, ROWS = 3 * COUNT };
    double expected[ROWS * WIDTH];
    float *values = TAKE(float, GAP * with->soup->vertices), out[ROWS * GAP];
    carvel_const_values_f32 from;
    carvel_values_f32 to;
    uint64_t i;
    for (i = 0; i < WIDTH * with->soup->vertices; i++)
        values[i / WIDTH * GAP + i % WIDTH] = (float)with->soup->positions[i];
    for (i = 0; i < ROWS * GAP; i++)
        out[i] = 777;
    from.data = values;
    from.count = with->soup->vertices;
    from.width = WIDTH;
    from.stride = GAP * sizeof *values;
    to.data = out;
    to.count = ROWS;
    to.width = WIDTH;
    to.stride = GAP * sizeof *out;
    evaluate(with, with->samples, COUNT, CARVEL_DERIVATIVES_FIRST, expected, ROWS);
    CHECK_OK(carvel_surface_evaluate_f32(with->surface, NULL, with->samples, COUNT,
                                         CARVEL_DERIVATIVES_FIRST, &from, &to, failure));
    for (i = 0; i < ROWS * GAP; i++) {
        double is = i % GAP == WIDTH ? 777 : expected[i / GAP * WIDTH + i % GAP];
        CHECK(fabs(out[i] - is) < 16 * SINGLE);
    }
    free(values);
}

/* ------------------------------------------------------------------- channels */

/* Two quads with a seam: across it values jump, along it they are those of either side. A
 * surface outlives its channel. */
static void check_channel(void)
{
    static const uint32_t indices[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    static const double values[8 * 2] = {0, 0, 1, 0, 1, 1, 0, 1, 5, 0, 6, 0, 6, 1, 5, 1};
    poly *soup = poly_grid(2, 1);
    carvel_mesh *mesh = poly_mesh(soup);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_scheme *other = scheme_of(CARVEL_SCHEME_QUARTIC, 0);
    carvel_channel *channel = NULL;
    carvel_channel_desc desc;
    carvel_surface *surface = NULL;
    carvel_sample samples[2];
    carvel_const_values_f64 from;
    double uvs[2 * 2];
    carvel_values_f64 to;
    uint32_t sectors = 0;
    CHECK_OK(carvel_channel_desc_init(&desc, sizeof desc));
    desc.mode = CARVEL_FACE_VARYING_ALL;
    desc.indices = indices;
    desc.index_count = 8;
    desc.value_count = 8;
    CHECK_OK(carvel_channel_create(mesh, &desc, &channel, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_surface_create_channel(NULL, channel, other, &surface, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_surface_create_channel(NULL, NULL, scheme, &surface, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_surface_create_channel(NULL, channel, scheme, NULL, failure));
    CHECK(surface == NULL);
    CHECK_OK(carvel_surface_create_channel(NULL, channel, scheme, &surface, failure));
    carvel_channel_destroy(channel);
    CHECK_OK(carvel_surface_sectors(surface, 1, &sectors, failure));
    CHECK_UINT(1, sectors);
    samples[0] = sample_at(0, 0, 1, 0.5);
    samples[1] = sample_at(1, 0, 0.25, 0.5);
    from.data = values;
    from.count = 8;
    from.width = to.width = 2;
    from.stride = to.stride = 0;
    to.data = uvs;
    to.count = 2;
    CHECK_OK(carvel_surface_evaluate_f64(surface, NULL, samples, 2, CARVEL_DERIVATIVES_NONE,
                                         &from, &to, failure));
    CHECK(uvs[0] == 1 && uvs[1] == 0.5 && uvs[2] == 5.25 && uvs[3] == 0.5);
    from.count = 6;
    CHECK_STATUS(CARVEL_STATUS_LENGTH_MISMATCH,
                 carvel_surface_evaluate_f64(surface, NULL, samples, 2, CARVEL_DERIVATIVES_NONE,
                                             &from, &to, failure));
    carvel_surface_destroy(surface);
    carvel_scheme_destroy(other);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(soup);
}

/* -------------------------------------------------------------------- tables */

static void check_table(const fixture *with, int32_t derivatives, uint64_t records)
{
    double expected[6 * COUNT * WIDTH], found[6 * COUNT * WIDTH];
    carvel_stencils *table = NULL, *single = NULL;
    carvel_stencil_counts counts;
    carvel_const_values_f64 from = control64(with);
    carvel_values_f64 to = to64(found, records * COUNT);
    CHECK_OK(carvel_stencil_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_surface_stencils(with->context, with->surface, with->samples, COUNT,
                                     derivatives, CARVEL_PRECISION_F64, &table, failure));
    CHECK_OK(carvel_stencils_counts(table, &counts, failure));
    CHECK_UINT(records * COUNT, counts.rows);
    CHECK_UINT(with->soup->vertices, counts.columns);
    CHECK_UINT(CARVEL_PRECISION_F64, counts.precision);
    evaluate(with, with->samples, COUNT, derivatives, expected, records * COUNT);
    CHECK_OK(carvel_stencils_apply_f64(table, NULL, &from, &to, failure));
    check_near(expected, found, records * COUNT * WIDTH, 1e-11);
    CHECK_OK(carvel_surface_stencils(NULL, with->surface, with->samples, COUNT, derivatives,
                                     CARVEL_PRECISION_F32, &single, failure));
    CHECK_OK(carvel_stencils_counts(single, &counts, failure));
    CHECK_UINT(CARVEL_PRECISION_F32, counts.precision);
    carvel_stencils_destroy(single);
    carvel_stencils_destroy(table);
}

/* A surface and its table outlive what they were made of. */
static void check_lifetimes(void)
{
    fixture with;
    double out[WIDTH], again[WIDTH];
    carvel_stencils *table = NULL;
    carvel_const_values_f64 from;
    carvel_values_f64 to = to64(again, 1);
    set_up(&with, poly_octahedron(), CARVEL_SCHEME_LOOP);
    carvel_mesh_destroy(with.mesh);
    carvel_scheme_destroy(with.scheme);
    evaluate(&with, with.samples, 1, CARVEL_DERIVATIVES_NONE, out, 1);
    CHECK_OK(carvel_surface_stencils(NULL, with.surface, with.samples, 1, CARVEL_DERIVATIVES_NONE,
                                     CARVEL_PRECISION_F64, &table, failure));
    carvel_surface_destroy(with.surface);
    from = control64(&with);
    CHECK_OK(carvel_stencils_apply_f64(table, NULL, &from, &to, failure));
    check_near(out, again, WIDTH, ROUNDING);
    carvel_stencils_destroy(table);
    carvel_context_destroy(with.context);
    poly_free(with.soup);
}

static void check_sectors(void)
{
    fixture with;
    uint32_t sectors = 0;
    set_up(&with, poly_octahedron(), CARVEL_SCHEME_CATMULL_CLARK);
    CHECK_OK(carvel_surface_sectors(with.surface, 7, &sectors, failure));
    CHECK_UINT(3, sectors);
    tear_down(&with);
    set_up(&with, poly_octahedron(), CARVEL_SCHEME_LOOP);
    CHECK_OK(carvel_surface_sectors(with.surface, 0, &sectors, failure));
    CHECK_UINT(1, sectors);
    tear_down(&with);
}

/* -------------------------------------------------------------------- misuse */

#define REFUSE(status, call) CHECK_STATUS(CARVEL_STATUS_##status, call)
/* A pointer that is not aligned. */
#define OFF(type, pointer) ((type *)(void *)((char *)(void *)(uintptr_t)(pointer) + 1))

static void check_wrong_surfaces(const fixture *with)
{
    carvel_surface *it = NULL;
    carvel_scheme *triangles = scheme_of(CARVEL_SCHEME_LOOP, 0);
    uint32_t sectors = 77;
    REFUSE(NULL_POINTER, carvel_surface_create(NULL, NULL, with->scheme, &it, failure));
    REFUSE(NULL_POINTER, carvel_surface_create(NULL, with->mesh, NULL, &it, failure));
    REFUSE(NULL_POINTER, carvel_surface_create(NULL, with->mesh, with->scheme, NULL, failure));
    REFUSE(MISALIGNED, carvel_surface_create(NULL, with->mesh, with->scheme,
                                             OFF(carvel_surface *, &it), failure));
    REFUSE(UNSUPPORTED, carvel_surface_create(NULL, with->mesh, triangles, &it, failure));
    CHECK(it == NULL);
    REFUSE(NULL_POINTER, carvel_surface_sectors(NULL, 0, &sectors, failure));
    REFUSE(NULL_POINTER, carvel_surface_sectors(with->surface, 0, NULL, failure));
    REFUSE(MISALIGNED, carvel_surface_sectors(with->surface, 0, OFF(uint32_t, &sectors), failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_surface_sectors(with->surface, (uint32_t)with->soup->faces, &sectors, failure));
    CHECK_UINT(77, sectors);
    carvel_context_cancel(with->context);
    REFUSE(CANCELLED, carvel_surface_create(with->context, with->mesh, with->scheme, &it, failure));
    carvel_context_reset(with->context);
    CHECK(it == NULL);
    carvel_surface_destroy(NULL);
    carvel_scheme_destroy(triangles);
}

static void check_wrong_calls(const fixture *with)
{
    double out[6 * COUNT * WIDTH];
    carvel_const_values_f64 from = control64(with), f;
    carvel_values_f64 to = to64(out, 3 * COUNT), t;
    carvel_sample wrong[COUNT];
    carvel_stencils *table = NULL;
    const carvel_sample *right = with->samples;
    const int32_t first = CARVEL_DERIVATIVES_FIRST;
#define EVALUATE(status, samples, count, derivatives, f, t) \
    REFUSE(status, carvel_surface_evaluate_f64(with->surface, with->context, (samples), (count), \
                                               (derivatives), (f), (t), failure))
#define TABLE(status, samples, count, derivatives, precision) \
    (REFUSE(status, carvel_surface_stencils(NULL, with->surface, (samples), (count), \
                                            (derivatives), (precision), &table, failure)), \
     CHECK(table == NULL))
#define BOTH(status, samples, count, derivatives) \
    (EVALUATE(status, samples, count, derivatives, &from, &to), \
     TABLE(status, samples, count, derivatives, CARVEL_PRECISION_F64))
    BOTH(NULL_POINTER, NULL, COUNT, first);
    BOTH(MISALIGNED, OFF(const carvel_sample, right), COUNT, first);
    BOTH(TOO_LARGE, right, UINT64_MAX / 2, first);
    BOTH(PARAMETER_OUT_OF_RANGE, right, COUNT, 3);
    BOTH(PARAMETER_OUT_OF_RANGE, right, COUNT, -1);
    TABLE(PARAMETER_OUT_OF_RANGE, right, COUNT, first, 2);
    REFUSE(NULL_POINTER, carvel_surface_stencils(NULL, with->surface, right, COUNT, first,
                                                 CARVEL_PRECISION_F64, NULL, failure));
    REFUSE(NULL_POINTER, carvel_surface_stencils(NULL, NULL, right, COUNT, first,
                                                 CARVEL_PRECISION_F64, &table, failure));
    REFUSE(NULL_POINTER, carvel_surface_evaluate_f64(NULL, NULL, right, COUNT, first, &from, &to,
                                                     failure));
    EVALUATE(NULL_POINTER, right, COUNT, first, NULL, &to);
    EVALUATE(NULL_POINTER, right, COUNT, first, &from, NULL);
    EVALUATE(BUFFER_TOO_SMALL, right, COUNT, CARVEL_DERIVATIVES_SECOND, &from, &to);
    f = from, f.count--;
    EVALUATE(LENGTH_MISMATCH, right, COUNT, first, &f, &to);
    f = from, f.width = 0;
    EVALUATE(PARAMETER_OUT_OF_RANGE, right, COUNT, first, &f, &to);
    f = from, f.stride = 8;
    EVALUATE(INVALID_STRIDE, right, COUNT, first, &f, &to);
    t = to, t.width = 2;
    EVALUATE(LENGTH_MISMATCH, right, COUNT, first, &from, &t);
    t = to, t.data = with->soup->positions;
    EVALUATE(OVERLAP, right, COUNT, first, &from, &t);
    EVALUATE(OVERLAP, (const carvel_sample *)(const void *)out, 1, first, &from, &to);

    /* The second sample is wrong, and named. */
#define WRONG(status, field, value) \
    (memcpy(wrong, right, sizeof wrong), wrong[1].field = (value), \
     BOTH(status, wrong, COUNT, first), \
     CHECK_UINT(CARVEL_ELEMENT_FACE, carvel_error_element(failure, 0, 0).kind), \
     CHECK_UINT(wrong[1].face, carvel_error_element(failure, 0, 0).index))
    WRONG(PARAMETER_OUT_OF_RANGE, face, UINT32_MAX);
    WRONG(PARAMETER_OUT_OF_RANGE, sector, 1);
    WRONG(PARAMETER_OUT_OF_RANGE, u, -0.5);
    WRONG(PARAMETER_OUT_OF_RANGE, v, (double)NAN);
    carvel_context_cancel(with->context);
    EVALUATE(CANCELLED, right, COUNT, first, &from, &to);
    REFUSE(CANCELLED, carvel_surface_stencils(with->context, with->surface, right, COUNT, first,
                                              CARVEL_PRECISION_F64, &table, failure));
    carvel_context_reset(with->context);
    /* No samples are no mistake. */
    t = to64(NULL, 0);
    CHECK_OK(carvel_surface_evaluate_f64(with->surface, NULL, NULL, 0, first, &from, &t, failure));
}

int main(void)
{
    static const int32_t families[2] = {CARVEL_SCHEME_CATMULL_CLARK, CARVEL_SCHEME_QUARTIC};
    fixture with;
    int i;
    check_begin();
    for (i = 0; i < 2; i++) {
        set_up(&with, poly_torus(6, 5), families[i]);
        check_constants(&with);
        check_derivatives(&with);
        check_strides(&with);
        check_table(&with, CARVEL_DERIVATIVES_NONE, 1);
        check_table(&with, CARVEL_DERIVATIVES_FIRST, 3);
        check_table(&with, CARVEL_DERIVATIVES_SECOND, 6);
        check_wrong_surfaces(&with);
        check_wrong_calls(&with);
        tear_down(&with);
    }
    check_cube();
    check_lifetimes();
    check_sectors();
    check_channel();
    return check_end();
}
