/* Primal schemes and what they heed: values found by hand from the papers' weights
 * and OpenSubdiv's rules for creases, corners, holes and edges of many faces. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As tests/kernel/support/tolerance.rs: the same sums in another order. */
static const double ROUNDING = 1e-13;

/* A cube's corners at +-1: the order of poly_cube. */
static const double CUBE[24] = { -1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                 -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1 };

/* The upper ring of poly_cube, 4 5 6 7, from every side. */
static const uint32_t RING[8] = { 4, 5, 6, 5, 6, 7, 4, 7 };

/* ------------------------------------------------------------------ fixture */

static poly *unit_cube(void)
{
    poly *cube = poly_cube();
    memcpy(cube->positions, CUBE, sizeof CUBE);
    return cube;
}

static carvel_scheme *scheme_by(const carvel_scheme_desc *desc)
{
    carvel_scheme *scheme = NULL;
    CHECK_OK(carvel_scheme_create(desc, &scheme, failure));
    return scheme;
}

static carvel_scheme_desc family_of(int32_t family)
{
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = family;
    return desc;
}

static carvel_mesh *mesh_by(const carvel_mesh_desc *desc)
{
    carvel_mesh *mesh = NULL;
    CHECK_OK(carvel_mesh_create(NULL, desc, &mesh, failure));
    return mesh;
}

static carvel_survey survey_of(const carvel_mesh *mesh)
{
    carvel_survey survey;
    CHECK_OK(carvel_survey_init(&survey, sizeof survey));
    CHECK_OK(carvel_mesh_survey(mesh, &survey, failure));
    return survey;
}

static int is_at(const double *p, double x, double y, double z)
{
    return fabs(p[0] - x) < ROUNDING && fabs(p[1] - y) < ROUNDING && fabs(p[2] - z) < ROUNDING;
}

/* 1 if one of the vertices is there. */
static int has_vertex(const level64 *level, double x, double y, double z)
{
    uint64_t v;
    for (v = 0; v < level->counts.vertices; v++)
        if (is_at(level->output.positions.data + 3 * v, x, y, z))
            return 1;
    return 0;
}

static void refine(level64 *level, const poly *control, const carvel_mesh *mesh,
                   const carvel_scheme_desc *desc, uint32_t levels)
{
    carvel_scheme *scheme = scheme_by(desc);
    level64_refine(level, NULL, mesh, scheme, levels, control->positions);
    carvel_scheme_destroy(scheme);
}

static void refine_plain(level64 *level, const poly *control, const carvel_scheme_desc *desc)
{
    carvel_mesh *mesh = poly_mesh(control);
    refine(level, control, mesh, desc, 1);
    carvel_mesh_destroy(mesh);
}

/* ------------------------------------------------------------------ families */

static void check_catmull_clark(void)
{
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    poly *cube = unit_cube();
    level64 level;
    check_context("Catmull-Clark");
    refine_plain(&level, cube, &desc);
    CHECK_UINT(26, level.counts.vertices);
    CHECK_UINT(24, level.counts.faces);
    CHECK_UINT(0, level.output.anchored);
    /* (1/3 + 2 * 2/3 + 0) / 3: old vertices keep their numbers. */
    CHECK(is_at(level.output.positions.data, -5.0 / 9, -5.0 / 9, -5.0 / 9));
    CHECK(has_vertex(&level, 0.75, 0.75, 0) && has_vertex(&level, 0, 0, -1));
    level64_free(&level);
    poly_free(cube);
}

static void check_bilinear(void)
{
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_BILINEAR);
    poly *cube = unit_cube();
    level64 level;
    check_context("bilinear");
    refine_plain(&level, cube, &desc);
    CHECK_BYTES(CUBE, level.output.positions.data, sizeof CUBE);
    CHECK(has_vertex(&level, 1, 1, 0) && has_vertex(&level, 0, 0, -1));
    level64_free(&level);
    poly_free(cube);
}

static void check_equal(const carvel_scheme_desc *a, const carvel_scheme_desc *b)
{
    poly *mixed = poly_mixed();
    level64 x, y;
    refine_plain(&x, mixed, a);
    refine_plain(&y, mixed, b);
    CHECK_UINT(x.counts.vertices, y.counts.vertices);
    CHECK_BYTES(x.output.positions.data, y.output.positions.data,
                (size_t)x.counts.vertices * 3 * sizeof(double));
    level64_free(&x);
    level64_free(&y);
    poly_free(mixed);
}

/* The members of the averaging family under all their names. */
static void check_names(void)
{
    static const carvel_fraction pass[1] = { { 0, 1 } };
    carvel_scheme_desc spline = family_of(CARVEL_SCHEME_B_SPLINE);
    carvel_scheme_desc primal = family_of(CARVEL_SCHEME_PRIMAL);
    carvel_scheme_desc linear = family_of(CARVEL_SCHEME_BILINEAR);
    check_context("names");
    spline.degree = 1;
    check_equal(&linear, &primal);
    check_equal(&linear, &spline);
    spline.degree = 3;
    primal.passes = pass;
    primal.pass_count = 1;
    check_equal(&primal, &spline);
}

/* The top of a refined octahedron, and an edge of it. */
static void check_octahedron(const carvel_scheme_desc *desc, double top, double edge)
{
    poly *octahedron = poly_octahedron();
    level64 level;
    refine_plain(&level, octahedron, desc);
    CHECK(is_at(level.output.positions.data + 12, 0, 0, top));
    CHECK(has_vertex(&level, edge, edge, 0));
    level64_free(&level);
    poly_free(octahedron);
}

static void check_triangles(void)
{
    carvel_scheme_desc loop = family_of(CARVEL_SCHEME_LOOP);
    carvel_scheme_desc clark = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    check_context("Loop's weights");
    /* 1 - (5/8 - (3/8)^2), and 3/8 of the two ends. */
    check_octahedron(&loop, 0.515625, 0.375);
    loop.loop_weights = CARVEL_LOOP_WEIGHTS_WARREN;
    check_octahedron(&loop, 0.625, 0.375);
    check_context("triangle rule");
    /* (1/3 + 2 * 1/2 + 1) / 4, and the mean of two ends and two faces. */
    check_octahedron(&clark, 7.0 / 12, 5.0 / 12);
    /* OpenSubdiv's 0.470 for each face. */
    clark.triangle_rule = CARVEL_TRIANGLE_RULE_SMOOTH;
    check_octahedron(&clark, 7.0 / 12, 0.03 + 0.47 * 2 / 3);
}

/* ------------------------------------------------------------------- creases */

/* A cube with the ring sharp. */
static carvel_mesh *ring_mesh(const poly *cube, const float *sharpness)
{
    carvel_mesh_desc desc;
    poly_describe(cube, &desc);
    desc.crease_vertices = RING;
    desc.crease_sharpness = sharpness;
    desc.crease_count = 4;
    return mesh_by(&desc);
}

/* The creases of a level, whatever their order: how many have a sharpness. */
static void check_sharpness(const carvel_hierarchy *hierarchy, uint32_t level, uint64_t creases,
                            float expected, uint64_t times)
{
    carvel_mesh *mesh = NULL;
    float *found = TAKE(float, creases + 1);
    uint64_t i, seen = 0;
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, level, &mesh, failure));
    CHECK_UINT(creases, survey_of(mesh).creases);
    CHECK_OK(carvel_mesh_crease_sharpness(mesh, found, creases, failure));
    for (i = 0; i < creases; i++)
        seen += memcmp(&found[i], &expected, sizeof expected) == 0;
    CHECK_UINT(times, seen);
    carvel_mesh_destroy(mesh);
    free(found);
}

/* Two vertices for each crease, which are ends of one of the ring. */
static void check_ring(const carvel_mesh *mesh)
{
    uint32_t ends[8];
    unsigned i;
    CHECK_OK(carvel_mesh_crease_vertices(mesh, ends, 8, failure));
    for (i = 0; i < 4; i++) {
        uint32_t a = ends[2 * i], b = ends[2 * i + 1];
        CHECK(a >= 4 && b >= 4 && (a - b == 1 || b - a == 1 || a + b == 11));
    }
}

static void check_infinite_crease(void)
{
    static const float sharpness[4] = { 10, 11, 10, (float)1e30 };
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    carvel_scheme *scheme = scheme_by(&desc);
    poly *cube = unit_cube();
    carvel_mesh *mesh = ring_mesh(cube, sharpness);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, 2);
    level64 level;
    check_context("infinitely sharp");
    check_ring(mesh);
    check_sharpness(hierarchy, 0, 4, 10, 4);
    check_sharpness(hierarchy, 2, 16, 10, 16);
    refine(&level, cube, mesh, &desc, 1);
    /* Midpoints along the crease, and (1 6 1)/8 at its vertices. */
    CHECK(has_vertex(&level, 1, 0, 1) && has_vertex(&level, 0.75, 0.75, 1));
    /* Elsewhere as ever. */
    CHECK(has_vertex(&level, 0.75, 0.75, 0) && has_vertex(&level, -5.0 / 9, -5.0 / 9, -5.0 / 9));
    level64_free(&level);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* Two steps sharp, the third one half, then smooth. */
static void check_semi_sharp(void)
{
    static const float sharpness[4] = { 2.5f, 2.5f, 2.5f, 2.5f };
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    carvel_scheme *scheme = scheme_by(&desc);
    poly *cube = unit_cube();
    carvel_mesh *mesh = ring_mesh(cube, sharpness);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, 3);
    check_context("semi-sharp");
    check_sharpness(hierarchy, 1, 8, 1.5f, 8);
    check_sharpness(hierarchy, 2, 16, 0.5f, 16);
    check_sharpness(hierarchy, 3, 0, 0, 0);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* Half a step sharp is half way between the two rules. */
static void check_fraction(void)
{
    static const float sharpness[4] = { 0.5f, 0.5f, 0.5f, 0.5f };
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    poly *cube = unit_cube();
    carvel_mesh *mesh = ring_mesh(cube, sharpness);
    level64 level;
    check_context("half sharp");
    refine(&level, cube, mesh, &desc, 1);
    CHECK(has_vertex(&level, 0.875, 0, 0.875));
    level64_free(&level);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* Around the ring 2, 4, 2, 4: each end has one of both. */
static void check_chaikin(void)
{
    static const float sharpness[4] = { 2, 4, 4, 2 };
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    carvel_scheme *uniform = scheme_by(&desc), *chaikin;
    poly *cube = unit_cube();
    carvel_mesh *mesh = ring_mesh(cube, sharpness);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, uniform, 1);
    check_context("creasing");
    check_sharpness(hierarchy, 1, 8, 1, 4);
    check_sharpness(hierarchy, 1, 8, 3, 4);
    carvel_hierarchy_destroy(hierarchy);
    desc.creasing = CARVEL_CREASING_CHAIKIN;
    chaikin = scheme_by(&desc);
    hierarchy = hierarchy_of(mesh, chaikin, 1);
    /* 3/4 of its own and 1/4 of the other, where they differ: 4567 has 2 4 2 4 in
     * the order 45, 56, 67, 74, so that 45 and 74, and 56 and 67, are alike. */
    check_sharpness(hierarchy, 1, 8, 1.5f, 2);
    check_sharpness(hierarchy, 1, 8, 2.5f, 2);
    check_sharpness(hierarchy, 1, 8, 1, 2);
    check_sharpness(hierarchy, 1, 8, 3, 2);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(chaikin);
    carvel_scheme_destroy(uniform);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* Interpolated for as long as it is sharp. */
static void check_sharp_vertices(void)
{
    static const uint32_t vertices[2] = { 6, 0 }, sorted[2] = { 0, 6 };
    static const float sharpness[2] = { 1, 20 }, kept[2] = { 10, 1 };
    carvel_scheme_desc desc = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    poly *cube = unit_cube();
    carvel_mesh_desc described;
    carvel_mesh *mesh;
    uint32_t found[2];
    float by[2];
    level64 level;
    check_context("sharp vertices");
    poly_describe(cube, &described);
    described.sharp_vertices = vertices;
    described.vertex_sharpness = sharpness;
    described.sharp_vertex_count = 2;
    mesh = mesh_by(&described);
    CHECK_UINT(2, survey_of(mesh).sharp_vertices);
    CHECK_OK(carvel_mesh_sharp_vertices(mesh, found, 2, failure));
    CHECK_OK(carvel_mesh_vertex_sharpness(mesh, by, 2, failure));
    CHECK_BYTES(sorted, found, sizeof found);
    CHECK_BYTES(kept, by, sizeof by);
    refine(&level, cube, mesh, &desc, 1);
    CHECK(is_at(level.output.positions.data, -1, -1, -1));
    CHECK(is_at(level.output.positions.data + 18, 1, 1, 1));
    level64_free(&level);
    refine(&level, cube, mesh, &desc, 2);
    CHECK(is_at(level.output.positions.data, -1, -1, -1));
    CHECK(!is_at(level.output.positions.data + 18, 1, 1, 1));
    level64_free(&level);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* --------------------------------------------------------------------- holes */

/* The holes of a scheme on a mesh must be these. */
static void check_holes_of(int32_t family, int32_t boundary, const carvel_mesh *mesh,
                           const uint32_t *expected, uint64_t count)
{
    carvel_scheme *scheme = scheme_of(family, boundary);
    uint32_t *found = TAKE(uint32_t, count + 1);
    uint64_t told = 99;
    CHECK_OK(carvel_scheme_holes(scheme, mesh, NULL, 0, &told, failure));
    CHECK_UINT(count, told);
    CHECK_OK(carvel_scheme_holes(scheme, mesh, found, count, NULL, failure));
    CHECK_BYTES(expected, found, (size_t)count * sizeof *found);
    free(found);
    carvel_scheme_destroy(scheme);
}

/* The caller's order in, the mesh's out; and down to the levels. */
static void check_tagged_holes(void)
{
    /* The mixed faces 0 1 2 3 stand in the mesh as 1 2 0 3. */
    static const uint32_t tagged[3] = { 2, 0, 2 }, kept[2] = { 1, 2 }, all[4] = { 0, 1, 2, 3 };
    poly *mixed = poly_mixed();
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_hierarchy *hierarchy;
    carvel_mesh_desc desc;
    carvel_mesh *mesh, *level = NULL;
    uint32_t found[9];
    check_context("holes");
    poly_describe(mixed, &desc);
    desc.holes = tagged;
    desc.hole_count = 3;
    mesh = mesh_by(&desc);
    CHECK_UINT(2, survey_of(mesh).holes);
    CHECK_OK(carvel_mesh_holes(mesh, found, 2, failure));
    CHECK_BYTES(kept, found, sizeof kept);
    check_holes_of(CARVEL_SCHEME_CATMULL_CLARK, CARVEL_BOUNDARY_EDGE, mesh, kept, 2);
    check_holes_of(CARVEL_SCHEME_BILINEAR, CARVEL_BOUNDARY_NONE, mesh, kept, 2);
    check_holes_of(CARVEL_SCHEME_CATMULL_CLARK, CARVEL_BOUNDARY_NONE, mesh, all, 4);
    hierarchy = hierarchy_of(mesh, scheme, 1);
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, 1, &level, failure));
    /* The pentagon's corners and the quad's. */
    CHECK_UINT(9, survey_of(level).holes);
    CHECK_OK(carvel_mesh_holes(level, found, 9, failure));
    CHECK(found[0] == 3 && found[8] == 11);
    carvel_mesh_destroy(level);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(mixed);
}

/* A boundary that is none leaves the inner face of nine. */
static void check_boundary_holes(void)
{
    static const uint32_t rim[8] = { 0, 1, 2, 3, 5, 6, 7, 8 };
    poly *grid = poly_grid(3, 3);
    carvel_mesh *mesh = poly_mesh(grid);
    check_context("boundary none");
    check_holes_of(CARVEL_SCHEME_CATMULL_CLARK, CARVEL_BOUNDARY_NONE, mesh, rim, 8);
    check_holes_of(CARVEL_SCHEME_CATMULL_CLARK, CARVEL_BOUNDARY_EDGE, mesh, rim, 0);
    check_holes_of(CARVEL_SCHEME_DOO_SABIN, CARVEL_BOUNDARY_NONE, mesh, rim, 0);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
}

/* -------------------------------------------------------------- not manifold */

/* The three pages of a book share one edge, 0 1. */
static void check_pages(const carvel_mesh *mesh)
{
    static const uint32_t twins[9] = { UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX,
                                       UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX };
    static const uint32_t sharp[2] = { 0, 1 }, valences[5] = { 3, 3, 1, 1, 1 };
    static const float infinite[2] = { 10, 10 };
    carvel_counts counts = counts_of(mesh);
    uint32_t room[9];
    float by[2];
    CHECK_UINT(0, carvel_mesh_is_manifold(mesh));
    CHECK_UINT(5, counts.vertices);
    CHECK_UINT(7, counts.edges);
    CHECK_UINT(6, counts.boundary_edges);
    CHECK_OK(carvel_mesh_corner_twins(mesh, room, 9, failure));
    CHECK_BYTES(twins, room, sizeof twins);
    CHECK_OK(carvel_mesh_valences(mesh, room, 5, failure));
    CHECK_BYTES(valences, room, sizeof valences);
    CHECK_OK(carvel_mesh_corner_edges(mesh, room, 9, failure));
    CHECK(room[0] == room[3] && room[0] == room[6]);
    /* Where a boundary meets it, a vertex is sharp. */
    CHECK_UINT(2, survey_of(mesh).sharp_vertices);
    CHECK_OK(carvel_mesh_sharp_vertices(mesh, room, 2, failure));
    CHECK_OK(carvel_mesh_vertex_sharpness(mesh, by, 2, failure));
    CHECK_BYTES(sharp, room, sizeof sharp);
    CHECK_BYTES(infinite, by, sizeof infinite);
    CHECK_OK(carvel_mesh_validate(mesh, failure));
}

static void check_sharpened(void)
{
    static const uint32_t sizes[3] = { 3, 3, 3 }, indices[9] = { 0, 1, 2, 1, 0, 3, 0, 1, 4 };
    carvel_scheme_desc clark = family_of(CARVEL_SCHEME_CATMULL_CLARK);
    carvel_scheme *dual = scheme_of(CARVEL_SCHEME_DOO_SABIN, 0);
    poly *book = poly_of(5, 3, sizes, indices);
    carvel_mesh_desc desc;
    carvel_mesh *mesh;
    carvel_counts counts;
    level64 level;
    check_context("not manifold");
    poly_describe(book, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_SHARPEN;
    mesh = mesh_by(&desc);
    check_pages(mesh);
    refine(&level, book, mesh, &clark, 1);
    /* One vertex on the shared edge. */
    CHECK_UINT(5 + 7 + 3, level.counts.vertices);
    CHECK_BYTES(book->positions, level.output.positions.data, 6 * sizeof(double));
    level64_free(&level);
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_predict_counts(mesh, dual, 1, &counts, failure));
    carvel_mesh_destroy(mesh);
    carvel_scheme_destroy(dual);
    poly_free(book);
}

/* -------------------------------------------------------------------- varying */

/* One attribute by the scheme's rows and one linearly: as positions and as under
 * the bilinear scheme, from a refiner and from a hierarchy. */
static void check_kinds(const poly *control, const carvel_scheme *scheme,
                        const carvel_scheme *linear, uint32_t levels)
{
    static const int32_t kinds[2] = { CARVEL_INTERPOLATION_VARYING, CARVEL_INTERPOLATION_VERTEX };
    carvel_mesh *mesh = poly_mesh(control);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, levels);
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(mesh, scheme, levels, control->positions);
    carvel_const_values_f64 in[2];
    carvel_values_f64 out[2];
    level64 smooth, flat;
    size_t size;
    unsigned i;
    level64_refine(&smooth, NULL, mesh, scheme, levels, control->positions);
    level64_refine(&flat, NULL, mesh, linear, levels, control->positions);
    size = (size_t)smooth.counts.vertices * 3 * sizeof(double);
    for (i = 0; i < 2; i++) {
        in[i] = input.positions;
        out[i] = smooth.output.positions;
        out[i].data = TAKE(double, 3 * smooth.counts.vertices);
    }
    input.attributes = in;
    input.interpolations = kinds;
    smooth.output.attributes = out;
    input.attribute_count = smooth.output.attribute_count = 2;
    CHECK_OK(carvel_refiner_refine_f64(refiner, NULL, &input, &smooth.output, failure));
    CHECK_BYTES(smooth.output.positions.data, out[1].data, size);
    CHECK_BYTES(flat.output.positions.data, out[0].data, size);
    memset(out[0].data, 0, size);
    CHECK_OK(carvel_hierarchy_interpolate_f64(hierarchy, NULL, levels, kinds[0], in, out,
                                              failure));
    CHECK_BYTES(flat.output.positions.data, out[0].data, size);
    CHECK_OK(carvel_hierarchy_interpolate_f64(hierarchy, NULL, levels, kinds[1], in, out,
                                              failure));
    CHECK_BYTES(smooth.output.positions.data, out[0].data, size);
    free(out[0].data);
    free(out[1].data);
    level64_free(&smooth);
    level64_free(&flat);
    carvel_refiner_destroy(refiner);
    carvel_hierarchy_destroy(hierarchy);
    carvel_mesh_destroy(mesh);
}

static void check_varying(void)
{
    carvel_scheme *clark = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_scheme *linear = scheme_of(CARVEL_SCHEME_BILINEAR, 0);
    poly *mixed = poly_mixed(), *cube = poly_cube();
    check_context("varying");
    check_kinds(mixed, clark, linear, 2);
    check_kinds(cube, clark, linear, 1);
    check_kinds(cube, clark, linear, 0);
    poly_free(mixed);
    poly_free(cube);
    carvel_scheme_destroy(clark);
    carvel_scheme_destroy(linear);
}

int main(void)
{
    check_begin();
    check_catmull_clark();
    check_bilinear();
    check_names();
    check_triangles();
    check_infinite_crease();
    check_semi_sharp();
    check_fraction();
    check_chaikin();
    check_sharp_vertices();
    check_tagged_holes();
    check_boundary_holes();
    check_sharpened();
    check_varying();
    return check_end();
}
