/* Every object made and destroyed 10,000 times, with a step in every sixteenth
 * round, without growth. Argument 1: how often instead. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "fixture.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Bytes in use by the heap. */
static size_t heap_bytes(void)
{
    return mallinfo2().uordblks + mallinfo2().hblkhd;
}

/* Resident memory in KiB. */
static unsigned long resident(void)
{
    char line[256];
    unsigned long kib = 0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file != NULL && kib == 0 && fgets(line, sizeof line, file) != NULL)
        if (sscanf(line, "VmRSS: %lu", &kib) != 1)
            kib = 0;
    if (file != NULL)
        fclose(file);
    CHECK(kib > 0);
    return kib;
}

typedef struct shared {
    poly *control, *broken;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    level64 level;
} shared;

static void churn_error(const shared *it)
{
    carvel_error *error = NULL;
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    CHECK_OK(carvel_error_create(&error));
    poly_describe(it->broken, &desc);
    CHECK(carvel_mesh_create(NULL, &desc, &mesh, error) ==
          CARVEL_STATUS_INCONSISTENT_ORIENTATION);
    CHECK(strlen(carvel_error_entry_message(error, 0)) > 0);
    carvel_error_destroy(error);
}

static void churn_context(uint32_t threads)
{
    carvel_context *context = context_of(threads);
    carvel_context_cancel(context);
    carvel_context_destroy(context);
}

static void churn_mesh(const shared *it, uint32_t levels)
{
    carvel_mesh *mesh = poly_mesh(it->control);
    carvel_hierarchy *hierarchy = hierarchy_of(mesh, it->scheme, levels);
    carvel_mesh *level = NULL;
    CHECK_OK(carvel_hierarchy_mesh(hierarchy, levels, &level, failure));
    carvel_mesh_destroy(mesh);
    carvel_hierarchy_destroy(hierarchy);
    carvel_mesh_destroy(level);
}

static void churn_refiner(const shared *it, uint32_t levels)
{
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(it->mesh, it->scheme, levels, it->control->positions);
    carvel_refine_output_f64 output = it->level.output;
    CHECK_OK(carvel_refiner_refine_f64(refiner, NULL, &input, &output, failure));
    carvel_refiner_destroy(refiner);
}

static void churn(const shared *it, unsigned long rounds)
{
    unsigned long i;
    for (i = 0; i < rounds; i++) {
        uint32_t levels = i % 16 == 0;
        churn_error(it);
        churn_context(1 + levels);
        carvel_scheme_destroy(scheme_of((int32_t)(i % 4), (int32_t)(i % 3)));
        churn_mesh(it, levels);
        churn_refiner(it, levels);
    }
}

/* NULL may be destroyed. */
static void destroy_nothing(void)
{
    carvel_error_destroy(NULL);
    carvel_context_destroy(NULL);
    carvel_scheme_destroy(NULL);
    carvel_mesh_destroy(NULL);
    carvel_refiner_destroy(NULL);
    carvel_hierarchy_destroy(NULL);
}

static void shared_take(shared *it)
{
    static const uint32_t sizes[2] = { 3, 3 }, same_way[6] = { 0, 1, 2, 0, 1, 3 };
    carvel_counts counts;
    it->control = poly_grid(2, 1);
    it->broken = poly_of(4, 2, sizes, same_way);
    it->mesh = poly_mesh(it->control);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    counts = predicted(it->mesh, it->scheme, 1);
    level64_take(&it->level, &counts);
}

static void shared_free(shared *it)
{
    level64_free(&it->level);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->control);
    poly_free(it->broken);
}

int main(int count, char **arguments)
{
    unsigned long rounds = size_argument(count, arguments, 10000), kib, kib_after;
    size_t bytes, bytes_after;
    shared it;
    check_begin();
    destroy_nothing();
    shared_take(&it);
    churn(&it, rounds / 10);
    bytes = heap_bytes();
    kib = resident();
    churn(&it, rounds);
    bytes_after = heap_bytes();
    kib_after = resident();
    printf("%lu to %lu bytes of heap, %lu to %lu KiB resident\n", (unsigned long)bytes,
           (unsigned long)bytes_after, kib, kib_after);
    /* The smallest piece of memory for each round would be five times as much. */
    CHECK(bytes_after < bytes + 65536);
    CHECK(kib_after < kib + 512);
    shared_free(&it);
    return check_end();
}
