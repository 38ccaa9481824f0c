/*
 * Two threads refine one mesh at once, each with its own values. Mesh and scheme
 * are shared as they are; a refiner and an error belong to one thread each.
 *
 *   gcc -std=c99 threads.c $(pkg-config --cflags --libs carvel) -pthread -o threads
 */
#include <carvel.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEVELS = 4 };

static const uint32_t cube[] = {
    0, 3, 2, 1,  4, 5, 6, 7,  0, 1, 5, 4,  1, 2, 6, 5,  2, 3, 7, 6,  3, 0, 4, 7 };
static const float corners[] = {
    0, 0, 0,  1, 0, 0,  1, 1, 0,  0, 1, 0,  0, 0, 1,  1, 0, 1,  1, 1, 1,  0, 1, 1 };

/* What one thread gets and gives. */
struct work {
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    uint64_t vertices;
    float size;
    float highest;
    carvel_status status;
};

/* Refines a cube of some size and measures how high the surface reaches. */
static void *refine(void *data)
{
    struct work *work = data;
    float points[24];
    carvel_error *error = NULL;
    carvel_refiner *refiner = NULL;
    carvel_refine_input_f32 input;
    carvel_refine_output_f32 output;

    carvel_refine_input_f32_init(&input, sizeof input);
    carvel_refine_output_f32_init(&output, sizeof output);
    for (int i = 0; i < 24; ++i)
        points[i] = work->size * corners[i];
    input.levels = LEVELS;
    input.mesh = work->mesh;
    input.scheme = work->scheme;
    input.positions.data = points;
    input.positions.count = 8;
    input.positions.width = 3;
    /* Positions are all that is wanted here. */
    output.positions.data = malloc((size_t)work->vertices * 3 * sizeof(float));
    output.positions.count = work->vertices;
    output.positions.width = 3;
    work->status = output.positions.data == NULL ? CARVEL_STATUS_OUT_OF_RESOURCES
                                                 : carvel_error_create(&error);
    if (work->status == CARVEL_STATUS_OK)
        work->status = carvel_refiner_create(&refiner, error);
    if (work->status == CARVEL_STATUS_OK)
        work->status = carvel_refiner_refine_f32(refiner, NULL, &input, &output, error);
    if (work->status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(work->status),
                carvel_error_message(error));
    else
        for (uint64_t i = 0; i < work->vertices; ++i)
            if (output.positions.data[3 * i + 2] > work->highest)
                work->highest = output.positions.data[3 * i + 2];
    free(output.positions.data);
    carvel_refiner_destroy(refiner);
    carvel_error_destroy(error);
    return NULL;
}

int main(void)
{
    carvel_error *error = NULL;
    carvel_mesh *mesh = NULL;
    carvel_scheme *scheme = NULL;
    carvel_mesh_desc mesh_desc;
    carvel_scheme_desc scheme_desc;
    carvel_counts counts;
    pthread_t other;

    carvel_mesh_desc_init(&mesh_desc, sizeof mesh_desc);
    carvel_scheme_desc_init(&scheme_desc, sizeof scheme_desc);
    carvel_counts_init(&counts, sizeof counts);
    carvel_status status = carvel_error_create(&error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    mesh_desc.vertex_count = 8;
    mesh_desc.face_count = 6;
    mesh_desc.face_size = 4;
    mesh_desc.face_vertices = cube;
    mesh_desc.face_vertex_count = 24;
    status = carvel_mesh_create(NULL, &mesh_desc, &mesh, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    scheme_desc.family = CARVEL_SCHEME_QUARTIC;
    status = carvel_scheme_create(&scheme_desc, &scheme, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_predict_counts(mesh, scheme, LEVELS, &counts, error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    struct work small = { mesh, scheme, counts.vertices, 1, 0, CARVEL_STATUS_OK };
    struct work large = { mesh, scheme, counts.vertices, 100, 0, CARVEL_STATUS_OK };
    if (pthread_create(&other, NULL, refine, &large) != 0) {
        status = CARVEL_STATUS_OUT_OF_RESOURCES;
        goto done;
    }
    refine(&small);
    pthread_join(other, NULL);
    if (small.status == CARVEL_STATUS_OK && large.status == CARVEL_STATUS_OK)
        printf("%" PRIu64 " vertices each, up to %.4f and %.2f\n", counts.vertices,
               small.highest, large.highest);
    else
        status = small.status != CARVEL_STATUS_OK ? small.status : large.status;

done:
    if (status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(status), carvel_error_message(error));
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_error_destroy(error);
    return status == CARVEL_STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
