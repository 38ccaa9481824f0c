/* Values at the corners of faces: seams, modes, and every call done wrongly. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CANARY = 0xa5 };

/* A pointer of a type, moved to where no such thing can be. */
#define OFF(type, pointer) ((type *)(void *)((char *)(uintptr_t)(pointer) + 1))

static int all_bytes_are(const unsigned char *bytes, size_t size)
{
    size_t i = 0;
    while (i < size && bytes[i] == CANARY)
        i++;
    return i == size;
}

static carvel_channel_desc describe(const uint32_t *indices, uint64_t index_count,
                                    uint64_t value_count, int32_t mode)
{
    carvel_channel_desc desc;
    CHECK_OK(carvel_channel_desc_init(&desc, sizeof desc));
    desc.mode = mode;
    desc.indices = indices;
    desc.index_count = index_count;
    desc.value_count = value_count;
    return desc;
}

static carvel_channel *channel_of(const carvel_mesh *mesh, const uint32_t *indices,
                                  uint64_t index_count, uint64_t value_count, int32_t mode)
{
    carvel_channel *channel = NULL;
    carvel_channel_desc desc = describe(indices, index_count, value_count, mode);
    CHECK_OK(carvel_channel_create(mesh, &desc, &channel, failure));
    return channel;
}

#define REAL float
#define TWIN(name) name##_f32
#define INIT(name) name##_f32_init
#define PAIR(name) name##32
#define LEVEL(verb) level32_##verb
#include "channel_twin.h"
#undef REAL
#undef TWIN
#undef INIT
#undef PAIR
#undef LEVEL

#define REAL double
#define TWIN(name) name##_f64
#define INIT(name) name##_f64_init
#define PAIR(name) name##64
#define LEVEL(verb) level64_##verb
#include "channel_twin.h"

/* -------------------------------------------------------------------- modes */

/* In which modes a value in the middle of four faces stays, CORNERS first. */
static void check_staying(const uint32_t *islands, uint32_t corner, const int *expected)
{
    int32_t mode;
    for (mode = 0; mode < 6; mode++) {
        CHECK_UINT(expected[mode], stays_f64(islands, corner, mode));
        CHECK_UINT(expected[mode], stays_f32(islands, corner, mode));
    }
}

/* The modes in order: CORNERS, SMOOTH, PLUS1, PLUS2, BOUNDARIES, ALL. The middle is
 * corner 2 of the first face and 12 of the last. */
static void check_modes(void)
{
    static const uint32_t whole[4] = { 0, 0, 0, 0 }, halves[4] = { 0, 0, 1, 1 };
    static const uint32_t three[4] = { 0, 1, 2, 2 }, nook[4] = { 0, 1, 1, 1 };
    static const int smooth[6] = { 0, 0, 0, 0, 0, 1 }, along[6] = { 0, 0, 0, 0, 1, 1 };
    static const int met[6] = { 0, 0, 1, 1, 1, 1 }, beside[6] = { 0, 0, 0, 1, 1, 1 };
    static const int single[6] = { 1, 0, 1, 1, 1, 1 };
    check_context("modes");
    check_staying(whole, 12, smooth);
    check_staying(halves, 12, along);
    check_staying(three, 12, met);
    check_staying(nook, 12, beside);
    check_staying(nook, 2, single);
}

/* A lone quad's values by hand: rounded off, or left. SMOOTH does no more than the
 * scheme does to vertices, which keeps corners unless the boundary rule is EDGE. */
static void check_quad(int32_t mode, int32_t boundary, int is_round)
{
    static const uint32_t own[4] = { 0, 1, 2, 3 };
    static const double unit[8] = { 0, 0, 1, 0, 1, 1, 0, 1 };
    static const double round[8] = { 0.125, 0.125, 0.875, 0.125, 0.875, 0.875, 0.125, 0.875 };
    poly *quad = poly_grid(1, 1);
    carvel_mesh *mesh = poly_mesh(quad);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, boundary);
    carvel_channel *channel = channel_of(mesh, own, 4, 4, mode);
    const double *expected = is_round ? round : unit;
    job_f64 it;
    job_take_f64(&it, quad, mesh, scheme, channel, 4, 1);
    memcpy(it.values, unit, sizeof unit);
    CHECK_UINT(9, it.value_count);
    CHECK_OK(run_f64(&it));
    CHECK_BYTES(expected, it.refined + 2 * it.indices[0], 2 * sizeof(double));
    CHECK_BYTES(expected + 4, it.refined + 2 * it.indices[8], 2 * sizeof(double));
    check_behind_f64(&it);
    job_free_f64(&it);
    carvel_channel_destroy(channel);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(quad);
}

/* ------------------------------------------------------------------- misuse */

static int refused(const carvel_mesh *mesh, carvel_channel_desc *desc, carvel_status status,
                   const char *what, int line)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    carvel_channel *channel = (carvel_channel *)desc;
    int ok = check_status(status, carvel_channel_create(mesh, desc, &channel, failure), what,
                          __FILE__, line);
    CHECK(channel == NULL);
    *desc = describe(own, 8, 8, 0);
    return ok;
}

#define CHANNEL(status, change) \
    ((change), refused(mesh, &desc, CARVEL_STATUS_##status, #change, __LINE__))

static void check_create(const carvel_mesh *mesh)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 }, absent[8] = { 0, 1, 2, 3, 0, 8 };
    carvel_channel *channel = (carvel_channel *)(uintptr_t)64;
    carvel_channel_desc desc = describe(own, 8, 8, 0);
    check_context("create");
    CHANNEL(PARAMETER_OUT_OF_RANGE, desc.mode = 6);
    CHANNEL(PARAMETER_OUT_OF_RANGE, desc.mode = -1);
    CHANNEL(NULL_POINTER, desc.indices = NULL);
    CHANNEL(MISALIGNED, desc.indices = OFF(const uint32_t, own));
    CHANNEL(LENGTH_MISMATCH, desc.index_count = 7);
    CHANNEL(LENGTH_MISMATCH, desc.index_count = 0);
    CHANNEL(TOO_LARGE, desc.index_count = UINT64_MAX);
    CHANNEL(INDEX_OUT_OF_RANGE, desc.value_count = 7);
    CHANNEL(INDEX_OUT_OF_RANGE, desc.value_count = 0);
    CHANNEL(INDEX_OUT_OF_RANGE, desc.indices = absent);
    CHECK_ELEMENT(0, 0, CARVEL_ELEMENT_FACE, 1, 0);
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_channel_create(mesh, &desc, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_channel_create(mesh, &desc, OFF(carvel_channel *, &channel), failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_channel_create(mesh, &desc, &channel, OFF(carvel_error, failure)));
    CHECK(channel == (carvel_channel *)(uintptr_t)64);
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_channel_create(NULL, &desc, &channel, failure));
    CHECK(channel == NULL);
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_channel_create(mesh, NULL, &channel, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_channel_create(OFF(carvel_mesh, mesh), &desc, &channel, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_channel_create(mesh, OFF(carvel_channel_desc, &desc), &channel, failure));
    carvel_channel_destroy(NULL);
    CHECK_UINT(0, carvel_channel_seam_edges(NULL));
}

/* A count that 32 bits cannot name is told at a refinement, not before. */
static void check_absurd_count(const poly *strip, const carvel_mesh *mesh)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_channel *channel = channel_of(mesh, own, 8, (uint64_t)1 << 40, 0);
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(mesh, scheme, 1, strip->positions);
    carvel_refine_output_f64 output;
    carvel_channel_input_f64 in;
    check_context("absurd count");
    CHECK_OK(carvel_refine_output_f64_init(&output, sizeof output));
    memset(&in, 0, sizeof in);
    in.channel = channel;
    in.values.count = (uint64_t)1 << 40;
    in.values.width = 2;
    input.channels = &in;
    input.channel_count = 1;
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_refiner_refine_f64(refiner, NULL, &input, &output, failure));
    carvel_refiner_destroy(refiner);
    carvel_channel_destroy(channel);
    carvel_scheme_destroy(scheme);
}

static void check_predictions(const carvel_mesh *mesh)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    carvel_channel *it = channel_of(mesh, own, 8, 9, 0);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_CATMULL_CLARK, 0);
    carvel_scheme *dual = scheme_of(CARVEL_SCHEME_DOO_SABIN, 0);
    uint64_t count = 99;
    check_context("predictions");
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER,
                 carvel_predict_channel(NULL, scheme, 1, &count, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_predict_channel(it, NULL, 1, &count, failure));
    CHECK_STATUS(CARVEL_STATUS_NULL_POINTER, carvel_predict_channel(it, scheme, 1, NULL, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_predict_channel(OFF(carvel_channel, it), scheme, 1, &count, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_predict_channel(it, OFF(carvel_scheme, scheme), 1, &count, failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_predict_channel(it, scheme, 1, OFF(uint64_t, &count), failure));
    CHECK_STATUS(CARVEL_STATUS_MISALIGNED,
                 carvel_predict_channel(it, scheme, 1, &count, OFF(carvel_error, failure)));
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_predict_channel(it, scheme, 65, &count, failure));
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED, carvel_predict_channel(it, dual, 1, &count, failure));
    CHECK_UINT(99, count);
    CHECK_OK(carvel_predict_channel(it, dual, 0, &count, failure));
    CHECK_UINT(9, count);
    CHECK_OK(carvel_predict_channel(it, scheme, 1, &count, failure));
    /* Two lone quads; the value that nobody takes is gone. */
    CHECK_UINT(2 * 9, count);
    CHECK_OK(carvel_predict_channel(it, scheme, 2, &count, failure));
    CHECK_UINT(2 * 25, count);
    carvel_channel_destroy(it);
    carvel_scheme_destroy(scheme);
    carvel_scheme_destroy(dual);
}

/* A channel keeps what it needs of its mesh. */
static void check_lives_on(const poly *strip)
{
    static const uint32_t own[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    carvel_mesh *mesh = poly_mesh(strip);
    carvel_channel *channel = channel_of(mesh, own, 8, 8, 0);
    carvel_mesh_destroy(mesh);
    CHECK_UINT(1, carvel_channel_seam_edges(channel));
    carvel_channel_destroy(channel);
}

int main(void)
{
    poly *strip = poly_grid(1, 2);
    carvel_mesh *mesh;
    check_begin();
    mesh = poly_mesh(strip);
    check_create(mesh);
    check_absurd_count(strip, mesh);
    check_predictions(mesh);
    check_lives_on(strip);
    check_f32();
    check_f64();
    check_modes();
    check_context("quad");
    check_quad(CARVEL_FACE_VARYING_SMOOTH, CARVEL_BOUNDARY_EDGE, 1);
    check_quad(CARVEL_FACE_VARYING_SMOOTH, CARVEL_BOUNDARY_EDGE_AND_CORNER, 0);
    check_quad(CARVEL_FACE_VARYING_CORNERS, CARVEL_BOUNDARY_EDGE, 0);
    carvel_mesh_destroy(mesh);
    poly_free(strip);
    return check_end();
}
