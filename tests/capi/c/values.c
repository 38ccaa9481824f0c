/* Values of any width and stride, in both precisions; bad values; what a
 * refinement says about its faces; level 0. Argument 1: widths from 1 to which. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTHS = 9, CANARY = 0xa5 };

static carvel_scheme *steep_scheme(void)
{
    /* Passes beyond 1 make more of a checkerboard. */
    static const carvel_fraction passes[2] = { { 7, 2 }, { 7, 2 } };
    return scheme_of_passes(passes, 2);
}

static int all_bytes_are(const unsigned char *bytes, size_t from, size_t to, unsigned char value)
{
    while (from < to && bytes[from] == value)
        from++;
    return from == to;
}

#define REAL float
#define TWIN(name) name##_f32
#define INIT(name) name##_f32_init
#define PAIR(name) name##32
#define LEVEL(verb) level32_##verb
#define LARGEST FLT_MAX
#include "values_twin.h"
#undef REAL
#undef TWIN
#undef INIT
#undef PAIR
#undef LEVEL
#undef LARGEST

#define REAL double
#define TWIN(name) name##_f64
#define INIT(name) name##_f64_init
#define PAIR(name) name##64
#define LEVEL(verb) level64_##verb
#define LARGEST DBL_MAX
#include "values_twin.h"

/* --------------------------------------------------------------- topology */

/* Offsets are the running sums of sizes; sources lead to a face of the mesh. */
static void check_faces(const level64 *level, uint64_t control_faces)
{
    uint64_t f;
    uint32_t corner = 0;
    const carvel_refine_output_f64 *out = &level->output;
    for (f = 0; f < level->counts.faces; f++) {
        CHECK_UINT(corner, out->face_offsets.data[f]);
        CHECK(out->face_sources.data[f] < control_faces);
        if (level->counts.level > 0 && f >= level->counts.irregular_faces)
            CHECK_UINT(4, out->face_sizes.data[f]);
        corner += out->face_sizes.data[f];
    }
    CHECK_UINT(level->counts.corners, corner);
    CHECK_UINT(corner, out->face_offsets.data[f]);
    for (f = 0; f < corner; f++)
        CHECK(out->face_vertices.data[f] < level->counts.vertices);
}

static void check_anchored_flag(int32_t boundary, uint32_t levels, int32_t expected)
{
    poly *grid = poly_grid(3, 2);
    carvel_mesh *mesh = poly_mesh(grid);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, boundary);
    level64 level;
    level64_refine(&level, NULL, mesh, scheme, levels, grid->positions);
    CHECK_UINT(expected, level.output.anchored);
    check_faces(&level, 6);
    level64_free(&level);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* A level's faces, as a mesh marked as told, give the next level's counts. */
static void check_continued(void)
{
    poly *grid = poly_grid(3, 2);
    carvel_mesh *mesh = poly_mesh(grid), *next = NULL;
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    carvel_mesh_desc desc;
    carvel_counts once, twice = predicted(mesh, scheme, 2);
    level64 level;
    level64_refine(&level, NULL, mesh, scheme, 1, grid->positions);
    CHECK_OK(carvel_mesh_desc_init(&desc, sizeof desc));
    desc.vertex_count = level.counts.vertices;
    desc.face_count = level.counts.faces;
    desc.face_offsets = level.output.face_offsets.data;
    desc.face_vertices = level.output.face_vertices.data;
    desc.face_vertex_count = level.counts.corners;
    desc.anchored = level.output.anchored;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &next, failure));
    once = predicted(next, scheme, 1);
    once.level = 2;
    CHECK_BYTES(&twice, &once, sizeof once);
    level64_free(&level);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(next);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* Level 0 is a copy in the mesh's own order. */
static void check_level_zero(void)
{
    static const uint32_t sizes[4] = { 3, 5, 4, 4 }, sources[4] = { 0, 1, 2, 3 };
    static const uint32_t offsets[5] = { 0, 3, 8, 12, 16 };
    poly *mixed = poly_mixed();
    carvel_mesh *mesh = poly_mesh(mixed);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_QUARTIC, 0);
    uint32_t indices[16];
    level64 level;
    check_context("level 0");
    level64_refine(&level, NULL, mesh, scheme, 0, mixed->positions);
    CHECK_OK(carvel_mesh_face_vertices(mesh, indices, 16, failure));
    CHECK_BYTES(indices, level.output.face_vertices.data, sizeof indices);
    CHECK_BYTES(sizes, level.output.face_sizes.data, sizeof sizes);
    CHECK_BYTES(offsets, level.output.face_offsets.data, sizeof offsets);
    CHECK_BYTES(sources, level.output.face_sources.data, sizeof sources);
    CHECK_BYTES(mixed->positions, level.output.positions.data, 13 * 3 * sizeof(double));
    CHECK_UINT(0, level.output.anchored);
    level64_free(&level);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(mixed);
}

/* Index arrays that are not wanted change nothing in what is. */
static void check_unwanted(void)
{
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_QUARTIC, 0);
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(mesh, scheme, 2, cube->positions);
    level64 all, some;
    check_context("unwanted");
    level64_refine(&all, NULL, mesh, scheme, 2, cube->positions);
    level64_take(&some, &all.counts);
    free(some.output.face_sizes.data);
    free(some.output.face_sources.data);
    some.output.face_sizes.data = some.output.face_sources.data = NULL;
    some.output.face_sizes.count = some.output.face_sources.count = 0;
    CHECK_OK(carvel_refiner_refine_f64(refiner, NULL, &input, &some.output, failure));
    CHECK_BYTES(all.output.face_vertices.data, some.output.face_vertices.data,
                (size_t)all.counts.corners * 4);
    CHECK_BYTES(all.output.positions.data, some.output.positions.data,
                (size_t)all.counts.vertices * 3 * sizeof(double));
    some.output.face_offsets.count = some.output.face_vertices.count = 0;
    free(some.output.face_offsets.data);
    free(some.output.face_vertices.data);
    some.output.face_offsets.data = some.output.face_vertices.data = NULL;
    memset(some.output.positions.data, 0, (size_t)all.counts.vertices * 3 * sizeof(double));
    CHECK_OK(carvel_refiner_refine_f64(refiner, NULL, &input, &some.output, failure));
    CHECK_BYTES(all.output.positions.data, some.output.positions.data,
                (size_t)all.counts.vertices * 3 * sizeof(double));
    level64_free(&some);
    level64_free(&all);
    carvel_refiner_destroy(refiner);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

int main(int count, char **arguments)
{
    uint64_t widths = size_argument(count, arguments, WIDTHS);
    check_begin();
    check_f32(widths);
    check_f64(widths);
    check_context("anchored");
    check_anchored_flag(CARVEL_BOUNDARY_EDGE_AND_CORNER, 0, 0);
    check_anchored_flag(CARVEL_BOUNDARY_EDGE_AND_CORNER, 1, 1);
    check_anchored_flag(CARVEL_BOUNDARY_EDGE, 2, 1);
    check_anchored_flag(CARVEL_BOUNDARY_NONE, 2, 0);
    check_continued();
    check_level_zero();
    check_unwanted();
    return check_end();
}
