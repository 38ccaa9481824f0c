/* The part of channel.c that is the same for floats and doubles. Included once for
 * each, with REAL, TWIN, INIT, PAIR and LEVEL; without a guard on purpose. */

/* One channel of width 2 on its way to a level, with a canary behind each buffer. */
typedef struct TWIN(job) {
    carvel_refiner *refiner;
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    REAL *positions, *values, *refined;
    uint32_t *indices;
    uint64_t value_count, corners;
    PAIR(level) level;
    TWIN(carvel_channel_input) in;
    TWIN(carvel_channel_output) out;
    TWIN(carvel_refine_input) input;
    TWIN(carvel_refine_output) output;
} TWIN(job);

static void TWIN(describe)(TWIN(job) *it, const carvel_channel *channel, uint64_t values,
                           uint32_t levels)
{
    it->in.channel = channel;
    it->in.values.data = it->values;
    it->in.values.count = values;
    it->in.values.width = 2;
    it->in.values.stride = 0;
    it->out.indices.data = it->indices;
    it->out.indices.count = it->corners;
    it->out.values.data = it->refined;
    it->out.values.count = it->value_count;
    it->out.values.width = 2;
    it->out.values.stride = 0;
    it->input = PAIR(input)(it->mesh, it->scheme, levels, it->positions);
    it->input.channels = &it->in;
    it->input.channel_count = 1;
    it->output = it->level.output;
    it->output.channels = &it->out;
    it->output.channel_count = 1;
}

static uint64_t TWIN(refined_bytes)(const TWIN(job) *it)
{
    return 2 * it->value_count * sizeof(REAL);
}

static void TWIN(job_take)(TWIN(job) *it, const poly *control, const carvel_mesh *mesh,
                           const carvel_scheme *scheme, const carvel_channel *channel,
                           uint64_t values, uint32_t levels)
{
    carvel_counts counts = predicted(mesh, scheme, levels);
    uint64_t state = 7, i;
    LEVEL(take)(&it->level, &counts);
    it->refiner = refiner_of();
    it->mesh = mesh;
    it->scheme = scheme;
    it->corners = counts.corners;
    CHECK_OK(carvel_predict_channel(channel, scheme, levels, &it->value_count, failure));
    it->positions = TAKE(REAL, 3 * control->vertices);
    for (i = 0; i < 3 * control->vertices; i++)
        it->positions[i] = (REAL)control->positions[i];
    it->values = TAKE(REAL, 2 * values);
    for (i = 0; i < 2 * values; i++)
        it->values[i] = (REAL)random_double(&state);
    it->indices = TAKE(uint32_t, it->corners + 1);
    it->indices[it->corners] = CANARY;
    it->refined = TAKE(REAL, 2 * it->value_count + 1);
    memset(it->refined, CANARY, (size_t)TWIN(refined_bytes)(it) + sizeof(REAL));
    TWIN(describe)(it, channel, values, levels);
}

static void TWIN(job_free)(TWIN(job) *it)
{
    LEVEL(free)(&it->level);
    carvel_refiner_destroy(it->refiner);
    free(it->positions);
    free(it->values);
    free(it->indices);
    free(it->refined);
}

static carvel_status TWIN(run)(TWIN(job) *it)
{
    return TWIN(carvel_refiner_refine)(it->refiner, NULL, &it->input, &it->output, failure);
}

/* Whatever was refined, nothing was written behind it. */
static void TWIN(check_behind)(const TWIN(job) *it)
{
    CHECK_UINT(CANARY, it->indices[it->corners]);
    CHECK(all_bytes_are((const unsigned char *)(it->refined + 2 * it->value_count), sizeof(REAL)));
}

/* ------------------------------------------------------------------- values */

/* Without a seam values are what attributes are. */
static void TWIN(check_no_seams)(void)
{
    poly *cube = poly_cube();
    carvel_mesh *mesh = poly_mesh(cube);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_channel *channel = channel_of(mesh, cube->indices, 24, 8, 0);
    TWIN(carvel_const_values) in;
    TWIN(carvel_values) out;
    TWIN(job) it;
    uint64_t i;
    CHECK_UINT(0, carvel_channel_seam_edges(channel));
    TWIN(job_take)(&it, cube, mesh, scheme, channel, 8, 2);
    in = it.in.values;
    out = it.out.values;
    out.data = TAKE(REAL, 2 * it.value_count);
    it.input.attributes = &in;
    it.output.attributes = &out;
    it.input.attribute_count = it.output.attribute_count = 1;
    CHECK_OK(TWIN(run)(&it));
    CHECK_BYTES(it.output.face_vertices.data, it.indices, (size_t)it.corners * 4);
    for (i = 0; i < 2 * it.value_count; i++)
        CHECK(fabs((double)(out.data[i] - it.refined[i])) < 1e-6);
    TWIN(check_behind)(&it);
    free(out.data);
    TWIN(job_free)(&it);
    carvel_channel_destroy(channel);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(cube);
}

/* The caller's values in the order of the mesh's faces; from level 0 on. */
static void TWIN(check_level_zero)(void)
{
    static const uint32_t order[16] = { 4, 5, 6, 7, 8, 9, 10, 11, 0, 1, 2, 3, 12, 13, 14, 15 };
    uint32_t own[16], i;
    poly *mixed = poly_mixed();
    carvel_mesh *mesh = poly_mesh(mixed);
    /* Level 0 asks for no rules. */
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, 0);
    carvel_channel *channel;
    TWIN(job) it;
    for (i = 0; i < 16; i++)
        own[i] = i;
    channel = channel_of(mesh, own, 16, 17, 0);
    CHECK_UINT(2, carvel_channel_seam_edges(channel));
    TWIN(job_take)(&it, mixed, mesh, scheme, channel, 17, 0);
    CHECK_UINT(17, it.value_count);
    CHECK_OK(TWIN(run)(&it));
    CHECK_BYTES(order, it.indices, sizeof order);
    CHECK_BYTES(it.values, it.refined, 34 * sizeof(REAL));
    TWIN(check_behind)(&it);
    TWIN(job_free)(&it);
    carvel_channel_destroy(channel);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(mixed);
}

/* 1 if a value at a corner of a grid, whose faces are on islands of their own, stays
 * where it was. */
static int TWIN(stays)(const uint32_t *islands, uint32_t corner, int32_t mode)
{
    poly *grid = poly_grid(2, 2);
    carvel_mesh *mesh = poly_mesh(grid);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_channel *channel;
    uint32_t own[16], i;
    int same;
    TWIN(job) it;
    for (i = 0; i < 16; i++)
        own[i] = 9 * islands[i / 4] + grid->indices[i];
    channel = channel_of(mesh, own, 16, 36, mode);
    TWIN(job_take)(&it, grid, mesh, scheme, channel, 36, 1);
    CHECK_OK(TWIN(run)(&it));
    TWIN(check_behind)(&it);
    /* A quad's corner leaves a quad that begins there. */
    same = memcmp(it.values + 2 * own[corner], it.refined + 2 * it.indices[4 * corner],
                  2 * sizeof(REAL)) == 0;
    TWIN(job_free)(&it);
    carvel_channel_destroy(channel);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(grid);
    return same;
}

/* A seam of the input is one at every level: twice as many edges each. */
static void TWIN(check_seam)(int32_t family, const poly *control, uint64_t seams)
{
    carvel_mesh *mesh = poly_mesh(control), *last = NULL;
    carvel_scheme *scheme = scheme_of(family, 0);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, 2);
    uint32_t *own = TAKE(uint32_t, control->corners), i;
    carvel_channel *channel, *again;
    TWIN(job) it;
    /* Every other face on an island. */
    for (i = 0; i < control->corners; i++)
        own[i] = control->indices[i] +
                 (i / control->sizes[0] % 2 == 1 ? (uint32_t)control->vertices : 0u);
    channel = channel_of(mesh, own, control->corners, 2 * control->vertices, 0);
    CHECK_UINT(seams, carvel_channel_seam_edges(channel));
    TWIN(job_take)(&it, control, mesh, scheme, channel, 2 * control->vertices, 2);
    CHECK_OK(TWIN(run)(&it));
    TWIN(check_behind)(&it);
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, 2, &last, failure));
    again = channel_of(last, it.indices, it.corners, it.value_count, 0);
    CHECK_UINT(4 * seams, carvel_channel_seam_edges(again));
    carvel_channel_destroy(again);
    carvel_mesh_destroy(last);
    TWIN(job_free)(&it);
    carvel_channel_destroy(channel);
    free(own);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
}

/* ------------------------------------------------------------------- misuse */

/* A strip of two quads with a seam between them, and what is beside it. */
typedef struct TWIN(setup) {
    poly *strip, *other;
    carvel_mesh *mesh, *like, *else_where;
    carvel_scheme *scheme, *dual;
    carvel_channel *channel, *stranger;
    TWIN(job) job;
} TWIN(setup);

static void TWIN(setup_take)(TWIN(setup) *it)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    static const uint32_t sizes[2] = { 4, 4 }, apart[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    it->strip = poly_grid(1, 2);
    it->other = poly_of(8, 2, sizes, apart);
    it->mesh = poly_mesh(it->strip);
    it->like = poly_mesh(it->strip);
    it->else_where = poly_mesh(it->other);
    it->scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    it->dual = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    it->channel = channel_of(it->mesh, own, 8, 8, 0);
    it->stranger = channel_of(it->else_where, own, 8, 8, 0);
    TWIN(job_take)(&it->job, it->strip, it->mesh, it->scheme, it->channel, 8, 1);
}

static void TWIN(setup_free)(TWIN(setup) *it)
{
    TWIN(job_free)(&it->job);
    carvel_channel_destroy(it->stranger);
    carvel_channel_destroy(it->channel);
    carvel_scheme_destroy(it->dual);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->else_where);
    carvel_mesh_destroy(it->like);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->other);
    poly_free(it->strip);
}

/* The refusal, nothing written, and a sound description again. */
static int TWIN(refused)(TWIN(setup) *it, carvel_status status, const char *what, int line)
{
    TWIN(job) *job = &it->job;
    int ok = check_status(status, TWIN(run)(job), what, __FILE__, line);
    CHECK(all_bytes_are((const unsigned char *)job->refined,
                        (size_t)TWIN(refined_bytes)(job) + sizeof(REAL)));
    TWIN(describe)(job, it->channel, 8, 1);
    return ok;
}

#ifndef REFUSED
#define REFUSED(status, change) \
    ((change), TWIN(refused)(it, CARVEL_STATUS_##status, #change, __LINE__))
#endif

static void TWIN(check_pointers)(TWIN(setup) *it)
{
    TWIN(job) *job = &it->job;
    REFUSED(NULL_POINTER, job->input.channels = NULL);
    REFUSED(NULL_POINTER, job->output.channels = NULL);
    REFUSED(NULL_POINTER, job->in.channel = NULL);
    REFUSED(NULL_POINTER, job->in.values.data = NULL);
    REFUSED(NULL_POINTER, job->out.indices.data = NULL);
    REFUSED(NULL_POINTER, job->out.values.data = NULL);
    REFUSED(MISALIGNED, job->input.channels = OFF(TWIN(carvel_channel_input), &job->in));
    REFUSED(MISALIGNED, job->output.channels = OFF(TWIN(carvel_channel_output), &job->out));
    REFUSED(MISALIGNED, job->in.channel = OFF(const carvel_channel, it->channel));
    REFUSED(MISALIGNED, job->in.values.data = OFF(const REAL, job->values));
    REFUSED(MISALIGNED, job->out.indices.data = OFF(uint32_t, job->indices));
    REFUSED(MISALIGNED, job->out.values.data = OFF(REAL, job->refined));
}

static void TWIN(check_counts)(TWIN(setup) *it)
{
    TWIN(job) *job = &it->job;
    REFUSED(LENGTH_MISMATCH, job->input.channel_count = 0);
    REFUSED(LENGTH_MISMATCH, job->output.channel_count = 0);
    REFUSED(LENGTH_MISMATCH, job->output.channel_count = UINT64_MAX);
    REFUSED(PARAMETER_OUT_OF_RANGE, job->input.channel_count = 257);
    REFUSED(PARAMETER_OUT_OF_RANGE, job->input.channel_count = UINT64_MAX);
    REFUSED(LENGTH_MISMATCH, job->in.values.count--);
    REFUSED(LENGTH_MISMATCH, job->in.values.count = UINT64_MAX);
    REFUSED(PARAMETER_OUT_OF_RANGE, job->in.values.width = job->out.values.width = 0);
    REFUSED(PARAMETER_OUT_OF_RANGE, job->in.values.width = job->out.values.width = 65537);
    REFUSED(LENGTH_MISMATCH, job->out.values.width = 3);
    REFUSED(INVALID_STRIDE, job->in.values.stride = sizeof(REAL));
    REFUSED(INVALID_STRIDE, job->out.values.stride = sizeof(REAL));
    REFUSED(TOO_LARGE, job->out.values.stride = (uint64_t)1 << 61);
    REFUSED(BUFFER_TOO_SMALL, job->out.values.count--);
    REFUSED(BUFFER_TOO_SMALL, job->out.indices.count--);
    REFUSED(BUFFER_TOO_SMALL, (job->out.indices.data = NULL, job->out.indices.count = 0));
    REFUSED(LENGTH_MISMATCH, job->in.channel = it->stranger);
    REFUSED(LENGTH_MISMATCH, job->input.mesh = it->else_where);
    REFUSED(UNSUPPORTED, job->input.scheme = it->dual);
}

static void TWIN(check_overlap)(TWIN(setup) *it)
{
    TWIN(job) *job = &it->job;
    REFUSED(OVERLAP, job->out.values.data = job->values);
    REFUSED(OVERLAP, job->out.values.data = job->output.positions.data);
    REFUSED(OVERLAP, job->out.indices.data = job->output.face_vertices.data);
    REFUSED(OVERLAP, job->out.indices.data = (uint32_t *)(void *)job->refined);
    REFUSED(OVERLAP, job->output.face_sources.data = (uint32_t *)(void *)&job->in);
    REFUSED(OVERLAP, job->output.face_sources.data = (uint32_t *)(void *)&job->out);
    REFUSED(OVERLAP, job->in.values.data = job->refined);
}

/* Not a number at any value, taken or not, is named. */
static void TWIN(check_not_finite)(TWIN(setup) *it)
{
    REAL before = it->job.values[11];
    it->job.values[11] = (REAL)HUGE_VAL;
    CHECK_STATUS(CARVEL_STATUS_NOT_FINITE, TWIN(run)(&it->job));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_VERTEX, 5, 0);
    REFUSED(NOT_FINITE, (void)0);
    it->job.values[11] = before;
}

/* A mesh that is alike will do; records may have gaps, and two channels be one. */
static void TWIN(check_good)(TWIN(setup) *it)
{
    TWIN(job) *job = &it->job;
    uint64_t count = job->value_count, i;
    REAL *spread = TAKE(REAL, 3 * count);
    TWIN(carvel_channel_input) in[2];
    TWIN(carvel_channel_output) out[2];
    uint32_t *indices = TAKE(uint32_t, job->corners);
    job->input.mesh = it->like;
    CHECK_OK(TWIN(run)(job));
    in[0] = in[1] = job->in;
    out[0] = out[1] = job->out;
    out[1].indices.data = indices;
    out[1].values.data = spread;
    out[1].values.stride = 3 * sizeof(REAL);
    job->input.channels = in;
    job->output.channels = out;
    job->input.channel_count = job->output.channel_count = 2;
    CHECK_OK(TWIN(run)(job));
    CHECK_BYTES(job->indices, indices, (size_t)job->corners * 4);
    for (i = 0; i < count; i++) {
        CHECK_BYTES(job->refined + 2 * i, spread + 3 * i, 2 * sizeof(REAL));
        CHECK(fabs((double)spread[3 * i + 2]) < 1e-30);
    }
    TWIN(check_behind)(job);
    free(spread);
    free(indices);
}

static void TWIN(check)(void)
{
    poly *grid = poly_grid(2, 3), *octahedron = poly_octahedron();
    TWIN(setup) it;
    check_context("no seams");
    TWIN(check_no_seams)();
    check_context("level 0");
    TWIN(check_level_zero)();
    check_context("seams");
    TWIN(check_seam)(CARVEL_SCHEME_CATMULL_CLARK, grid, 7);
    TWIN(check_seam)(CARVEL_SCHEME_BILINEAR, grid, 7);
    TWIN(check_seam)(CARVEL_SCHEME_LOOP, octahedron, 8);
    check_context("refining channels");
    TWIN(setup_take)(&it);
    TWIN(check_pointers)(&it);
    TWIN(check_counts)(&it);
    TWIN(check_overlap)(&it);
    TWIN(check_not_finite)(&it);
    TWIN(check_good)(&it);
    TWIN(setup_free)(&it);
    poly_free(grid);
    poly_free(octahedron);
}
