/* Two threads share a mesh, a scheme, a context and a hierarchy, each with its
 * own refiner, error and buffers; then both use one refiner. Argument 1: how
 * often each does so. Argument 2: "serial" for a serial context alone, "pool" for
 * one of two threads alone, "apart" for a serial context and no refiner in common:
 * tools judge these in different ways.
 *
 * Compiled with PLANTED both threads write to the same buffer, which a tool that
 * looks for races must see. */
#include "fixture.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 2, LEVELS = 2 };

/* What all share. */
typedef struct shared {
    const poly *control;
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    const carvel_context *context;
    const carvel_hierarchy *hierarchy;
    /* Used by both at once, in the second part. */
    carvel_refiner *refiner;
    const level64 *expected;
    unsigned long rounds;
} shared;

/* What one thread has, and what it found. Nothing here is printed or counted
 * by a thread: the main thread looks when both are done. */
typedef struct worker {
    const shared *all;
    carvel_refine_input_f64 input;
    level64 level;
    unsigned long wrong, busy, done;
} worker;

static int same(const void *x, const void *y, uint64_t size)
{
    return memcmp(x, y, (size_t)size) == 0;
}

static int is_expected(const worker *it)
{
    const level64 *x = it->all->expected, *y = &it->level;
    return same(x->output.positions.data, y->output.positions.data,
                x->counts.vertices * 3 * sizeof(double)) &&
           same(x->output.face_vertices.data, y->output.face_vertices.data,
                x->counts.corners * 4);
}

static void forget(worker *it)
{
    memset(it->level.output.positions.data, 0,
           (size_t)it->level.counts.vertices * 3 * sizeof(double));
}

static void refine_own(worker *it, carvel_refiner *refiner, carvel_error *error)
{
    forget(it);
    it->wrong += carvel_refiner_refine_f64(refiner, it->all->context, &it->input,
                                           &it->level.output, error) != CARVEL_STATUS_OK;
    it->wrong += !is_expected(it);
}

static void refine_hierarchy(worker *it, carvel_error *error)
{
    forget(it);
    it->wrong += carvel_hierarchy_refine_f64(it->all->hierarchy, it->all->context, LEVELS,
                                             &it->input.positions, &it->level.output.positions,
                                             error) != CARVEL_STATUS_OK;
    it->wrong += !is_expected(it);
}

/* What only reads, and what fails, each with its own error. */
static void ask(worker *it, carvel_error *error)
{
    carvel_counts counts;
    carvel_mesh *mesh = NULL;
    carvel_counts_init(&counts, sizeof counts);
    it->wrong += carvel_predict_counts(it->all->mesh, it->all->scheme, LEVELS, &counts, error) !=
                 CARVEL_STATUS_OK;
    it->wrong += counts.faces != it->level.counts.faces;
    it->wrong += carvel_hierarchy_mesh(it->all->hierarchy, 1, &mesh, error) != CARVEL_STATUS_OK;
    it->wrong += carvel_mesh_validate(mesh, error) != CARVEL_STATUS_OK;
    carvel_mesh_destroy(mesh);
    it->wrong += carvel_hierarchy_mesh(it->all->hierarchy, 9, &mesh, error) !=
                 CARVEL_STATUS_PARAMETER_OUT_OF_RANGE;
    it->wrong += strlen(carvel_error_message(error)) == 0;
}

static void *work(void *argument)
{
    worker *it = (worker *)argument;
    carvel_refiner *refiner = NULL;
    carvel_error *error = NULL;
    unsigned long round;
    it->wrong += carvel_error_create(&error) != CARVEL_STATUS_OK;
    it->wrong += carvel_refiner_create(&refiner, error) != CARVEL_STATUS_OK;
    for (round = 0; round < it->all->rounds; round++) {
        refine_own(it, refiner, error);
        refine_hierarchy(it, error);
        ask(it, error);
        it->done++;
    }
    carvel_refiner_destroy(refiner);
    carvel_error_destroy(error);
    return NULL;
}

/* One refiner serves one call at a time and says so to the other. */
static void *contend(void *argument)
{
    worker *it = (worker *)argument;
    unsigned long round;
    for (round = 0; round < it->all->rounds; round++) {
        carvel_status status = carvel_refiner_refine_f64(it->all->refiner, it->all->context,
                                                         &it->input, &it->level.output, NULL);
        it->busy += status == CARVEL_STATUS_BUSY;
        it->done += status == CARVEL_STATUS_OK;
        it->wrong += status != CARVEL_STATUS_BUSY && status != CARVEL_STATUS_OK;
        it->wrong += status == CARVEL_STATUS_OK && !is_expected(it);
        carvel_refiner_bytes(it->all->refiner);
    }
    return NULL;
}

static void run(worker *workers, void *(*task)(void *))
{
    pthread_t threads[THREADS];
    int i;
    for (i = 0; i < THREADS; i++) {
        workers[i].wrong = workers[i].busy = workers[i].done = 0;
        CHECK(pthread_create(&threads[i], NULL, task, &workers[i]) == 0);
    }
    for (i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
}

static void check_workers(worker *workers, const shared *all, int apart)
{
    int i;
    run(workers, work);
    for (i = 0; i < THREADS; i++) {
        CHECK_UINT(0, workers[i].wrong);
        CHECK_UINT(all->rounds, workers[i].done);
    }
    if (apart)
        return;
    run(workers, contend);
    for (i = 0; i < THREADS; i++) {
        CHECK_UINT(0, workers[i].wrong);
        CHECK_UINT(all->rounds, workers[i].done + workers[i].busy);
    }
    CHECK(workers[0].done + workers[1].done > 0);
}

static void check_shared(uint32_t threads, unsigned long rounds, int apart)
{
    poly *control = poly_grid(12, 9);
    carvel_mesh *mesh = poly_mesh(control);
    carvel_scheme *scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    carvel_context *context = context_of(threads);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, scheme, LEVELS);
    carvel_refiner *refiner = refiner_of();
    worker workers[THREADS];
    level64 expected;
    shared all;
    int i;
    level64_refine(&expected, NULL, mesh, scheme, LEVELS, control->positions);
    all.control = control;
    all.mesh = mesh;
    all.scheme = scheme;
    all.context = context;
    all.hierarchy = hierarchy;
    all.refiner = refiner;
    all.expected = &expected;
    all.rounds = rounds;
    for (i = 0; i < THREADS; i++) {
        workers[i].all = &all;
        workers[i].input = input64(mesh, scheme, LEVELS, control->positions);
        level64_take(&workers[i].level, &expected.counts);
    }
#ifdef PLANTED
    free(workers[1].level.output.positions.data);
    workers[1].level.output.positions.data = workers[0].level.output.positions.data;
#endif
    check_workers(workers, &all, apart);
#ifdef PLANTED
    workers[1].level.output.positions.data = NULL;
#endif
    for (i = 0; i < THREADS; i++)
        level64_free(&workers[i].level);
    level64_free(&expected);
    carvel_refiner_destroy(refiner);
    carvel_hierarchy_destroy(hierarchy);
    carvel_context_destroy(context);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    poly_free(control);
}

int main(int count, char **arguments)
{
    unsigned long rounds = size_argument(count, arguments, 8);
    const char *which = count > 2 ? arguments[2] : "";
    int apart = strcmp(which, "apart") == 0;
    check_begin();
    check_context("a serial context");
    if (strcmp(which, "pool") != 0)
        check_shared(1, rounds, apart);
    check_context("a context of two threads");
    if (strcmp(which, "serial") != 0 && !apart)
        check_shared(2, rounds, 0);
    return check_end();
}
