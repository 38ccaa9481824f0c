/*
 * Refines the faces and points below and writes the result as an OBJ file.
 *
 *   gcc -std=c99 refine.c $(pkg-config --cflags --libs carvel) -o refine
 *   ./refine 3 > house.obj
 */
#include <carvel.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* A house: quads, and a pentagon at either end. */
static const float points[] = {
    0, 0, 0,  3, 0, 0,  3, 0, 2,  0, 0, 2,
    0, 2, 0,  3, 2, 0,  3, 2, 2,  0, 2, 2,
    0, 3, 1,  3, 3, 1 };
static const uint32_t face_sizes[] = { 4, 4, 4, 4, 4, 5, 5 };
static const uint32_t face_vertices[] = {
    0, 1, 2, 3,  0, 4, 5, 1,  2, 6, 7, 3,  4, 8, 9, 5,  6, 9, 8, 7,
    0, 3, 7, 8, 4,  1, 5, 9, 6, 2 };

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* At least one byte, since malloc(0) may be NULL. */
static void *buffer(uint64_t count, size_t size)
{
    return count < SIZE_MAX / size ? malloc((size_t)count * size + 1) : NULL;
}

static void write_obj(const carvel_counts *counts, const carvel_refine_output_f32 *smooth)
{
    const float *xyz = smooth->positions.data;
    const uint32_t *vertex = smooth->face_vertices.data;
    for (uint64_t i = 0; i < counts->vertices; ++i, xyz += 3)
        printf("v %.9g %.9g %.9g\n", xyz[0], xyz[1], xyz[2]);
    for (uint64_t i = 0; i < counts->faces; ++i) {
        putchar('f');
        for (uint32_t j = 0; j < smooth->face_sizes.data[i]; ++j)
            printf(" %" PRIu32, *vertex++ + 1);
        putchar('\n');
    }
}

int main(int argc, char **argv)
{
    char *end = NULL;
    const unsigned long levels = argc > 1 ? strtoul(argv[1], &end, 10) : 2;
    carvel_error *error = NULL;
    carvel_mesh *mesh = NULL;
    carvel_scheme *scheme = NULL;
    carvel_refiner *refiner = NULL;
    carvel_mesh_desc mesh_desc;
    carvel_scheme_desc scheme_desc;
    carvel_counts counts;
    carvel_refine_input_f32 input;
    carvel_refine_output_f32 output;

    if (end != NULL && (end == argv[1] || *end != '\0' || levels > 64)) {
        fprintf(stderr, "'%s' is no number of levels: refine [0-64]\n", argv[1]);
        return EXIT_FAILURE;
    }
    carvel_mesh_desc_init(&mesh_desc, sizeof mesh_desc);
    carvel_scheme_desc_init(&scheme_desc, sizeof scheme_desc);
    carvel_counts_init(&counts, sizeof counts);
    carvel_refine_input_f32_init(&input, sizeof input);
    carvel_refine_output_f32_init(&output, sizeof output);
    carvel_status status = carvel_error_create(&error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    mesh_desc.vertex_count = COUNT(points) / 3;
    mesh_desc.face_count = COUNT(face_sizes);
    mesh_desc.face_sizes = face_sizes;
    mesh_desc.face_vertices = face_vertices;
    mesh_desc.face_vertex_count = COUNT(face_vertices);
    status = carvel_mesh_create(NULL, &mesh_desc, &mesh, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    scheme_desc.family = CARVEL_SCHEME_THREE_POINT;
    status = carvel_scheme_create(&scheme_desc, &scheme, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    status = carvel_refiner_create(&refiner, error);
    if (status != CARVEL_STATUS_OK)
        goto done;

    status = carvel_predict_counts(mesh, scheme, (uint32_t)levels, &counts, error);
    if (status != CARVEL_STATUS_OK)
        goto done;
    input.levels = (uint32_t)levels;
    input.mesh = mesh;
    input.scheme = scheme;
    input.positions.data = points;
    input.positions.count = COUNT(points) / 3;
    input.positions.width = 3;
    output.face_sizes.data = buffer(counts.faces, sizeof(uint32_t));
    output.face_sizes.count = counts.faces;
    output.face_vertices.data = buffer(counts.corners, sizeof(uint32_t));
    output.face_vertices.count = counts.corners;
    output.positions.data = buffer(counts.vertices, 3 * sizeof(float));
    output.positions.count = counts.vertices;
    output.positions.width = 3;
    if (output.face_sizes.data == NULL || output.face_vertices.data == NULL ||
        output.positions.data == NULL) {
        status = CARVEL_STATUS_OUT_OF_RESOURCES;
        goto done;
    }
    status = carvel_refiner_refine_f32(refiner, NULL, &input, &output, error);
    if (status == CARVEL_STATUS_OK)
        write_obj(&counts, &output);

done:
    if (status != CARVEL_STATUS_OK)
        fprintf(stderr, "%s: %s\n", carvel_status_string(status), carvel_error_message(error));
    free(output.face_sizes.data);
    free(output.face_vertices.data);
    free(output.positions.data);
    carvel_refiner_destroy(refiner);
    carvel_scheme_destroy(scheme);
    carvel_mesh_destroy(mesh);
    carvel_error_destroy(error);
    return status == CARVEL_STATUS_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
