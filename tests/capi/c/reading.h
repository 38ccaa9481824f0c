/* Reads the lists that the Rust side writes for a program. */
#ifndef READING_H
#define READING_H

#include "fixture.h"

#include <stdio.h>

/* The file that the first argument names. */
FILE *read_file(int count, char **arguments);
/* Ends the program. */
void misread(const char *what);
unsigned long read_number(FILE *file);
/* Vertices, faces, corners, sizes, indices, positions. */
poly *read_poly(FILE *file);

#endif
