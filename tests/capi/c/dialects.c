/* A host's first flow, in a language as old or as new as the compiler allows. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

static int32_t go_on(double done, void *user_data)
{
    uint32_t *calls = (uint32_t *)user_data;
    CHECK(done >= 0.0 && done <= 1.0);
    ++*calls;
    return 0;
}

static carvel_context *make_context(uint32_t *calls)
{
    carvel_context *context = NULL;
    carvel_context_desc desc;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = 2;
    desc.memory_ceiling = (uint64_t)1 << 30;
    desc.progress = go_on;
    desc.user_data = calls;
    CHECK_OK(carvel_context_create(&desc, &context, failure));
    CHECK_UINT(2, carvel_context_thread_count(context));
    return context;
}

static void check_single(const carvel_context *context, const carvel_mesh *mesh,
                         const carvel_scheme *scheme, const poly *cube, const level64 *wide)
{
    carvel_refiner *refiner = refiner_of();
    float *positions = poly_floats(cube);
    carvel_refine_input_f32 input = input32(mesh, scheme, 2, positions);
    level32 it;
    uint64_t i;
    level32_take(&it, &wide->counts);
    CHECK_OK(carvel_refiner_refine_f32(refiner, context, &input, &it.output, failure));
    for (i = 0; i < 3 * it.counts.vertices; i++) {
        double apart = (double)it.output.positions.data[i] - wide->output.positions.data[i];
        CHECK(apart < 1e-6 && apart > -1e-6);
    }
    level32_free(&it);
    free(positions);
    carvel_refiner_destroy(refiner);
}

static void check_levels(const carvel_context *context, const carvel_mesh *mesh,
                         const carvel_scheme *scheme, const poly *cube, const level64 *expected)
{
    carvel_hierarchy *hierarchy = NULL;
    carvel_const_values_f64 values;
    carvel_values_f64 out;
    CHECK_OK(carvel_hierarchy_create(context, mesh, scheme, 2, &hierarchy, failure));
    CHECK_UINT(2, carvel_hierarchy_last_level(hierarchy));
    values.data = cube->positions;
    values.count = cube->vertices;
    values.width = 3;
    values.stride = 0;
    out.data = TAKE(double, 3 * expected->counts.vertices);
    out.count = expected->counts.vertices;
    out.width = 3;
    out.stride = 0;
    CHECK_OK(carvel_hierarchy_refine_f64(hierarchy, context, 2, &values, &out, failure));
    CHECK_BYTES(expected->output.positions.data, out.data,
                (size_t)out.count * 3 * sizeof(double));
    free(out.data);
    carvel_hierarchy_destroy(hierarchy);
}

static void check_failure(void)
{
    static const uint32_t sizes[1] = { 3 };
    static const uint32_t corners[3] = { 0, 1, 7 };
    poly *bad = poly_of(3, 1, sizes, corners);
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(bad, &desc);
    CHECK_STATUS(CARVEL_STATUS_INDEX_OUT_OF_RANGE,
                 carvel_mesh_create(NULL, &desc, &mesh, failure));
    CHECK(mesh == NULL);
    CHECK(strlen(carvel_error_message(failure)) > 0);
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_VERTEX, 7, 0);
    poly_free(bad);
}

int main(void)
{
    uint32_t calls = 0;
    poly *cube = poly_cube();
    level64 expected;
    carvel_context *context;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    check_begin();
    CHECK(strcmp(carvel_version(), CARVEL_VERSION_STRING) == 0);
    CHECK(carvel_version_number() == CARVEL_VERSION);
    context = make_context(&calls);
    mesh = poly_mesh(cube);
    scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, CARVEL_BOUNDARY_EDGE_AND_CORNER);
    level64_refine(&expected, context, mesh, scheme, 2, cube->positions);
    CHECK_UINT(98, expected.counts.faces);
    CHECK(calls > 0);
    check_single(context, mesh, scheme, cube, &expected);
    check_levels(context, mesh, scheme, cube, &expected);
    check_failure();
    level64_free(&expected);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_context_destroy(context);
    poly_free(cube);
    return check_end();
}
