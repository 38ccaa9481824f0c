/* Every function called wrongly, one thing wrong at a time: a status, and not a
 * byte written but what the header says. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

enum { CANARY = 0xa5, MARGIN = 64 };

/* A pointer of a type, moved to where no such thing can be. Larger than what an
 * aligned byte would allow, smaller than any alignment. */
#define OFF(type, pointer) ((type *)(void *)((char *)(uintptr_t)(pointer) + 1))

#define REFUSE(status, call) CHECK_STATUS(CARVEL_STATUS_##status, call)

/* ------------------------------------------------------------------ canaries */

/* A buffer with canaries before, in and after it. */
typedef struct guarded {
    unsigned char *whole, *bytes;
    size_t size;
} guarded;

static void guarded_reset(guarded *it)
{
    memset(it->whole, CANARY, it->size + 2 * MARGIN);
}

static void guarded_take(guarded *it, uint64_t size)
{
    it->size = (size_t)size;
    it->whole = (unsigned char *)take(it->size + 2 * MARGIN);
    it->bytes = it->whole + MARGIN;
    guarded_reset(it);
}

static void guarded_free(guarded *it)
{
    free(it->whole);
}

static int is_canary(const void *from, size_t size)
{
    const unsigned char *bytes = (const unsigned char *)from;
    size_t i = 0;
    while (i < size && bytes[i] == CANARY)
        i++;
    return i == size;
}

/* 1 if nothing was written before the buffer or from `used` bytes of it on. */
static int untouched(const guarded *it, size_t used)
{
    return is_canary(it->whole, MARGIN) &&
           is_canary(it->bytes + used, it->size - used + MARGIN);
}

static carvel_indices indices_of(const guarded *it, uint64_t count)
{
    carvel_indices indices;
    indices.data = (uint32_t *)(void *)it->bytes;
    indices.count = count;
    return indices;
}

/* --------------------------------------------------------------- struct sizes */

/* One struct that may grow: its init function, behind a pointer to anything, and
 * where its fields end but for the last. */
typedef struct versioned {
    const char *name;
    carvel_status (*init)(void *, uint32_t);
    size_t whole;
    const size_t *ends;
    size_t end_count;
} versioned;

static versioned versioned_of(const char *name, carvel_status (*init)(void *, uint32_t),
                              size_t whole, const size_t *ends, size_t end_count)
{
    versioned it;
    it.name = name;
    it.init = init;
    it.whole = whole;
    it.ends = ends;
    it.end_count = end_count;
    return it;
}

/* 1 if a struct of this size ends between two fields, or is whole. */
static int is_end(const versioned *it, size_t size)
{
    size_t i;
    /* Less is the size of a pointer, or was never set. */
    if (size < 16)
        return 0;
    for (i = 0; i < it->end_count; i++)
        if (it->ends[i] == size)
            return 1;
    return size == it->whole;
}

/* The start of a struct that says how long it is, on a heap block as long: what
 * is read or written beyond is seen by sanitizers. */
static void *truncated(const void *from, size_t whole, uint32_t size)
{
    size_t room = size < sizeof size ? sizeof size : size;
    unsigned char *copy = (unsigned char *)take(room);
    memset(copy, 0x5a, room);
    memcpy(copy, from, size < whole ? size : whole);
    memcpy(copy, &size, sizeof size);
    return copy;
}

/* ------------------------------------------------------------------- fixture */

typedef struct fixture {
    poly *control;
    carvel_mesh *mesh;
    carvel_counts counts;
    carvel_scheme *scheme;
    carvel_context *context;
    carvel_refiner *refiner;
    carvel_hierarchy *hierarchy;
} fixture;

static void fixture_take(fixture *it)
{
    it->control = poly_mixed();
    it->mesh = poly_mesh(it->control);
    it->counts = counts_of(it->mesh);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    it->context = context_of(1);
    it->refiner = refiner_of();
    it->hierarchy = hierarchy_of(it->mesh, it->scheme, 1);
}

static void fixture_free(fixture *it)
{
    carvel_hierarchy_destroy(it->hierarchy);
    carvel_refiner_destroy(it->refiner);
    carvel_context_destroy(it->context);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->control);
}

/* ---------------------------------------------------------------------- inits */

/* A list of ends is the list of the offsets of all fields but the first. */
#define VERSIONED(type, ends) \
    versioned_of(#type, init_##type, sizeof(type), ends, sizeof ends / sizeof ends[0])

#define DEFINE_INIT(type) \
    static carvel_status init_##type(void *it, uint32_t size) \
    { \
        return type##_init((type *)it, size); \
    }
DEFINE_INIT(carvel_context_desc)
DEFINE_INIT(carvel_scheme_desc)
DEFINE_INIT(carvel_mesh_desc)
DEFINE_INIT(carvel_channel_desc)
DEFINE_INIT(carvel_counts)
DEFINE_INIT(carvel_survey)
DEFINE_INIT(carvel_bytes)
DEFINE_INIT(carvel_seconds)

/* A struct made by an init function is a zeroed one with its size, so far as it
 * goes. */
static void check_init(const versioned *it)
{
    unsigned char zeroed[256];
    uint32_t size;
    guarded room;
    guarded_take(&room, it->whole + 16);
    memset(zeroed, 0, sizeof zeroed);
    check_context(it->name);
    for (size = 0; size <= it->whole + 9; size++) {
        guarded_reset(&room);
        if (!is_end(it, size)) {
            REFUSE(STRUCT_SIZE, it->init(room.bytes, size));
            CHECK(untouched(&room, 0));
            continue;
        }
        CHECK_OK(it->init(room.bytes, size));
        memcpy(zeroed, &size, sizeof size);
        CHECK_BYTES(zeroed, room.bytes, size);
        CHECK(untouched(&room, size));
    }
    guarded_reset(&room);
    REFUSE(STRUCT_SIZE, it->init(room.bytes, UINT32_MAX));
    REFUSE(NULL_POINTER, it->init(NULL, (uint32_t)it->whole));
    REFUSE(MISALIGNED, it->init(room.bytes + 1, (uint32_t)it->whole));
    REFUSE(MISALIGNED, it->init(room.bytes + 4, (uint32_t)it->whole));
    CHECK(untouched(&room, 0));
    guarded_free(&room);
}

/* ------------------------------------------------------------------- refining */

#define REAL float
#define TWIN(name) name##_f32
#define INIT(name) name##_f32_init
#include "misuse_twin.h"
#undef REAL
#undef TWIN
#undef INIT

#define REAL double
#define TWIN(name) name##_f64
#define INIT(name) name##_f64_init
#include "misuse_twin.h"

/* ------------------------------------------------------------------- queries */

/* Calls a query with the room for its struct. */
typedef carvel_status (*query)(const fixture *, void *);

static carvel_status query_mesh_counts(const fixture *it, void *out)
{
    return carvel_mesh_counts(it->mesh, (carvel_counts *)out, failure);
}

static carvel_status query_survey(const fixture *it, void *out)
{
    return carvel_mesh_survey(it->mesh, (carvel_survey *)out, failure);
}

static carvel_status query_predicted(const fixture *it, void *out)
{
    return carvel_predict_counts(it->mesh, it->scheme, 3, (carvel_counts *)out, failure);
}

static carvel_status query_bytes(const fixture *it, void *out)
{
    return carvel_predict_bytes(it->mesh, it->scheme, 3, 5, 8, (carvel_bytes *)out, failure);
}

static carvel_status query_seconds(const fixture *it, void *out)
{
    return carvel_predict_seconds(it->mesh, it->scheme, 3, 5, 8, 2, (carvel_seconds *)out,
                                  failure);
}

static carvel_status query_level(const fixture *it, void *out)
{
    return carvel_hierarchy_counts(it->hierarchy, 1, (carvel_counts *)out, failure);
}

/* Written as far as the caller's version goes, and not a byte beyond. */
static void check_query(const versioned *it, query ask, const fixture *with)
{
    unsigned char full[256];
    uint32_t size = (uint32_t)it->whole;
    guarded room;
    guarded_take(&room, it->whole + 16);
    memcpy(full, &size, sizeof size);
    CHECK_OK(ask(with, full));
    for (size = 0; size <= it->whole + 9; size++) {
        guarded_reset(&room);
        memcpy(room.bytes, &size, sizeof size);
        if (is_end(it, size)) {
            CHECK_OK(ask(with, room.bytes));
            CHECK_BYTES(full + 4, room.bytes + 4, size - 4);
            CHECK(untouched(&room, size));
        } else {
            REFUSE(STRUCT_SIZE, ask(with, room.bytes));
            CHECK(untouched(&room, 4));
        }
        CHECK_BYTES(&size, room.bytes, sizeof size);
    }
    REFUSE(NULL_POINTER, ask(with, NULL));
    REFUSE(MISALIGNED, ask(with, room.bytes + 4));
    guarded_free(&room);
}

static void check_queries(const fixture *with)
{
    static const size_t counts[] = {
        offsetof(carvel_counts, level),          offsetof(carvel_counts, vertices),
        offsetof(carvel_counts, faces),          offsetof(carvel_counts, corners),
        offsetof(carvel_counts, edges),          offsetof(carvel_counts, boundary_edges),
        offsetof(carvel_counts, irregular_faces)
    };
    static const size_t survey[] = {
        offsetof(carvel_survey, anchored),          offsetof(carvel_survey, components),
        offsetof(carvel_survey, boundary_loops),    offsetof(carvel_survey, isolated_vertices),
        offsetof(carvel_survey, euler_characteristic),
        offsetof(carvel_survey, corner_tags),       offsetof(carvel_survey, bytes),
        offsetof(carvel_survey, creases),           offsetof(carvel_survey, sharp_vertices),
        offsetof(carvel_survey, holes)
    };
    static const size_t bytes[] = { offsetof(carvel_bytes, level),
                                    offsetof(carvel_bytes, topology),
                                    offsetof(carvel_bytes, scratch),
                                    offsetof(carvel_bytes, output) };
    static const size_t seconds[] = { offsetof(carvel_seconds, level),
                                      offsetof(carvel_seconds, steps),
                                      offsetof(carvel_seconds, last),
                                      offsetof(carvel_seconds, memory),
                                      offsetof(carvel_seconds, total) };
    versioned it = VERSIONED(carvel_counts, counts);
    check_init(&it);
    check_query(&it, query_mesh_counts, with);
    check_query(&it, query_predicted, with);
    check_query(&it, query_level, with);
    it = VERSIONED(carvel_survey, survey);
    check_init(&it);
    check_query(&it, query_survey, with);
    it = VERSIONED(carvel_bytes, bytes);
    check_init(&it);
    check_query(&it, query_bytes, with);
    it = VERSIONED(carvel_seconds, seconds);
    check_init(&it);
    check_query(&it, query_seconds, with);
}

/* ------------------------------------------------------------------- contexts */

static versioned context_version(void)
{
    static const size_t ends[] = { offsetof(carvel_context_desc, thread_count),
                                   offsetof(carvel_context_desc, memory_ceiling),
                                   offsetof(carvel_context_desc, progress),
                                   offsetof(carvel_context_desc, user_data) };
    return VERSIONED(carvel_context_desc, ends);
}

/* What makes an object refuses, and answers NULL whatever was there. */
#define MADE_NOTHING(object, status, call) \
    do { \
        memset(&(object), CANARY, sizeof(object)); \
        REFUSE(status, call); \
        CHECK((object) == NULL); \
    } while (0)

static void check_contexts(void)
{
    versioned version = context_version();
    carvel_context *context = NULL;
    carvel_context_desc desc;
    uint32_t size;
    check_init(&version);
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = 1;
    for (size = 0; size <= sizeof desc + 9; size++) {
        carvel_context_desc *shorter =
            (carvel_context_desc *)truncated(&desc, sizeof desc, size);
        carvel_status expected =
            is_end(&version, size) ? CARVEL_STATUS_OK : CARVEL_STATUS_STRUCT_SIZE;
        CHECK_STATUS(expected, carvel_context_create(shorter, &context, failure));
        CHECK((context != NULL) == (expected == CARVEL_STATUS_OK));
        if (size >= 8 && context != NULL)
            CHECK_UINT(1, carvel_context_thread_count(context));
        carvel_context_destroy(context);
        free(shorter);
    }
    REFUSE(NULL_POINTER, carvel_context_create(&desc, NULL, failure));
    REFUSE(MISALIGNED, carvel_context_create(&desc, OFF(carvel_context *, &context), failure));
    MADE_NOTHING(context, NULL_POINTER, carvel_context_create(NULL, &context, failure));
    MADE_NOTHING(context, MISALIGNED,
                 carvel_context_create(OFF(carvel_context_desc, &desc), &context, failure));
    REFUSE(MISALIGNED, carvel_context_create(&desc, &context, OFF(carvel_error, failure)));
    /* Functions without a status do nothing. */
    CHECK_UINT(1, carvel_context_thread_count(NULL));
    CHECK_UINT(0, carvel_context_is_cancelled(NULL));
    carvel_context_cancel(NULL);
    carvel_context_reset(NULL);
    carvel_context_destroy(NULL);
}

/* -------------------------------------------------------------------- schemes */

static versioned scheme_version(void)
{
    static const size_t ends[] = {
        offsetof(carvel_scheme_desc, family),   offsetof(carvel_scheme_desc, corner_rule),
        offsetof(carvel_scheme_desc, boundary), offsetof(carvel_scheme_desc, w),
        offsetof(carvel_scheme_desc, degree),   offsetof(carvel_scheme_desc, passes),
        offsetof(carvel_scheme_desc, pass_count),
        offsetof(carvel_scheme_desc, creasing), offsetof(carvel_scheme_desc, triangle_rule),
        offsetof(carvel_scheme_desc, loop_weights),
        offsetof(carvel_scheme_desc, extraordinary)
    };
    return VERSIONED(carvel_scheme_desc, ends);
}

static void check_scheme_sizes(void)
{
    versioned version = scheme_version();
    carvel_scheme *scheme = NULL;
    carvel_scheme_desc desc;
    uint32_t size;
    uint64_t passes = 99;
    check_init(&version);
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    desc.family = CARVEL_SCHEME_QUARTIC;
    for (size = 0; size <= sizeof desc + 9; size++) {
        carvel_scheme_desc *shorter = (carvel_scheme_desc *)truncated(&desc, sizeof desc, size);
        carvel_status expected =
            is_end(&version, size) ? CARVEL_STATUS_OK : CARVEL_STATUS_STRUCT_SIZE;
        CHECK_STATUS(expected, carvel_scheme_create(shorter, &scheme, failure));
        if (CHECK((scheme != NULL) == (expected == CARVEL_STATUS_OK)) && scheme != NULL) {
            CHECK_OK(carvel_scheme_passes(scheme, NULL, 0, &passes, failure));
            /* Without a family it is Doo and Sabin's, which has none. */
            CHECK_UINT(size >= 8, passes);
        }
        carvel_scheme_destroy(scheme);
        free(shorter);
    }
}

static void check_scheme_pointers(void)
{
    carvel_scheme *scheme = NULL;
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    REFUSE(NULL_POINTER, carvel_scheme_create(&desc, NULL, failure));
    REFUSE(MISALIGNED, carvel_scheme_create(&desc, OFF(carvel_scheme *, &scheme), failure));
    REFUSE(MISALIGNED, carvel_scheme_create(&desc, &scheme, OFF(carvel_error, failure)));
    MADE_NOTHING(scheme, NULL_POINTER, carvel_scheme_create(NULL, &scheme, failure));
    MADE_NOTHING(scheme, MISALIGNED,
                 carvel_scheme_create(OFF(carvel_scheme_desc, &desc), &scheme, failure));
    desc.family = CARVEL_SCHEME_AVERAGING;
    desc.pass_count = 1;
    MADE_NOTHING(scheme, NULL_POINTER, carvel_scheme_create(&desc, &scheme, failure));
    desc.passes = OFF(const carvel_fraction, &desc.w);
    MADE_NOTHING(scheme, MISALIGNED, carvel_scheme_create(&desc, &scheme, failure));
    /* Where a count is 0 its pointer is not looked at. */
    desc.pass_count = 0;
    CHECK_OK(carvel_scheme_create(&desc, &scheme, failure));
    carvel_scheme_destroy(scheme);
}

static int scheme_refused(carvel_scheme_desc *desc, carvel_status status, const char *what,
                          int line)
{
    carvel_scheme *scheme = (carvel_scheme *)desc;
    int ok = check_status(status, carvel_scheme_create(desc, &scheme, failure), what, __FILE__,
                          line);
    CHECK(scheme == NULL || status == CARVEL_STATUS_OK);
    if (status == CARVEL_STATUS_OK)
        carvel_scheme_destroy(scheme);
    carvel_scheme_desc_init(desc, sizeof *desc);
    return ok;
}

#define SCHEME(status, change) \
    ((change), scheme_refused(&desc, CARVEL_STATUS_##status, #change, __LINE__))
#define FRACTION(field, p, q) ((field).numerator = (p), (field).denominator = (q))
#define THREE_POINT(p, q) \
    (desc.family = CARVEL_SCHEME_THREE_POINT, FRACTION(desc.w, p, q))
#define SPLINE(n) (desc.family = CARVEL_SCHEME_B_SPLINE, desc.degree = (n))
#define PASSES(list, n) \
    (desc.family = CARVEL_SCHEME_AVERAGING, desc.passes = (list), desc.pass_count = (n))
#define ONE_PASS(p, q) (FRACTION(passes[0], p, q), PASSES(passes, 1))

static void check_scheme_values(void)
{
    carvel_fraction passes[65];
    carvel_scheme_desc desc;
    memset(passes, 0, sizeof passes);
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.family = 9);
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.family = -1);
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.family = INT32_MAX);
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.corner_rule = 2);
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.corner_rule = INT32_MIN);
#define TUNED (desc.family = CARVEL_SCHEME_THREE_POINT, desc.extraordinary = 1)
    SCHEME(OK, TUNED);
    SCHEME(OK, (TUNED, FRACTION(desc.w, 2, 64)));
    SCHEME(UNSUPPORTED, (TUNED, FRACTION(desc.w, 1, 64)));
    SCHEME(PARAMETER_OUT_OF_RANGE, (TUNED, desc.extraordinary = 2));
    SCHEME(PARAMETER_OUT_OF_RANGE, (TUNED, desc.family = CARVEL_SCHEME_AVERAGING));
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.boundary = 3);
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.boundary = -1);
    SCHEME(OK, THREE_POINT(0, 0));
    SCHEME(OK, THREE_POINT(0, 1));
    SCHEME(OK, THREE_POINT(1, 16));
    SCHEME(INVALID_NUMBER, THREE_POINT(1, 0));
    SCHEME(INVALID_NUMBER, THREE_POINT(INT64_MIN, 1));
    SCHEME(INVALID_NUMBER, THREE_POINT(1, INT64_MIN));
    SCHEME(PARAMETER_OUT_OF_RANGE, THREE_POINT(1, 15));
    SCHEME(PARAMETER_OUT_OF_RANGE, THREE_POINT(-1, 1000));
    SCHEME(PARAMETER_OUT_OF_RANGE, THREE_POINT(INT64_MAX, 1));
    SCHEME(OK, SPLINE(2));
    SCHEME(OK, SPLINE(64));
    SCHEME(OK, SPLINE(1));
    SCHEME(OK, SPLINE(65));
    SCHEME(PARAMETER_OUT_OF_RANGE, SPLINE(0));
    SCHEME(PARAMETER_OUT_OF_RANGE, SPLINE(66));
    SCHEME(PARAMETER_OUT_OF_RANGE, SPLINE(((uint64_t)1 << 32) + 4));
    SCHEME(PARAMETER_OUT_OF_RANGE, SPLINE(UINT64_MAX));
    /* A field that belongs to another family. */
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.degree = 4);
    SCHEME(PARAMETER_OUT_OF_RANGE, FRACTION(desc.w, 1, 32));
    SCHEME(PARAMETER_OUT_OF_RANGE, (desc.passes = passes, desc.pass_count = 1));
    SCHEME(OK, ONE_PASS(-1000, 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, ONE_PASS(1001, 1));
    SCHEME(INVALID_NUMBER, ONE_PASS(1, 0));
    SCHEME(INVALID_NUMBER, ONE_PASS(0, 0));
    SCHEME(INVALID_NUMBER, ONE_PASS(INT64_MIN, 1));
    SCHEME(INVALID_NUMBER, ONE_PASS(INT64_MIN, INT64_MIN));
    SCHEME(PARAMETER_OUT_OF_RANGE, PASSES(passes, 65));
    SCHEME(PARAMETER_OUT_OF_RANGE, PASSES(passes, UINT64_MAX));
}

#define CATMULL_CLARK(change) (desc.family = CARVEL_SCHEME_CATMULL_CLARK, (change))
#define LOOP(change) (desc.family = CARVEL_SCHEME_LOOP, (change))
#define BILINEAR(change) (desc.family = CARVEL_SCHEME_BILINEAR, (change))
#define PRIMAL(list, n) (PASSES(list, n), desc.family = CARVEL_SCHEME_PRIMAL)

/* Options of the primal schemes, each with its own family and with another. */
static void check_primal_values(void)
{
    carvel_fraction passes[1] = { { 1, 2 } };
    carvel_scheme_desc desc;
    CHECK_OK(carvel_scheme_desc_init(&desc, sizeof desc));
    SCHEME(OK, CATMULL_CLARK(desc.creasing = CARVEL_CREASING_CHAIKIN));
    SCHEME(OK, LOOP(desc.creasing = CARVEL_CREASING_CHAIKIN));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK(desc.creasing = 2));
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.creasing = -1));
    SCHEME(PARAMETER_OUT_OF_RANGE, BILINEAR(desc.creasing = CARVEL_CREASING_CHAIKIN));
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.creasing = CARVEL_CREASING_CHAIKIN);
    SCHEME(OK, CATMULL_CLARK(desc.triangle_rule = CARVEL_TRIANGLE_RULE_SMOOTH));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK(desc.triangle_rule = 2));
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.triangle_rule = CARVEL_TRIANGLE_RULE_SMOOTH));
    SCHEME(OK, LOOP(desc.loop_weights = CARVEL_LOOP_WEIGHTS_WARREN));
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.loop_weights = 2));
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.loop_weights = INT32_MIN));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK(desc.loop_weights = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK(desc.corner_rule = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.corner_rule = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, BILINEAR(desc.corner_rule = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK(desc.extraordinary = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, desc.extraordinary = -1);
    SCHEME(PARAMETER_OUT_OF_RANGE, LOOP(desc.degree = 3));
    SCHEME(PARAMETER_OUT_OF_RANGE, BILINEAR(FRACTION(desc.w, 1, 32)));
    SCHEME(PARAMETER_OUT_OF_RANGE, CATMULL_CLARK((desc.passes = passes, desc.pass_count = 1)));
    SCHEME(OK, PRIMAL(passes, 1));
    SCHEME(OK, (PRIMAL(passes, 1), desc.corner_rule = 1));
    SCHEME(PARAMETER_OUT_OF_RANGE, PRIMAL(passes, 65));
    SCHEME(NULL_POINTER, PRIMAL(NULL, 1));
    SCHEME(MISALIGNED, PRIMAL(OFF(const carvel_fraction, passes), 1));
    SCHEME(INVALID_NUMBER, (PRIMAL(passes, 1), FRACTION(passes[0], 1, 0)));
}

static void check_holes(const fixture *with)
{
    /* All four faces of the open mesh are at its boundary. */
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, CARVEL_BOUNDARY_NONE);
    const carvel_mesh *mesh = with->mesh;
    uint32_t *out;
    uint64_t count = 99;
    guarded room;
    guarded_take(&room, 6 * sizeof *out);
    out = (uint32_t *)(void *)room.bytes;
    REFUSE(NULL_POINTER, carvel_scheme_holes(NULL, mesh, out, 4, &count, failure));
    REFUSE(NULL_POINTER, carvel_scheme_holes(scheme, NULL, out, 4, &count, failure));
    REFUSE(NULL_POINTER, carvel_scheme_holes(scheme, mesh, NULL, 4, &count, failure));
    REFUSE(MISALIGNED,
           carvel_scheme_holes(OFF(carvel_scheme, scheme), mesh, out, 4, &count, failure));
    REFUSE(MISALIGNED,
           carvel_scheme_holes(scheme, OFF(carvel_mesh, mesh), out, 4, &count, failure));
    REFUSE(MISALIGNED,
           carvel_scheme_holes(scheme, mesh, OFF(uint32_t, out), 4, &count, failure));
    REFUSE(MISALIGNED,
           carvel_scheme_holes(scheme, mesh, out, 4, OFF(uint64_t, &count), failure));
    REFUSE(MISALIGNED,
           carvel_scheme_holes(scheme, mesh, out, 4, NULL, OFF(carvel_error, failure)));
    REFUSE(OVERLAP, carvel_scheme_holes(scheme, mesh, out, 4, (uint64_t *)(void *)out, failure));
    CHECK_UINT(99, count);
    REFUSE(BUFFER_TOO_SMALL, carvel_scheme_holes(scheme, mesh, out, 3, &count, failure));
    CHECK_UINT(4, count);
    CHECK(untouched(&room, 0));
    CHECK_OK(carvel_scheme_holes(scheme, mesh, NULL, 0, &count, failure));
    CHECK_OK(carvel_scheme_holes(scheme, mesh, out, UINT64_MAX, NULL, failure));
    CHECK(untouched(&room, 4 * sizeof *out));
    guarded_free(&room);
    carvel_scheme_destroy(scheme);
}

static void check_passes(void)
{
    static const carvel_fraction given[3] = { { 2, 4 }, { 0, 7 }, { 3, -9 } };
    static const carvel_fraction lowest[3] = { { 1, 2 }, { 0, 1 }, { -1, 3 } };
    carvel_scheme *scheme = scheme_of_passes(given, 3);
    carvel_fraction *out;
    uint64_t count = 99;
    guarded room;
    guarded_take(&room, 4 * sizeof *out);
    out = (carvel_fraction *)(void *)room.bytes;
    REFUSE(NULL_POINTER, carvel_scheme_passes(NULL, out, 3, &count, failure));
    REFUSE(NULL_POINTER, carvel_scheme_passes(scheme, NULL, 3, NULL, failure));
    REFUSE(MISALIGNED, carvel_scheme_passes(OFF(carvel_scheme, scheme), out, 3, &count, failure));
    REFUSE(MISALIGNED, carvel_scheme_passes(scheme, OFF(carvel_fraction, out), 3, NULL, failure));
    REFUSE(MISALIGNED, carvel_scheme_passes(scheme, out, 3, OFF(uint64_t, &count), failure));
    REFUSE(MISALIGNED, carvel_scheme_passes(scheme, out, 3, NULL, OFF(carvel_error, failure)));
    REFUSE(NULL_POINTER, carvel_scheme_passes(scheme, NULL, 3, &count, failure));
    REFUSE(MISALIGNED, carvel_scheme_passes(scheme, OFF(carvel_fraction, out), 3, &count, failure));
    CHECK_UINT(99, count);
    REFUSE(OVERLAP, carvel_scheme_passes(scheme, out, 3, (uint64_t *)(void *)(out + 1), failure));
    CHECK(untouched(&room, 0));
    REFUSE(BUFFER_TOO_SMALL, carvel_scheme_passes(scheme, out, 2, &count, failure));
    CHECK_UINT(3, count);
    CHECK(untouched(&room, 0));
    CHECK_OK(carvel_scheme_passes(scheme, out, UINT64_MAX, NULL, failure));
    CHECK_BYTES(lowest, out, sizeof lowest);
    CHECK(untouched(&room, sizeof lowest));
    guarded_free(&room);
    carvel_scheme_destroy(scheme);
}

/* --------------------------------------------------------------------- meshes */

static versioned mesh_version(void)
{
    static const size_t ends[] = {
        offsetof(carvel_mesh_desc, face_size),     offsetof(carvel_mesh_desc, vertex_count),
        offsetof(carvel_mesh_desc, face_count),    offsetof(carvel_mesh_desc, face_sizes),
        offsetof(carvel_mesh_desc, face_offsets),  offsetof(carvel_mesh_desc, face_vertices),
        offsetof(carvel_mesh_desc, face_vertex_count),
        offsetof(carvel_mesh_desc, non_manifold),  offsetof(carvel_mesh_desc, anchored),
        offsetof(carvel_mesh_desc, corner_tags),   offsetof(carvel_mesh_desc, corner_tag_count),
        offsetof(carvel_mesh_desc, crease_vertices),
        offsetof(carvel_mesh_desc, crease_sharpness),
        offsetof(carvel_mesh_desc, crease_count),
        offsetof(carvel_mesh_desc, sharp_vertices),
        offsetof(carvel_mesh_desc, vertex_sharpness),
        offsetof(carvel_mesh_desc, sharp_vertex_count),
        offsetof(carvel_mesh_desc, holes),         offsetof(carvel_mesh_desc, hole_count)
    };
    return VERSIONED(carvel_mesh_desc, ends);
}

static void check_mesh_sizes(const fixture *with)
{
    versioned version = mesh_version();
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    uint32_t size;
    check_init(&version);
    poly_describe(with->control, &desc);
    for (size = 0; size <= sizeof desc + 9; size++) {
        carvel_mesh_desc *shorter = (carvel_mesh_desc *)truncated(&desc, sizeof desc, size);
        carvel_status status = carvel_mesh_create(NULL, shorter, &mesh, failure);
        if (!is_end(&version, size))
            CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, status);
        else if (size >= offsetof(carvel_mesh_desc, non_manifold))
            CHECK_OK(status);
        else if (size > offsetof(carvel_mesh_desc, face_count))
            /* Faces without a layout, or without their vertices. */
            CHECK(status == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE ||
                  status == CARVEL_STATUS_LENGTH_MISMATCH);
        else
            CHECK_OK(status);
        CHECK((mesh != NULL) == (status == CARVEL_STATUS_OK));
        carvel_mesh_destroy(mesh);
        free(shorter);
    }
}

static void check_mesh_pointers(const fixture *with)
{
    static const uint32_t tags[2] = { 0, 1 };
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc good, desc;
    poly_describe(with->control, &good);
    REFUSE(NULL_POINTER, carvel_mesh_create(NULL, &good, NULL, failure));
    REFUSE(MISALIGNED, carvel_mesh_create(NULL, &good, OFF(carvel_mesh *, &mesh), failure));
    REFUSE(MISALIGNED, carvel_mesh_create(NULL, &good, &mesh, OFF(carvel_error, failure)));
    MADE_NOTHING(mesh, NULL_POINTER, carvel_mesh_create(NULL, NULL, &mesh, failure));
    MADE_NOTHING(mesh, MISALIGNED,
                 carvel_mesh_create(NULL, OFF(carvel_mesh_desc, &good), &mesh, failure));
    MADE_NOTHING(mesh, MISALIGNED, carvel_mesh_create(OFF(carvel_context, with->context), &good,
                                                      &mesh, failure));
    desc = good;
    desc.face_vertices = NULL;
    MADE_NOTHING(mesh, NULL_POINTER, carvel_mesh_create(NULL, &desc, &mesh, failure));
    desc.face_vertices = OFF(const uint32_t, good.face_vertices);
    MADE_NOTHING(mesh, MISALIGNED, carvel_mesh_create(NULL, &desc, &mesh, failure));
    desc = good;
    desc.face_sizes = OFF(const uint32_t, good.face_sizes);
    MADE_NOTHING(mesh, MISALIGNED, carvel_mesh_create(NULL, &desc, &mesh, failure));
    desc.face_sizes = NULL;
    desc.face_offsets = OFF(const uint32_t, good.face_sizes);
    MADE_NOTHING(mesh, MISALIGNED, carvel_mesh_create(NULL, &desc, &mesh, failure));
    desc = good;
    desc.corner_tag_count = 2;
    MADE_NOTHING(mesh, NULL_POINTER, carvel_mesh_create(NULL, &desc, &mesh, failure));
    desc.corner_tags = OFF(const uint32_t, tags);
    MADE_NOTHING(mesh, MISALIGNED, carvel_mesh_create(NULL, &desc, &mesh, failure));
}

static int mesh_refused(carvel_mesh_desc *desc, const fixture *with, carvel_status status,
                        const char *what, int line)
{
    carvel_mesh *mesh = (carvel_mesh *)desc;
    int ok = check_status(status, carvel_mesh_create(NULL, desc, &mesh, failure), what, __FILE__,
                          line);
    CHECK(mesh == NULL);
    poly_describe(with->control, desc);
    return ok;
}

#define MESH(status, change) \
    ((change), mesh_refused(&desc, with, CARVEL_STATUS_##status, #change, __LINE__))
#define CREASES(ends, by, n) \
    (desc.crease_vertices = (ends), desc.crease_sharpness = (by), desc.crease_count = (n))
#define SHARP(list, by, n) \
    (desc.sharp_vertices = (list), desc.vertex_sharpness = (by), desc.sharp_vertex_count = (n))
#define HOLES(list, n) (desc.holes = (list), desc.hole_count = (n))

static void check_tag_pointers(const fixture *with)
{
    static const uint32_t ends[2] = { 2, 3 };
    static const float sharpness[1] = { 1 };
    carvel_mesh_desc desc;
    poly_describe(with->control, &desc);
    MESH(NULL_POINTER, CREASES(NULL, sharpness, 1));
    MESH(NULL_POINTER, CREASES(ends, NULL, 1));
    MESH(MISALIGNED, CREASES(OFF(const uint32_t, ends), sharpness, 1));
    MESH(MISALIGNED, CREASES(ends, OFF(const float, sharpness), 1));
    MESH(TOO_LARGE, CREASES(ends, sharpness, UINT32_MAX));
    MESH(TOO_LARGE, CREASES(ends, sharpness, ((uint64_t)1 << 63) + 1));
    MESH(NULL_POINTER, SHARP(NULL, sharpness, 1));
    MESH(NULL_POINTER, SHARP(ends, NULL, 1));
    MESH(MISALIGNED, SHARP(OFF(const uint32_t, ends), sharpness, 1));
    MESH(MISALIGNED, SHARP(ends, OFF(const float, sharpness), 1));
    MESH(TOO_LARGE, SHARP(ends, sharpness, UINT64_MAX));
    MESH(NULL_POINTER, HOLES(NULL, 1));
    MESH(MISALIGNED, HOLES(OFF(const uint32_t, ends), 1));
    MESH(TOO_LARGE, HOLES(ends, (uint64_t)1 << 32));
}

static void check_tag_values(const fixture *with)
{
    static const uint32_t ends[4] = { 2, 3, 3, 2 }, apart[2] = { 0, 4 }, absent[2] = { 2, 13 };
    static const uint32_t no_face[1] = { 4 };
    static const float one[1] = { 1 }, two[2] = { 1, 2 }, negative[1] = { -1 };
    float nan[1];
    carvel_mesh_desc desc;
    memset(nan, 0xff, sizeof nan);
    poly_describe(with->control, &desc);
    MESH(PARAMETER_OUT_OF_RANGE, desc.non_manifold = 3);
    MESH(PARAMETER_OUT_OF_RANGE, desc.non_manifold = -1);
    MESH(INVALID_TAG, CREASES(apart, one, 1));
    MESH(INVALID_TAG, CREASES(absent, one, 1));
    MESH(INVALID_TAG, CREASES(ends, negative, 1));
    MESH(INVALID_TAG, CREASES(ends, nan, 1));
    MESH(INVALID_TAG, CREASES(ends, two, 2));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_EDGE, 3, 2);
    MESH(INVALID_TAG, SHARP(absent, two, 2));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_VERTEX, 13, 0);
    MESH(INVALID_TAG, SHARP(ends, negative, 1));
    MESH(INVALID_TAG, SHARP(ends, nan, 1));
    MESH(INVALID_TAG, SHARP(ends + 1, two, 2));
    MESH(INVALID_TAG, HOLES(no_face, 1));
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_FACE, 4, 0);
}

typedef carvel_status (*array_function)(const carvel_mesh *, uint32_t *, uint64_t,
                                        carvel_error *);

/* One array function, and the number of entries that it writes. */
static void check_array(const carvel_mesh *mesh, array_function get, uint64_t count)
{
    uint32_t *out;
    guarded room;
    guarded_take(&room, (count + 1) * 4);
    out = (uint32_t *)(void *)room.bytes;
    REFUSE(NULL_POINTER, get(NULL, out, count, failure));
    REFUSE(NULL_POINTER, get(mesh, NULL, count, failure));
    REFUSE(MISALIGNED, get(OFF(carvel_mesh, mesh), out, count, failure));
    REFUSE(MISALIGNED, get(mesh, OFF(uint32_t, out), count, failure));
    REFUSE(MISALIGNED, get(mesh, out, count, OFF(carvel_error, failure)));
    REFUSE(BUFFER_TOO_SMALL, get(mesh, out, count - 1, failure));
    REFUSE(BUFFER_TOO_SMALL, get(mesh, out, 0, failure));
    CHECK(untouched(&room, 0));
    CHECK_OK(get(mesh, out, UINT64_MAX, failure));
    CHECK(untouched(&room, (size_t)count * 4));
    guarded_free(&room);
}

static carvel_mesh *tagged_grid(void)
{
    static const uint32_t tags[2] = { 1, 3 };
    static const uint32_t ends[4] = { 3, 4, 5, 4 };
    static const float sharpness[2] = { 1, 2 };
    poly *grid = poly_grid(2, 2);
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(grid, &desc);
    desc.corner_tags = tags;
    desc.corner_tag_count = 2;
    CREASES(ends, sharpness, 2);
    SHARP(tags, sharpness, 2);
    HOLES(tags, 2);
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    poly_free(grid);
    return mesh;
}

typedef carvel_status (*float_function)(const carvel_mesh *, float *, uint64_t, carvel_error *);

static void check_floats(const carvel_mesh *mesh, float_function get, uint64_t count)
{
    float *out;
    guarded room;
    guarded_take(&room, (count + 1) * sizeof *out);
    out = (float *)(void *)room.bytes;
    REFUSE(NULL_POINTER, get(NULL, out, count, failure));
    REFUSE(NULL_POINTER, get(mesh, NULL, count, failure));
    REFUSE(MISALIGNED, get(OFF(carvel_mesh, mesh), out, count, failure));
    REFUSE(MISALIGNED, get(mesh, OFF(float, out), count, failure));
    REFUSE(MISALIGNED, get(mesh, out, count, OFF(carvel_error, failure)));
    REFUSE(BUFFER_TOO_SMALL, get(mesh, out, count - 1, failure));
    CHECK(untouched(&room, 0));
    CHECK_OK(get(mesh, out, UINT64_MAX, failure));
    CHECK(untouched(&room, (size_t)count * sizeof *out));
    guarded_free(&room);
}

static void check_arrays(const fixture *with)
{
    const carvel_counts *counts = &with->counts;
    carvel_mesh *tagged = tagged_grid();
    check_context("arrays");
    check_array(with->mesh, carvel_mesh_face_sizes, counts->faces);
    check_array(with->mesh, carvel_mesh_face_offsets, counts->faces + 1);
    check_array(with->mesh, carvel_mesh_face_vertices, counts->corners);
    check_array(with->mesh, carvel_mesh_edges, 2 * counts->edges);
    check_array(with->mesh, carvel_mesh_corner_edges, counts->corners);
    check_array(with->mesh, carvel_mesh_corner_twins, counts->corners);
    check_array(with->mesh, carvel_mesh_valences, counts->vertices);
    check_array(with->mesh, carvel_mesh_face_sources, counts->faces);
    check_array(with->mesh, carvel_mesh_vertex_sources, counts->vertices);
    check_array(tagged, carvel_mesh_corner_tags, 2);
    check_array(tagged, carvel_mesh_crease_vertices, 4);
    check_floats(tagged, carvel_mesh_crease_sharpness, 2);
    check_array(tagged, carvel_mesh_sharp_vertices, 2);
    check_floats(tagged, carvel_mesh_vertex_sharpness, 2);
    check_array(tagged, carvel_mesh_holes, 2);
    carvel_mesh_destroy(tagged);
}

static void check_flags(const fixture *with)
{
    const carvel_mesh *mesh = with->mesh;
    uint64_t count = with->counts.vertices;
    guarded room;
    guarded_take(&room, count + 1);
    REFUSE(NULL_POINTER, carvel_mesh_boundary_flags(NULL, room.bytes, count, failure));
    REFUSE(NULL_POINTER, carvel_mesh_boundary_flags(mesh, NULL, count, failure));
    REFUSE(MISALIGNED,
           carvel_mesh_boundary_flags(OFF(carvel_mesh, mesh), room.bytes, count, failure));
    REFUSE(MISALIGNED,
           carvel_mesh_boundary_flags(mesh, room.bytes, count, OFF(carvel_error, failure)));
    REFUSE(BUFFER_TOO_SMALL, carvel_mesh_boundary_flags(mesh, room.bytes, count - 1, failure));
    CHECK(untouched(&room, 0));
    CHECK_OK(carvel_mesh_boundary_flags(mesh, room.bytes, UINT64_MAX, failure));
    CHECK(untouched(&room, (size_t)count));
    guarded_free(&room);
}

static void check_histogram(const fixture *with)
{
    const carvel_mesh *mesh = with->mesh;
    carvel_histogram_entry *out;
    uint64_t count = 99;
    guarded room;
    guarded_take(&room, 4 * sizeof *out);
    out = (carvel_histogram_entry *)(void *)room.bytes;
    REFUSE(NULL_POINTER, carvel_mesh_histogram(NULL, 1, out, 3, &count, failure));
    REFUSE(NULL_POINTER, carvel_mesh_histogram(mesh, 1, NULL, 3, NULL, failure));
    REFUSE(MISALIGNED,
           carvel_mesh_histogram(OFF(carvel_mesh, mesh), 1, out, 3, &count, failure));
    REFUSE(MISALIGNED,
           carvel_mesh_histogram(mesh, 1, OFF(carvel_histogram_entry, out), 3, NULL, failure));
    REFUSE(MISALIGNED, carvel_mesh_histogram(mesh, 1, out, 3, OFF(uint64_t, &count), failure));
    REFUSE(MISALIGNED, carvel_mesh_histogram(mesh, 1, out, 3, NULL, OFF(carvel_error, failure)));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_mesh_histogram(mesh, 0, out, 3, &count, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_mesh_histogram(mesh, 4, out, 3, &count, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_mesh_histogram(mesh, -1, out, 3, &count, failure));
    CHECK_UINT(99, count);
    REFUSE(BUFFER_TOO_SMALL, carvel_mesh_histogram(mesh, 1, out, 2, &count, failure));
    CHECK_UINT(3, count);
    CHECK(untouched(&room, 0));
    CHECK_OK(carvel_mesh_histogram(mesh, 1, out, UINT64_MAX, NULL, failure));
    CHECK(untouched(&room, 3 * sizeof *out));
    guarded_free(&room);
}

static void check_mesh_queries(const fixture *with)
{
    carvel_counts counts;
    carvel_survey survey;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_survey_init(&survey, sizeof survey));
    REFUSE(NULL_POINTER, carvel_mesh_counts(NULL, &counts, failure));
    REFUSE(MISALIGNED, carvel_mesh_counts(OFF(carvel_mesh, with->mesh), &counts, failure));
    REFUSE(MISALIGNED, carvel_mesh_counts(with->mesh, &counts, OFF(carvel_error, failure)));
    REFUSE(NULL_POINTER, carvel_mesh_survey(NULL, &survey, failure));
    REFUSE(MISALIGNED, carvel_mesh_survey(OFF(carvel_mesh, with->mesh), &survey, failure));
    REFUSE(MISALIGNED, carvel_mesh_survey(with->mesh, &survey, OFF(carvel_error, failure)));
    REFUSE(NULL_POINTER, carvel_mesh_validate(NULL, failure));
    REFUSE(MISALIGNED, carvel_mesh_validate(OFF(carvel_mesh, with->mesh), failure));
    REFUSE(MISALIGNED, carvel_mesh_validate(with->mesh, OFF(carvel_error, failure)));
    CHECK_UINT(0, carvel_mesh_is_manifold(NULL));
    CHECK_UINT(1, carvel_mesh_is_manifold(with->mesh));
    CHECK_UINT(0, counts.faces);
    CHECK_UINT(0, survey.bytes);
}

/* ---------------------------------------------------------------- predictions */

/* A scheme that has no rule for the mesh, wherever the two meet. */
static void check_unsupported(const fixture *with)
{
    carvel_scheme *loop = scheme_of(CARVEL_SCHEME_LOOP, 0);
    carvel_mesh *tagged = tagged_grid();
    carvel_hierarchy *it = NULL;
    carvel_counts counts;
    carvel_bytes bytes;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_bytes_init(&bytes, sizeof bytes));
    REFUSE(UNSUPPORTED, carvel_predict_counts(with->mesh, loop, 1, &counts, failure));
    /* The first face that is no triangle, in the caller's order. */
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_FACE, 0, 0);
    REFUSE(UNSUPPORTED, carvel_predict_bytes(with->mesh, loop, 1, 3, 4, &bytes, failure));
    MADE_NOTHING(it, UNSUPPORTED,
                 carvel_hierarchy_create(NULL, with->mesh, loop, 1, &it, failure));
    REFUSE(UNSUPPORTED, carvel_predict_counts(tagged, with->scheme, 1, &counts, failure));
    MADE_NOTHING(it, UNSUPPORTED,
                 carvel_hierarchy_create(NULL, tagged, with->scheme, 1, &it, failure));
    CHECK_UINT(0, counts.faces);
    CHECK_UINT(0, bytes.output);
    carvel_mesh_destroy(tagged);
    carvel_scheme_destroy(loop);
}

static void check_times(const carvel_mesh *mesh, const carvel_scheme *scheme)
{
    carvel_seconds it, nil;
    CHECK_OK(carvel_seconds_init(&it, sizeof it));
    nil = it;
    REFUSE(NULL_POINTER, carvel_predict_seconds(NULL, scheme, 1, 3, 4, 1, &it, failure));
    REFUSE(NULL_POINTER, carvel_predict_seconds(mesh, NULL, 1, 3, 4, 1, &it, failure));
    REFUSE(MISALIGNED,
           carvel_predict_seconds(OFF(carvel_mesh, mesh), scheme, 1, 3, 4, 1, &it, failure));
    REFUSE(MISALIGNED,
           carvel_predict_seconds(mesh, OFF(carvel_scheme, scheme), 1, 3, 4, 1, &it, failure));
    REFUSE(MISALIGNED,
           carvel_predict_seconds(mesh, scheme, 1, 3, 4, 1, &it, OFF(carvel_error, failure)));
    REFUSE(TOO_LARGE, carvel_predict_seconds(mesh, scheme, 65, 3, 4, 1, &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_seconds(mesh, scheme, 1, 0, 4, 1, &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_seconds(mesh, scheme, 1, 65537, 4, 1, &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_seconds(mesh, scheme, 1, 3, 5, 1, &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_seconds(mesh, scheme, 1, 3, 4, 0, &it, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_seconds(mesh, scheme, 1, 3, 4, 1025, &it, failure));
    CHECK_BYTES(&nil, &it, sizeof it);
    CHECK_OK(carvel_predict_seconds(mesh, scheme, 1, 65536, 8, 1024, &it, failure));
}

static void check_predictions(const fixture *with)
{
    const carvel_mesh *mesh = with->mesh;
    const carvel_scheme *scheme = with->scheme;
    carvel_counts counts, none;
    carvel_bytes bytes, nil;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_bytes_init(&bytes, sizeof bytes));
    none = counts;
    nil = bytes;
    REFUSE(NULL_POINTER, carvel_predict_counts(NULL, scheme, 1, &counts, failure));
    REFUSE(NULL_POINTER, carvel_predict_counts(mesh, NULL, 1, &counts, failure));
    REFUSE(MISALIGNED,
           carvel_predict_counts(OFF(carvel_mesh, mesh), scheme, 1, &counts, failure));
    REFUSE(MISALIGNED,
           carvel_predict_counts(mesh, OFF(carvel_scheme, scheme), 1, &counts, failure));
    REFUSE(MISALIGNED,
           carvel_predict_counts(mesh, scheme, 1, &counts, OFF(carvel_error, failure)));
    REFUSE(TOO_LARGE, carvel_predict_counts(mesh, scheme, 65, &counts, failure));
    REFUSE(TOO_LARGE, carvel_predict_counts(mesh, scheme, UINT32_MAX, &counts, failure));
    CHECK_BYTES(&none, &counts, sizeof counts);
    REFUSE(NULL_POINTER, carvel_predict_bytes(NULL, scheme, 1, 3, 4, &bytes, failure));
    REFUSE(NULL_POINTER, carvel_predict_bytes(mesh, NULL, 1, 3, 4, &bytes, failure));
    REFUSE(MISALIGNED,
           carvel_predict_bytes(OFF(carvel_mesh, mesh), scheme, 1, 3, 4, &bytes, failure));
    REFUSE(MISALIGNED,
           carvel_predict_bytes(mesh, OFF(carvel_scheme, scheme), 1, 3, 4, &bytes, failure));
    REFUSE(MISALIGNED,
           carvel_predict_bytes(mesh, scheme, 1, 3, 4, &bytes, OFF(carvel_error, failure)));
    REFUSE(TOO_LARGE, carvel_predict_bytes(mesh, scheme, 65, 3, 4, &bytes, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_predict_bytes(mesh, scheme, 1, 0, 4, &bytes, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE,
           carvel_predict_bytes(mesh, scheme, 1, 65537, 4, &bytes, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_predict_bytes(mesh, scheme, 1, 3, 0, &bytes, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_predict_bytes(mesh, scheme, 1, 3, 2, &bytes, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_predict_bytes(mesh, scheme, 1, 3, 16, &bytes, failure));
    CHECK_BYTES(&nil, &bytes, sizeof bytes);
    CHECK_OK(carvel_predict_bytes(mesh, scheme, 1, 65536, 8, &bytes, failure));
    check_times(mesh, scheme);
}

/* ---------------------------------------------------------------- hierarchies */

/* Channels have a program of their own; this is what all descriptions share. */
static void check_channel_sizes(const fixture *with)
{
    static const size_t ends[] = { offsetof(carvel_channel_desc, mode),
                                   offsetof(carvel_channel_desc, indices),
                                   offsetof(carvel_channel_desc, index_count),
                                   offsetof(carvel_channel_desc, value_count) };
    versioned version = VERSIONED(carvel_channel_desc, ends);
    carvel_channel *channel = NULL;
    carvel_channel_desc desc;
    uint32_t size;
    check_init(&version);
    CHECK_OK(carvel_channel_desc_init(&desc, sizeof desc));
    desc.indices = with->control->indices;
    desc.index_count = with->control->corners;
    desc.value_count = with->control->vertices;
    for (size = 0; size <= sizeof desc + 9; size++) {
        carvel_channel_desc *shorter =
            (carvel_channel_desc *)truncated(&desc, sizeof desc, size);
        carvel_status status = carvel_channel_create(with->mesh, shorter, &channel, failure);
        if (!is_end(&version, size))
            CHECK_STATUS(CARVEL_STATUS_STRUCT_SIZE, status);
        else if (size < sizeof desc)
            /* No indices, or no values for them. */
            CHECK(status == CARVEL_STATUS_LENGTH_MISMATCH ||
                  status == CARVEL_STATUS_INDEX_OUT_OF_RANGE);
        else
            CHECK_OK(status);
        CHECK((channel != NULL) == (status == CARVEL_STATUS_OK));
        carvel_channel_destroy(channel);
        free(shorter);
    }
}

static void check_hierarchy_create(const fixture *with)
{
    const carvel_mesh *mesh = with->mesh;
    const carvel_scheme *scheme = with->scheme;
    carvel_hierarchy *it = NULL;
    REFUSE(NULL_POINTER, carvel_hierarchy_create(NULL, mesh, scheme, 1, NULL, failure));
    REFUSE(MISALIGNED, carvel_hierarchy_create(NULL, mesh, scheme, 1, OFF(carvel_hierarchy *, &it),
                                               failure));
    REFUSE(MISALIGNED,
           carvel_hierarchy_create(NULL, mesh, scheme, 1, &it, OFF(carvel_error, failure)));
    MADE_NOTHING(it, NULL_POINTER, carvel_hierarchy_create(NULL, NULL, scheme, 1, &it, failure));
    MADE_NOTHING(it, NULL_POINTER, carvel_hierarchy_create(NULL, mesh, NULL, 1, &it, failure));
    MADE_NOTHING(it, MISALIGNED, carvel_hierarchy_create(NULL, OFF(carvel_mesh, mesh), scheme, 1,
                                                         &it, failure));
    MADE_NOTHING(it, MISALIGNED, carvel_hierarchy_create(NULL, mesh, OFF(carvel_scheme, scheme), 1,
                                                         &it, failure));
    MADE_NOTHING(it, MISALIGNED, carvel_hierarchy_create(OFF(carvel_context, with->context), mesh,
                                                         scheme, 1, &it, failure));
    MADE_NOTHING(it, TOO_LARGE, carvel_hierarchy_create(NULL, mesh, scheme, 65, &it, failure));
    MADE_NOTHING(it, TOO_LARGE,
                 carvel_hierarchy_create(NULL, mesh, scheme, UINT32_MAX, &it, failure));
}

static void check_hierarchy_queries(const fixture *with)
{
    const carvel_hierarchy *it = with->hierarchy;
    carvel_mesh *mesh = NULL;
    carvel_counts counts;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    CHECK_UINT(0, carvel_hierarchy_last_level(NULL));
    REFUSE(NULL_POINTER, carvel_hierarchy_counts(NULL, 0, &counts, failure));
    REFUSE(MISALIGNED, carvel_hierarchy_counts(OFF(carvel_hierarchy, it), 0, &counts, failure));
    REFUSE(MISALIGNED, carvel_hierarchy_counts(it, 0, &counts, OFF(carvel_error, failure)));
    REFUSE(PARAMETER_OUT_OF_RANGE, carvel_hierarchy_counts(it, 2, &counts, failure));
    CHECK_UINT(0, counts.faces);
    REFUSE(NULL_POINTER, carvel_hierarchy_mesh(it, 0, NULL, failure));
    REFUSE(MISALIGNED, carvel_hierarchy_mesh(it, 0, OFF(carvel_mesh *, &mesh), failure));
    REFUSE(MISALIGNED, carvel_hierarchy_mesh(it, 0, &mesh, OFF(carvel_error, failure)));
    MADE_NOTHING(mesh, NULL_POINTER, carvel_hierarchy_mesh(NULL, 0, &mesh, failure));
    MADE_NOTHING(mesh, MISALIGNED,
                 carvel_hierarchy_mesh(OFF(carvel_hierarchy, it), 0, &mesh, failure));
    MADE_NOTHING(mesh, PARAMETER_OUT_OF_RANGE, carvel_hierarchy_mesh(it, 2, &mesh, failure));
    MADE_NOTHING(mesh, PARAMETER_OUT_OF_RANGE,
                 carvel_hierarchy_mesh(it, UINT32_MAX, &mesh, failure));
}

typedef carvel_status (*origin_function)(const carvel_hierarchy *, uint32_t, carvel_origin *,
                                         uint64_t, carvel_error *);

static void check_origins(const carvel_hierarchy *it, origin_function get, uint64_t count)
{
    carvel_origin *out;
    guarded room;
    guarded_take(&room, (count + 1) * sizeof *out);
    out = (carvel_origin *)(void *)room.bytes;
    REFUSE(NULL_POINTER, get(NULL, 1, out, count, failure));
    REFUSE(NULL_POINTER, get(it, 1, NULL, count, failure));
    REFUSE(MISALIGNED, get(OFF(carvel_hierarchy, it), 1, out, count, failure));
    REFUSE(MISALIGNED, get(it, 1, OFF(carvel_origin, out), count, failure));
    REFUSE(MISALIGNED, get(it, 1, out, count, OFF(carvel_error, failure)));
    REFUSE(BUFFER_TOO_SMALL, get(it, 1, out, count - 1, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, get(it, 0, out, count, failure));
    REFUSE(PARAMETER_OUT_OF_RANGE, get(it, 2, out, count, failure));
    CHECK(untouched(&room, 0));
    CHECK_OK(get(it, 1, out, UINT64_MAX, failure));
    CHECK(untouched(&room, (size_t)count * sizeof *out));
    guarded_free(&room);
}

/* A matrix with room for it. */
typedef struct matrix {
    const carvel_hierarchy *hierarchy;
    uint32_t level, stage;
    uint64_t *offsets, rows, entries, capacity, *count, counted;
    uint32_t *indices;
    double *weights;
    guarded offset_room, index_room, weight_room;
} matrix;

static void matrix_describe(matrix *it, const fixture *with)
{
    it->hierarchy = with->hierarchy;
    it->level = 1;
    it->stage = 0;
    it->rows = predicted(with->mesh, with->scheme, 1).vertices + 1;
    it->offsets = (uint64_t *)(void *)it->offset_room.bytes;
    it->indices = (uint32_t *)(void *)it->index_room.bytes;
    it->weights = (double *)(void *)it->weight_room.bytes;
    it->capacity = it->entries;
    it->count = &it->counted;
    it->counted = 99;
}

static carvel_status matrix_run(const matrix *it)
{
    return carvel_hierarchy_rows(it->hierarchy, it->level, it->stage, it->offsets, it->rows,
                                 it->indices, it->weights, it->capacity, it->count, failure);
}

static int matrix_refused(matrix *it, const fixture *with, carvel_status status,
                          const char *what, int line)
{
    int ok = check_status(status, matrix_run(it), what, __FILE__, line);
    CHECK(untouched(&it->offset_room, 0));
    CHECK(untouched(&it->index_room, 0));
    CHECK(untouched(&it->weight_room, 0));
    matrix_describe(it, with);
    return ok;
}

#define MATRIX(status, change) \
    ((change), matrix_refused(&it, with, CARVEL_STATUS_##status, #change, __LINE__))

static void check_rows(const fixture *with)
{
    uint64_t rows = predicted(with->mesh, with->scheme, 1).vertices + 1;
    matrix it;
    guarded_take(&it.offset_room, (rows + 1) * 8);
    CHECK_OK(carvel_hierarchy_rows(with->hierarchy, 1, 0,
                                   (uint64_t *)(void *)it.offset_room.bytes, rows, NULL, NULL, 0,
                                   &it.entries, failure));
    CHECK(untouched(&it.offset_room, (size_t)rows * 8));
    guarded_reset(&it.offset_room);
    guarded_take(&it.index_room, (it.entries + 1) * 4);
    guarded_take(&it.weight_room, (it.entries + 1) * 8);
    matrix_describe(&it, with);
    MATRIX(NULL_POINTER, it.hierarchy = NULL);
    MATRIX(NULL_POINTER, it.offsets = NULL);
    MATRIX(NULL_POINTER, it.indices = NULL);
    MATRIX(NULL_POINTER, it.weights = NULL);
    MATRIX(MISALIGNED, it.hierarchy = OFF(carvel_hierarchy, it.hierarchy));
    MATRIX(MISALIGNED, it.offsets = OFF(uint64_t, it.offsets));
    MATRIX(MISALIGNED, it.indices = OFF(uint32_t, it.indices));
    MATRIX(MISALIGNED, it.weights = OFF(double, it.weights));
    MATRIX(MISALIGNED, it.count = OFF(uint64_t, it.count));
    MATRIX(BUFFER_TOO_SMALL, it.rows--);
    MATRIX(BUFFER_TOO_SMALL, it.rows = 0);
    MATRIX(BUFFER_TOO_SMALL, it.capacity--);
    MATRIX(BUFFER_TOO_SMALL, it.capacity = 1);
    MATRIX(PARAMETER_OUT_OF_RANGE, it.level = 0);
    MATRIX(PARAMETER_OUT_OF_RANGE, it.level = 2);
    MATRIX(PARAMETER_OUT_OF_RANGE, it.stage = 2);
    MATRIX(PARAMETER_OUT_OF_RANGE, it.stage = UINT32_MAX);
    MATRIX(OVERLAP, it.indices = (uint32_t *)(void *)it.offsets);
    MATRIX(OVERLAP, it.weights = (double *)(void *)(it.offsets + it.rows - 1));
    MATRIX(OVERLAP, it.indices = (uint32_t *)(void *)(it.weights + it.entries) - 1);
    it.rows = it.capacity = UINT64_MAX;
    CHECK_OK(matrix_run(&it));
    CHECK_UINT(it.entries, it.counted);
    CHECK(untouched(&it.offset_room, (size_t)rows * 8));
    CHECK(untouched(&it.index_room, (size_t)it.entries * 4));
    CHECK(untouched(&it.weight_room, (size_t)it.entries * 8));
    guarded_free(&it.offset_room);
    guarded_free(&it.index_room);
    guarded_free(&it.weight_room);
}

/* ------------------------------------------------------- errors and refiners */

static void check_errors(void)
{
    carvel_error *error = NULL;
    int32_t status;
    REFUSE(NULL_POINTER, carvel_error_create(NULL));
    REFUSE(MISALIGNED, carvel_error_create(OFF(carvel_error *, &error)));
    CHECK(error == NULL);
    CHECK(carvel_error_status(NULL) == CARVEL_STATUS_OK);
    CHECK(strcmp(carvel_error_message(NULL), "") == 0);
    CHECK_UINT(0, carvel_error_entry_count(NULL));
    CHECK(carvel_error_entry_status(NULL, 0) == CARVEL_STATUS_OK);
    CHECK(strcmp(carvel_error_entry_message(NULL, 0), "") == 0);
    CHECK_UINT(0, carvel_error_element_count(NULL, 0));
    CHECK_UINT(0, carvel_error_element(NULL, 0, 0).kind);
    carvel_error_destroy(NULL);
    /* Every status has words of its own, every other number the same. */
    for (status = 0; status <= 109; status++)
        if (status <= CARVEL_STATUS_BROKEN_INVARIANT || status > 100)
            CHECK(strcmp(carvel_status_string(status), carvel_status_string(-1)) != 0);
    CHECK(strcmp(carvel_status_string(-1), "unknown status") == 0);
    CHECK(strcmp(carvel_status_string(22), "unknown status") == 0);
    CHECK(strcmp(carvel_status_string(110), "unknown status") == 0);
    CHECK(strcmp(carvel_status_string(INT32_MIN), "unknown status") == 0);
}

static void check_refiners(const fixture *with)
{
    carvel_refiner *refiner = NULL;
    REFUSE(NULL_POINTER, carvel_refiner_create(NULL, failure));
    REFUSE(MISALIGNED, carvel_refiner_create(OFF(carvel_refiner *, &refiner), failure));
    REFUSE(MISALIGNED, carvel_refiner_create(&refiner, OFF(carvel_error, failure)));
    CHECK_UINT(0, carvel_refiner_bytes(NULL));
    carvel_refiner_destroy(NULL);
    carvel_hierarchy_destroy(NULL);
    carvel_mesh_destroy(NULL);
    carvel_scheme_destroy(NULL);
    check_context("floats");
    check_refining_f32(with);
    check_context("doubles");
    check_refining_f64(with);
    CHECK(carvel_refiner_bytes(with->refiner) > 0);
}

int main(void)
{
    fixture it;
    check_begin();
    fixture_take(&it);
    check_queries(&it);
    check_contexts();
    check_scheme_sizes();
    check_context("schemes");
    check_scheme_pointers();
    check_scheme_values();
    check_primal_values();
    check_holes(&it);
    check_passes();
    check_mesh_sizes(&it);
    check_context("meshes");
    check_mesh_pointers(&it);
    check_tag_pointers(&it);
    check_tag_values(&it);
    check_arrays(&it);
    check_flags(&it);
    check_histogram(&it);
    check_mesh_queries(&it);
    check_context("channels");
    check_channel_sizes(&it);
    check_context("predictions");
    check_predictions(&it);
    check_unsupported(&it);
    check_context("hierarchies");
    check_hierarchy_create(&it);
    check_hierarchy_queries(&it);
    check_origins(it.hierarchy, carvel_hierarchy_vertex_origins,
                  predicted(it.mesh, it.scheme, 1).vertices);
    check_origins(it.hierarchy, carvel_hierarchy_face_origins,
                  predicted(it.mesh, it.scheme, 1).faces);
    check_rows(&it);
    check_context("errors");
    check_errors();
    check_refiners(&it);
    fixture_free(&it);
    return check_end();
}
