/*
 * Shows everything that is wrong with a mesh, element by element, and then takes
 * the mesh all the same by cutting it where it is not manifold.
 *
 *   gcc -std=c99 errors.c $(pkg-config --cflags --libs carvel) -o errors
 */
#include <carvel.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* Three faces at the edge 0-1, and two cones that touch in vertex 5. */
static const uint32_t triangles[] = {
    0, 1, 2,  1, 0, 3,  0, 1, 4,
    5, 6, 7,  5, 8, 9 };

static void print_element(carvel_element element)
{
    switch (element.kind) {
    case CARVEL_ELEMENT_VERTEX:
        printf(" [vertex %" PRIu64 "]", element.index);
        break;
    case CARVEL_ELEMENT_FACE:
        printf(" [face %" PRIu64 "]", element.index);
        break;
    case CARVEL_ELEMENT_EDGE:
        printf(" [edge %" PRIu64 "-%" PRIu64 "]", element.index, element.second);
        break;
    default:
        break;
    }
}

static void print_error(carvel_error *error)
{
    printf("refused: %s\n", carvel_error_message(error));
    for (uint64_t i = 0; i < carvel_error_entry_count(error); ++i) {
        const carvel_status status = carvel_error_entry_status(error, i);
        printf("%d (%s): %s", (int)status, carvel_status_string(status),
               carvel_error_entry_message(error, i));
        for (uint64_t j = 0; j < carvel_error_element_count(error, i); ++j)
            print_element(carvel_error_element(error, i, j));
        putchar('\n');
    }
}

int main(void)
{
    carvel_error *error = NULL;
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    carvel_counts counts;

    carvel_mesh_desc_init(&desc, sizeof desc);
    carvel_counts_init(&counts, sizeof counts);
    carvel_status status = carvel_error_create(&error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    desc.vertex_count = 10;
    desc.face_count = 5;
    desc.face_size = 3;
    desc.face_vertices = triangles;
    desc.face_vertex_count = sizeof triangles / sizeof *triangles;
    status = carvel_mesh_create(NULL, &desc, &mesh, error);
    switch (status) {
    case CARVEL_STATUS_OK:
        break;
    case CARVEL_STATUS_INCONSISTENT_ORIENTATION:
    case CARVEL_STATUS_NON_MANIFOLD_EDGE:
    case CARVEL_STATUS_NON_MANIFOLD_VERTEX:
        print_error(error);
        desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
        status = carvel_mesh_create(NULL, &desc, &mesh, error);
        break;
    default:
        /* Nothing to be done about the others here. */
        break;
    }
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_mesh_counts(mesh, &counts, error);
    if (status == CARVEL_STATUS_OK)
        printf("cut: %" PRIu64 " vertices became %" PRIu64 "\n", desc.vertex_count,
               counts.vertices);

done:
    if (status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(status), carvel_error_message(error));
    carvel_mesh_destroy(mesh);
    carvel_error_destroy(error);
    return status == CARVEL_STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
