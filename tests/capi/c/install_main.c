/* A program that links an installed carvel: refines a cube with two threads and prints the
   library's version. Exit 1: the header is of another version; 2: refining failed. */
#include <carvel.h>
#include <stdio.h>
#include <string.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
#define HEADER_VERSION \
    TEXT(CARVEL_VERSION_MAJOR) "." TEXT(CARVEL_VERSION_MINOR) "." TEXT(CARVEL_VERSION_PATCH)

/* The faces of a cube after two dual steps; 0 if something failed. */
static uint64_t faces(void) {
    static const uint32_t sizes[6] = { 4, 4, 4, 4, 4, 4 };
    static const uint32_t corners[24] = { 0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                          1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7 };
    carvel_context *context = NULL;
    carvel_mesh *mesh = NULL;
    carvel_scheme *scheme = NULL;
    carvel_hierarchy *hierarchy = NULL;
    carvel_context_desc threads;
    carvel_mesh_desc cube;
    carvel_scheme_desc smooth;
    carvel_counts counts;

    carvel_context_desc_init(&threads, sizeof threads);
    carvel_mesh_desc_init(&cube, sizeof cube);
    carvel_scheme_desc_init(&smooth, sizeof smooth);
    carvel_counts_init(&counts, sizeof counts);
    threads.thread_count = 2;
    cube.vertex_count = 8;
    cube.face_count = 6;
    cube.face_sizes = sizes;
    cube.face_vertices = corners;
    cube.face_vertex_count = 24;
    if (carvel_context_create(&threads, &context, NULL) == CARVEL_STATUS_OK &&
        carvel_mesh_create(context, &cube, &mesh, NULL) == CARVEL_STATUS_OK &&
        carvel_scheme_create(&smooth, &scheme, NULL) == CARVEL_STATUS_OK &&
        carvel_hierarchy_create(context, mesh, scheme, 4, &hierarchy, NULL) == CARVEL_STATUS_OK)
        carvel_hierarchy_counts(hierarchy, 2, &counts, NULL);
    carvel_hierarchy_destroy(hierarchy);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_context_destroy(context);
    return counts.faces;
}

int main(void) {
    if (strcmp(carvel_version(), HEADER_VERSION) != 0)
        return 1;
    /* 26 faces and 24 vertices after the first step: 24 + 48 + 26. */
    if (faces() != 98)
        return 2;
    printf("%s\n", carvel_version());
    return 0;
}
