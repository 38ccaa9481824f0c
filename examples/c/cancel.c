/*
 * Shows the progress of a long refinement, and ends it from another thread.
 *
 *   gcc -std=c99 cancel.c $(pkg-config --cflags --libs carvel) -pthread -o cancel
 */
#define _POSIX_C_SOURCE 200809L
#include <carvel.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static const uint32_t tetrahedron[] = { 0, 2, 1,  0, 1, 3,  1, 2, 3,  2, 0, 3 };

/* What the two threads share. */
struct job {
    carvel_context *context;
    pthread_mutex_t lock;
    pthread_cond_t moved;
    int reports;
};

static void wake_up(struct job *job)
{
    pthread_mutex_lock(&job->lock);
    ++job->reports;
    pthread_cond_signal(&job->moved);
    pthread_mutex_unlock(&job->lock);
}

/* Called by the library on the thread that refines. */
static int32_t report(double done, void *user_data)
{
    fprintf(stderr, "%3.0f %%\n", 100 * done);
    wake_up(user_data);
    return 0; /* Non-zero would cancel, too. */
}

/* The user: waits for the first sign of work, and has enough of it. */
static void *impatient(void *data)
{
    struct job *job = data;
    pthread_mutex_lock(&job->lock);
    while (job->reports == 0)
        pthread_cond_wait(&job->moved, &job->lock);
    pthread_mutex_unlock(&job->lock);
    carvel_context_cancel(job->context);
    return NULL;
}

int main(void)
{
    struct job job = { NULL, PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0 };
    carvel_error *error = NULL;
    carvel_mesh *mesh = NULL;
    carvel_scheme *scheme = NULL;
    carvel_hierarchy *hierarchy = NULL;
    carvel_context_desc context_desc;
    carvel_mesh_desc mesh_desc;
    carvel_scheme_desc scheme_desc;
    pthread_t thread;

    carvel_context_desc_init(&context_desc, sizeof context_desc);
    carvel_mesh_desc_init(&mesh_desc, sizeof mesh_desc);
    carvel_scheme_desc_init(&scheme_desc, sizeof scheme_desc);
    carvel_status status = carvel_error_create(&error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    context_desc.progress = report;
    context_desc.user_data = &job;
    status = carvel_context_create(&context_desc, &job.context, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    mesh_desc.vertex_count = 4;
    mesh_desc.face_count = 4;
    mesh_desc.face_size = 3;
    mesh_desc.face_vertices = tetrahedron;
    mesh_desc.face_vertex_count = 12;
    status = carvel_mesh_create(NULL, &mesh_desc, &mesh, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_scheme_create(&scheme_desc, &scheme, error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    if (pthread_create(&thread, NULL, impatient, &job) != 0) {
        status = CARVEL_STATUS_OUT_OF_RESOURCES;
        goto done;
    }
    /* 12 million corners, unless somebody objects. */
    status = carvel_hierarchy_create(job.context, mesh, scheme, 10, &hierarchy, error);
    /* In case nothing was reported. */
    wake_up(&job);
    pthread_join(thread, NULL);
    if (status == CARVEL_STATUS_CANCELLED) {
        /* Expected here. The context can be used again. */
        printf("cancelled\n");
        carvel_context_reset(job.context);
        status = carvel_hierarchy_create(job.context, mesh, scheme, 2, &hierarchy, error);
    }
    if (status == CARVEL_STATUS_OK)
        printf("refined to level %u\n", (unsigned)carvel_hierarchy_last_level(hierarchy));

done:
    if (status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(status), carvel_error_message(error));
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_context_destroy(job.context);
    carvel_error_destroy(error);
    return status == CARVEL_STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
