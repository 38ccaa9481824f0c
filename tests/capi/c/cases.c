/* The awkward meshes of tests/cases from C: argument 1 is a list of them, made by the
 * Rust side. Each is created under both policies; those that become a mesh run every
 * scheme of the header in f64 and in f32, by a refiner and by a hierarchy. Prints the
 * names of the cases that ran. */
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
} scheme_line;

static const carvel_fraction four_point[2] = { { 0, 1 }, { 7, 2 } };

/* Every scheme of the header, a line each. */
static const scheme_line schemes[] = {
    { CARVEL_SCHEME_DOO_SABIN, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0 },
    { CARVEL_SCHEME_DOO_SABIN, CARVEL_CORNER_RULE_AVERAGE, 0, NULL, 0 },
    { CARVEL_SCHEME_THREE_POINT, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0 },
    { CARVEL_SCHEME_QUARTIC, CARVEL_CORNER_RULE_COSINE, 0, NULL, 0 },
    { CARVEL_SCHEME_B_SPLINE, CARVEL_CORNER_RULE_AVERAGE, 4, NULL, 0 },
    { CARVEL_SCHEME_AVERAGING, CARVEL_CORNER_RULE_COSINE, 0, four_point, 2 },
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
    CHECK_OK(carvel_scheme_create(&desc, &scheme, failure));
    return scheme;
}

/* ---------------------------------------------------------------- reading */

typedef struct awkward {
    char name[64];
    /* What creating the mesh answers, if defects are refused and if they are cut. */
    carvel_status refused, cut;
    /* What refining answers in f64 and in f32, and what some schemes may say. */
    carvel_status wide, narrow, may_be;
    poly *control;
} awkward;

static carvel_status read_status(FILE *file)
{
    return (carvel_status)read_number(file);
}

/* 0 at the end of the list. */
static int read_case(FILE *file, awkward *it)
{
    if (fscanf(file, "%63s", it->name) != 1)
        return 0;
    it->refused = read_status(file);
    it->cut = read_status(file);
    it->wide = read_status(file);
    it->narrow = read_status(file);
    it->may_be = read_status(file);
    it->control = read_poly(file);
    return 1;
}

/* --------------------------------------------------------------- creating */

static carvel_mesh *create(const awkward *it, int32_t policy, carvel_status expected)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(it->control, &desc);
    desc.non_manifold = policy;
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

static void run_scheme(run *at, const scheme_line *line, int32_t boundary)
{
    carvel_scheme *scheme = scheme_by_line(line, boundary);
    at->scheme = scheme;
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

static void run_case(const awkward *it)
{
    carvel_mesh *mesh, *repaired;
    check_context(it->name);
    mesh = create(it, CARVEL_NON_MANIFOLD_REFUSE, it->refused);
    repaired = create(it, CARVEL_NON_MANIFOLD_CUT, it->cut);
    if (mesh != NULL || repaired != NULL)
        run_mesh(it, mesh != NULL ? mesh : repaired);
    carvel_mesh_destroy(mesh);
    carvel_mesh_destroy(repaired);
    poly_free(it->control);
}

int main(int count, char **arguments)
{
    FILE *file = read_file(count, arguments);
    awkward it;
    check_begin();
    while (read_case(file, &it)) {
        run_case(&it);
        printf("%s\n", it.name);
    }
    fclose(file);
    return check_end();
}
