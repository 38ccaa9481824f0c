/* The awkward meshes of tests/cases from C: argument 1 is a list of them, made by the
 * Rust side. Each is created under every policy, and with its tags; those that become
 * a mesh run every scheme of the header that has rules for them in f64 and in f32, by a
 * refiner and by a hierarchy. Prints the names of the cases that ran. */
#include "reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 2 };

/* ---------------------------------------------------------------- schemes */

typedef struct scheme_line {
    int32_t family;
    int32_t corner_rule;
    uint64_t degree;
    const carvel_fraction *passes;
    uint64_t pass_count;
    int32_t creasing, triangle_rule, loop_weights, extraordinary;
} scheme_line;

static const carvel_fraction four_point[2] = { { 0, 1 }, { 7, 2 } };

/* Every scheme of the header, a line each. */
static const scheme_line schemes[] = {
    { CARVEL_SCHEME_DOO_SABIN, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_DOO_SABIN, CARVEL_CORNER_RULE_AVERAGE, 0, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_THREE_POINT, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_THREE_POINT, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0, 0, 0, 0,
      CARVEL_EXTRAORDINARY_TUNED },
    { CARVEL_SCHEME_QUARTIC, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_B_SPLINE, CARVEL_CORNER_RULE_AVERAGE, 4, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_AVERAGING, CARVEL_CORNER_RULE_COSINE, 0, four_point, 2, 0, 0, 0, 0 },
    { CARVEL_SCHEME_B_SPLINE, CARVEL_CORNER_RULE_AVERAGE, 5, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_PRIMAL, CARVEL_CORNER_RULE_COSINE, 0, four_point, 2, 0, 0, 0, 0 },
    { CARVEL_SCHEME_BILINEAR, 0, 0, NULL, 0, 0, 0, 0, 0 },
    { CARVEL_SCHEME_CATMULL_CLARK, 0, 0, NULL, 0, CARVEL_CREASING_UNIFORM,
      CARVEL_TRIANGLE_RULE_SMOOTH, 0, 0 },
    { CARVEL_SCHEME_CATMULL_CLARK, 0, 0, NULL, 0, CARVEL_CREASING_CHAIKIN, 0, 0, 0 },
    { CARVEL_SCHEME_LOOP, 0, 0, NULL, 0, CARVEL_CREASING_UNIFORM, 0, CARVEL_LOOP_WEIGHTS_WARREN,
      0 },
    { CARVEL_SCHEME_LOOP, 0, 0, NULL, 0, CARVEL_CREASING_CHAIKIN, 0, CARVEL_LOOP_WEIGHTS_LOOP,
      0 },
};

static const int32_t boundaries[] = { CARVEL_BOUNDARY_EDGE_AND_CORNER, CARVEL_BOUNDARY_EDGE,
                                      CARVEL_BOUNDARY_NONE };

static carvel_scheme *scheme_by_line(const scheme_line *line, int32_t boundary)
{
    carvel_scheme *scheme = NULL;
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = line->family;
    desc.corner_rule = line->corner_rule;
    desc.boundary = boundary;
    desc.degree = line->degree;
    desc.passes = line->passes;
    desc.pass_count = line->pass_count;
    desc.creasing = line->creasing;
    desc.triangle_rule = line->triangle_rule;
    desc.loop_weights = line->loop_weights;
    desc.extraordinary = line->extraordinary;
    CHECK_OK(carvel_scheme_create(&desc, &scheme, failure));
    return scheme;
}

/* ---------------------------------------------------------------- reading */

typedef struct awkward {
    char name[64];
    /* What creating the mesh answers: if defects are refused, cut or sharpened, and if
     * they are refused and tags given. */
    carvel_status refused, cut, sharpened, tagged;
    /* What refining answers in f64 and in f32, and what some schemes may say. */
    carvel_status wide, narrow, may_be;
    poly *control;
    uint64_t crease_count, sharp_vertex_count, hole_count;
    uint32_t *crease_vertices, *sharp_vertices, *holes;
    float *crease_sharpness, *vertex_sharpness;
} awkward;

static carvel_status read_status(FILE *file)
{
    return (carvel_status)read_number(file);
}

/* Sharpness is written as its bits, since some of it is no number. */
static float read_sharpness(FILE *file)
{
    uint32_t bits = (uint32_t)read_number(file);
    float sharpness;
    memcpy(&sharpness, &bits, sizeof sharpness);
    return sharpness;
}

static void read_tags(FILE *file, awkward *it)
{
    uint64_t i;
    it->crease_count = read_number(file);
    it->sharp_vertex_count = read_number(file);
    it->hole_count = read_number(file);
    it->crease_vertices = TAKE(uint32_t, 2 * it->crease_count);
    it->crease_sharpness = TAKE(float, it->crease_count);
    it->sharp_vertices = TAKE(uint32_t, it->sharp_vertex_count);
    it->vertex_sharpness = TAKE(float, it->sharp_vertex_count);
    it->holes = TAKE(uint32_t, it->hole_count);
    for (i = 0; i < it->crease_count; i++) {
        it->crease_vertices[2 * i] = (uint32_t)read_number(file);
        it->crease_vertices[2 * i + 1] = (uint32_t)read_number(file);
        it->crease_sharpness[i] = read_sharpness(file);
    }
    for (i = 0; i < it->sharp_vertex_count; i++) {
        it->sharp_vertices[i] = (uint32_t)read_number(file);
        it->vertex_sharpness[i] = read_sharpness(file);
    }
    for (i = 0; i < it->hole_count; i++)
        it->holes[i] = (uint32_t)read_number(file);
}

static void free_case(awkward *it)
{
    poly_free(it->control);
    free(it->crease_vertices);
    free(it->crease_sharpness);
    free(it->sharp_vertices);
    free(it->vertex_sharpness);
    free(it->holes);
}

/* 0 at the end of the list. */
static int read_case(FILE *file, awkward *it)
{
    if (fscanf(file, "%63s", it->name) != 1)
        return 0;
    it->refused = read_status(file);
    it->cut = read_status(file);
    it->sharpened = read_status(file);
    it->tagged = read_status(file);
    it->wide = read_status(file);
    it->narrow = read_status(file);
    it->may_be = read_status(file);
    it->control = read_poly(file);
    read_tags(file, it);
    return 1;
}

/* --------------------------------------------------------------- creating */

static void describe_tags(const awkward *it, carvel_mesh_desc *desc)
{
    desc->crease_vertices = it->crease_vertices;
    desc->crease_sharpness = it->crease_sharpness;
    desc->crease_count = it->crease_count;
    desc->sharp_vertices = it->sharp_vertices;
    desc->vertex_sharpness = it->vertex_sharpness;
    desc->sharp_vertex_count = it->sharp_vertex_count;
    desc->holes = it->holes;
    desc->hole_count = it->hole_count;
}

static carvel_mesh *create(const awkward *it, int32_t policy, int with_tags,
                           carvel_status expected)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(it->control, &desc);
    desc.non_manifold = policy;
    if (with_tags)
        describe_tags(it, &desc);
    CHECK_STATUS(expected, carvel_mesh_create(NULL, &desc, &mesh, failure));
    if (expected == CARVEL_STATUS_OK)
        CHECK_OK(carvel_mesh_validate(mesh, failure));
    else
        CHECK(mesh == NULL && carvel_error_element_count(failure, 0) > 0);
    return mesh;
}

/* Positions of the mesh's vertices, some of which may be copies. */
static double *positions_of(const awkward *it, const carvel_mesh *mesh, uint64_t vertices)
{
    uint32_t *sources = TAKE(uint32_t, vertices);
    double *positions = TAKE(double, 3 * vertices);
    uint64_t v;
    CHECK_OK(carvel_mesh_vertex_sources(mesh, sources, vertices, failure));
    for (v = 0; v < vertices; v++)
        memcpy(positions + 3 * v, it->control->positions + 3 * (size_t)sources[v],
               3 * sizeof *positions);
    free(sources);
    return positions;
}

/* --------------------------------------------------------------- refining */

/* A case under a scheme. */
typedef struct run {
    const awkward *it;
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    carvel_hierarchy *hierarchy;
    carvel_refiner *refiner;
    carvel_counts counts;
    const double *positions;
    uint64_t vertices;
} run;

/* 1 if the call went well, as it should or may. */
static int meets(const run *at, carvel_status expected, carvel_status actual)
{
    if (actual != CARVEL_STATUS_OK && actual == at->it->may_be)
        return 0;
    return CHECK_STATUS(expected, actual) && actual == CARVEL_STATUS_OK;
}

static void check_faces(const run *at, const uint32_t *sizes, const uint32_t *indices)
{
    uint64_t corners = 0, wrong = 0, i;
    for (i = 0; i < at->counts.faces; i++)
        corners += sizes[i];
    CHECK_UINT(at->counts.corners, corners);
    for (i = 0; i < at->counts.corners; i++)
        wrong += indices[i] >= at->counts.vertices;
    CHECK_UINT(0, wrong);
}

static void check_f64(const run *at)
{
    uint64_t count = 3 * at->counts.vertices, wrong = 0, i;
    level64 level;
    carvel_refine_input_f64 input = input64(at->mesh, at->scheme, LEVELS, at->positions);
    carvel_const_values_f64 values = { NULL, 0, 3, 0 };
    carvel_values_f64 out = { NULL, 0, 3, 0 };
    carvel_status status;
    level64_take(&level, &at->counts);
    values.data = at->positions;
    values.count = at->vertices;
    out.data = TAKE(double, count);
    out.count = at->counts.vertices;
    status = carvel_refiner_refine_f64(at->refiner, NULL, &input, &level.output, failure);
    CHECK_STATUS(status, carvel_hierarchy_refine_f64(at->hierarchy, NULL, LEVELS, &values, &out,
                                                     failure));
    if (meets(at, at->it->wide, status)) {
        check_faces(at, level.output.face_sizes.data, level.output.face_vertices.data);
        for (i = 0; i < count; i++)
            wrong += !isfinite(out.data[i]);
        CHECK_UINT(0, wrong);
        CHECK_BYTES(level.output.positions.data, out.data, (size_t)count * sizeof(double));
    }
    free(out.data);
    level64_free(&level);
}

static void check_f32(const run *at)
{
    uint64_t count = 3 * at->counts.vertices, wrong = 0, i;
    level32 level;
    float *floats = TAKE(float, 3 * at->vertices);
    carvel_refine_input_f32 input = input32(at->mesh, at->scheme, LEVELS, floats);
    carvel_const_values_f32 values = { NULL, 0, 3, 0 };
    carvel_values_f32 out = { NULL, 0, 3, 0 };
    carvel_status status;
    level32_take(&level, &at->counts);
    for (i = 0; i < 3 * at->vertices; i++)
        floats[i] = (float)at->positions[i];
    values.data = floats;
    values.count = at->vertices;
    out.data = TAKE(float, count);
    out.count = at->counts.vertices;
    status = carvel_refiner_refine_f32(at->refiner, NULL, &input, &level.output, failure);
    CHECK_STATUS(status, carvel_hierarchy_refine_f32(at->hierarchy, NULL, LEVELS, &values, &out,
                                                     failure));
    if (meets(at, at->it->narrow, status)) {
        check_faces(at, level.output.face_sizes.data, level.output.face_vertices.data);
        for (i = 0; i < count; i++)
            wrong += !isfinite(out.data[i]);
        CHECK_UINT(0, wrong);
        CHECK_BYTES(level.output.positions.data, out.data, (size_t)count * sizeof(float));
    }
    free(out.data);
    free(floats);
    level32_free(&level);
}

/* Every level is sound and as large as predicted. */
static void check_levels(const run *at)
{
    uint32_t level;
    for (level = 0; level <= LEVELS; level++) {
        carvel_mesh *mesh = NULL;
        carvel_counts counts = predicted(at->mesh, at->scheme, level), found;
        CHECK_OK(carvel_hierarchy_mesh(at->hierarchy, level, &mesh, failure));
        CHECK_OK(carvel_mesh_validate(mesh, failure));
        found = counts_of(mesh);
        CHECK_UINT(counts.vertices, found.vertices);
        CHECK_UINT(counts.faces, found.faces);
        CHECK_UINT(counts.corners, found.corners);
        CHECK_UINT(counts.edges, found.edges);
        CHECK_UINT(counts.boundary_edges, found.boundary_edges);
        carvel_mesh_destroy(mesh);
    }
}

/* 1 if all faces are triangles. */
static int is_triangles(const poly *control)
{
    uint64_t f = 0;
    while (f < control->faces && control->sizes[f] == 3)
        f++;
    return f == control->faces;
}

/* 1 if a scheme has rules for the mesh, as the header says; linear refinement has them
 * for everything, Loop's scheme for triangles. */
static int has_rules(const run *at, const scheme_line *line)
{
    carvel_survey survey;
    if (line->family == CARVEL_SCHEME_LOOP)
        return is_triangles(at->it->control);
    if (line->family == CARVEL_SCHEME_CATMULL_CLARK || line->family == CARVEL_SCHEME_BILINEAR)
        return 1;
    CHECK_OK(carvel_survey_init(&survey, sizeof survey));
    CHECK_OK(carvel_mesh_survey(at->mesh, &survey, failure));
    return survey.creases + survey.sharp_vertices == 0 && carvel_mesh_is_manifold(at->mesh);
}

static void run_scheme(run *at, const scheme_line *line, int32_t boundary)
{
    carvel_scheme *scheme = scheme_by_line(line, boundary);
    at->scheme = scheme;
    if (!has_rules(at, line)) {
        CHECK_OK(carvel_counts_init(&at->counts, sizeof at->counts));
        CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                     carvel_predict_counts(at->mesh, scheme, 1, &at->counts, failure));
        carvel_scheme_destroy(scheme);
        return;
    }
    at->hierarchy = hierarchy_of(at->mesh, scheme, LEVELS);
    at->counts = predicted(at->mesh, scheme, LEVELS);
    check_levels(at);
    check_f64(at);
    check_f32(at);
    carvel_hierarchy_destroy(at->hierarchy);
    carvel_scheme_destroy(scheme);
}

static void run_mesh(const awkward *it, const carvel_mesh *mesh)
{
    run at;
    size_t i, j, rules = sizeof boundaries / sizeof *boundaries;
    double *positions;
    carvel_counts counts = counts_of(mesh);
    memset(&at, 0, sizeof at);
    /* Where there is no boundary, one rule will do. */
    if (counts.boundary_edges == 0)
        rules = 1;
    at.it = it;
    at.mesh = mesh;
    at.vertices = counts.vertices;
    at.positions = positions = positions_of(it, mesh, at.vertices);
    at.refiner = refiner_of();
    for (i = 0; i < sizeof schemes / sizeof *schemes; i++)
        for (j = 0; j < rules; j++)
            run_scheme(&at, &schemes[i], boundaries[j]);
    carvel_refiner_destroy(at.refiner);
    free(positions);
}

static int has_tags(const awkward *it)
{
    return it->crease_count + it->sharp_vertex_count + it->hole_count > 0;
}

static void run_case(const awkward *it)
{
    carvel_mesh *mesh, *repaired, *sharpened, *tagged;
    check_context(it->name);
    mesh = create(it, CARVEL_NON_MANIFOLD_REFUSE, 0, it->refused);
    repaired = create(it, CARVEL_NON_MANIFOLD_CUT, 0, it->cut);
    sharpened = create(it, CARVEL_NON_MANIFOLD_SHARPEN, 0, it->sharpened);
    tagged = create(it, CARVEL_NON_MANIFOLD_REFUSE, 1, it->tagged);
    if (mesh != NULL || repaired != NULL)
        run_mesh(it, mesh != NULL ? mesh : repaired);
    if (sharpened != NULL && !carvel_mesh_is_manifold(sharpened))
        run_mesh(it, sharpened);
    if (tagged != NULL && has_tags(it))
        run_mesh(it, tagged);
    carvel_mesh_destroy(mesh);
    carvel_mesh_destroy(repaired);
    carvel_mesh_destroy(sharpened);
    carvel_mesh_destroy(tagged);
}

int main(int count, char **arguments)
{
    FILE *file = read_file(count, arguments);
    awkward it;
    check_begin();
    while (read_case(file, &it)) {
        run_case(&it);
        printf("%s\n", it.name);
        free_case(&it);
    }
    fclose(file);
    return check_end();
}
