/* Every function of a mesh, against values found by hand. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

typedef carvel_status (*array_function)(const carvel_mesh *, uint32_t *, uint64_t,
                                        carvel_error *);

/* The array that a function writes must be this one, no entry more. */
static void check_array(const carvel_mesh *mesh, array_function get, const uint32_t *expected,
                        uint64_t count)
{
    uint32_t *room = TAKE(uint32_t, count + 1);
    room[count] = 0xabcdu;
    CHECK_OK(get(mesh, room, count, failure));
    CHECK_BYTES(expected, room, (size_t)count * sizeof *room);
    CHECK_UINT(0xabcdu, room[count]);
    /* A larger buffer is used from its start. */
    memset(room, 0, (size_t)count * sizeof *room);
    CHECK_OK(get(mesh, room, count + 1, failure));
    CHECK_BYTES(expected, room, (size_t)count * sizeof *room);
    CHECK_UINT(0xabcdu, room[count]);
    free(room);
}

static uint32_t *array_of(const carvel_mesh *mesh, array_function get, uint64_t count)
{
    uint32_t *room = TAKE(uint32_t, count);
    CHECK_OK(get(mesh, room, count, failure));
    return room;
}

static void check_flags(const carvel_mesh *mesh, const uint8_t *expected, uint64_t count)
{
    uint8_t *room = TAKE(uint8_t, count + 1);
    room[count] = 0xcd;
    CHECK_OK(carvel_mesh_boundary_flags(mesh, room, count, failure));
    CHECK_BYTES(expected, room, (size_t)count);
    CHECK_UINT(0xcd, room[count]);
    free(room);
}

static void check_counts(const carvel_mesh *mesh, uint64_t vertices, uint64_t faces,
                         uint64_t corners, uint64_t edges, uint64_t boundary_edges,
                         uint64_t irregular_faces)
{
    carvel_counts counts = counts_of(mesh);
    CHECK_UINT(sizeof counts, counts.struct_size);
    CHECK_UINT(0, counts.level);
    CHECK_UINT(vertices, counts.vertices);
    CHECK_UINT(faces, counts.faces);
    CHECK_UINT(corners, counts.corners);
    CHECK_UINT(edges, counts.edges);
    CHECK_UINT(boundary_edges, counts.boundary_edges);
    CHECK_UINT(irregular_faces, counts.irregular_faces);
}

static carvel_survey survey_of(const carvel_mesh *mesh)
{
    carvel_survey survey;
    CHECK_OK(carvel_survey_init(&survey, sizeof survey));
    CHECK_OK(carvel_mesh_survey(mesh, &survey, failure));
    CHECK_UINT(sizeof survey, survey.struct_size);
    return survey;
}

static void check_survey(const carvel_mesh *mesh, uint64_t components, uint64_t boundary_loops,
                         uint64_t isolated, int64_t euler, uint64_t tags)
{
    carvel_survey survey = survey_of(mesh);
    CHECK_UINT(components, survey.components);
    CHECK_UINT(boundary_loops, survey.boundary_loops);
    CHECK_UINT(isolated, survey.isolated_vertices);
    CHECK(euler == survey.euler_characteristic);
    CHECK_UINT(tags, survey.corner_tags);
}

/* A histogram by its pairs of value and count: asked for its length first. */
static void check_histogram(const carvel_mesh *mesh, int32_t which, const uint64_t *pairs,
                            uint64_t entries)
{
    carvel_histogram_entry room[8];
    uint64_t count = 99, i;
    CHECK_OK(carvel_mesh_histogram(mesh, which, NULL, 0, &count, failure));
    CHECK_UINT(entries, count);
    memset(room, 0xcd, sizeof room);
    CHECK_OK(carvel_mesh_histogram(mesh, which, room, 8, NULL, failure));
    for (i = 0; i < entries; i++) {
        CHECK_UINT(pairs[2 * i], room[i].value);
        CHECK_UINT(pairs[2 * i + 1], room[i].count);
    }
    CHECK_UINT((uint64_t)0xcdcdcdcdcdcdcdcdUL, room[entries].value);
}

/* ------------------------------------------------------------- adjacency */

typedef struct adjacency {
    carvel_counts counts;
    uint32_t *offsets, *vertices, *edges, *corner_edges, *twins, *valences;
    uint8_t *boundary;
    /* The next corner of each corner's face. */
    uint32_t *next;
} adjacency;

static void take_next(adjacency *it)
{
    uint64_t f;
    uint32_t c;
    it->next = TAKE(uint32_t, it->counts.corners);
    for (f = 0; f < it->counts.faces; f++)
        for (c = it->offsets[f]; c < it->offsets[f + 1]; c++)
            it->next[c] = c + 1 < it->offsets[f + 1] ? c + 1 : it->offsets[f];
}

static void take_adjacency(adjacency *it, const carvel_mesh *mesh)
{
    carvel_counts counts = counts_of(mesh);
    it->counts = counts;
    it->offsets = array_of(mesh, carvel_mesh_face_offsets, counts.faces + 1);
    it->vertices = array_of(mesh, carvel_mesh_face_vertices, counts.corners);
    it->edges = array_of(mesh, carvel_mesh_edges, 2 * counts.edges);
    it->corner_edges = array_of(mesh, carvel_mesh_corner_edges, counts.corners);
    it->twins = array_of(mesh, carvel_mesh_corner_twins, counts.corners);
    it->valences = array_of(mesh, carvel_mesh_valences, counts.vertices);
    it->boundary = TAKE(uint8_t, counts.vertices);
    CHECK_OK(carvel_mesh_boundary_flags(mesh, it->boundary, counts.vertices, failure));
    take_next(it);
}

static void free_adjacency(adjacency *it)
{
    free(it->offsets);
    free(it->vertices);
    free(it->edges);
    free(it->corner_edges);
    free(it->twins);
    free(it->valences);
    free(it->boundary);
    free(it->next);
}

/* The ends of a corner's edge are its vertex and the next, in either order. */
static int edge_has_ends(const adjacency *it, uint32_t c)
{
    const uint32_t *ends = it->edges + 2 * (size_t)it->corner_edges[c];
    uint32_t a = it->vertices[c], b = it->vertices[it->next[c]];
    return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a);
}

static void check_twin(const adjacency *it, uint32_t c)
{
    uint32_t twin = it->twins[c];
    if (twin == UINT32_MAX) {
        CHECK_UINT(1, it->boundary[it->vertices[c]]);
        CHECK_UINT(1, it->boundary[it->vertices[it->next[c]]]);
        return;
    }
    CHECK(twin < it->counts.corners && twin != c);
    CHECK_UINT(c, it->twins[twin]);
    CHECK_UINT(it->corner_edges[c], it->corner_edges[twin]);
    CHECK_UINT(it->vertices[c], it->vertices[it->next[twin]]);
    CHECK_UINT(it->vertices[twin], it->vertices[it->next[c]]);
}

/* Edges are numbered by their first corner: numbers appear one by one. */
static void check_edge_numbers(const adjacency *it)
{
    uint64_t c, seen = 0, open = 0;
    for (c = 0; c < it->counts.corners; c++) {
        CHECK(it->corner_edges[c] <= seen);
        seen += it->corner_edges[c] == seen;
        open += it->twins[c] == UINT32_MAX;
    }
    CHECK_UINT(it->counts.edges, seen);
    CHECK_UINT(it->counts.boundary_edges, open);
}

static void check_adjacency(const carvel_mesh *mesh)
{
    adjacency it;
    uint32_t *around;
    uint64_t c, v;
    take_adjacency(&it, mesh);
    around = TAKE(uint32_t, it.counts.vertices);
    CHECK_UINT(it.counts.corners, it.offsets[it.counts.faces]);
    for (c = 0; c < it.counts.corners; c++) {
        CHECK(edge_has_ends(&it, (uint32_t)c));
        check_twin(&it, (uint32_t)c);
        around[it.vertices[c]]++;
    }
    check_edge_numbers(&it);
    for (v = 0; v < it.counts.vertices; v++)
        CHECK_UINT(around[v], it.valences[v]);
    CHECK_OK(carvel_mesh_validate(mesh, failure));
    free(around);
    free_adjacency(&it);
}

/* ----------------------------------------------------------------- meshes */

static void check_cube_arrays(const carvel_mesh *mesh, const poly *cube)
{
    static const uint32_t sizes[6] = { 4, 4, 4, 4, 4, 4 };
    static const uint32_t offsets[7] = { 0, 4, 8, 12, 16, 20, 24 };
    static const uint32_t edges[24] = { 3, 2, 2, 1, 1, 0, 0, 3, 4, 5, 5, 6,
                                        6, 7, 7, 4, 1, 5, 4, 0, 2, 6, 3, 7 };
    static const uint32_t corner_edges[24] = { 0, 1, 2, 3, 4,  5, 6, 7, 2, 8, 4, 9,
                                               1, 10, 5, 8, 0, 11, 6, 10, 3, 9, 7, 11 };
    static const uint32_t twins[24] = { 16, 12, 8,  20, 10, 14, 18, 22, 2, 15, 4, 21,
                                        1,  19, 5,  9,  0,  23, 6,  13, 3, 11, 7, 17 };
    static const uint32_t valences[8] = { 3, 3, 3, 3, 3, 3, 3, 3 };
    static const uint32_t numbers[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    check_array(mesh, carvel_mesh_face_sizes, sizes, 6);
    check_array(mesh, carvel_mesh_face_offsets, offsets, 7);
    check_array(mesh, carvel_mesh_face_vertices, cube->indices, 24);
    check_array(mesh, carvel_mesh_edges, edges, 24);
    check_array(mesh, carvel_mesh_corner_edges, corner_edges, 24);
    check_array(mesh, carvel_mesh_corner_twins, twins, 24);
    check_array(mesh, carvel_mesh_valences, valences, 8);
    check_array(mesh, carvel_mesh_face_sources, numbers, 6);
    check_array(mesh, carvel_mesh_vertex_sources, numbers, 8);
    check_array(mesh, carvel_mesh_corner_tags, numbers, 0);
}

static void check_cube(void)
{
    static const uint8_t inside[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    static const uint64_t quads[2] = { 4, 6 }, threes[2] = { 3, 8 };
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube);
    check_context("cube");
    check_counts(mesh, 8, 6, 24, 12, 0, 0);
    check_survey(mesh, 1, 0, 0, 2, 0);
    CHECK_UINT(0, survey_of(mesh).anchored);
    /* Vertex and twin of every corner are the least a mesh can hold. */
    CHECK(survey_of(mesh).bytes >= 24 * 8 && survey_of(mesh).bytes < 4096);
    check_cube_arrays(mesh, cube);
    check_flags(mesh, inside, 8);
    check_histogram(mesh, CARVEL_HISTOGRAM_FACE_SIZES, quads, 1);
    check_histogram(mesh, CARVEL_HISTOGRAM_INTERIOR_VALENCES, threes, 1);
    check_histogram(mesh, CARVEL_HISTOGRAM_BOUNDARY_VALENCES, NULL, 0);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

static void check_grid(void)
{
    static const uint8_t rim[9] = { 1, 1, 1, 1, 0, 1, 1, 1, 1 };
    static const uint32_t valences[9] = { 1, 2, 1, 2, 4, 2, 1, 2, 1 };
    static const uint64_t quads[2] = { 4, 4 }, four[2] = { 4, 1 }, ones[4] = { 1, 4, 2, 4 };
    /* Across 3-4, 4-1 and so on; the faces are 0 3 4 1, 1 4 5 2, 3 6 7 4, 4 7 8 5. */
    static const uint32_t twins[16] = { UINT32_MAX, 11, 4, UINT32_MAX, 2, 15, UINT32_MAX,
                                        UINT32_MAX, UINT32_MAX, UINT32_MAX, 12, 1, 10,
                                        UINT32_MAX, UINT32_MAX, 5 };
    poly *grid = poly_grid(2, 2);
    carvel_mesh *mesh = poly_mesh(grid);
    check_context("grid");
    check_counts(mesh, 9, 4, 16, 12, 8, 0);
    check_survey(mesh, 1, 1, 0, 1, 0);
    check_array(mesh, carvel_mesh_valences, valences, 9);
    check_array(mesh, carvel_mesh_corner_twins, twins, 16);
    check_flags(mesh, rim, 9);
    check_histogram(mesh, CARVEL_HISTOGRAM_FACE_SIZES, quads, 1);
    check_histogram(mesh, CARVEL_HISTOGRAM_INTERIOR_VALENCES, four, 1);
    check_histogram(mesh, CARVEL_HISTOGRAM_BOUNDARY_VALENCES, ones, 2);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* Faces that are no quads come first. */
static void check_mixed(void)
{
    static const uint32_t sizes[4] = { 3, 5, 4, 4 };
    static const uint32_t offsets[5] = { 0, 3, 8, 12, 16 };
    static const uint32_t indices[16] = { 3, 2, 4, 4, 2, 5, 6, 7, 0, 1, 2, 3, 8, 9, 10, 11 };
    static const uint32_t sources[4] = { 1, 2, 0, 3 };
    static const uint32_t valences[13] = { 1, 1, 3, 2, 2, 1, 1, 1, 1, 1, 1, 1, 0 };
    static const uint8_t rim[13] = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0 };
    static const uint64_t by_size[6] = { 3, 1, 4, 2, 5, 1 }, by_rim[6] = { 1, 9, 2, 2, 3, 1 };
    poly *mixed = poly_mixed();
    carvel_mesh *mesh = poly_mesh(mixed);
    check_context("mixed");
    check_counts(mesh, 13, 4, 16, 14, 12, 2);
    check_survey(mesh, 2, 2, 1, 2, 0);
    check_array(mesh, carvel_mesh_face_sizes, sizes, 4);
    check_array(mesh, carvel_mesh_face_offsets, offsets, 5);
    check_array(mesh, carvel_mesh_face_vertices, indices, 16);
    check_array(mesh, carvel_mesh_face_sources, sources, 4);
    check_array(mesh, carvel_mesh_valences, valences, 13);
    check_flags(mesh, rim, 13);
    check_histogram(mesh, CARVEL_HISTOGRAM_FACE_SIZES, by_size, 3);
    check_histogram(mesh, CARVEL_HISTOGRAM_INTERIOR_VALENCES, NULL, 0);
    check_histogram(mesh, CARVEL_HISTOGRAM_BOUNDARY_VALENCES, by_rim, 3);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(mixed);
}

/* ---------------------------------------------------------------- layouts */

/* Two meshes that answer alike. */
static void check_same(const carvel_mesh *x, const carvel_mesh *y)
{
    carvel_counts a = counts_of(x), b = counts_of(y);
    uint32_t *expected = array_of(x, carvel_mesh_face_vertices, a.corners);
    CHECK_BYTES(&a, &b, sizeof a);
    check_array(y, carvel_mesh_face_vertices, expected, a.corners);
    free(expected);
    expected = array_of(x, carvel_mesh_face_offsets, a.faces + 1);
    check_array(y, carvel_mesh_face_offsets, expected, a.faces + 1);
    free(expected);
    expected = array_of(x, carvel_mesh_face_sources, a.faces);
    check_array(y, carvel_mesh_face_sources, expected, a.faces);
    free(expected);
}

static void check_described(const carvel_mesh_desc *desc, const carvel_mesh *expected)
{
    carvel_mesh *mesh = NULL;
    if (CHECK_OK(carvel_mesh_create(NULL, desc, &mesh, failure)))
        check_same(expected, mesh);
    carvel_mesh_destroy(mesh);
}

static void check_layouts(void)
{
    static const uint32_t mixed_offsets[5] = { 0, 4, 7, 12, 16 };
    poly *mixed = poly_mixed(), *cube = poly_cube();
    carvel_mesh *expected = poly_mesh(mixed);
    carvel_mesh_desc desc;
    check_context("offsets");
    poly_describe(mixed, &desc);
    desc.face_sizes = NULL;
    desc.face_offsets = mixed_offsets;
    check_described(&desc, expected);
    carvel_mesh_destroy(expected);
    check_context("one size");
    expected = poly_mesh(cube);
    poly_describe(cube, &desc);
    desc.face_sizes = NULL;
    desc.face_size = 4;
    check_described(&desc, expected);
    carvel_mesh_destroy(expected);
    poly_free(mixed);
    poly_free(cube);
}

/* Nothing of the caller's is needed once a mesh is made. */
static void check_own_copy(void)
{
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube), *again;
    check_context("own copy");
    memset(cube->sizes, 0xee, (size_t)cube->faces * sizeof *cube->sizes);
    memset(cube->indices, 0xee, (size_t)cube->corners * sizeof *cube->indices);
    poly_free(cube);
    cube = poly_cube();
    again = poly_mesh(cube);
    check_same(again, mesh);
    carvel_mesh_destroy(again);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* -------------------------------------------------------------------- cut */

static carvel_mesh *cut_mesh(const poly *it, const uint32_t *tags, uint64_t tag_count)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    desc.corner_tags = tags;
    desc.corner_tag_count = tag_count;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    return mesh;
}

static void check_bow_tie(void)
{
    static const uint32_t sizes[2] = { 3, 3 }, indices[6] = { 0, 1, 2, 0, 3, 4 };
    static const uint32_t sources[6] = { 0, 1, 2, 3, 4, 0 }, tag[1] = { 0 }, tags[2] = { 0, 5 };
    poly *bow_tie = poly_of(5, 2, sizes, indices);
    carvel_mesh *mesh = cut_mesh(bow_tie, tag, 1);
    check_context("bow tie");
    check_counts(mesh, 6, 2, 6, 6, 6, 0);
    check_survey(mesh, 2, 2, 0, 2, 2);
    check_array(mesh, carvel_mesh_vertex_sources, sources, 6);
    check_array(mesh, carvel_mesh_corner_tags, tags, 2);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(bow_tie);
}

/* Three pages of a book: every page for itself. */
static void check_book(void)
{
    static const uint32_t sizes[3] = { 3, 3, 3 }, indices[9] = { 0, 1, 2, 1, 0, 3, 0, 1, 4 };
    static const uint32_t copies[9] = { 0, 1, 2, 3, 4, 0, 0, 1, 1 };
    poly *book = poly_of(5, 3, sizes, indices);
    carvel_mesh *mesh = cut_mesh(book, NULL, 0);
    check_context("book");
    check_counts(mesh, 9, 3, 9, 9, 9, 0);
    check_survey(mesh, 3, 3, 0, 3, 0);
    check_array(mesh, carvel_mesh_vertex_sources, copies, 9);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(book);
}

/* A pillow whose edges all have two faces is no reason to cut. */
static void check_nothing_to_cut(void)
{
    poly *cube = poly_cube();
    carvel_mesh *plain = poly_mesh(cube), *cut = cut_mesh(cube, NULL, 0);
    check_context("nothing to cut");
    check_same(plain, cut);
    carvel_mesh_destroy(plain);
    carvel_mesh_destroy(cut);
    poly_free(cube);
}

/* ------------------------------------------------ anchored, tags, nothing */

static void check_anchored(void)
{
    poly *grid = poly_grid(2, 2);
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    check_context("anchored");
    poly_describe(grid, &desc);
    desc.anchored = 1;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    CHECK_UINT(1, survey_of(mesh).anchored);
    check_adjacency(mesh);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* Sorted, each once. */
static void check_tags(void)
{
    static const uint32_t given[4] = { 7, 1, 7, 3 }, kept[3] = { 1, 3, 7 };
    poly *grid = poly_grid(2, 2);
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    check_context("tags");
    poly_describe(grid, &desc);
    desc.corner_tags = given;
    desc.corner_tag_count = 4;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    check_survey(mesh, 1, 1, 0, 1, 3);
    check_array(mesh, carvel_mesh_corner_tags, kept, 3);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* Isolated vertices, or none at all. The pointers of empty arrays are not
 * looked at. */
static void check_no_faces(uint64_t vertices)
{
    static const uint32_t zeros[3] = { 0, 0, 0 }, numbers[3] = { 0, 1, 2 };
    static const uint8_t inside[3] = { 0, 0, 0 };
    poly *nothing = poly_of(vertices, 0, NULL, NULL);
    carvel_mesh *mesh = poly_mesh(nothing);
    carvel_counts counts = counts_of(mesh);
    check_context("no faces");
    check_counts(mesh, vertices, 0, 0, 0, 0, 0);
    check_survey(mesh, 0, 0, vertices, 0, 0);
    check_array(mesh, carvel_mesh_face_offsets, zeros, 1);
    check_array(mesh, carvel_mesh_valences, zeros, vertices);
    check_array(mesh, carvel_mesh_vertex_sources, numbers, vertices);
    check_flags(mesh, inside, vertices);
    check_histogram(mesh, CARVEL_HISTOGRAM_FACE_SIZES, NULL, 0);
    CHECK_OK(carvel_mesh_face_sizes(mesh, NULL, 0, failure));
    CHECK_OK(carvel_mesh_face_vertices(mesh, NULL, 0, failure));
    CHECK_OK(carvel_mesh_edges(mesh, NULL, 0, failure));
    CHECK_UINT(0, counts.faces);
    carvel_mesh_destroy(mesh);
    poly_free(nothing);
}

/* The same prediction by both ways to ask. */
static void check_predictions(void)
{
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, CARVEL_BOUNDARY_NONE);
    carvel_counts counts = predicted(mesh, scheme, 1);
    carvel_bytes bytes;
    carvel_seconds seconds, two;
    check_context("predictions");
    CHECK_UINT(1, counts.level);
    CHECK_UINT(24, counts.vertices);
    CHECK_UINT(26, counts.faces);
    CHECK_UINT(96, counts.corners);
    CHECK_UINT(48, counts.edges);
    CHECK_UINT(0, counts.boundary_edges);
    CHECK_UINT(8, counts.irregular_faces);
    CHECK_OK(carvel_bytes_init(&bytes, sizeof bytes));
    CHECK_OK(carvel_predict_bytes(mesh, scheme, 1, 3, 8, &bytes, failure));
    CHECK_UINT(1, bytes.level);
    CHECK_UINT(26 * 4 + 96 * 4 + 24 * 3 * 8, bytes.output);
    CHECK(bytes.topology >= 96 * 8);
    CHECK_OK(carvel_seconds_init(&seconds, sizeof seconds));
    CHECK_OK(carvel_predict_seconds(mesh, scheme, 1, 3, 8, 1, &seconds, failure));
    CHECK_UINT(1, seconds.level);
    CHECK(seconds.steps > 0 && seconds.last >= 0 && seconds.memory > 0);
    CHECK(seconds.total == seconds.steps + seconds.last + seconds.memory);
    /* 26 faces: not a millisecond on any machine. */
    CHECK(seconds.total > 1e-9 && seconds.total < 1e-3);
    two = seconds;
    CHECK_OK(carvel_predict_seconds(mesh, scheme, 1, 3, 8, 2, &two, failure));
    CHECK(two.total < seconds.total && two.total >= seconds.total / 2);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

int main(void)
{
    check_begin();
    check_cube();
    check_grid();
    check_mixed();
    check_layouts();
    check_own_copy();
    check_bow_tie();
    check_book();
    check_nothing_to_cut();
    check_anchored();
    check_tags();
    check_no_faces(0);
    check_no_faces(3);
    check_predictions();
    return check_end();
}
