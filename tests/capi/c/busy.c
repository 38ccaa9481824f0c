/* A refiner at work answers BUSY to whoever calls it, every time: the progress
 * callback of a call, which runs in the middle of it, uses the same refiner from
 * its own thread and from another one while it waits. */
#include "fixture.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 2, FILL = 0x5a };

/* A refiner, what its call works on, and what callbacks find. */
typedef struct setup {
    poly *control;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_refiner *refiner;
    carvel_refine_input_f64 input;
    carvel_refine_input_f32 input32;
    level64 expected, level;
    /* Places of their own for the calls that must not come to write. */
    level64 other;
    level32 other32;
    float *positions32;
    /* Calls of the callback so far, and what it answers after the first. */
    unsigned long calls;
    /* Bytes of the refiner before its call. */
    uint64_t held;
    int32_t answer;
} setup;

static uint64_t bytes_of_positions(const setup *it)
{
    return it->expected.counts.vertices * 3 * sizeof(double);
}

static void fill(setup *it)
{
    memset(it->other.output.positions.data, FILL, (size_t)bytes_of_positions(it));
    memset(it->other.output.face_vertices.data, FILL,
           (size_t)it->expected.counts.corners * sizeof(uint32_t));
    it->other.output.anchored = -1;
}

static int is_filled(const void *memory, uint64_t size)
{
    const unsigned char *bytes = (const unsigned char *)memory;
    uint64_t i;
    for (i = 0; i < size; i++)
        if (bytes[i] != FILL)
            return 0;
    return 1;
}

/* Every call that uses the refiner, with an error object of the calling thread's
 * own: `failure` belongs to the call that is running. */
static void check_busy(setup *it)
{
    carvel_error *error = NULL;
    CHECK_OK(carvel_error_create(&error));
    fill(it);
    CHECK_STATUS(CARVEL_STATUS_BUSY,
                 carvel_refiner_refine_f64(it->refiner, NULL, &it->input, &it->other.output,
                                           error));
    CHECK_UINT(CARVEL_STATUS_BUSY, carvel_error_status(error));
    CHECK(strlen(carvel_error_message(error)) > 0);
    CHECK_UINT(1, carvel_error_entry_count(error));
    CHECK(is_filled(it->other.output.positions.data, bytes_of_positions(it)));
    CHECK(is_filled(it->other.output.face_vertices.data,
                    it->expected.counts.corners * sizeof(uint32_t)));
    CHECK(it->other.output.anchored == -1);
    /* The other number type uses the same refiner. */
    CHECK_STATUS(CARVEL_STATUS_BUSY,
                 carvel_refiner_refine_f32(it->refiner, NULL, &it->input32, &it->other32.output,
                                           error));
    CHECK_STATUS(CARVEL_STATUS_BUSY,
                 carvel_refiner_refine_f64(it->refiner, NULL, &it->input, &it->other.output,
                                           NULL));
    /* What only looks need not wait: as the call before left it. */
    CHECK_UINT(it->held, carvel_refiner_bytes(it->refiner));
    carvel_error_destroy(error);
}

static void *call_from_elsewhere(void *user_data)
{
    check_busy((setup *)user_data);
    return NULL;
}

/* In the middle of a call. */
static int32_t intrude(double done, void *user_data)
{
    setup *it = (setup *)user_data;
    pthread_t thread;
    (void)done;
    it->calls++;
    if (it->calls > 1)
        return it->answer;
    check_busy(it);
    /* While this thread waits, so that checks are counted by one at a time. */
    if (CHECK(pthread_create(&thread, NULL, call_from_elsewhere, it) == 0))
        CHECK(pthread_join(thread, NULL) == 0);
    return 0;
}

static carvel_context *intruded(setup *it, uint32_t threads)
{
    carvel_context *context = NULL;
    carvel_context_desc desc;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = threads;
    desc.progress = intrude;
    desc.user_data = it;
    CHECK_OK(carvel_context_create(&desc, &context, failure));
    return context;
}

static void setup_take(setup *it)
{
    memset(it, 0, sizeof *it);
    it->control = poly_grid(9, 7);
    it->mesh = poly_mesh(it->control);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    it->refiner = refiner_of();
    it->input = input64(it->mesh, it->scheme, LEVELS, it->control->positions);
    it->positions32 = poly_floats(it->control);
    it->input32 = input32(it->mesh, it->scheme, LEVELS, it->positions32);
    level64_refine(&it->expected, NULL, it->mesh, it->scheme, LEVELS, it->control->positions);
    level64_take(&it->level, &it->expected.counts);
    level64_take(&it->other, &it->expected.counts);
    level32_take(&it->other32, &it->expected.counts);
}

static void setup_free(setup *it)
{
    level32_free(&it->other32);
    level64_free(&it->other);
    level64_free(&it->level);
    level64_free(&it->expected);
    free(it->positions32);
    carvel_refiner_destroy(it->refiner);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->control);
}

/* A call whose callback intrudes; its callback answers `answer` the second time. */
static carvel_status refine(setup *it, const carvel_context *context, int32_t answer)
{
    it->calls = 0;
    it->answer = answer;
    it->held = carvel_refiner_bytes(it->refiner);
    memset(it->level.output.positions.data, FILL, (size_t)bytes_of_positions(it));
    return carvel_refiner_refine_f64(it->refiner, context, &it->input, &it->level.output,
                                     failure);
}

static void check_result(const setup *it)
{
    CHECK_BYTES(it->expected.output.positions.data, it->level.output.positions.data,
                (size_t)bytes_of_positions(it));
    CHECK_BYTES(it->expected.output.face_vertices.data, it->level.output.face_vertices.data,
                (size_t)it->expected.counts.corners * sizeof(uint32_t));
    CHECK(carvel_refiner_bytes(it->refiner) > 0);
}

static void check_intruded(uint32_t threads)
{
    setup it;
    carvel_context *context;
    setup_take(&it);
    context = intruded(&it, threads);
    /* Those that were turned away change nothing for the one at work. */
    CHECK_OK(refine(&it, context, 0));
    CHECK(it.calls > 1);
    check_result(&it);
    /* Afterwards it works again, */
    CHECK_OK(refine(&it, NULL, 0));
    check_result(&it);
    /* and after a call that was stopped. */
    CHECK_STATUS(CARVEL_STATUS_CANCELLED, refine(&it, context, 1));
    CHECK_UINT(2, it.calls);
    CHECK_OK(refine(&it, NULL, 0));
    check_result(&it);
    carvel_context_destroy(context);
    setup_free(&it);
}

int main(void)
{
    check_begin();
    check_context("a serial context");
    check_intruded(1);
    check_context("a context of two threads");
    check_intruded(2);
    return check_end();
}
