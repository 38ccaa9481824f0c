/* Meshes, schemes and refinements that the programs share. */
#ifndef FIXTURE_H
#define FIXTURE_H

#include "check.h"

/* Polygons as a host has them. */
typedef struct poly {
    uint64_t vertices;
    uint64_t faces;
    uint64_t corners;
    uint32_t *sizes;
    uint32_t *indices;
    double *positions;
} poly;

/* Copies what it is given; positions are made up. */
poly *poly_of(uint64_t vertices, uint64_t faces, const uint32_t *sizes, const uint32_t *indices);
/* Two quads, then four quads around. */
poly *poly_cube(void);
/* `width` by `height` quads, open. */
poly *poly_grid(uint32_t width, uint32_t height);
/* `around` by `across` quads, closed. */
poly *poly_torus(uint32_t around, uint32_t across);
/* Eight triangles, closed; its positions are the six unit vectors, +x first, then
 * +y, -x, -y, +z, -z. */
poly *poly_octahedron(void);
/* A quad, a triangle, a pentagon, a quad apart, and an isolated vertex: open. */
poly *poly_mixed(void);
void poly_free(poly *it);

/* The description with face sizes. */
void poly_describe(const poly *it, carvel_mesh_desc *desc);
/* The mesh, which must be accepted. */
carvel_mesh *poly_mesh(const poly *it);
/* The positions as floats; the caller frees them. */
float *poly_floats(const poly *it);

/* A scheme of a family and boundary with its defaults. */
carvel_scheme *scheme_of(int32_t family, int32_t boundary);
/* Passes of averaging, cosine, edge and corner. */
carvel_scheme *scheme_of_passes(const carvel_fraction *passes, uint64_t count);
/* The w of the three-point scheme. */
carvel_scheme *scheme_three_point(int64_t numerator, int64_t denominator);

carvel_context *context_of(uint32_t threads);
carvel_refiner *refiner_of(void);
carvel_hierarchy *hierarchy_of(const carvel_mesh *mesh, const carvel_scheme *scheme,
                               uint32_t levels);

carvel_counts counts_of(const carvel_mesh *mesh);
carvel_counts predicted(const carvel_mesh *mesh, const carvel_scheme *scheme, uint32_t level);

/* Room for a whole level: tight arrays, no attributes. */
typedef struct level64 {
    carvel_counts counts;
    carvel_refine_output_f64 output;
} level64;

typedef struct level32 {
    carvel_counts counts;
    carvel_refine_output_f32 output;
} level32;

void level64_take(level64 *it, const carvel_counts *counts);
void level64_free(level64 *it);
void level32_take(level32 *it, const carvel_counts *counts);
void level32_free(level32 *it);

/* An input of tight positions, no attributes. */
carvel_refine_input_f64 input64(const carvel_mesh *mesh, const carvel_scheme *scheme,
                                uint32_t levels, const double *positions);
carvel_refine_input_f32 input32(const carvel_mesh *mesh, const carvel_scheme *scheme,
                                uint32_t levels, const float *positions);

/* Refines positions by a refiner of its own; everything must go well. */
void level64_refine(level64 *it, const carvel_context *context, const carvel_mesh *mesh,
                    const carvel_scheme *scheme, uint32_t levels, const double *positions);

#endif
