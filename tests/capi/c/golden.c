/* The golden cases from C: argument 1 is a list of them, made by the Rust side.
 * Each is refined by a refiner and by a hierarchy, in f64 and in f32, and
 * compared as an unordered mesh. Prints the names of the cases that ran. */
#include "reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double GOLDEN = 1e-12;
static const double GOLDEN_SINGLE = 2e-6;

typedef struct golden_case {
    char name[64];
    unsigned long levels;
    carvel_scheme_desc scheme;
    carvel_fraction passes[64];
    poly *control;
    poly *expected;
} golden_case;

/* ---------------------------------------------------------------- reading */

static int64_t read_signed(FILE *file)
{
    long number;
    if (fscanf(file, "%ld", &number) != 1)
        misread("a fraction");
    return number;
}

/* 0 at the end of the list. */
static int read_case(FILE *file, golden_case *it)
{
    uint64_t i;
    if (fscanf(file, "%63s", it->name) != 1)
        return 0;
    it->levels = read_number(file);
    CHECK_OK(carvel_scheme_desc_init(&it->scheme, sizeof it->scheme));
    it->scheme.family = (int32_t)read_number(file);
    it->scheme.corner_rule = (int32_t)read_number(file);
    it->scheme.boundary = (int32_t)read_number(file);
    it->scheme.pass_count = read_number(file);
    it->scheme.passes = it->passes;
    for (i = 0; i < it->scheme.pass_count; i++) {
        it->passes[i].numerator = read_signed(file);
        it->passes[i].denominator = read_signed(file);
    }
    it->control = read_poly(file);
    it->expected = read_poly(file);
    return 1;
}

/* -------------------------------------------------------------- comparing */

/* What came out, its positions as doubles. */
typedef struct outcome {
    uint64_t vertices, faces;
    const uint32_t *sizes, *offsets, *indices;
    const double *positions;
} outcome;

static double distance(const double *p, const double *q)
{
    double x = fabs(p[0] - q[0]), y = fabs(p[1] - q[1]), z = fabs(p[2] - q[2]);
    double most = x > y ? x : y;
    return most > z ? most : z;
}

static double largest(const poly *it)
{
    double most = 0.0;
    uint64_t i;
    for (i = 0; i < 3 * it->vertices; i++)
        most = fabs(it->positions[i]) > most ? fabs(it->positions[i]) : most;
    return most;
}

/* The one expected vertex within the tolerance, UINT32_MAX if there is another
 * number of them. */
static uint32_t partner_of(const double *p, const poly *expected, double tolerance)
{
    uint32_t partner = UINT32_MAX, w;
    for (w = 0; w < expected->vertices; w++)
        if (distance(p, expected->positions + 3 * (size_t)w) <= tolerance) {
            if (partner != UINT32_MAX)
                return UINT32_MAX;
            partner = w;
        }
    return partner;
}

/* 1 if every vertex has a partner of its own. */
static int match(const outcome *actual, const poly *expected, double tolerance,
                 uint32_t *partners)
{
    char *taken = TAKE(char, expected->vertices);
    int ok = 1;
    uint64_t v;
    for (v = 0; v < actual->vertices && ok; v++) {
        partners[v] = partner_of(actual->positions + 3 * v, expected, tolerance);
        ok = CHECK(partners[v] != UINT32_MAX) && CHECK(!taken[partners[v]]);
        if (ok)
            taken[partners[v]] = 1;
    }
    free(taken);
    return ok;
}

/* The same cycle, wherever it starts. */
static int same_cycle(const uint32_t *x, const uint32_t *partners, const uint32_t *y,
                      uint32_t size)
{
    uint32_t turn = 0, i = 0;
    while (turn < size && y[turn] != partners[x[0]])
        turn++;
    while (i < size && y[(i + turn) % size] == partners[x[i]])
        i++;
    return i == size;
}

/* Takes the expected face that equals this one. */
static int take_face(const uint32_t *face, uint32_t size, const uint32_t *partners,
                     const poly *expected, char *taken)
{
    const uint32_t *at = expected->indices;
    uint64_t f;
    for (f = 0; f < expected->faces; at += expected->sizes[f], f++)
        if (!taken[f] && expected->sizes[f] == size && same_cycle(face, partners, at, size)) {
            taken[f] = 1;
            return 1;
        }
    return 0;
}

static void check_same(const outcome *actual, const poly *expected, double relative)
{
    uint32_t *partners = TAKE(uint32_t, actual->vertices);
    char *taken = TAKE(char, expected->faces);
    uint64_t f;
    if (CHECK_UINT(expected->vertices, actual->vertices) &&
        CHECK_UINT(expected->faces, actual->faces) &&
        CHECK_UINT(expected->corners, actual->offsets[actual->faces]) &&
        match(actual, expected, relative * largest(expected), partners))
        for (f = 0; f < actual->faces; f++)
            CHECK(take_face(actual->indices + actual->offsets[f], actual->sizes[f], partners,
                            expected, taken));
    free(partners);
    free(taken);
}

static double *doubles_of(const float *floats, uint64_t count)
{
    double *doubles = TAKE(double, count);
    uint64_t i;
    for (i = 0; i < count; i++)
        doubles[i] = (double)floats[i];
    return doubles;
}

/* ---------------------------------------------------------------- running */

static void run_refiner(const golden_case *it, const carvel_mesh *mesh,
                        const carvel_scheme *scheme, outcome *actual)
{
    level64 wide;
    level32 narrow;
    carvel_refiner *refiner = refiner_of();
    float *floats = poly_floats(it->control);
    carvel_refine_input_f32 input = input32(mesh, scheme, (uint32_t)it->levels, floats);
    double *doubles;
    level64_refine(&wide, NULL, mesh, scheme, (uint32_t)it->levels, it->control->positions);
    actual->vertices = wide.counts.vertices;
    actual->faces = wide.counts.faces;
    actual->sizes = wide.output.face_sizes.data;
    actual->offsets = wide.output.face_offsets.data;
    actual->indices = wide.output.face_vertices.data;
    actual->positions = wide.output.positions.data;
    check_same(actual, it->expected, GOLDEN);
    level32_take(&narrow, &wide.counts);
    CHECK_OK(carvel_refiner_refine_f32(refiner, NULL, &input, &narrow.output, failure));
    doubles = doubles_of(narrow.output.positions.data, 3 * narrow.counts.vertices);
    actual->sizes = narrow.output.face_sizes.data;
    actual->offsets = narrow.output.face_offsets.data;
    actual->indices = narrow.output.face_vertices.data;
    actual->positions = doubles;
    check_same(actual, it->expected, GOLDEN_SINGLE);
    free(doubles);
    free(floats);
    level32_free(&narrow);
    level64_free(&wide);
    carvel_refiner_destroy(refiner);
}

static void run_hierarchy_f64(const golden_case *it, const carvel_hierarchy *hierarchy,
                              outcome *actual)
{
    carvel_const_values_f64 values = { NULL, 0, 3, 0 };
    carvel_values_f64 out = { NULL, 0, 3, 0 };
    values.data = it->control->positions;
    values.count = it->control->vertices;
    out.data = TAKE(double, 3 * actual->vertices);
    out.count = actual->vertices;
    CHECK_OK(carvel_hierarchy_refine_f64(hierarchy, NULL, (uint32_t)it->levels, &values, &out,
                                         failure));
    actual->positions = out.data;
    check_same(actual, it->expected, GOLDEN);
    free(out.data);
}

static void run_hierarchy_f32(const golden_case *it, const carvel_hierarchy *hierarchy,
                              outcome *actual)
{
    float *floats = poly_floats(it->control);
    carvel_const_values_f32 values = { NULL, 0, 3, 0 };
    carvel_values_f32 out = { NULL, 0, 3, 0 };
    double *doubles;
    values.data = floats;
    values.count = it->control->vertices;
    out.data = TAKE(float, 3 * actual->vertices);
    out.count = actual->vertices;
    CHECK_OK(carvel_hierarchy_refine_f32(hierarchy, NULL, (uint32_t)it->levels, &values, &out,
                                         failure));
    doubles = doubles_of(out.data, 3 * actual->vertices);
    actual->positions = doubles;
    check_same(actual, it->expected, GOLDEN_SINGLE);
    free(doubles);
    free(out.data);
    free(floats);
}

static void run_hierarchy(const golden_case *it, const carvel_mesh *mesh,
                          const carvel_scheme *scheme, outcome *actual)
{
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, (uint32_t)it->levels);
    carvel_mesh *last = NULL;
    carvel_counts counts;
    uint32_t *sizes, *offsets, *indices;
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, (uint32_t)it->levels, &last, failure));
    counts = counts_of(last);
    sizes = TAKE(uint32_t, counts.faces);
    offsets = TAKE(uint32_t, counts.faces + 1);
    indices = TAKE(uint32_t, counts.corners);
    CHECK_OK(carvel_mesh_face_sizes(last, sizes, counts.faces, failure));
    CHECK_OK(carvel_mesh_face_offsets(last, offsets, counts.faces + 1, failure));
    CHECK_OK(carvel_mesh_face_vertices(last, indices, counts.corners, failure));
    actual->vertices = counts.vertices;
    actual->faces = counts.faces;
    actual->sizes = sizes;
    actual->offsets = offsets;
    actual->indices = indices;
    run_hierarchy_f64(it, hierarchy, actual);
    run_hierarchy_f32(it, hierarchy, actual);
    free(sizes);
    free(offsets);
    free(indices);
    carvel_mesh_destroy(last);
    carvel_hierarchy_destroy(hierarchy);
}

static void run_case(const golden_case *it)
{
    carvel_mesh *mesh = poly_mesh(it->control);
    carvel_scheme *scheme = NULL;
    outcome actual;
    check_context(it->name);
    CHECK_OK(carvel_scheme_create(&it->scheme, &scheme, failure));
    run_refiner(it, mesh, scheme, &actual);
    run_hierarchy(it, mesh, scheme, &actual);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(it->control);
    poly_free(it->expected);
}

int main(int count, char **arguments)
{
    FILE *file = read_file(count, arguments);
    golden_case it;
    check_begin();
    while (read_case(file, &it)) {
        run_case(&it);
        printf("%s\n", it.name);
    }
    fclose(file);
    return check_end();
}
