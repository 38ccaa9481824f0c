/* The part of misuse.c that is the same for floats and doubles. Included once
 * for each, with REAL, TWIN and INIT; without a guard on purpose. */

/* Values with canaries around them. */
static REAL *TWIN(data)(const guarded *it)
{
    return (REAL *)(void *)it->bytes;
}

static TWIN(carvel_const_values) TWIN(input_of)(const REAL *data, uint64_t count,
                                                uint64_t width)
{
    TWIN(carvel_const_values) values;
    values.data = data;
    values.count = count;
    values.width = width;
    values.stride = 0;
    return values;
}

static TWIN(carvel_values) TWIN(output_of)(const guarded *it, uint64_t count, uint64_t width)
{
    TWIN(carvel_values) values;
    values.data = TWIN(data)(it);
    values.count = count;
    values.width = width;
    values.stride = 0;
    return values;
}

/* A refinement that would go well, with positions and one attribute of width 2. */
typedef struct TWIN(job) {
    const fixture *with;
    carvel_refiner *refiner;
    const carvel_context *context;
    carvel_counts counts;
    REAL *positions, *attribute;
    int32_t kind;
    TWIN(carvel_const_values) in;
    TWIN(carvel_values) out;
    TWIN(carvel_refine_input) input;
    TWIN(carvel_refine_output) output;
    guarded sizes, offsets, vertices, sources, points, values;
} TWIN(job);

static void TWIN(describe)(TWIN(job) *it)
{
    uint64_t before = it->with->counts.vertices;
    CHECK_OK(INIT(carvel_refine_input)(&it->input, sizeof it->input));
    CHECK_OK(INIT(carvel_refine_output)(&it->output, sizeof it->output));
    it->refiner = it->with->refiner;
    it->context = NULL;
    it->input.levels = 1;
    it->input.mesh = it->with->mesh;
    it->input.scheme = it->with->scheme;
    it->input.positions = TWIN(input_of)(it->positions, before, 3);
    it->in = TWIN(input_of)(it->attribute, before, 2);
    it->input.attributes = &it->in;
    it->input.attribute_count = 1;
    it->kind = CARVEL_INTERPOLATION_VERTEX;
    it->input.interpolations = &it->kind;
    it->output.face_sizes = indices_of(&it->sizes, it->counts.faces);
    it->output.face_offsets = indices_of(&it->offsets, it->counts.faces + 1);
    it->output.face_vertices = indices_of(&it->vertices, it->counts.corners);
    it->output.face_sources = indices_of(&it->sources, it->counts.faces);
    it->output.positions = TWIN(output_of)(&it->points, it->counts.vertices, 3);
    it->out = TWIN(output_of)(&it->values, it->counts.vertices, 2);
    it->output.attributes = &it->out;
    it->output.attribute_count = 1;
}

static void TWIN(job_take)(TWIN(job) *it, const fixture *with)
{
    uint64_t before = with->counts.vertices, i;
    it->with = with;
    it->counts = predicted(with->mesh, with->scheme, 1);
    it->positions = TAKE(REAL, 3 * before);
    it->attribute = TAKE(REAL, 2 * before);
    for (i = 0; i < 3 * before; i++)
        it->positions[i] = (REAL)with->control->positions[i];
    guarded_take(&it->sizes, it->counts.faces * 4);
    guarded_take(&it->offsets, (it->counts.faces + 1) * 4);
    guarded_take(&it->vertices, it->counts.corners * 4);
    guarded_take(&it->sources, it->counts.faces * 4);
    /* Room for strides. */
    guarded_take(&it->points, it->counts.vertices * 8 * sizeof(REAL));
    guarded_take(&it->values, it->counts.vertices * 8 * sizeof(REAL));
    TWIN(describe)(it);
}

static void TWIN(job_free)(TWIN(job) *it)
{
    guarded_free(&it->sizes);
    guarded_free(&it->offsets);
    guarded_free(&it->vertices);
    guarded_free(&it->sources);
    guarded_free(&it->points);
    guarded_free(&it->values);
    free(it->positions);
    free(it->attribute);
}

static void TWIN(check_all_untouched)(const TWIN(job) *it)
{
    CHECK(untouched(&it->sizes, 0));
    CHECK(untouched(&it->offsets, 0));
    CHECK(untouched(&it->vertices, 0));
    CHECK(untouched(&it->sources, 0));
    CHECK(untouched(&it->points, 0));
    CHECK(untouched(&it->values, 0));
}

static void TWIN(reset)(TWIN(job) *it)
{
    guarded_reset(&it->sizes);
    guarded_reset(&it->offsets);
    guarded_reset(&it->vertices);
    guarded_reset(&it->sources);
    guarded_reset(&it->points);
    guarded_reset(&it->values);
}

static carvel_status TWIN(run)(TWIN(job) *it)
{
    return TWIN(carvel_refiner_refine)(it->refiner, it->context, &it->input, &it->output,
                                       failure);
}

/* The refusal, nothing written, and a sound description again. */
static int TWIN(refused)(TWIN(job) *it, carvel_status status, const char *what, int line)
{
    carvel_status answer = TWIN(run)(it);
    int ok = check_status(status, answer, what, __FILE__, line);
    TWIN(check_all_untouched)(it);
    /* Nor is anything said in the description. */
    CHECK(it->output.anchored == 0);
    TWIN(describe)(it);
    return ok;
}

#ifndef REFUSED
/* Changes one thing and looks what comes of it. */
#define REFUSED(status, change) \
    ((change), TWIN(refused)(it, CARVEL_STATUS_##status, #change, __LINE__))
#endif

static void TWIN(check_pointers)(TWIN(job) *it)
{
    REFUSED(NULL_POINTER, it->refiner = NULL);
    REFUSED(NULL_POINTER, it->input.mesh = NULL);
    REFUSED(NULL_POINTER, it->input.scheme = NULL);
    REFUSED(NULL_POINTER, it->input.positions.data = NULL);
    REFUSED(NULL_POINTER, it->input.attributes = NULL);
    REFUSED(NULL_POINTER, it->in.data = NULL);
    REFUSED(NULL_POINTER, it->output.positions.data = NULL);
    REFUSED(NULL_POINTER, it->output.attributes = NULL);
    REFUSED(NULL_POINTER, it->out.data = NULL);
    REFUSED(MISALIGNED, it->refiner = OFF(carvel_refiner, it->refiner));
    REFUSED(MISALIGNED, it->context = OFF(carvel_context, it->with->context));
    REFUSED(MISALIGNED, it->input.mesh = OFF(carvel_mesh, it->input.mesh));
    REFUSED(MISALIGNED, it->input.scheme = OFF(carvel_scheme, it->input.scheme));
    REFUSED(MISALIGNED, it->input.positions.data = OFF(REAL, it->positions));
    REFUSED(MISALIGNED,
            it->input.attributes = OFF(TWIN(carvel_const_values), it->input.attributes));
    REFUSED(MISALIGNED, it->in.data = OFF(REAL, it->attribute));
    REFUSED(MISALIGNED, it->input.interpolations = OFF(const int32_t, &it->kind));
    REFUSED(MISALIGNED, it->output.positions.data = OFF(REAL, it->output.positions.data));
    REFUSED(MISALIGNED, it->output.attributes = OFF(TWIN(carvel_values), it->output.attributes));
    REFUSED(MISALIGNED, it->out.data = OFF(REAL, it->out.data));
    REFUSED(MISALIGNED, it->output.face_sizes.data = OFF(uint32_t, it->sizes.bytes));
    REFUSED(MISALIGNED, it->output.face_offsets.data = OFF(uint32_t, it->offsets.bytes));
    REFUSED(MISALIGNED, it->output.face_vertices.data = OFF(uint32_t, it->vertices.bytes));
    REFUSED(MISALIGNED, it->output.face_sources.data = OFF(uint32_t, it->sources.bytes));
}

/* The pointers that the macro above cannot change. */
static void TWIN(check_arguments)(TWIN(job) *it)
{
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, TWIN(carvel_refiner_refine)(it->refiner, NULL, NULL,
                                                                         &it->output, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, TWIN(carvel_refiner_refine)(it->refiner, NULL,
                                                                         &it->input, NULL,
                                                                         failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 TWIN(carvel_refiner_refine)(it->refiner, NULL,
                                             OFF(TWIN(carvel_refine_input), &it->input),
                                             &it->output, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 TWIN(carvel_refiner_refine)(it->refiner, NULL, &it->input,
                                             OFF(TWIN(carvel_refine_output), &it->output),
                                             failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 TWIN(carvel_refiner_refine)(it->refiner, NULL, &it->input, &it->output,
                                             OFF(carvel_error, failure)));
    TWIN(check_all_untouched)(it);
}

static void TWIN(check_counts)(TWIN(job) *it)
{
    REFUSED(LENGTH_MISMATCH, it->input.positions.count--);
    REFUSED(LENGTH_MISMATCH, it->input.positions.count++);
    REFUSED(LENGTH_MISMATCH, it->input.positions.count = UINT64_MAX);
    REFUSED(LENGTH_MISMATCH, it->input.positions.count = 0);
    REFUSED(LENGTH_MISMATCH, it->in.count--);
    REFUSED(LENGTH_MISMATCH, it->in.count = UINT64_MAX);
    REFUSED(LENGTH_MISMATCH, it->input.positions.width = 2);
    REFUSED(LENGTH_MISMATCH, it->input.positions.width = 4);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->in.width = it->out.width = 0);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->in.width = it->out.width = 65537);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->in.width = it->out.width = UINT64_MAX);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->kind = 2);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->kind = INT32_MIN);
    /* The fixture's scheme splits corners. */
    REFUSED(UNSUPPORTED, it->kind = CARVEL_INTERPOLATION_VARYING);
    REFUSED(LENGTH_MISMATCH, it->out.width = 1);
    REFUSED(LENGTH_MISMATCH, it->out.width = 3);
    REFUSED(LENGTH_MISMATCH, it->out.width = UINT64_MAX);
    REFUSED(LENGTH_MISMATCH, it->output.positions.width = 2);
    REFUSED(LENGTH_MISMATCH, it->input.attribute_count = 0);
    REFUSED(LENGTH_MISMATCH, it->output.attribute_count = 0);
    REFUSED(LENGTH_MISMATCH, it->output.attribute_count = UINT64_MAX);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->input.attribute_count = 257);
    REFUSED(PARAMETER_OUT_OF_RANGE, it->input.attribute_count = UINT64_MAX);
    REFUSED(BUFFER_TOO_SMALL, it->output.positions.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.positions.count = 0);
    REFUSED(BUFFER_TOO_SMALL, it->out.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.face_sizes.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.face_offsets.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.face_vertices.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.face_sources.count--);
    REFUSED(BUFFER_TOO_SMALL, it->output.face_sources.count = 0);
    REFUSED(TOO_LARGE, it->input.levels = 65);
    REFUSED(TOO_LARGE, it->input.levels = UINT32_MAX);
}

static void TWIN(check_strides)(TWIN(job) *it)
{
    const uint64_t most = UINT64_MAX - (sizeof(REAL) - 1);
    REFUSED(INVALID_STRIDE, it->input.positions.stride = 2 * sizeof(REAL));
    REFUSED(INVALID_STRIDE, it->in.stride = sizeof(REAL));
    REFUSED(INVALID_STRIDE, it->output.positions.stride = 2 * sizeof(REAL));
    REFUSED(INVALID_STRIDE, it->out.stride = sizeof(REAL));
    REFUSED(INVALID_STRIDE, it->out.stride = 1);
    REFUSED(MISALIGNED, it->input.positions.stride = 3 * sizeof(REAL) + 1);
    REFUSED(MISALIGNED, it->in.stride = 2 * sizeof(REAL) + 2);
    REFUSED(MISALIGNED, it->output.positions.stride = 4 * sizeof(REAL) - 1);
    REFUSED(MISALIGNED, it->out.stride = UINT64_MAX);
    REFUSED(TOO_LARGE, it->input.positions.stride = most);
    REFUSED(TOO_LARGE, it->in.stride = (uint64_t)1 << 61);
    REFUSED(TOO_LARGE, it->output.positions.stride = most);
    REFUSED(TOO_LARGE, it->out.stride = (uint64_t)1 << 63);
    /* A product that is a small number again in 64 bits. */
    REFUSED(TOO_LARGE, it->out.stride = UINT64_MAX / it->counts.vertices / 8 * 8 + 8);
}

static void TWIN(check_overlap)(TWIN(job) *it)
{
    const REAL *points = it->output.positions.data;
    REAL *last = it->output.positions.data + 3 * it->counts.vertices - 1;
    REFUSED(OVERLAP, it->output.positions.data = (REAL *)(void *)it->positions);
    REFUSED(OVERLAP, it->out.data = it->attribute);
    /* The struct that is written to, and what is read. */
    REFUSED(OVERLAP, it->output.face_sources.data = (uint32_t *)(void *)&it->output.anchored);
    REFUSED(OVERLAP, it->output.face_sources.data = (uint32_t *)(void *)&it->input.levels);
    REFUSED(OVERLAP, it->output.face_sources.data = (uint32_t *)(void *)&it->in);
    REFUSED(OVERLAP, it->output.face_sources.data = (uint32_t *)(void *)&it->out);
    REFUSED(OVERLAP, it->output.face_sources.data = (uint32_t *)(void *)&it->kind);
    REFUSED(NULL_POINTER, it->output.face_sources.data = NULL);
    REFUSED(OVERLAP, it->out.data = it->output.positions.data);
    REFUSED(OVERLAP, it->out.data = last);
    REFUSED(OVERLAP, it->input.positions.data = points);
    REFUSED(OVERLAP, it->in.data = last);
    REFUSED(OVERLAP, it->output.face_sizes.data = it->output.face_sources.data);
    REFUSED(OVERLAP, it->output.face_offsets.data = it->output.face_sources.data);
    REFUSED(OVERLAP, it->output.face_sizes.data = (uint32_t *)(void *)it->points.bytes);
    REFUSED(OVERLAP, it->output.face_sources.data =
                         it->output.face_vertices.data + it->counts.corners - 1);
    /* Records that would share one value. */
    it->output.positions.stride = it->out.stride = 6 * sizeof(REAL);
    REFUSED(OVERLAP, it->out.data = it->output.positions.data + 2);
    it->output.positions.stride = it->out.stride = 6 * sizeof(REAL);
    REFUSED(OVERLAP, it->out.data = it->output.positions.data + 5);
    /* Records of unequal stride in one place. */
    it->output.positions.stride = 6 * sizeof(REAL);
    it->out.stride = 7 * sizeof(REAL);
    REFUSED(OVERLAP, it->out.data = it->output.positions.data + 3);
}

/* Positions and attribute side by side in one buffer, one value between. */
static void TWIN(check_interleaved)(TWIN(job) *it)
{
    REAL *expected = TAKE(REAL, 3 * it->counts.vertices), *at = it->output.positions.data;
    uint64_t v;
    CHECK_OK(TWIN(run)(it));
    memcpy(expected, at, (size_t)it->counts.vertices * 3 * sizeof(REAL));
    guarded_reset(&it->points);
    TWIN(describe)(it);
    it->output.positions.stride = it->out.stride = 6 * sizeof(REAL);
    it->out.data = at + 4;
    CHECK_OK(TWIN(run)(it));
    for (v = 0; v < it->counts.vertices; v++) {
        CHECK_BYTES(expected + 3 * v, at + 6 * v, 3 * sizeof(REAL));
        CHECK(is_canary(at + 6 * v + 3, sizeof(REAL)));
        CHECK(!is_canary(at + 6 * v + 4, 2 * sizeof(REAL)));
    }
    CHECK(untouched(&it->points, (size_t)it->counts.vertices * 6 * sizeof(REAL)));
    free(expected);
}

/* What is larger than needed is used from its start. */
static void TWIN(check_larger)(TWIN(job) *it)
{
    it->output.face_sizes.count = UINT64_MAX;
    it->output.face_offsets.count++;
    it->output.face_vertices.count = (uint64_t)1 << 40;
    it->output.face_sources.count++;
    it->output.positions.count = it->out.count = it->counts.vertices + 1;
    CHECK_OK(TWIN(run)(it));
    CHECK_UINT(1, it->output.anchored);
    CHECK(untouched(&it->sizes, (size_t)it->counts.faces * 4));
    CHECK(untouched(&it->offsets, (size_t)(it->counts.faces + 1) * 4));
    CHECK(untouched(&it->vertices, (size_t)it->counts.corners * 4));
    CHECK(untouched(&it->sources, (size_t)it->counts.faces * 4));
    CHECK(untouched(&it->points, (size_t)it->counts.vertices * 3 * sizeof(REAL)));
    CHECK(untouched(&it->values, (size_t)it->counts.vertices * 2 * sizeof(REAL)));
}

static carvel_status TWIN(init_input)(void *it, uint32_t size)
{
    return INIT(carvel_refine_input)((TWIN(carvel_refine_input) *)it, size);
}

static carvel_status TWIN(init_output)(void *it, uint32_t size)
{
    return INIT(carvel_refine_output)((TWIN(carvel_refine_output) *)it, size);
}

static versioned TWIN(input_version)(void)
{
    static const size_t ends[] = {
        offsetof(TWIN(carvel_refine_input), levels),
        offsetof(TWIN(carvel_refine_input), mesh),
        offsetof(TWIN(carvel_refine_input), scheme),
        offsetof(TWIN(carvel_refine_input), positions),
        offsetof(TWIN(carvel_refine_input), attributes),
        offsetof(TWIN(carvel_refine_input), attribute_count),
        offsetof(TWIN(carvel_refine_input), interpolations),
        offsetof(TWIN(carvel_refine_input), channels),
        offsetof(TWIN(carvel_refine_input), channel_count)
    };
    return versioned_of("carvel_refine_input", TWIN(init_input),
                        sizeof(TWIN(carvel_refine_input)), ends, sizeof ends / sizeof ends[0]);
}

static versioned TWIN(output_version)(void)
{
    static const size_t ends[] = {
        offsetof(TWIN(carvel_refine_output), anchored),
        offsetof(TWIN(carvel_refine_output), face_sizes),
        offsetof(TWIN(carvel_refine_output), face_offsets),
        offsetof(TWIN(carvel_refine_output), face_vertices),
        offsetof(TWIN(carvel_refine_output), face_sources),
        offsetof(TWIN(carvel_refine_output), positions),
        offsetof(TWIN(carvel_refine_output), attributes),
        offsetof(TWIN(carvel_refine_output), attribute_count),
        offsetof(TWIN(carvel_refine_output), channels),
        offsetof(TWIN(carvel_refine_output), channel_count)
    };
    return versioned_of("carvel_refine_output", TWIN(init_output),
                        sizeof(TWIN(carvel_refine_output)), ends, sizeof ends / sizeof ends[0]);
}

/* Structs of every size: copies on the heap, not a byte longer than they say. */
static void TWIN(check_input_sizes)(TWIN(job) *it)
{
    versioned version = TWIN(input_version)();
    uint32_t size;
    check_init(&version);
    for (size = 0; size <= sizeof it->input + 9; size++) {
        TWIN(carvel_refine_input) *input =
            (TWIN(carvel_refine_input) *)truncated(&it->input, sizeof it->input, size);
        carvel_status status =
            TWIN(carvel_refiner_refine)(it->refiner, NULL, input, &it->output, failure);
        if (!is_end(&version, size))
            CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, status);
        else if (size <= offsetof(TWIN(carvel_refine_input), scheme))
            CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, status);
        else if (size < offsetof(TWIN(carvel_refine_input), interpolations))
            /* No positions; no attributes where there is an output for one. */
            CHECK(status == CARVEL_STATUS_LENGTH_MISMATCH ||
                  status == CARVEL_STATUS_NULL_POINTER);
        else
            CHECK_OK(status);
        if (status != CARVEL_STATUS_OK)
            TWIN(check_all_untouched)(it);
        TWIN(reset)(it);
        free(input);
    }
}

static void TWIN(check_output_sizes)(TWIN(job) *it)
{
    versioned version = TWIN(output_version)();
    uint32_t size;
    check_init(&version);
    it->input.attribute_count = 0;
    for (size = 0; size <= sizeof it->output + 9; size++) {
        TWIN(carvel_refine_output) *output =
            (TWIN(carvel_refine_output) *)truncated(&it->output, sizeof it->output, size);
        carvel_status status;
        if (size >= offsetof(TWIN(carvel_refine_output), channels))
            output->attribute_count = 0;
        status = TWIN(carvel_refiner_refine)(it->refiner, NULL, &it->input, output, failure);
        if (!is_end(&version, size))
            CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, status);
        else if (size >= offsetof(TWIN(carvel_refine_output), attributes))
            CHECK_OK(status);
        else
            CHECK(status != CARVEL_STATUS_OK && status != CARVEL_STATUS_STRUCT_SIZE);
        if (status != CARVEL_STATUS_OK)
            TWIN(check_all_untouched)(it);
        else
            CHECK_UINT(1, output->anchored);
        TWIN(reset)(it);
        free(output);
    }
    TWIN(describe)(it);
}

/* -------------------------------------------------------------- hierarchy */

typedef carvel_status (*TWIN(level_function))(const carvel_hierarchy *, const carvel_context *,
                                              uint32_t, const TWIN(carvel_const_values) *,
                                              const TWIN(carvel_values) *, carvel_error *);

/* The function that takes a kind of interpolation, like the one that takes none. */
static carvel_status TWIN(interpolate)(const carvel_hierarchy *hierarchy,
                                       const carvel_context *context, uint32_t level,
                                       const TWIN(carvel_const_values) *values,
                                       const TWIN(carvel_values) *out, carvel_error *error)
{
    return TWIN(carvel_hierarchy_interpolate)(hierarchy, context, level,
                                              CARVEL_INTERPOLATION_VERTEX, values, out, error);
}

static const TWIN(level_function) TWIN(level_functions)[2] = { TWIN(carvel_hierarchy_refine),
                                                               TWIN(interpolate) };

static int TWIN(refused_level)(TWIN(job) *it, carvel_status status, uint32_t level,
                               const char *what, int line)
{
    int ok = 1, i;
    for (i = 0; i < 2; i++) {
        carvel_status answer = TWIN(level_functions)[i](it->with->hierarchy, it->context, level,
                                                        &it->in, &it->out, failure);
        ok = check_status(status, answer, what, __FILE__, line) && ok;
    }
    TWIN(check_all_untouched)(it);
    TWIN(describe)(it);
    return ok;
}

#ifndef LEVEL_REFUSED
#define LEVEL_REFUSED(status, change) \
    ((change), TWIN(refused_level)(it, CARVEL_STATUS_##status, 1, #change, __LINE__))
#endif

static void TWIN(check_level_values)(TWIN(job) *it)
{
    LEVEL_REFUSED(NULL_POINTER, it->in.data = NULL);
    LEVEL_REFUSED(NULL_POINTER, it->out.data = NULL);
    LEVEL_REFUSED(MISALIGNED, it->in.data = OFF(REAL, it->in.data));
    LEVEL_REFUSED(MISALIGNED, it->out.data = OFF(REAL, it->out.data));
    LEVEL_REFUSED(MISALIGNED, it->context = OFF(carvel_context, it->with->context));
    LEVEL_REFUSED(LENGTH_MISMATCH, it->in.count++);
    LEVEL_REFUSED(PARAMETER_OUT_OF_RANGE, it->in.width = it->out.width = 0);
    LEVEL_REFUSED(PARAMETER_OUT_OF_RANGE, it->in.width = it->out.width = 65537);
    LEVEL_REFUSED(LENGTH_MISMATCH, it->out.width = 1);
    LEVEL_REFUSED(BUFFER_TOO_SMALL, it->out.count--);
    LEVEL_REFUSED(INVALID_STRIDE, it->in.stride = sizeof(REAL));
    LEVEL_REFUSED(INVALID_STRIDE, it->out.stride = sizeof(REAL));
    LEVEL_REFUSED(MISALIGNED, it->in.stride = 2 * sizeof(REAL) + 1);
    LEVEL_REFUSED(MISALIGNED, it->out.stride = 2 * sizeof(REAL) + 1);
    LEVEL_REFUSED(TOO_LARGE, it->in.stride = (uint64_t)1 << 61);
    LEVEL_REFUSED(TOO_LARGE, it->out.stride = (uint64_t)1 << 61);
    LEVEL_REFUSED(OVERLAP, it->in.data = it->out.data + 2 * it->counts.vertices - 1);
    LEVEL_REFUSED(OVERLAP, it->out.data = it->attribute);
    TWIN(refused_level)(it, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, 2, "level 2", __LINE__);
    TWIN(refused_level)(it, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, UINT32_MAX, "level", __LINE__);
}

static void TWIN(check_level_kinds)(TWIN(job) *it)
{
    const carvel_hierarchy *hierarchy = it->with->hierarchy;
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 TWIN(carvel_hierarchy_interpolate)(hierarchy, NULL, 1, 2, &it->in, &it->out,
                                                    failure));
    CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                 TWIN(carvel_hierarchy_interpolate)(hierarchy, NULL, 1, -1, &it->in, &it->out,
                                                    failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 TWIN(carvel_hierarchy_interpolate)(hierarchy, NULL, 1,
                                                    CARVEL_INTERPOLATION_VARYING, &it->in,
                                                    &it->out, failure));
    TWIN(check_all_untouched)(it);
}

static void TWIN(check_arguments_of)(TWIN(job) *it, TWIN(level_function) run)
{
    const carvel_hierarchy *hierarchy = it->with->hierarchy;
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, run(NULL, NULL, 1, &it->in, &it->out, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, run(hierarchy, NULL, 1, NULL, &it->out, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, run(hierarchy, NULL, 1, &it->in, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED, run(OFF(carvel_hierarchy, hierarchy), NULL, 1, &it->in,
                                               &it->out, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 run(hierarchy, NULL, 1, OFF(TWIN(carvel_const_values), &it->in), &it->out,
                     failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED, run(hierarchy, NULL, 1, &it->in,
                                               OFF(TWIN(carvel_values), &it->out), failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED, run(hierarchy, NULL, 1, &it->in, &it->out,
                                               OFF(carvel_error, failure)));
    TWIN(check_all_untouched)(it);
    it->out.count++;
    CHECK_OK(run(hierarchy, NULL, 1, &it->in, &it->out, failure));
    CHECK(untouched(&it->values, (size_t)it->counts.vertices * 2 * sizeof(REAL)));
    TWIN(reset)(it);
}

static void TWIN(check_level_arguments)(TWIN(job) *it)
{
    TWIN(check_arguments_of)(it, TWIN(level_functions)[0]);
    TWIN(check_arguments_of)(it, TWIN(level_functions)[1]);
}

static void TWIN(check_refining)(const fixture *with)
{
    static void (*const parts[])(TWIN(job) *) = {
        TWIN(check_pointers),     TWIN(check_arguments),    TWIN(check_counts),
        TWIN(check_strides),      TWIN(check_overlap),      TWIN(check_interleaved),
        TWIN(check_larger),       TWIN(check_input_sizes),  TWIN(check_output_sizes),
        TWIN(check_level_values), TWIN(check_level_arguments),
        TWIN(check_level_kinds)
    };
    size_t i;
    for (i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        TWIN(job) it;
        TWIN(job_take)(&it, with);
        parts[i](&it);
        TWIN(job_free)(&it);
    }
}
