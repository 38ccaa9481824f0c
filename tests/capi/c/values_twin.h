/* The part of values.c that is the same for floats and doubles. Included once
 * for each, with REAL, TWIN, INIT, PAIR, LEVEL and LARGEST; without a guard on purpose. */

/* Records spread over memory: as many bytes apart as asked for. */
typedef struct TWIN(spread) {
    unsigned char *bytes;
    size_t size;
    uint64_t count, width, stride;
} TWIN(spread);

static void TWIN(spread_take)(TWIN(spread) *it, uint64_t count, uint64_t width, uint64_t stride)
{
    it->size = (size_t)(count * stride);
    it->bytes = (unsigned char *)take(it->size);
    it->count = count;
    it->width = width;
    it->stride = stride;
    memset(it->bytes, CANARY, it->size);
}

static REAL *TWIN(record)(const TWIN(spread) *it, uint64_t i)
{
    return (REAL *)(void *)(it->bytes + i * it->stride);
}

static void TWIN(spread_fill)(TWIN(spread) *it, const REAL *tight)
{
    uint64_t i;
    for (i = 0; i < it->count; i++)
        memcpy(TWIN(record)(it, i), tight + i * it->width, (size_t)it->width * sizeof(REAL));
}

/* The records are the tight ones, and what lies between is untouched. */
static void TWIN(check_spread)(const TWIN(spread) *it, const REAL *tight)
{
    uint64_t i;
    size_t size = (size_t)it->width * sizeof(REAL);
    for (i = 0; i < it->count; i++) {
        CHECK_BYTES(tight + i * it->width, TWIN(record)(it, i), size);
        CHECK(all_bytes_are(it->bytes, (size_t)(i * it->stride) + size,
                            (size_t)((i + 1) * it->stride), CANARY));
    }
}

static TWIN(carvel_const_values) TWIN(tight_input)(const REAL *data, uint64_t count,
                                                   uint64_t width)
{
    TWIN(carvel_const_values) values;
    values.data = data;
    values.count = count;
    values.width = width;
    values.stride = 0;
    return values;
}

static TWIN(carvel_values) TWIN(tight_output)(REAL *data, uint64_t count, uint64_t width)
{
    TWIN(carvel_values) values;
    values.data = data;
    values.count = count;
    values.width = width;
    values.stride = 0;
    return values;
}

static REAL *TWIN(random_values)(uint64_t count)
{
    REAL *values = TAKE(REAL, count);
    uint64_t i, state = count;
    for (i = 0; i < count; i++)
        values[i] = (REAL)random_double(&state);
    return values;
}

/* ------------------------------------------------------------------ strides */

/* A mesh with attributes of widths 1 to 9, refined with all of them tight. */
typedef struct TWIN(setup) {
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_refiner *refiner;
    uint32_t levels;
    uint64_t before, after;
    REAL *in[WIDTHS + 1], *out[WIDTHS + 1];
} TWIN(setup);

static void TWIN(refine_tight)(TWIN(setup) *it)
{
    TWIN(carvel_const_values) in[WIDTHS];
    TWIN(carvel_values) out[WIDTHS];
    TWIN(carvel_refine_input) input;
    TWIN(carvel_refine_output) output;
    uint64_t w;
    input = PAIR(input)(it->mesh, it->scheme, it->levels, it->in[0]);
    CHECK_OK(INIT(carvel_refine_output)(&output, sizeof output));
    for (w = 1; w <= WIDTHS; w++) {
        in[w - 1] = TWIN(tight_input)(it->in[w], it->before, w);
        out[w - 1] = TWIN(tight_output)(it->out[w], it->after, w);
    }
    input.attributes = in;
    output.attributes = out;
    input.attribute_count = output.attribute_count = WIDTHS;
    output.positions = TWIN(tight_output)(it->out[0], it->after, 3);
    CHECK_OK(TWIN(carvel_refiner_refine)(it->refiner, NULL, &input, &output, failure));
}

static void TWIN(take_setup)(TWIN(setup) *it, const poly *control, uint32_t levels)
{
    uint64_t w;
    it->mesh = poly_mesh(control);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, CARVEL_BOUNDARY_EDGE_AND_CORNER);
    it->refiner = refiner_of();
    it->levels = levels;
    it->before = control->vertices;
    it->after = predicted(it->mesh, it->scheme, levels).vertices;
    for (w = 0; w <= WIDTHS; w++) {
        uint64_t width = w == 0 ? 3 : w;
        it->in[w] = TWIN(random_values)(it->before * width);
        it->out[w] = TAKE(REAL, it->after * width);
    }
}

static void TWIN(free_setup)(TWIN(setup) *it)
{
    uint64_t w;
    for (w = 0; w <= WIDTHS; w++) {
        free(it->in[w]);
        free(it->out[w]);
    }
    carvel_refiner_destroy(it->refiner);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
}

/* One attribute and the positions with gaps, in and out. */
static void TWIN(check_strides)(TWIN(setup) *it, uint64_t width, uint64_t gap)
{
    TWIN(spread) from[2], to[2];
    TWIN(carvel_const_values) in;
    TWIN(carvel_values) out;
    TWIN(carvel_refine_input) input = PAIR(input)(it->mesh, it->scheme, it->levels, NULL);
    TWIN(carvel_refine_output) output;
    TWIN(spread_take)(&from[0], it->before, 3, (3 + gap) * sizeof(REAL));
    TWIN(spread_take)(&from[1], it->before, width, (width + gap) * sizeof(REAL));
    TWIN(spread_take)(&to[0], it->after, 3, (3 + gap) * sizeof(REAL));
    TWIN(spread_take)(&to[1], it->after, width, (width + gap) * sizeof(REAL));
    TWIN(spread_fill)(&from[0], it->in[0]);
    TWIN(spread_fill)(&from[1], it->in[width]);
    CHECK_OK(INIT(carvel_refine_output)(&output, sizeof output));
    input.positions.data = TWIN(record)(&from[0], 0);
    input.positions.stride = from[0].stride;
    in = TWIN(tight_input)(TWIN(record)(&from[1], 0), it->before, width);
    in.stride = from[1].stride;
    output.positions = TWIN(tight_output)(TWIN(record)(&to[0], 0), it->after, 3);
    output.positions.stride = to[0].stride;
    out = TWIN(tight_output)(TWIN(record)(&to[1], 0), it->after, width);
    out.stride = to[1].stride;
    input.attributes = &in;
    output.attributes = &out;
    input.attribute_count = output.attribute_count = 1;
    CHECK_OK(TWIN(carvel_refiner_refine)(it->refiner, NULL, &input, &output, failure));
    TWIN(check_spread)(&to[0], it->out[0]);
    TWIN(check_spread)(&to[1], it->out[width]);
    free(from[0].bytes);
    free(from[1].bytes);
    free(to[0].bytes);
    free(to[1].bytes);
}

/* The same through a hierarchy, which takes one array at a time. */
static void TWIN(check_hierarchy_strides)(TWIN(setup) *it, uint64_t width, uint64_t gap)
{
    carvel_hierarchy *hierarchy = hierarchy_of(it->mesh, it->scheme, it->levels);
    TWIN(spread) from, to;
    TWIN(carvel_const_values) in;
    TWIN(carvel_values) out;
    TWIN(spread_take)(&from, it->before, width, (width + gap) * sizeof(REAL));
    TWIN(spread_take)(&to, it->after, width, (width + gap) * sizeof(REAL));
    TWIN(spread_fill)(&from, it->in[width]);
    in = TWIN(tight_input)(TWIN(record)(&from, 0), it->before, width);
    in.stride = from.stride;
    out = TWIN(tight_output)(TWIN(record)(&to, 0), it->after, width);
    out.stride = to.stride;
    CHECK_OK(TWIN(carvel_hierarchy_refine)(hierarchy, NULL, it->levels, &in, &out, failure));
    TWIN(check_spread)(&to, it->out[width]);
    free(from.bytes);
    free(to.bytes);
    carvel_hierarchy_destroy(hierarchy);
}

static void TWIN(check_widths)(uint32_t levels, uint64_t widths)
{
    poly *mixed = poly_mixed();
    TWIN(setup) it;
    uint64_t width;
    TWIN(take_setup)(&it, mixed, levels);
    TWIN(refine_tight)(&it);
    for (width = 1; width <= widths; width++) {
        TWIN(check_strides)(&it, width, width % 3);
        TWIN(check_strides)(&it, width, 7);
        TWIN(check_hierarchy_strides)(&it, width, width % 3);
        TWIN(check_hierarchy_strides)(&it, width, 5);
    }
    TWIN(free_setup)(&it);
    poly_free(mixed);
}

/* ----------------------------------------------------------------- bad values */

typedef struct TWIN(attempt) {
    TWIN(carvel_refine_input) input;
    TWIN(carvel_refine_output) output;
    TWIN(carvel_const_values) in;
    TWIN(carvel_values) out;
    PAIR(level) level;
    REAL *values;
} TWIN(attempt);

/* Positions and an attribute of width 2; all output bytes are canaries. */
static void TWIN(take_attempt)(TWIN(attempt) *it, const carvel_mesh *mesh,
                               const carvel_scheme *scheme, uint32_t levels,
                               const REAL *positions, const REAL *attribute)
{
    carvel_counts counts = predicted(mesh, scheme, levels);
    uint64_t before = counts_of(mesh).vertices;
    LEVEL(take)(&it->level, &counts);
    it->input = PAIR(input)(mesh, scheme, levels, positions);
    it->output = it->level.output;
    it->values = TAKE(REAL, 2 * counts.vertices);
    memset(it->output.positions.data, CANARY, (size_t)counts.vertices * 3 * sizeof(REAL));
    memset(it->values, CANARY, (size_t)counts.vertices * 2 * sizeof(REAL));
    it->in = TWIN(tight_input)(attribute, before, 2);
    it->out = TWIN(tight_output)(it->values, counts.vertices, 2);
    it->input.attributes = &it->in;
    it->output.attributes = &it->out;
    it->input.attribute_count = it->output.attribute_count = 1;
}

static void TWIN(free_attempt)(TWIN(attempt) *it)
{
    LEVEL(free)(&it->level);
    free(it->values);
}

/* Refused, the vertex named, nothing written. */
static void TWIN(refuse_value)(const carvel_mesh *mesh, const carvel_scheme *scheme,
                               uint32_t levels, const REAL *positions, const REAL *attribute,
                               uint64_t vertex)
{
    carvel_refiner *refiner = refiner_of();
    TWIN(attempt) it;
    TWIN(take_attempt)(&it, mesh, scheme, levels, positions, attribute);
    CHECK_STATUS(CARVEL_STATUS_NOT_FINITE,
                 TWIN(carvel_refiner_refine)(refiner, NULL, &it.input, &it.output, failure));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_VERTEX, vertex, 0);
    CHECK(all_bytes_are((unsigned char *)it.output.positions.data, 0,
                        (size_t)it.level.counts.vertices * 3 * sizeof(REAL), CANARY));
    CHECK(all_bytes_are((unsigned char *)it.values, 0,
                        (size_t)it.level.counts.vertices * 2 * sizeof(REAL), CANARY));
    TWIN(free_attempt)(&it);
    carvel_refiner_destroy(refiner);
}

static void TWIN(refuse_hierarchy_value)(const carvel_mesh *mesh, const carvel_scheme *scheme,
                                         uint32_t levels, const REAL *positions)
{
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, levels);
    uint64_t before = counts_of(mesh).vertices;
    uint64_t after = predicted(mesh, scheme, levels).vertices;
    REAL *room = TAKE(REAL, 3 * after);
    TWIN(carvel_const_values) in = TWIN(tight_input)(positions, before, 3);
    TWIN(carvel_values) out = TWIN(tight_output)(room, after, 3);
    memset(room, CANARY, (size_t)after * 3 * sizeof(REAL));
    CHECK_STATUS(CARVEL_STATUS_NOT_FINITE, TWIN(carvel_hierarchy_refine)(hierarchy, NULL, levels,
                                                                         &in, &out, failure));
    CHECK(all_bytes_are((unsigned char *)room, 0, (size_t)after * 3 * sizeof(REAL), CANARY));
    free(room);
    carvel_hierarchy_destroy(hierarchy);
}

/* In positions, in an attribute, and at an isolated vertex, which is in no row. */
static void TWIN(check_not_finite)(REAL bad)
{
    poly *mixed = poly_mixed();
    carvel_mesh *mesh = poly_mesh(mixed);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    uint32_t levels;
    for (levels = 0; levels < 3; levels++) {
        REAL *good = TWIN(random_values)(39), *worse = TWIN(random_values)(39);
        worse[3 * 5 + 1] = bad;
        TWIN(refuse_value)(mesh, scheme, levels, worse, good, 5);
        TWIN(refuse_hierarchy_value)(mesh, scheme, levels, worse);
        worse[3 * 5 + 1] = 0;
        worse[3 * 12 + 2] = bad;
        TWIN(refuse_value)(mesh, scheme, levels, worse, good, 12);
        worse[2 * 7 + 1] = bad;
        TWIN(refuse_value)(mesh, scheme, levels, good, worse, 7);
        free(good);
        free(worse);
    }
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(mixed);
}

/* Coordinates at the end of the range, of either sign, in a checkerboard. */
static void TWIN(check_overflow)(const poly *control)
{
    carvel_mesh *mesh = poly_mesh(control);
    carvel_scheme *steep = steep_scheme();
    carvel_refiner *refiner = refiner_of();
    REAL *extreme = TAKE(REAL, 3 * control->vertices), *zero = TAKE(REAL, 3 * control->vertices);
    uint64_t i;
    uint32_t levels;
    TWIN(attempt) it;
    for (i = 0; i < 3 * control->vertices; i++)
        extreme[i] = i / 3 % 2 == 0 ? (REAL)0.99 * LARGEST : (REAL)-0.99 * LARGEST;
    for (levels = 1; levels <= 3; levels++) {
        TWIN(take_attempt)(&it, mesh, steep, levels, extreme, zero);
        CHECK_STATUS(CARVEL_STATUS_OVERFLOW,
                     TWIN(carvel_refiner_refine)(refiner, NULL, &it.input, &it.output, failure));
        TWIN(free_attempt)(&it);
    }
    /* The refiner is as good as new, and means of such numbers are in range. */
    carvel_scheme_destroy(steep);
    steep = scheme_of(CARVEL_SCHEME_QUARTIC, 0);
    TWIN(take_attempt)(&it, mesh, steep, 2, extreme, zero);
    for (i = 0; i < 3 * control->vertices; i++)
        extreme[i] /= 2;
    CHECK_OK(TWIN(carvel_refiner_refine)(refiner, NULL, &it.input, &it.output, failure));
    TWIN(free_attempt)(&it);
    carvel_refiner_destroy(refiner);
    carvel_scheme_destroy(steep);
    carvel_mesh_destroy(mesh);
    free(extreme);
    free(zero);
}

static void TWIN(check)(uint64_t widths)
{
    poly *torus = poly_torus(4, 4), *strip = poly_grid(1, 3);
    const REAL infinite = (REAL)HUGE_VAL;
    check_context("widths");
    TWIN(check_widths)(0, widths);
    TWIN(check_widths)(1, widths);
    TWIN(check_widths)(2, widths);
    check_context("not finite");
    TWIN(check_not_finite)(infinite - infinite);
    TWIN(check_not_finite)(infinite);
    TWIN(check_not_finite)(-infinite);
    check_context("overflow, closed");
    TWIN(check_overflow)(torus);
    check_context("overflow, open");
    TWIN(check_overflow)(strip);
    poly_free(torus);
    poly_free(strip);
}
