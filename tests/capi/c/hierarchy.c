/* Every function of a hierarchy: counts and meshes of levels, lineage by brute
 * force, rows that reproduce the values, the same bytes as a refiner. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 2 };

/* As tests/kernel/support/tolerance.rs: the same sums in another order. */
static const double ROUNDING = 1e-13;

/* ---------------------------------------------------------------- one level */

/* The arrays of a level's mesh. */
typedef struct arrays {
    carvel_counts counts;
    uint32_t *offsets, *vertices, *twins, *edges, *face_of, *next;
} arrays;

static void take_arrays(arrays *it, const carvel_mesh *mesh)
{
    uint64_t f;
    uint32_t c;
    it->counts = counts_of(mesh);
    it->offsets = TAKE(uint32_t, it->counts.faces + 1);
    it->vertices = TAKE(uint32_t, it->counts.corners);
    it->twins = TAKE(uint32_t, it->counts.corners);
    it->edges = TAKE(uint32_t, it->counts.corners);
    it->face_of = TAKE(uint32_t, it->counts.corners);
    it->next = TAKE(uint32_t, it->counts.corners);
    CHECK_OK(carvel_mesh_face_offsets(mesh, it->offsets, it->counts.faces + 1, failure));
    CHECK_OK(carvel_mesh_face_vertices(mesh, it->vertices, it->counts.corners, failure));
    CHECK_OK(carvel_mesh_corner_twins(mesh, it->twins, it->counts.corners, failure));
    CHECK_OK(carvel_mesh_corner_edges(mesh, it->edges, it->counts.corners, failure));
    for (f = 0; f < it->counts.faces; f++)
        for (c = it->offsets[f]; c < it->offsets[f + 1]; c++) {
            it->face_of[c] = (uint32_t)f;
            it->next[c] = c + 1 < it->offsets[f + 1] ? c + 1 : it->offsets[f];
        }
}

static void free_arrays(arrays *it)
{
    free(it->offsets);
    free(it->vertices);
    free(it->twins);
    free(it->edges);
    free(it->face_of);
    free(it->next);
}

static carvel_mesh *level_mesh(const carvel_hierarchy *hierarchy, uint32_t level)
{
    carvel_mesh *mesh = NULL;
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, level, &mesh, failure));
    return mesh;
}

static carvel_counts level_counts(const carvel_hierarchy *hierarchy, uint32_t level)
{
    carvel_counts counts;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_hierarchy_counts(hierarchy, level, &counts, failure));
    return counts;
}

/* ------------------------------------------------------------------- lineage */

/* Parent and child of one step. */
typedef struct step {
    arrays parent, child;
    carvel_origin *vertices, *faces;
} step;

static int is_corner(const arrays *parent, const carvel_origin *origin)
{
    return origin->kind != CARVEL_ORIGIN_VERTEX && origin->index < parent->counts.corners;
}

static uint32_t side_start(const arrays *it, uint32_t corner)
{
    return it->vertices[corner];
}

static uint32_t side_end(const arrays *it, uint32_t corner)
{
    return it->vertices[it->next[corner]];
}

/* 1 if a refined vertex lies in a face: at one of its corners. */
static int comes_from_face(const step *it, const carvel_origin *origin, uint32_t face)
{
    return origin->kind == CARVEL_ORIGIN_CORNER && is_corner(&it->parent, origin) &&
           it->parent.face_of[origin->index] == face;
}

/* 1 if it lies beside an edge: at an end of it, in a face of it, or on it. */
static int comes_from_edge(const step *it, const carvel_origin *origin, uint32_t side)
{
    const arrays *parent = &it->parent;
    uint32_t twin = parent->twins[side], at = origin->index;
    if (!is_corner(parent, origin))
        return 0;
    if (origin->kind != CARVEL_ORIGIN_CORNER)
        return twin == UINT32_MAX && at == side;
    return at == side || at == parent->next[side] ||
           (twin != UINT32_MAX && (at == twin || at == parent->next[twin]));
}

/* 1 if it lies at a vertex. */
static int comes_from_vertex(const step *it, const carvel_origin *origin, uint32_t vertex)
{
    switch (origin->kind) {
    case CARVEL_ORIGIN_VERTEX:
        return origin->index == vertex;
    case CARVEL_ORIGIN_CORNER:
    case CARVEL_ORIGIN_EDGE_START:
        return is_corner(&it->parent, origin) &&
               side_start(&it->parent, origin->index) == vertex;
    case CARVEL_ORIGIN_EDGE_END:
        return is_corner(&it->parent, origin) && side_end(&it->parent, origin->index) == vertex;
    default:
        return 0;
    }
}

static int comes_from(const step *it, const carvel_origin *vertex, const carvel_origin *face)
{
    switch (face->kind) {
    case CARVEL_ORIGIN_FACE:
        return comes_from_face(it, vertex, face->index);
    case CARVEL_ORIGIN_EDGE:
        return face->index < it->parent.counts.corners &&
               comes_from_edge(it, vertex, face->index);
    case CARVEL_ORIGIN_VERTEX:
        return comes_from_vertex(it, vertex, face->index);
    default:
        return 0;
    }
}

/* Every face is made of vertices from its own parent. */
static void check_face_parents(const step *it)
{
    uint64_t f;
    uint32_t c;
    for (f = 0; f < it->child.counts.faces; f++)
        for (c = it->child.offsets[f]; c < it->child.offsets[f + 1]; c++)
            CHECK(comes_from(it, &it->vertices[it->child.vertices[c]], &it->faces[f]));
}

/* How many elements have an origin. */
static uint64_t times(const carvel_origin *origins, uint64_t count, uint32_t kind, uint32_t index)
{
    uint64_t i, found = 0;
    for (i = 0; i < count; i++)
        found += origins[i].kind == kind && origins[i].index == index;
    return found;
}

static uint64_t vertices_from(const step *it, uint32_t kind, uint32_t index)
{
    return times(it->vertices, it->child.counts.vertices, kind, index);
}

static uint64_t faces_from(const step *it, uint32_t kind, uint32_t index)
{
    return times(it->faces, it->child.counts.faces, kind, index);
}

/* Each corner leaves one vertex; a side of the boundary, two where the step lays
 * an anchor row; each edge and each face, one face. */
static void check_complete(const step *it, int lays_row)
{
    const arrays *parent = &it->parent;
    uint32_t c, f;
    for (c = 0; c < parent->counts.corners; c++) {
        uint32_t twin = parent->twins[c];
        uint64_t on_rim = twin == UINT32_MAX && lays_row;
        CHECK_UINT(1, vertices_from(it, CARVEL_ORIGIN_CORNER, c));
        CHECK_UINT(on_rim, vertices_from(it, CARVEL_ORIGIN_EDGE_START, c));
        CHECK_UINT(on_rim, vertices_from(it, CARVEL_ORIGIN_EDGE_END, c));
        /* By either corner that leads away. */
        CHECK_UINT(twin == UINT32_MAX ? on_rim : 1,
                   faces_from(it, CARVEL_ORIGIN_EDGE, c) +
                       (twin == UINT32_MAX ? 0 : faces_from(it, CARVEL_ORIGIN_EDGE, twin)));
    }
    for (f = 0; f < parent->counts.faces; f++)
        CHECK_UINT(1, faces_from(it, CARVEL_ORIGIN_FACE, f));
}

/* ----------------------------------------------------------- primal lineage */

/* A vertex of a refined face must have this origin; edges are compared by number. */
static void check_comes(const step *it, uint32_t corner, uint32_t kind, uint32_t index)
{
    carvel_origin origin = it->vertices[it->child.vertices[corner]];
    CHECK_UINT(kind, origin.kind);
    if (kind != CARVEL_ORIGIN_EDGE)
        CHECK_UINT(index, origin.index);
    else if (CHECK(origin.index < it->parent.counts.corners))
        CHECK_UINT(it->parent.edges[index], it->parent.edges[origin.index]);
}

static uint32_t before(const arrays *it, uint32_t corner)
{
    uint32_t first = it->offsets[it->face_of[corner]];
    return corner > first ? corner - 1 : it->offsets[it->face_of[corner] + 1] - 1;
}

/* The face in a corner: from the vertex through the edge ahead and, if it is a quad,
 * the middle, to the edge behind. */
static void check_face_in_corner(const step *it, uint32_t face, uint32_t corner)
{
    uint32_t first = it->child.offsets[face], last = it->child.offsets[face + 1] - 1;
    check_comes(it, first, CARVEL_ORIGIN_VERTEX, it->parent.vertices[corner]);
    check_comes(it, first + 1, CARVEL_ORIGIN_EDGE, corner);
    if (last - first == 3)
        check_comes(it, first + 2, CARVEL_ORIGIN_FACE, it->parent.face_of[corner]);
    check_comes(it, last, CARVEL_ORIGIN_EDGE, before(&it->parent, corner));
}

/* Quads in the order of the corners, or triangles with one in the middle of three. */
static void check_primal_faces(const step *it, int triangles)
{
    uint32_t corner = 0, f, i;
    for (f = 0; f < it->child.counts.faces; f++) {
        if (triangles && f % 4 == 3) {
            CHECK_UINT(CARVEL_ORIGIN_FACE, it->faces[f].kind);
            CHECK_UINT(f / 4, it->faces[f].index);
            for (i = 0; i < 3; i++)
                check_comes(it, it->child.offsets[f] + i, CARVEL_ORIGIN_EDGE,
                            before(&it->parent, corner - 3 + i));
            continue;
        }
        CHECK_UINT(CARVEL_ORIGIN_CORNER, it->faces[f].kind);
        CHECK_UINT(corner, it->faces[f].index);
        check_face_in_corner(it, f, corner++);
    }
    CHECK_UINT(it->parent.counts.corners, corner);
}

/* Old vertices, then edges by number, then faces. */
static void check_primal_vertices(const step *it, int triangles)
{
    const carvel_counts *parent = &it->parent.counts;
    uint64_t v, edges = parent->vertices + parent->edges;
    CHECK_UINT(edges + (triangles ? 0 : parent->faces), it->child.counts.vertices);
    for (v = 0; v < it->child.counts.vertices; v++) {
        carvel_origin origin = it->vertices[v];
        if (v < parent->vertices) {
            CHECK_UINT(CARVEL_ORIGIN_VERTEX, origin.kind);
            CHECK_UINT(v, origin.index);
        } else if (v < edges) {
            CHECK_UINT(CARVEL_ORIGIN_EDGE, origin.kind);
            if (CHECK(origin.index < parent->corners))
                CHECK_UINT(v - parent->vertices, it->parent.edges[origin.index]);
        } else {
            CHECK_UINT(CARVEL_ORIGIN_FACE, origin.kind);
            CHECK_UINT(v - edges, origin.index);
        }
    }
}

/* How a scheme splits: DUAL, laying a ROW along the boundary or not, or one of the
 * primal splits. */
enum split { DUAL, ROW, QUADS, TRIANGLES };

static void check_lineage(const carvel_hierarchy *hierarchy, uint32_t level, int split)
{
    carvel_mesh *before = level_mesh(hierarchy, level - 1), *after = level_mesh(hierarchy, level);
    step it;
    take_arrays(&it.parent, before);
    take_arrays(&it.child, after);
    it.vertices = TAKE(carvel_origin, it.child.counts.vertices);
    it.faces = TAKE(carvel_origin, it.child.counts.faces);
    CHECK_OK(carvel_hierarchy_vertex_origins(hierarchy, level, it.vertices,
                                             it.child.counts.vertices, failure));
    CHECK_OK(carvel_hierarchy_face_origins(hierarchy, level, it.faces, it.child.counts.faces,
                                           failure));
    if (split == DUAL || split == ROW) {
        check_face_parents(&it);
        check_complete(&it, split == ROW);
    } else {
        check_primal_faces(&it, split == TRIANGLES);
        check_primal_vertices(&it, split == TRIANGLES);
    }
    free(it.vertices);
    free(it.faces);
    free_arrays(&it.parent);
    free_arrays(&it.child);
    carvel_mesh_destroy(before);
    carvel_mesh_destroy(after);
}

/* --------------------------------------------------------------------- values */

static double *values_of(const carvel_hierarchy *hierarchy, uint32_t level,
                         const double *positions, uint64_t count)
{
    carvel_const_values_f64 in;
    carvel_values_f64 out;
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    in.data = positions;
    in.count = count;
    in.width = out.width = 3;
    out.count = level_counts(hierarchy, level).vertices;
    out.data = TAKE(double, 3 * out.count);
    CHECK_OK(carvel_hierarchy_refine_f64(hierarchy, NULL, level, &in, &out, failure));
    return out.data;
}

/* The product of a stage's matrix and values. */
static double *apply_stage(const carvel_hierarchy *hierarchy, uint32_t level, uint32_t stage,
                           const double *values)
{
    uint64_t vertices = level_counts(hierarchy, level).vertices, count = 0, row, k, x;
    uint64_t *offsets = TAKE(uint64_t, vertices + 1);
    double *out = TAKE(double, 3 * vertices), *weights;
    uint32_t *indices;
    CHECK_OK(carvel_hierarchy_rows(hierarchy, level, stage, offsets, vertices + 1, NULL, NULL, 0,
                                   &count, failure));
    CHECK_UINT(count, offsets[vertices]);
    indices = TAKE(uint32_t, count);
    weights = TAKE(double, count);
    memset(offsets, 0xee, (size_t)(vertices + 1) * sizeof *offsets);
    CHECK_OK(carvel_hierarchy_rows(hierarchy, level, stage, offsets, vertices + 1, indices,
                                   weights, count, NULL, failure));
    CHECK_UINT(0, offsets[0]);
    for (row = 0; row < vertices; row++) {
        double sum = 0.0;
        for (k = offsets[row]; k < offsets[row + 1]; k++) {
            sum += weights[k];
            for (x = 0; x < 3; x++)
                out[3 * row + x] += weights[k] * values[3 * (uint64_t)indices[k] + x];
        }
        CHECK(fabs(sum - 1.0) < ROUNDING);
    }
    free(offsets);
    free(indices);
    free(weights);
    return out;
}

static double *copy_of(const double *values, uint64_t count)
{
    double *copy = TAKE(double, count);
    memcpy(copy, values, (size_t)count * sizeof *copy);
    return copy;
}

/* Stage by stage from one level to the next, and level by level to the last. */
static void check_rows(const carvel_hierarchy *hierarchy, uint64_t passes, const poly *control)
{
    uint32_t level, stage;
    double *values = copy_of(control->positions, 3 * control->vertices);
    for (level = 1; level <= LEVELS; level++) {
        uint64_t count = 3 * level_counts(hierarchy, level).vertices, i;
        double *expected = values_of(hierarchy, level, control->positions, control->vertices);
        for (stage = 0; stage <= passes; stage++) {
            double *next = apply_stage(hierarchy, level, stage, values);
            free(values);
            values = next;
        }
        for (i = 0; i < count; i++)
            CHECK(fabs(values[i] - expected[i]) < ROUNDING);
        free(expected);
    }
    free(values);
}

/* There is no stage after the last pass. */
static void check_no_more_stages(const carvel_hierarchy *hierarchy, uint64_t passes)
{
    uint64_t vertices = level_counts(hierarchy, 1).vertices;
    uint64_t *offsets = TAKE(uint64_t, vertices + 1);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_rows(hierarchy, 1, (uint32_t)passes + 1, offsets, vertices + 1,
                                       NULL, NULL, 0, NULL, failure));
    free(offsets);
}

/* The same bytes as a refiner's, faces included. */
static void check_refiner(const carvel_hierarchy *hierarchy, const carvel_mesh *mesh,
                          const carvel_scheme *scheme, const poly *control, uint32_t level)
{
    level64 once;
    carvel_mesh *built = level_mesh(hierarchy, level);
    double *values = values_of(hierarchy, level, control->positions, control->vertices);
    arrays it;
    take_arrays(&it, built);
    level64_refine(&once, NULL, mesh, scheme, level, control->positions);
    CHECK_BYTES(once.output.positions.data, values,
                (size_t)once.counts.vertices * 3 * sizeof(double));
    CHECK_BYTES(once.output.face_offsets.data, it.offsets, (size_t)(it.counts.faces + 1) * 4);
    CHECK_BYTES(once.output.face_vertices.data, it.vertices, (size_t)it.counts.corners * 4);
    free_arrays(&it);
    free(values);
    level64_free(&once);
    carvel_mesh_destroy(built);
}

/* --------------------------------------------------------------------- levels */

static void check_level(const carvel_hierarchy *hierarchy, const carvel_mesh *mesh,
                        const carvel_scheme *scheme, uint32_t level)
{
    carvel_mesh *built = level_mesh(hierarchy, level);
    carvel_counts counts = level_counts(hierarchy, level), of_mesh = counts_of(built);
    carvel_counts expected = predicted(mesh, scheme, level);
    uint32_t *sources = TAKE(uint32_t, counts.faces), f;
    CHECK_BYTES(&expected, &counts, sizeof counts);
    of_mesh.level = level;
    CHECK_BYTES(&expected, &of_mesh, sizeof counts);
    CHECK_OK(carvel_mesh_validate(built, failure));
    if (level > 0) {
        /* For the mesh of a refined level every face is its own source. */
        CHECK_OK(carvel_mesh_face_sources(built, sources, counts.faces, failure));
        for (f = 0; f < counts.faces; f++)
            CHECK_UINT(f, sources[f]);
    }
    free(sources);
    carvel_mesh_destroy(built);
}

static void check_not_built(const carvel_hierarchy *hierarchy)
{
    carvel_counts counts;
    carvel_mesh *mesh = (carvel_mesh *)&counts;
    carvel_origin origin;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_counts(hierarchy, LEVELS + 1, &counts, failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_mesh(hierarchy, LEVELS + 1, &mesh, failure));
    CHECK(mesh == NULL);
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_vertex_origins(hierarchy, 0, &origin, 1, failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_vertex_origins(hierarchy, LEVELS + 1, &origin, 1, failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_face_origins(hierarchy, 0, &origin, 1, failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_face_origins(hierarchy, LEVELS + 1, &origin, 1, failure));
}

static uint64_t passes_of(const carvel_scheme *scheme)
{
    uint64_t count = 99;
    CHECK_OK(carvel_scheme_passes(scheme, NULL, 0, &count, failure));
    return count;
}

static void check_stages(const poly *control, const carvel_scheme *scheme, int split,
                         uint64_t last)
{
    carvel_mesh *mesh = poly_mesh(control), *kept = poly_mesh(control);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, LEVELS);
    uint32_t level;
    /* The hierarchy keeps what it needs. */
    carvel_mesh_destroy(mesh);
    CHECK_UINT(LEVELS, carvel_hierarchy_last_level(hierarchy));
    for (level = 0; level <= LEVELS; level++) {
        check_level(hierarchy, kept, scheme, level);
        check_refiner(hierarchy, kept, scheme, control, level);
    }
    check_lineage(hierarchy, 1, split);
    /* The row is laid once, and refined along itself from then on; without one
     * nothing is ever laid. */
    check_lineage(hierarchy, 2, split == ROW ? DUAL : split);
    check_rows(hierarchy, last, control);
    check_no_more_stages(hierarchy, last);
    check_not_built(hierarchy);
    carvel_hierarchy_destroy(hierarchy);
    carvel_mesh_destroy(kept);
}

/* A stage for the split and each pass. */
static void check_hierarchy(const poly *control, const carvel_scheme *scheme, int split)
{
    check_stages(control, scheme, split, passes_of(scheme));
}

/* A step with the tuned rule is one stage, and its values are others from the second step on;
 * later where faces at the boundary are near all that is irregular. */
static void check_tuned(const poly *control, int split, uint32_t first)
{
    carvel_mesh *mesh = poly_mesh(control);
    carvel_scheme *plain = NULL, *tuned = NULL;
    carvel_scheme_desc desc;
    uint32_t level;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = CARVEL_SCHEME_THREE_POINT;
    CHECK_OK(carvel_scheme_create(&desc, &plain, failure));
    desc.extraordinary = CARVEL_EXTRAORDINARY_TUNED;
    CHECK_OK(carvel_scheme_create(&desc, &tuned, failure));
    CHECK_UINT(1, passes_of(tuned));
    check_stages(control, tuned, split, 0);
    for (level = 1; level <= LEVELS + 1; level++) {
        level64 by_rule, by_default;
        level64_refine(&by_rule, NULL, mesh, tuned, level, control->positions);
        level64_refine(&by_default, NULL, mesh, plain, level, control->positions);
        CHECK((memcmp(by_rule.output.positions.data, by_default.output.positions.data,
                      (size_t)by_rule.counts.vertices * 3 * sizeof(double)) == 0) ==
              (level < first));
        level64_free(&by_rule);
        level64_free(&by_default);
    }
    carvel_scheme_destroy(plain);
    carvel_scheme_destroy(tuned);
    carvel_mesh_destroy(mesh);
}

static void check_family(const poly *control, int32_t family, int open)
{
    int32_t boundary;
    for (boundary = 0; boundary < 3; boundary++) {
        carvel_scheme *scheme = scheme_of(family, boundary);
        check_hierarchy(control, scheme, open && boundary != CARVEL_BOUNDARY_NONE ? ROW : DUAL);
        carvel_scheme_destroy(scheme);
    }
}

static void check_primal(const poly *control, int32_t family, int split)
{
    int32_t boundary;
    for (boundary = 0; boundary < 3; boundary++) {
        carvel_scheme *scheme = scheme_of(family, boundary);
        check_hierarchy(control, scheme, split);
        carvel_scheme_destroy(scheme);
    }
}

/* An odd degree is primal, and has passes to be told. */
static void check_odd_spline(const poly *control)
{
    carvel_scheme_desc desc;
    carvel_scheme *scheme = NULL;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = CARVEL_SCHEME_B_SPLINE;
    desc.degree = 5;
    CHECK_OK(carvel_scheme_create(&desc, &scheme, failure));
    check_hierarchy(control, scheme, QUADS);
    carvel_scheme_destroy(scheme);
}

/* Meshes had from a hierarchy live on, and so does a scheme's work. */
static void check_lives_on(void)
{
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube), *level;
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, 0);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, 1);
    check_context("lives on");
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    level = level_mesh(hierarchy, 1);
    free(values_of(hierarchy, 1, cube->positions, 8));
    carvel_hierarchy_destroy(hierarchy);
    CHECK_OK(carvel_mesh_validate(level, failure));
    CHECK_UINT(26, counts_of(level).faces);
    carvel_mesh_destroy(level);
    poly_free(cube);
}

int main(void)
{
    static const uint32_t strip_sizes[3] = { 3, 3, 3 };
    static const uint32_t strip_indices[9] = { 0, 1, 2, 2, 1, 3, 2, 3, 4 };
    poly *cube = poly_cube(), *grid = poly_grid(3, 2), *mixed = poly_mixed();
    poly *octahedron = poly_octahedron(), *strip = poly_of(6, 3, strip_sizes, strip_indices);
    check_begin();
    check_context("cube");
    check_family(cube, CARVEL_SCHEME_THREE_POINT, 0);
    check_tuned(cube, DUAL, 2);
    check_context("grid");
    check_family(grid, CARVEL_SCHEME_DOO_SABIN, 1);
    check_family(grid, CARVEL_SCHEME_B_SPLINE, 1);
    check_context("mixed");
    check_family(mixed, CARVEL_SCHEME_THREE_POINT, 1);
    check_family(mixed, CARVEL_SCHEME_QUARTIC, 1);
    check_context("primal");
    check_primal(cube, CARVEL_SCHEME_CATMULL_CLARK, QUADS);
    check_primal(mixed, CARVEL_SCHEME_CATMULL_CLARK, QUADS);
    check_primal(mixed, CARVEL_SCHEME_BILINEAR, QUADS);
    check_primal(strip, CARVEL_SCHEME_CATMULL_CLARK, QUADS);
    check_primal(octahedron, CARVEL_SCHEME_LOOP, TRIANGLES);
    check_primal(strip, CARVEL_SCHEME_LOOP, TRIANGLES);
    check_odd_spline(mixed);
    check_tuned(mixed, ROW, 3);
    check_lives_on();
    poly_free(octahedron);
    poly_free(strip);
    poly_free(cube);
    poly_free(grid);
    poly_free(mixed);
    return check_end();
}
