/* Threads, memory ceiling, progress and cancellation. Argument 1: quads along a
 * side of the torus for the comparison of threads. */
#include "fixture.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* What a callback saw, and when it is to stop. */
typedef struct watch {
    pthread_t thread;
    unsigned long calls;
    /* Answers stop at this call; 0 for never. */
    unsigned long stop_at;
    double last;
    int rising, elsewhere, in_range;
} watch;

static int32_t see(double done, void *user_data)
{
    watch *it = (watch *)user_data;
    it->elsewhere |= !pthread_equal(it->thread, pthread_self());
    it->rising &= done >= it->last;
    it->in_range &= done >= 0.0 && done <= 1.0;
    it->last = done;
    it->calls++;
    return it->calls == it->stop_at ? 7 : 0;
}

static void watch_begin(watch *it, unsigned long stop_at)
{
    memset(it, 0, sizeof *it);
    it->thread = pthread_self();
    it->stop_at = stop_at;
    it->rising = it->in_range = 1;
}

static carvel_context *watched(watch *it, uint32_t threads)
{
    carvel_context *context = NULL;
    carvel_context_desc desc;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = threads;
    desc.progress = see;
    desc.user_data = it;
    CHECK_OK(carvel_context_create(&desc, &context, failure));
    return context;
}

/* What is refined in most checks. */
typedef struct setup {
    poly *control;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_refiner *refiner;
    carvel_refine_input_f64 input;
    level64 level;
} setup;

static void setup_take(setup *it, poly *control, uint32_t levels)
{
    carvel_counts counts;
    it->control = control;
    it->mesh = poly_mesh(control);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    it->refiner = refiner_of();
    it->input = input64(it->mesh, it->scheme, levels, control->positions);
    counts = predicted(it->mesh, it->scheme, levels);
    level64_take(&it->level, &counts);
}

static void setup_free(setup *it)
{
    level64_free(&it->level);
    carvel_refiner_destroy(it->refiner);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->control);
}

static carvel_status refine(setup *it, const carvel_context *context)
{
    return carvel_refiner_refine_f64(it->refiner, context, &it->input, &it->level.output,
                                     failure);
}

static carvel_status build(const setup *it, const carvel_context *context,
                           carvel_hierarchy **hierarchy)
{
    *hierarchy = (carvel_hierarchy *)it->mesh;
    return carvel_hierarchy_create(context, it->mesh, it->scheme, it->input.levels, hierarchy,
                                   failure);
}

/* ------------------------------------------------------------------- progress */

static void check_watch(const watch *it)
{
    CHECK(it->calls > 1);
    CHECK(it->rising);
    CHECK(it->in_range);
    CHECK(!it->elsewhere);
    CHECK(it->last >= 1.0);
}

static void check_progress(uint32_t threads)
{
    setup it;
    watch seen;
    carvel_context *context;
    carvel_hierarchy *hierarchy;
    setup_take(&it, poly_grid(5, 4), 3);
    watch_begin(&seen, 0);
    context = watched(&seen, threads);
    CHECK_OK(refine(&it, context));
    check_watch(&seen);
    watch_begin(&seen, 0);
    CHECK_OK(build(&it, context, &hierarchy));
    check_watch(&seen);
    carvel_hierarchy_destroy(hierarchy);
    carvel_context_destroy(context);
    setup_free(&it);
}

/* ----------------------------------------------------------------- cancelling */

/* Stopped at any report, everything is as good as new. */
static void check_callback_stops(uint32_t threads)
{
    setup it;
    watch seen;
    unsigned long stop, reports;
    carvel_context *context;
    carvel_hierarchy *hierarchy;
    setup_take(&it, poly_grid(5, 4), 3);
    watch_begin(&seen, 0);
    context = watched(&seen, threads);
    CHECK_OK(refine(&it, context));
    reports = seen.calls < 4 ? seen.calls : 4;
    for (stop = 1; stop <= reports; stop++) {
        watch_begin(&seen, stop);
        CHECK_STATUS(CARVEL_STATUS_CANCELLED, refine(&it, context));
        CHECK_UINT(stop, seen.calls);
        watch_begin(&seen, 1);
        CHECK_STATUS(CARVEL_STATUS_CANCELLED, build(&it, context, &hierarchy));
        CHECK(hierarchy == NULL);
        /* A callback's answer is for its call; the flag was not set. */
        CHECK_UINT(0, carvel_context_is_cancelled(context));
        watch_begin(&seen, 0);
        CHECK_OK(refine(&it, context));
    }
    carvel_context_destroy(context);
    setup_free(&it);
}

/* Every call that takes a context notices. */
static void check_all_cancelled(setup *it, const carvel_context *context)
{
    carvel_hierarchy *whole = hierarchy_of(it->mesh, it->scheme, 1), *hierarchy;
    poly *nothing = poly_grid(1, 1);
    carvel_mesh_desc desc;
    carvel_mesh *mesh;
    carvel_const_values_f64 in;
    carvel_values_f64 out;
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    in = it->input.positions;
    out = it->level.output.positions;
    CHECK_STATUS(CARVEL_STATUS_CANCELLED, refine(it, context));
    CHECK_STATUS(CARVEL_STATUS_CANCELLED, build(it, context, &hierarchy));
    CHECK(hierarchy == NULL);
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_hierarchy_create(context, it->mesh, it->scheme, 0, &hierarchy, failure));
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_hierarchy_refine_f64(whole, context, 1, &in, &out, failure));
    CHECK_STATUS(CARVEL_STATUS_CANCELLED,
                 carvel_hierarchy_refine_f64(whole, context, 0, &in, &out, failure));
    poly_describe(nothing, &desc);
    CHECK_STATUS(CARVEL_STATUS_CANCELLED, carvel_mesh_create(context, &desc, &mesh, failure));
    CHECK(mesh == NULL);
    poly_free(nothing);
    carvel_hierarchy_destroy(whole);
}

static void check_flag(uint32_t threads)
{
    setup it;
    carvel_context *context = context_of(threads);
    setup_take(&it, poly_grid(5, 4), 3);
    CHECK_UINT(0, carvel_context_is_cancelled(context));
    carvel_context_cancel(context);
    CHECK_UINT(1, carvel_context_is_cancelled(context));
    check_all_cancelled(&it, context);
    /* Until it is taken back. */
    check_all_cancelled(&it, context);
    carvel_context_reset(context);
    CHECK_UINT(0, carvel_context_is_cancelled(context));
    CHECK_OK(refine(&it, context));
    carvel_context_destroy(context);
    setup_free(&it);
    /* NULL is ignored. */
    carvel_context_cancel(NULL);
    carvel_context_reset(NULL);
    CHECK_UINT(0, carvel_context_is_cancelled(NULL));
}

/* One thread works, another asks for a stop once work has begun. */
typedef struct stop {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int begun;
    carvel_context *context;
} stop;

static void *stop_once_begun(void *argument)
{
    stop *it = (stop *)argument;
    pthread_mutex_lock(&it->lock);
    while (!it->begun)
        pthread_cond_wait(&it->changed, &it->lock);
    pthread_mutex_unlock(&it->lock);
    carvel_context_cancel(it->context);
    return NULL;
}

static void begin(stop *it)
{
    pthread_mutex_lock(&it->lock);
    it->begun = 1;
    pthread_cond_signal(&it->changed);
    pthread_mutex_unlock(&it->lock);
}

static void check_stopped_from_elsewhere(uint32_t threads)
{
    setup it;
    stop other;
    pthread_t thread;
    carvel_status status;
    setup_take(&it, poly_grid(5, 4), 3);
    pthread_mutex_init(&other.lock, NULL);
    pthread_cond_init(&other.changed, NULL);
    other.begun = 0;
    other.context = context_of(threads);
    CHECK(pthread_create(&thread, NULL, stop_once_begun, &other) == 0);
    do {
        status = refine(&it, other.context);
        begin(&other);
    } while (status == CARVEL_STATUS_OK);
    CHECK_STATUS(CARVEL_STATUS_CANCELLED, status);
    pthread_join(thread, NULL);
    carvel_context_reset(other.context);
    CHECK_OK(refine(&it, other.context));
    carvel_context_destroy(other.context);
    pthread_cond_destroy(&other.changed);
    pthread_mutex_destroy(&other.lock);
    setup_free(&it);
}

/* -------------------------------------------------------------------- ceiling */

static carvel_context *limited(uint64_t bytes)
{
    carvel_context *context = NULL;
    carvel_context_desc desc;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    desc.thread_count = 1;
    desc.memory_ceiling = bytes;
    CHECK_OK(carvel_context_create(&desc, &context, failure));
    return context;
}

/* Refused before work, by a message that names the ceiling. */
static void check_refused(setup *it, const carvel_context *context, const char *ceiling)
{
    carvel_hierarchy *hierarchy;
    uint32_t levels = it->input.levels;
    level64 level;
    carvel_counts counts = predicted(it->mesh, it->scheme, 7);
    carvel_refiner *fresh = refiner_of();
    level64_take(&level, &counts);
    it->input.levels = 7;
    CHECK_STATUS(CARVEL_STATUS_MEMORY_CEILING,
                 carvel_refiner_refine_f64(fresh, context, &it->input, &level.output, failure));
    CHECK(strstr(carvel_error_message(failure), ceiling) != NULL);
    CHECK_UINT(0, carvel_refiner_bytes(fresh));
    CHECK_STATUS(CARVEL_STATUS_MEMORY_CEILING, build(it, context, &hierarchy));
    CHECK(hierarchy == NULL);
    CHECK(strstr(carvel_error_message(failure), ceiling) != NULL);
    it->input.levels = levels;
    carvel_refiner_destroy(fresh);
    level64_free(&level);
}

static void check_ceiling(void)
{
    setup it;
    poly *large = poly_grid(100, 100);
    carvel_context *context = limited(100000), *tiny = limited(1000);
    carvel_mesh *mesh = (carvel_mesh *)large;
    carvel_mesh_desc desc;
    setup_take(&it, poly_cube(), 2);
    CHECK_OK(refine(&it, context));
    check_refused(&it, context, "100000");
    CHECK_OK(refine(&it, context));
    poly_describe(large, &desc);
    CHECK_STATUS(CARVEL_STATUS_MEMORY_CEILING,
                 carvel_mesh_create(tiny, &desc, &mesh, failure));
    CHECK(mesh == NULL);
    carvel_context_destroy(context);
    carvel_context_destroy(tiny);
    setup_free(&it);
    poly_free(large);
}

/* -------------------------------------------------------------------- threads */

static void check_thread_limits(void)
{
    static const uint32_t too_many[3] = { 1025, 100000, UINT32_MAX };
    carvel_context_desc desc;
    uint32_t i;
    CHECK_OK(carvel_context_desc_init(&desc, sizeof desc));
    for (i = 0; i < 3; i++) {
        carvel_context *context = (carvel_context *)&desc;
        desc.thread_count = too_many[i];
        CHECK_STATUS(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE,
                     carvel_context_create(&desc, &context, failure));
        CHECK(context == NULL);
    }
    CHECK_UINT(1, carvel_context_thread_count(NULL));
}

/* The same bytes, one after the other, from any number of threads. */
static void check_same_bytes(uint32_t side)
{
    static const uint32_t threads[3] = { 2, 5, 0 };
    setup it;
    level64 expected;
    uint32_t i;
    carvel_context *context = context_of(1);
    setup_take(&it, poly_torus(side, side), 2);
    level64_refine(&expected, context, it.mesh, it.scheme, 2, it.control->positions);
    CHECK_UINT(1, carvel_context_thread_count(context));
    for (i = 0; i < 3; i++) {
        carvel_context_destroy(context);
        context = context_of(threads[i]);
        CHECK(carvel_context_thread_count(context) >= 1);
        if (threads[i] > 0)
            CHECK_UINT(threads[i], carvel_context_thread_count(context));
        CHECK_OK(refine(&it, context));
        CHECK_BYTES(expected.output.positions.data, it.level.output.positions.data,
                    (size_t)expected.counts.vertices * 3 * sizeof(double));
        CHECK_BYTES(expected.output.face_vertices.data, it.level.output.face_vertices.data,
                    (size_t)expected.counts.corners * 4);
        CHECK_BYTES(expected.output.face_sources.data, it.level.output.face_sources.data,
                    (size_t)expected.counts.faces * 4);
    }
    carvel_context_destroy(context);
    level64_free(&expected);
    setup_free(&it);
}

int main(int count, char **arguments)
{
    uint32_t threads;
    check_begin();
    for (threads = 1; threads <= 3; threads += 2) {
        check_context(threads == 1 ? "1 thread" : "3 threads");
        check_progress(threads);
        check_callback_stops(threads);
        check_flag(threads);
        check_stopped_from_elsewhere(threads);
    }
    check_context("ceiling");
    check_ceiling();
    check_context("threads");
    check_thread_limits();
    check_same_bytes((uint32_t)size_argument(count, arguments, 80));
    return check_end();
}
