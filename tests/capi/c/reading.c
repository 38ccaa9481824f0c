#include "reading.h"

#include <stdlib.h>

FILE *read_file(int count, char **arguments)
{
    FILE *file = count > 1 ? fopen(arguments[1], "r") : NULL;
    if (file == NULL)
        misread("its name");
    return file;
}

void misread(const char *what)
{
    fprintf(stderr, "the list of cases is broken at %s\n", what);
    exit(1);
}

unsigned long read_number(FILE *file)
{
    unsigned long number;
    if (fscanf(file, "%lu", &number) != 1)
        misread("a number");
    return number;
}

static double read_double(FILE *file)
{
    double number;
    if (fscanf(file, "%lf", &number) != 1)
        misread("a coordinate");
    return number;
}

poly *read_poly(FILE *file)
{
    uint64_t vertices = read_number(file), faces = read_number(file);
    uint64_t corners = read_number(file), i;
    uint32_t *sizes = TAKE(uint32_t, faces), *indices = TAKE(uint32_t, corners);
    poly *it;
    for (i = 0; i < faces; i++)
        sizes[i] = (uint32_t)read_number(file);
    for (i = 0; i < corners; i++)
        indices[i] = (uint32_t)read_number(file);
    it = poly_of(vertices, faces, sizes, indices);
    for (i = 0; i < 3 * vertices; i++)
        it->positions[i] = read_double(file);
    free(sizes);
    free(indices);
    return it;
}
