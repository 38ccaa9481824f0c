/*
 * Evaluates a moving control mesh frame by frame: the topology is refined once,
 * and each frame costs only its points.
 *
 *   gcc -std=c99 animate.c $(pkg-config --cflags --libs carvel) -lm -o animate
 */
#define _POSIX_C_SOURCE 199309L
#include <carvel.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { SIDE = 33, FRAMES = 24, LEVEL = 2 };

static uint32_t faces[4 * (SIDE - 1) * (SIDE - 1)];
static double control[3 * SIDE * SIDE];

/* A sheet of quads with SIDE x SIDE points. */
static void make_faces(void)
{
    uint32_t *face = faces;
    for (uint32_t i = 0; i + 1 < SIDE; ++i)
        for (uint32_t j = 0; j + 1 < SIDE; ++j, face += 4) {
            face[0] = i * SIDE + j;
            face[1] = face[0] + SIDE;
            face[2] = face[1] + 1;
            face[3] = face[0] + 1;
        }
}

/* A wave runs through the sheet. */
static void move_points(int frame)
{
    double *point = control;
    for (int i = 0; i < SIDE; ++i)
        for (int j = 0; j < SIDE; ++j, point += 3) {
            point[0] = i;
            point[1] = j;
            point[2] = sin(0.3 * i + 0.1 * j + 0.5 * frame);
        }
}

static double milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

int main(void)
{
    carvel_error *error = NULL;
    carvel_context *context = NULL;
    carvel_mesh *mesh = NULL;
    carvel_scheme *scheme = NULL;
    carvel_hierarchy *hierarchy = NULL;
    carvel_const_values_f64 from = { control, SIDE * SIDE, 3, 0 };
    carvel_values_f64 to = { NULL, 0, 3, 0 };
    carvel_context_desc context_desc;
    carvel_mesh_desc mesh_desc;
    carvel_scheme_desc scheme_desc;
    carvel_counts counts;

    carvel_context_desc_init(&context_desc, sizeof context_desc);
    carvel_mesh_desc_init(&mesh_desc, sizeof mesh_desc);
    carvel_scheme_desc_init(&scheme_desc, sizeof scheme_desc);
    carvel_counts_init(&counts, sizeof counts);
    carvel_status status = carvel_error_create(&error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    /* Once: threads on all cores, topology, room for the refined points. */
    status = carvel_context_create(&context_desc, &context, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    make_faces();
    mesh_desc.vertex_count = SIDE * SIDE;
    mesh_desc.face_count = (SIDE - 1) * (SIDE - 1);
    mesh_desc.face_size = 4;
    mesh_desc.face_vertices = faces;
    mesh_desc.face_vertex_count = sizeof faces / sizeof *faces;
    status = carvel_mesh_create(context, &mesh_desc, &mesh, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    scheme_desc.family = CARVEL_SCHEME_QUARTIC;
    status = carvel_scheme_create(&scheme_desc, &scheme, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_hierarchy_create(context, mesh, scheme, LEVEL, &hierarchy, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_hierarchy_counts(hierarchy, LEVEL, &counts, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    to.count = counts.vertices;
    to.data = malloc((size_t)counts.vertices * 3 * sizeof(double));
    if (to.data == NULL) {
        status = CARVEL_STATUS_OUT_OF_RESOURCES;
        goto done;
    }
    printf("%" PRIu64 " vertices, %" PRIu64 " faces\n", counts.vertices, counts.faces);

    /* Every frame. */
    for (int frame = 0; frame < FRAMES; ++frame) {
        move_points(frame);
        const double start = milliseconds();
        status = carvel_hierarchy_refine_f64(hierarchy, context, LEVEL, &from, &to, error);
        if (status != CARVEL_STATUS_OK)
            goto done;
        printf("frame %d: %.2f ms, the first point is at height %.6f\n", frame,
               milliseconds() - start, to.data[2]);
    }

done:
    if (status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(status), carvel_error_message(error));
    free(to.data);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_context_destroy(context);
    carvel_error_destroy(error);
    return status == CARVEL_STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
