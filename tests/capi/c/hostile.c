/* Every mesh that must be refused, with status and elements, and every defect
 * in the list of entries. The inputs are those of tests/kernel/mesh.rs and
 * tests/kernel/limits.rs. Argument 1: sides of a face that has many. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VERTEX = CARVEL_ELEMENT_VERTEX, FACE = CARVEL_ELEMENT_FACE, EDGE = CARVEL_ELEMENT_EDGE };

/* One line for people, naming something. */
static void check_message(const char *text)
{
    CHECK(strlen(text) > 0);
    CHECK(strchr(text, '\n') == NULL);
}

/* Refuses a description; the error's first entry is the refusal's. */
static void refuse_desc(carvel_status status, const carvel_mesh_desc *desc)
{
    carvel_mesh *mesh = (carvel_mesh *)desc->face_vertices;
    CHECK_STATUS(status, carvel_mesh_create(NULL, desc, &mesh, failure));
    CHECK(mesh == NULL);
    CHECK(carvel_error_status(failure) == status);
    check_message(carvel_error_message(failure));
    CHECK(carvel_error_entry_count(failure) >= 1);
    CHECK(carvel_error_entry_status(failure, 0) == status);
    check_message(carvel_error_entry_message(failure, 0));
    /* Without an error object the answer is the same. */
    CHECK(carvel_mesh_create(NULL, desc, &mesh, NULL) == status);
}

/* Faces are given by their sizes and all their vertices. */
static void refuse(carvel_status status, uint64_t vertices, uint64_t faces,
                   const uint32_t *sizes, const uint32_t *indices)
{
    poly *it = poly_of(vertices, faces, sizes, indices);
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    refuse_desc(status, &desc);
    poly_free(it);
}

/* An element of the refusal, and no element after the last. */
static void names(uint64_t element, uint64_t kind, uint64_t index, uint64_t second)
{
    CHECK_ELEMENT(0, element, kind, index, second);
}

static void names_no_more(uint64_t elements)
{
    CHECK_UINT(elements, carvel_error_element_count(failure, 0));
    CHECK_ELEMENT(0, elements, 0, 0, 0);
}

/* ------------------------------------------------------------------ faces */

static void refuse_face(carvel_status status, uint64_t vertices, uint64_t faces,
                        const uint32_t *sizes, const uint32_t *indices, uint64_t vertex,
                        uint64_t face)
{
    refuse(status, vertices, faces, sizes, indices);
    names(0, VERTEX, vertex, 0);
    names(1, FACE, face, 0);
    names_no_more(2);
}

static void check_indices(void)
{
    static const uint32_t sizes[2] = { 3, 3 }, beyond[6] = { 0, 1, 2, 0, 2, 4 };
    static const uint32_t last[3] = { 0, 1, UINT32_MAX }, none[3] = { 0, 1, 2 };
    static const uint32_t minus[3] = { 0, 1, (uint32_t)-2 };
    check_context("indices");
    refuse_face(CARVEL_STATUS_INDEX_OUT_OF_RANGE, 4, 2, sizes, beyond, 4, 1);
    refuse_face(CARVEL_STATUS_INDEX_OUT_OF_RANGE, 4, 1, sizes, last, UINT32_MAX, 0);
    refuse_face(CARVEL_STATUS_INDEX_OUT_OF_RANGE, 4, 1, sizes, minus, UINT32_MAX - 1, 0);
    refuse_face(CARVEL_STATUS_INDEX_OUT_OF_RANGE, 0, 1, sizes, none, 0, 0);
}

static void refuse_size(uint64_t faces, const uint32_t *sizes, const uint32_t *indices,
                        uint64_t face)
{
    refuse(CARVEL_STATUS_FACE_TOO_SMALL, 4, faces, sizes, indices);
    names(0, FACE, face, 0);
    names_no_more(1);
}

static void check_sizes(void)
{
    static const uint32_t two[2] = { 3, 2 }, pair[5] = { 0, 1, 2, 1, 2 };
    static const uint32_t one[1] = { 1 }, point[1] = { 3 };
    static const uint32_t zero[2] = { 0, 3 }, triangle[3] = { 0, 1, 2 };
    check_context("sizes");
    refuse_size(2, two, pair, 1);
    refuse_size(1, one, point, 0);
    refuse_size(2, zero, triangle, 0);
}

static void check_repeated(void)
{
    static const uint32_t three[1] = { 3 }, twice[3] = { 0, 1, 1 };
    static const uint32_t four[1] = { 4 }, around[4] = { 0, 1, 2, 0 };
    static const uint32_t sizes[2] = { 3, 40 };
    uint32_t large[43], i;
    check_context("repeated");
    refuse_face(CARVEL_STATUS_REPEATED_VERTEX, 4, 1, three, twice, 1, 0);
    refuse_face(CARVEL_STATUS_REPEATED_VERTEX, 4, 1, four, around, 0, 0);
    /* A large face is searched in another way. */
    for (i = 0; i < 43; i++)
        large[i] = i < 3 ? i : i - 3;
    large[3 + 33] = 5;
    refuse_face(CARVEL_STATUS_REPEATED_VERTEX, 40, 2, sizes, large, 5, 1);
}

/* ------------------------------------------------------- edges and vertices */

static void refuse_edge(carvel_status status, uint64_t vertices, uint64_t faces,
                        const uint32_t *indices)
{
    static const uint32_t sizes[4] = { 3, 3, 3, 3 };
    uint64_t f;
    refuse(status, vertices, faces, sizes, indices);
    names(0, EDGE, 0, 1);
    for (f = 0; f < faces; f++)
        names(f + 1, FACE, f, 0);
    names_no_more(faces + 1);
}

static void check_edges(void)
{
    static const uint32_t same_way[6] = { 0, 1, 2, 0, 1, 3 };
    static const uint32_t three[9] = { 0, 1, 2, 1, 0, 3, 0, 1, 4 };
    static const uint32_t four[12] = { 0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 0, 5 };
    static const uint32_t twice[6] = { 0, 1, 2, 0, 1, 2 };
    check_context("edges");
    refuse_edge(CARVEL_STATUS_INCONSISTENT_ORIENTATION, 4, 2, same_way);
    refuse_edge(CARVEL_STATUS_NON_MANIFOLD_EDGE, 5, 3, three);
    refuse_edge(CARVEL_STATUS_NON_MANIFOLD_EDGE, 6, 4, four);
    refuse_edge(CARVEL_STATUS_INCONSISTENT_ORIENTATION, 3, 2, twice);
}

static void check_moebius(void)
{
    static const uint32_t sizes[5] = { 4, 4, 4, 4, 4 };
    static const uint32_t indices[20] = { 0, 1, 6, 5, 1, 2, 7, 6, 2, 3, 8, 7,
                                          3, 4, 9, 8, 4, 5, 0, 9 };
    check_context("moebius");
    refuse(CARVEL_STATUS_INCONSISTENT_ORIENTATION, 10, 5, sizes, indices);
}

static void check_vertices(void)
{
    static const uint32_t sizes[4] = { 3, 3, 3, 3 };
    static const uint32_t bow_tie[6] = { 0, 1, 2, 0, 3, 4 };
    static const uint32_t pillows[12] = { 0, 1, 2, 2, 1, 0, 2, 3, 4, 4, 3, 2 };
    check_context("vertices");
    refuse(CARVEL_STATUS_NON_MANIFOLD_VERTEX, 5, 2, sizes, bow_tie);
    names(0, VERTEX, 0, 0);
    names_no_more(1);
    refuse(CARVEL_STATUS_NON_MANIFOLD_VERTEX, 5, 4, sizes, pillows);
    names(0, VERTEX, 2, 0);
    names_no_more(1);
}

/* The mesh puts quads last; errors speak of the caller's faces all the same. */
static void check_callers_order(void)
{
    static const uint32_t sizes[6] = { 4, 3, 4, 3, 3, 3 };
    static const uint32_t indices[20] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,
                                          5, 4, 11, 4, 5, 7, 8, 7, 0 };
    check_context("the caller's order");
    refuse(CARVEL_STATUS_NON_MANIFOLD_EDGE, 12, 6, sizes, indices);
    names(0, EDGE, 4, 5);
    names(1, FACE, 1, 0);
    names(2, FACE, 3, 0);
    names(3, FACE, 4, 0);
    names_no_more(4);
}

/* ------------------------------------------------------------------- lists */

static void check_entry(uint64_t entry, carvel_status status, uint64_t elements)
{
    CHECK(carvel_error_entry_status(failure, entry) == status);
    CHECK_UINT(elements, carvel_error_element_count(failure, entry));
    check_message(carvel_error_entry_message(failure, entry));
}

static void check_end_of_list(uint64_t entries)
{
    CHECK_UINT(entries, carvel_error_entry_count(failure));
    CHECK(carvel_error_entry_status(failure, entries) == CARVEL_STATUS_OK);
    CHECK(strcmp(carvel_error_entry_message(failure, entries), "") == 0);
    CHECK_UINT(0, carvel_error_element_count(failure, entries));
    CHECK_ELEMENT(entries, 0, 0, 0, 0);
    CHECK(carvel_error_entry_status(failure, UINT64_MAX) == CARVEL_STATUS_OK);
    CHECK(strcmp(carvel_error_entry_message(failure, UINT64_MAX), "") == 0);
    CHECK_UINT(0, carvel_error_element_count(failure, UINT64_MAX));
    CHECK_ELEMENT(UINT64_MAX, UINT64_MAX, 0, 0, 0);
}

static void check_list(void)
{
    static const uint32_t sizes[8] = { 3, 2, 3, 3, 3, 3, 3, 3 };
    static const uint32_t indices[23] = { 0, 1, 2, 3, 4, 0, 1, 3, 4, 5, 5, 6,
                                          7, 99, 6, 7, 8, 7, 6, 9, 6, 7, 10 };
    check_context("list");
    refuse(CARVEL_STATUS_FACE_TOO_SMALL, 11, 8, sizes, indices);
    check_entry(0, CARVEL_STATUS_FACE_TOO_SMALL, 1);
    CHECK_ELEMENT(0, 0, FACE, 1, 0);
    check_entry(1, CARVEL_STATUS_REPEATED_VERTEX, 2);
    CHECK_ELEMENT(1, 0, VERTEX, 5, 0);
    CHECK_ELEMENT(1, 1, FACE, 3, 0);
    check_entry(2, CARVEL_STATUS_INDEX_OUT_OF_RANGE, 2);
    CHECK_ELEMENT(2, 0, VERTEX, 99, 0);
    CHECK_ELEMENT(2, 1, FACE, 4, 0);
    check_entry(3, CARVEL_STATUS_INCONSISTENT_ORIENTATION, 3);
    CHECK_ELEMENT(3, 0, EDGE, 0, 1);
    CHECK_ELEMENT(3, 1, FACE, 0, 0);
    CHECK_ELEMENT(3, 2, FACE, 2, 0);
    check_entry(4, CARVEL_STATUS_NON_MANIFOLD_EDGE, 4);
    CHECK_ELEMENT(4, 0, EDGE, 6, 7);
    CHECK_ELEMENT(4, 3, FACE, 7, 0);
    check_end_of_list(5);
    /* The message of the call tells that there is more. */
    CHECK(strstr(carvel_error_message(failure), "4 more") != NULL);
}

static void check_second_list(void)
{
    static const uint32_t sizes[7] = { 3, 3, 3, 3, 3, 3, 3 };
    static const uint32_t indices[21] = { 0, 1, 2, 1, 0, 3, 0, 1, 4, 5,  6,
                                          7, 5, 8, 9, 10, 11, 12, 12, 13, 14 };
    check_context("edges and vertices");
    refuse(CARVEL_STATUS_NON_MANIFOLD_EDGE, 15, 7, sizes, indices);
    check_entry(0, CARVEL_STATUS_NON_MANIFOLD_EDGE, 4);
    check_entry(1, CARVEL_STATUS_NON_MANIFOLD_VERTEX, 1);
    CHECK_ELEMENT(1, 0, VERTEX, 5, 0);
    check_entry(2, CARVEL_STATUS_NON_MANIFOLD_VERTEX, 1);
    CHECK_ELEMENT(2, 0, VERTEX, 12, 0);
    check_end_of_list(3);
}

/* Every face is bad: the list is as long. */
static void check_long_list(void)
{
    enum { FACES = 3000 };
    uint32_t *sizes = TAKE(uint32_t, FACES), *indices = TAKE(uint32_t, 3 * FACES), i;
    check_context("long list");
    for (i = 0; i < FACES; i++) {
        sizes[i] = 3;
        indices[3 * i] = indices[3 * i + 1] = 0;
        indices[3 * i + 2] = 1;
    }
    refuse(CARVEL_STATUS_REPEATED_VERTEX, 2, FACES, sizes, indices);
    CHECK_UINT(FACES, carvel_error_entry_count(failure));
    for (i = 0; i < FACES; i += 97) {
        CHECK_ELEMENT(i, 1, FACE, i, 0);
        check_message(carvel_error_entry_message(failure, i));
    }
    free(sizes);
    free(indices);
}

/* The same defects leave nothing behind after a call that goes well. */
static void check_emptied(void)
{
    poly *cube = poly_cube();
    check_context("emptied");
    carvel_mesh_destroy(poly_mesh(cube));
    CHECK(carvel_error_status(failure) == CARVEL_STATUS_OK);
    CHECK(strcmp(carvel_error_message(failure), "") == 0);
    check_end_of_list(0);
    poly_free(cube);
}

/* ------------------------------------------------------------------- cut */

static void check_cut_cannot_repair(void)
{
    static const uint32_t sizes[2] = { 2, 3 }, indices[5] = { 0, 1, 0, 1, 2 };
    poly *it = poly_of(4, 2, sizes, indices);
    carvel_mesh_desc desc;
    check_context("cut cannot repair");
    poly_describe(it, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    refuse_desc(CARVEL_STATUS_FACE_TOO_SMALL, &desc);
    CHECK_UINT(1, carvel_error_entry_count(failure));
    poly_free(it);
}

/* Any soup of sound faces is cut into a manifold whose map leads back. */
static void check_soup(uint64_t seed)
{
    uint64_t state = seed, i, j;
    uint32_t sizes[16], indices[16 * 6];
    uint64_t faces = random_below(&state, 16), corners = 0;
    uint32_t vertices = 4 + random_below(&state, 8);
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly *it;
    for (i = 0; i < faces; i++) {
        uint32_t start = random_below(&state, vertices);
        /* Steps that repeat no vertex in so few. */
        uint32_t step = vertices % 5 != 0 && random_below(&state, 2) ? 5 : 1;
        sizes[i] = 3 + random_below(&state, (vertices < 6 ? vertices : 6) - 2);
        for (j = 0; j < sizes[i]; j++)
            indices[corners + j] = (uint32_t)((start + j * step) % vertices);
        corners += sizes[i];
    }
    it = poly_of(vertices, faces, sizes, indices);
    poly_describe(it, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    CHECK_OK(carvel_mesh_validate(mesh, failure));
    CHECK_UINT(corners, counts_of(mesh).corners);
    carvel_mesh_destroy(mesh);
    poly_free(it);
}

static void check_soups(void)
{
    uint64_t seed;
    check_context("soups");
    for (seed = 0; seed < 200; seed++)
        check_soup(seed);
}

/* ------------------------------------------------------ lengths and layouts */

static carvel_mesh_desc quad_desc(void)
{
    static const uint32_t sizes[1] = { 4 }, indices[4] = { 0, 1, 2, 3 };
    carvel_mesh_desc desc;
    CHECK_OK(carvel_mesh_desc_init(&desc, sizeof desc));
    desc.vertex_count = 4;
    desc.face_count = 1;
    desc.face_sizes = sizes;
    desc.face_vertices = indices;
    desc.face_vertex_count = 4;
    return desc;
}

static void check_lengths(void)
{
    static const uint32_t three[2] = { 3, 3 }, huge[3] = { UINT32_MAX, UINT32_MAX, UINT32_MAX };
    carvel_mesh_desc desc = quad_desc();
    check_context("lengths");
    desc.face_sizes = three;
    refuse_desc(CARVEL_STATUS_LENGTH_MISMATCH, &desc);
    desc.face_count = 2;
    desc.face_vertex_count = 3;
    refuse_desc(CARVEL_STATUS_LENGTH_MISMATCH, &desc);
    desc.face_count = 3;
    desc.face_sizes = huge;
    refuse_desc(CARVEL_STATUS_LENGTH_MISMATCH, &desc);
    desc = quad_desc();
    desc.face_count = 0;
    refuse_desc(CARVEL_STATUS_LENGTH_MISMATCH, &desc);
    desc = quad_desc();
    desc.vertex_count = UINT32_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    CHECK_OK(carvel_mesh_desc_init(&desc, sizeof desc));
    desc.vertex_count = UINT64_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
}

/* Sizes that memory or indices cannot hold, with pointers that are never read. */
static void check_absurd(void)
{
    carvel_mesh_desc desc = quad_desc();
    check_context("absurd");
    desc.face_vertex_count = UINT32_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    desc.face_vertex_count = UINT64_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    desc = quad_desc();
    desc.face_count = UINT64_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    desc.face_count = UINT64_MAX / 4;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    desc = quad_desc();
    desc.face_sizes = NULL;
    desc.face_size = UINT32_MAX;
    desc.face_count = UINT64_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
    desc = quad_desc();
    desc.corner_tags = desc.face_vertices;
    desc.corner_tag_count = UINT64_MAX;
    refuse_desc(CARVEL_STATUS_TOO_LARGE, &desc);
}

static void refuse_offsets(carvel_status status, const uint32_t *offsets)
{
    carvel_mesh_desc desc;
    static const uint32_t indices[7] = { 0, 1, 2, 3, 4, 5, 6 };
    CHECK_OK(carvel_mesh_desc_init(&desc, sizeof desc));
    desc.vertex_count = 7;
    desc.face_count = 2;
    desc.face_offsets = offsets;
    desc.face_vertices = indices;
    desc.face_vertex_count = 7;
    refuse_desc(status, &desc);
}

static void check_offsets(void)
{
    static const uint32_t falling[3] = { 0, 8, 7 }, late[3] = { 1, 4, 7 };
    static const uint32_t small[3] = { 0, 2, 7 }, early[3] = { 0, 3, 6 };
    static const uint32_t wild[3] = { 0, UINT32_MAX, 7 };
    check_context("offsets");
    refuse_offsets(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, falling);
    refuse_offsets(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, wild);
    refuse_offsets(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, late);
    refuse_offsets(CARVEL_STATUS_FACE_TOO_SMALL, small);
    refuse_offsets(CARVEL_STATUS_LENGTH_MISMATCH, early);
}

static void check_layouts(void)
{
    static const uint32_t offsets[2] = { 0, 4 };
    carvel_mesh_desc desc = quad_desc();
    check_context("layouts");
    desc.face_offsets = offsets;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
    desc.face_offsets = NULL;
    desc.face_size = 4;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
    desc.face_size = 0;
    desc.face_sizes = NULL;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
    desc.face_size = 2;
    refuse_desc(CARVEL_STATUS_LENGTH_MISMATCH, &desc);
    desc.face_count = 2;
    refuse_desc(CARVEL_STATUS_FACE_TOO_SMALL, &desc);
    desc = quad_desc();
    desc.non_manifold = 3;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
    desc.non_manifold = -1;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
    desc = quad_desc();
    desc.anchored = 2;
    refuse_desc(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, &desc);
}

/* -------------------------------------------------------- anchored and tags */

static void refuse_anchored(const poly *it, uint64_t kind, uint64_t index)
{
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    desc.anchored = 1;
    refuse_desc(CARVEL_STATUS_NOT_ANCHORED, &desc);
    names(0, kind, index, 0);
    names_no_more(1);
}

static void check_anchored(void)
{
    static const uint32_t four[1] = { 4 }, polygon[4] = { 0, 1, 2, 3 };
    static const uint32_t threes[2] = { 3, 3 }, fan[6] = { 0, 1, 3, 1, 2, 3 };
    static const uint32_t mixed[6] = { 4, 4, 4, 4, 3, 3 };
    poly *grid = poly_grid(4, 4), *notched, *joined, *it;
    uint32_t indices[22], i;
    check_context("anchored");
    /* Three faces at a boundary vertex: where a corner of a grid is missing. */
    notched = poly_of(25, 15, grid->sizes + 1, grid->indices + 4);
    refuse_anchored(notched, VERTEX, 6);
    it = poly_of(4, 1, four, polygon);
    refuse_anchored(it, FACE, 0);
    poly_free(it);
    it = poly_of(4, 2, threes, fan);
    refuse_anchored(it, FACE, 0);
    poly_free(it);
    /* The caller's face, though quads come last in the mesh. */
    it = poly_grid(2, 2);
    memcpy(indices, it->indices, 16 * sizeof *indices);
    for (i = 0; i < 6; i++)
        indices[16 + i] = fan[i] + 9;
    joined = poly_of(13, 6, mixed, indices);
    refuse_anchored(joined, FACE, 4);
    poly_free(joined);
    poly_free(it);
    poly_free(notched);
    poly_free(grid);
}

static void refuse_tag(const poly *it, uint32_t tag, int32_t anchored)
{
    uint32_t tags[2] = { 0, 0 };
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    tags[1] = tag;
    desc.corner_tags = anchored ? tags + 1 : tags;
    desc.corner_tag_count = anchored ? 1 : 2;
    desc.anchored = anchored;
    refuse_desc(CARVEL_STATUS_INVALID_TAG, &desc);
    names(0, VERTEX, tag, 0);
    names_no_more(1);
}

static void check_tags(void)
{
    poly *grid = poly_grid(2, 2), *more = poly_of(10, 4, grid->sizes, grid->indices);
    check_context("tags");
    refuse_tag(more, 10, 0);
    refuse_tag(more, UINT32_MAX, 0);
    refuse_tag(more, 4, 0);
    refuse_tag(more, 9, 0);
    refuse_tag(more, 1, 1);
    poly_free(more);
    poly_free(grid);
}

/* ------------------------------------------------------------------ levels */

static void check_levels(void)
{
    static const uint32_t levels[6] = { 15, 16, 31, 64, 1u << 20, UINT32_MAX };
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    carvel_refiner *refiner = refiner_of();
    uint32_t i;
    check_context("levels");
    for (i = 0; i < 6; i++) {
        carvel_hierarchy *hierarchy = (carvel_hierarchy *)mesh;
        carvel_refine_input_f64 input = input64(mesh, scheme, levels[i], cube->positions);
        carvel_refine_output_f64 output;
        CHECK_OK(carvel_refine_output_f64_init(&output, sizeof output));
        CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                     carvel_refiner_refine_f64(refiner, NULL, &input, &output, failure));
        CHECK_UINT(0, carvel_refiner_bytes(refiner));
        CHECK_STATUS(CARVEL_STATUS_TOO_LARGE, carvel_hierarchy_create(NULL, mesh, scheme,
                                                                      levels[i], &hierarchy,
                                                                      failure));
        CHECK(hierarchy == NULL);
    }
    carvel_refiner_destroy(refiner);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* A mesh that does not grow: levels have a limit of their own. */
static void check_level_limit(uint64_t faces)
{
    static const uint32_t sizes[1] = { 3 }, indices[3] = { 0, 1, 2 };
    poly *lone = poly_of(3, faces, sizes, indices);
    carvel_mesh *mesh = poly_mesh(lone);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, CARVEL_BOUNDARY_NONE);
    carvel_counts counts = predicted(mesh, scheme, 64);
    check_context("level limit");
    CHECK_UINT(64, counts.level);
    CHECK_UINT(faces, counts.faces);
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_predict_counts(mesh, scheme, 65, &counts, failure));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_predict_counts(mesh, scheme, UINT32_MAX, &counts, failure));
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(lone);
}

/* A face of very many sides, a hub of very many faces. */
static void check_extreme(uint32_t many)
{
    uint32_t sizes[1], *indices = TAKE(uint32_t, 3 * many), *threes = TAKE(uint32_t, many), i;
    poly *polygon, *hub;
    carvel_mesh *mesh;
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, 0);
    level64 level;
    check_context("extreme");
    for (i = 0; i < many; i++)
        indices[i] = i;
    sizes[0] = many;
    polygon = poly_of(many, 1, sizes, indices);
    mesh = poly_mesh(polygon);
    level64_refine(&level, NULL, mesh, scheme, 1, polygon->positions);
    level64_free(&level);
    carvel_mesh_destroy(mesh);
    for (i = 0; i < many; i++) {
        threes[i] = 3;
        indices[3 * i] = i;
        indices[3 * i + 1] = (i + 1) % many;
        indices[3 * i + 2] = many;
    }
    hub = poly_of(many + 1, many, threes, indices);
    mesh = poly_mesh(hub);
    level64_refine(&level, NULL, mesh, scheme, 1, hub->positions);
    level64_free(&level);
    carvel_mesh_destroy(mesh);
    carvel_scheme_destroy(scheme);
    poly_free(hub);
    poly_free(polygon);
    free(indices);
    free(threes);
}

int main(int count, char **arguments)
{
    check_begin();
    check_indices();
    check_sizes();
    check_repeated();
    check_edges();
    check_moebius();
    check_vertices();
    check_callers_order();
    check_list();
    check_second_list();
    check_long_list();
    check_emptied();
    check_cut_cannot_repair();
    check_soups();
    check_lengths();
    check_absurd();
    check_offsets();
    check_layouts();
    check_anchored();
    check_tags();
    check_levels();
    check_level_limit(0);
    check_level_limit(1);
    check_extreme((uint32_t)size_argument(count, arguments, 2000));
    return check_end();
}
