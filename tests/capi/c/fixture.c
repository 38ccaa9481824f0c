#include "fixture.h"

#include <stdlib.h>
#include <string.h>

static poly *poly_take(uint64_t vertices, uint64_t faces, uint64_t corners)
{
    poly *it = TAKE(poly, 1);
    uint64_t state = vertices, i;
    it->vertices = vertices;
    it->faces = faces;
    it->corners = corners;
    it->sizes = TAKE(uint32_t, faces);
    it->indices = TAKE(uint32_t, corners);
    it->positions = TAKE(double, 3 * vertices);
    for (i = 0; i < 3 * vertices; i++)
        it->positions[i] = random_double(&state);
    return it;
}

poly *poly_of(uint64_t vertices, uint64_t faces, const uint32_t *sizes, const uint32_t *indices)
{
    uint64_t corners = 0, f;
    poly *it;
    for (f = 0; f < faces; f++)
        corners += sizes[f];
    it = poly_take(vertices, faces, corners);
    if (faces > 0)
        memcpy(it->sizes, sizes, (size_t)faces * sizeof *sizes);
    if (corners > 0)
        memcpy(it->indices, indices, (size_t)corners * sizeof *indices);
    return it;
}

poly *poly_cube(void)
{
    static const uint32_t sizes[6] = { 4, 4, 4, 4, 4, 4 };
    static const uint32_t indices[24] = { 3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4,
                                          1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7 };
    return poly_of(8, 6, sizes, indices);
}

static void put_quad(poly *it, uint64_t face, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    uint32_t *at = it->indices + 4 * face;
    it->sizes[face] = 4;
    at[0] = a;
    at[1] = b;
    at[2] = c;
    at[3] = d;
}

poly *poly_grid(uint32_t width, uint32_t height)
{
    uint64_t faces = (uint64_t)width * height;
    poly *it = poly_take((uint64_t)(width + 1) * (height + 1), faces, 4 * faces);
    uint32_t i, j, row = height + 1;
    for (i = 0; i < width; i++)
        for (j = 0; j < height; j++)
            put_quad(it, (uint64_t)i * height + j, i * row + j, (i + 1) * row + j,
                     (i + 1) * row + j + 1, i * row + j + 1);
    return it;
}

poly *poly_torus(uint32_t around, uint32_t across)
{
    uint64_t faces = (uint64_t)around * across;
    poly *it = poly_take(faces, faces, 4 * faces);
    uint32_t i, j;
    for (i = 0; i < around; i++)
        for (j = 0; j < across; j++) {
            uint32_t k = (i + 1) % around, l = (j + 1) % across;
            put_quad(it, (uint64_t)i * across + j, i * across + j, k * across + j,
                     k * across + l, i * across + l);
        }
    return it;
}

poly *poly_octahedron(void)
{
    static const uint32_t sizes[8] = { 3, 3, 3, 3, 3, 3, 3, 3 };
    static const uint32_t indices[24] = { 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4,
                                          1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5 };
    static const double unit[18] = { 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1 };
    poly *it = poly_of(6, 8, sizes, indices);
    memcpy(it->positions, unit, sizeof unit);
    return it;
}

poly *poly_mixed(void)
{
    static const uint32_t sizes[4] = { 4, 3, 5, 4 };
    static const uint32_t indices[16] = { 0, 1, 2, 3, 3, 2, 4, 4, 2, 5, 6, 7, 8, 9, 10, 11 };
    return poly_of(13, 4, sizes, indices);
}

void poly_free(poly *it)
{
    free(it->sizes);
    free(it->indices);
    free(it->positions);
    free(it);
}

void poly_describe(const poly *it, carvel_mesh_desc *desc)
{
    CHECK_OK(carvel_mesh_desc_init(desc, sizeof *desc));
    desc->vertex_count = it->vertices;
    desc->face_count = it->faces;
    desc->face_sizes = it->sizes;
    desc->face_vertices = it->indices;
    desc->face_vertex_count = it->corners;
}

carvel_mesh *poly_mesh(const poly *it)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    return mesh;
}

float *poly_floats(const poly *it)
{
    float *floats = TAKE(float, 3 * it->vertices);
    uint64_t i;
    for (i = 0; i < 3 * it->vertices; i++)
        floats[i] = (float)it->positions[i];
    return floats;
}

static carvel_scheme *scheme_by(const carvel_scheme_desc *desc)
{
    carvel_scheme *scheme = NULL;
    CHECK_OK(carvel_scheme_create(desc, &scheme, failure));
    return scheme;
}

carvel_scheme *scheme_of(int32_t family, int32_t boundary)
{
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = family;
    desc.boundary = boundary;
    if (family == CARVEL_SCHEME_B_SPLINE)
        desc.degree = 4;
    return scheme_by(&desc);
}

carvel_scheme *scheme_of_passes(const carvel_fraction *passes, uint64_t count)
{
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = CARVEL_SCHEME_AVERAGING;
    desc.passes = passes;
    desc.pass_count = count;
    return scheme_by(&desc);
}

carvel_scheme *scheme_three_point(int64_t numerator, int64_t denominator)
{
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = CARVEL_SCHEME_THREE_POINT;
    desc.w.numerator = numerator;
    desc.w.denominator = denominator;
    return scheme_by(&desc);
}

carvel_context *context_of(uint32_t threads)
{
    carvel_context *context = NULL;
    carvel_context_desc desc;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = threads;
    CHECK_OK(carvel_context_create(&desc, &context, failure));
    return context;
}

carvel_refiner *refiner_of(void)
{
    carvel_refiner *refiner = NULL;
    CHECK_OK(carvel_refiner_create(&refiner, failure));
    return refiner;
}

carvel_hierarchy *hierarchy_of(const carvel_mesh *mesh, const carvel_scheme *scheme,
                               uint32_t levels)
{
    carvel_hierarchy *hierarchy = NULL;
    CHECK_OK(carvel_hierarchy_create(NULL, mesh, scheme, levels, &hierarchy, failure));
    return hierarchy;
}

carvel_counts counts_of(const carvel_mesh *mesh)
{
    carvel_counts counts;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_mesh_counts(mesh, &counts, failure));
    return counts;
}

carvel_counts predicted(const carvel_mesh *mesh, const carvel_scheme *scheme, uint32_t level)
{
    carvel_counts counts;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_predict_counts(mesh, scheme, level, &counts, failure));
    return counts;
}

static void take_indices(carvel_indices *it, uint64_t count)
{
    it->data = TAKE(uint32_t, count);
    it->count = count;
}

void level64_take(level64 *it, const carvel_counts *counts)
{
    carvel_refine_output_f64 *output = &it->output;
    it->counts = *counts;
    CHECK_OK(carvel_refine_output_f64_init(output, sizeof *output));
    take_indices(&output->face_sizes, counts->faces);
    take_indices(&output->face_offsets, counts->faces + 1);
    take_indices(&output->face_vertices, counts->corners);
    take_indices(&output->face_sources, counts->faces);
    output->positions.data = TAKE(double, 3 * counts->vertices);
    output->positions.count = counts->vertices;
    output->positions.width = 3;
}

void level64_free(level64 *it)
{
    free(it->output.face_sizes.data);
    free(it->output.face_offsets.data);
    free(it->output.face_vertices.data);
    free(it->output.face_sources.data);
    free(it->output.positions.data);
}

void level32_take(level32 *it, const carvel_counts *counts)
{
    carvel_refine_output_f32 *output = &it->output;
    it->counts = *counts;
    CHECK_OK(carvel_refine_output_f32_init(output, sizeof *output));
    take_indices(&output->face_sizes, counts->faces);
    take_indices(&output->face_offsets, counts->faces + 1);
    take_indices(&output->face_vertices, counts->corners);
    take_indices(&output->face_sources, counts->faces);
    output->positions.data = TAKE(float, 3 * counts->vertices);
    output->positions.count = counts->vertices;
    output->positions.width = 3;
}

void level32_free(level32 *it)
{
    free(it->output.face_sizes.data);
    free(it->output.face_offsets.data);
    free(it->output.face_vertices.data);
    free(it->output.face_sources.data);
    free(it->output.positions.data);
}

carvel_refine_input_f64 input64(const carvel_mesh *mesh, const carvel_scheme *scheme,
                                uint32_t levels, const double *positions)
{
    carvel_refine_input_f64 input;
    CHECK_OK(carvel_refine_input_f64_init(&input, sizeof input));
    input.levels = levels;
    input.mesh = mesh;
    input.scheme = scheme;
    input.positions.data = positions;
    input.positions.count = counts_of(mesh).vertices;
    input.positions.width = 3;
    return input;
}

carvel_refine_input_f32 input32(const carvel_mesh *mesh, const carvel_scheme *scheme,
                                uint32_t levels, const float *positions)
{
    carvel_refine_input_f32 input;
    CHECK_OK(carvel_refine_input_f32_init(&input, sizeof input));
    input.levels = levels;
    input.mesh = mesh;
    input.scheme = scheme;
    input.positions.data = positions;
    input.positions.count = counts_of(mesh).vertices;
    input.positions.width = 3;
    return input;
}

void level64_refine(level64 *it, const carvel_context *context, const carvel_mesh *mesh,
                    const carvel_scheme *scheme, uint32_t levels, const double *positions)
{
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(mesh, scheme, levels, positions);
    carvel_counts counts = predicted(mesh, scheme, levels);
    level64_take(it, &counts);
    CHECK_OK(carvel_refiner_refine_f64(refiner, context, &input, &it->output, failure));
    carvel_refiner_destroy(refiner);
}
