/*
 * carvel.h - the C interface of carvel, a subdivision-surface kernel.
 *
 * A control mesh of any topology goes in, a smooth surface comes out. This file
 * is the manual: an overview with a complete example, then one section for each
 * object.
 *
 *
 * An example
 * ==========
 * Refines a pyramid twice with the three-point scheme.
 *
 *   #include <carvel.h>
 *   #include <stdio.h>
 *   #include <stdlib.h>
 *
 *   int main(void)
 *   {
 *       static const double points[15] = {
 *           0, 0, 0,  2, 0, 0,  2, 2, 0,  0, 2, 0,  1, 1, 2 };
 *       static const uint32_t sizes[5] = { 4, 3, 3, 3, 3 };
 *       static const uint32_t corners[16] = {
 *           3, 2, 1, 0,  0, 1, 4,  1, 2, 4,  2, 3, 4,  3, 0, 4 };
 *       carvel_error *error = NULL;
 *       carvel_mesh *mesh = NULL;
 *       carvel_scheme *scheme = NULL;
 *       carvel_refiner *refiner = NULL;
 *       carvel_mesh_desc mesh_desc;
 *       carvel_scheme_desc scheme_desc;
 *       carvel_counts counts;
 *       carvel_refine_input_f64 input;
 *       carvel_refine_output_f64 output;
 *       carvel_status status;
 *
 *       carvel_mesh_desc_init(&mesh_desc, sizeof mesh_desc);
 *       carvel_scheme_desc_init(&scheme_desc, sizeof scheme_desc);
 *       carvel_counts_init(&counts, sizeof counts);
 *       carvel_refine_input_f64_init(&input, sizeof input);
 *       carvel_refine_output_f64_init(&output, sizeof output);
 *       status = carvel_error_create(&error);
 *
 *       mesh_desc.vertex_count = 5;
 *       mesh_desc.face_count = 5;
 *       mesh_desc.face_sizes = sizes;
 *       mesh_desc.face_vertices = corners;
 *       mesh_desc.face_vertex_count = 16;
 *       if (status == CARVEL_STATUS_OK)
 *           status = carvel_mesh_create(NULL, &mesh_desc, &mesh, error);
 *       scheme_desc.family = CARVEL_SCHEME_THREE_POINT;
 *       if (status == CARVEL_STATUS_OK)
 *           status = carvel_scheme_create(&scheme_desc, &scheme, error);
 *       if (status == CARVEL_STATUS_OK)
 *           status = carvel_refiner_create(&refiner, error);
 *       if (status == CARVEL_STATUS_OK)
 *           status = carvel_predict_counts(mesh, scheme, 2, &counts, error);
 *       if (status == CARVEL_STATUS_OK) {
 *           input.levels = 2;
 *           input.mesh = mesh;
 *           input.scheme = scheme;
 *           input.positions.data = points;
 *           input.positions.count = 5;
 *           input.positions.width = 3;
 *           output.face_sizes.count = counts.faces;
 *           output.face_sizes.data = malloc(counts.faces * sizeof(uint32_t));
 *           output.face_vertices.count = counts.corners;
 *           output.face_vertices.data = malloc(counts.corners * sizeof(uint32_t));
 *           output.positions.count = counts.vertices;
 *           output.positions.width = 3;
 *           output.positions.data = malloc(counts.vertices * 3 * sizeof(double));
 *           status = carvel_refiner_refine_f64(refiner, NULL, &input, &output, error);
 *       }
 *       if (status == CARVEL_STATUS_OK)
 *           printf("%lu faces, the first vertex is at %g %g %g\n",
 *                  (unsigned long)counts.faces, output.positions.data[0],
 *                  output.positions.data[1], output.positions.data[2]);
 *       else
 *           fprintf(stderr, "%s: %s\n", carvel_status_string(status),
 *                   carvel_error_message(error));
 *       free(output.face_sizes.data);
 *       free(output.face_vertices.data);
 *       free(output.positions.data);
 *       carvel_refiner_destroy(refiner);
 *       carvel_scheme_destroy(scheme);
 *       carvel_mesh_destroy(mesh);
 *       carvel_error_destroy(error);
 *       return status == CARVEL_STATUS_OK ? 0 : 1;
 *   }
 *
 *   cc pyramid.c $(pkg-config --cflags --libs carvel) -o pyramid
 *
 * Where the loader does not look in the place that carvel is installed in, add
 * -Wl,-rpath,$(pkg-config --variable=libdir carvel).
 *
 *
 * The objects
 * ===========
 *   carvel_error      why a call failed: a message, the elements, every defect
 *   carvel_context    threads, memory ceiling, progress, cancellation
 *   carvel_scheme     a subdivision scheme with its parameters
 *   carvel_mesh       the topology of a mesh, checked
 *   carvel_channel    values at the corners of a mesh's faces, with seams
 *   (predict)         what a level will cost, before anything is built
 *   carvel_refiner    one-shot: faces and values of level n
 *   carvel_hierarchy  all levels, kept: values again and again, lineage
 *   carvel_stencils   rows of weights: the cheapest values of a fixed topology
 *   carvel_surface    the limit surface at any point, with derivatives
 *   carvel_search     its closest points, and where rays meet it
 *   carvel_tessellation  triangles within a tolerance of it
 *   carvel_mask       a scheme of polygons, and what is proved of it
 *   carvel_grid_mask  a scheme of grids, by any mask of two directions
 *   (catalogue)       the schemes of polygons that have names
 *
 * Each is made by a _create function, which hands it over to the caller, and
 * given back by its _destroy function; NULL may be destroyed. An object may be
 * destroyed as soon as no call that was given it is running: none keeps a
 * pointer to another one that you have to keep alive, nor to any memory of
 * yours but a context's `user_data`.
 *
 *
 * What holds for every function
 * =============================
 * Status     A function that can fail returns a carvel_status, 0 for success.
 *            Results go through pointers. On failure an object pointer is set
 *            to NULL; other outputs are untouched unless the function says
 *            otherwise. Nothing is ever printed, no call aborts on bad input.
 *
 * Errors     The last argument, `error`, may be NULL. Otherwise it is filled
 *            with what went wrong, and emptied by a call that succeeds. One that
 *            is misaligned is answered before anything else is looked at.
 *
 * Pointers   are checked for NULL and for alignment, sizes for what memory and
 *            indices can hold, before anything is read or written: NULL_POINTER,
 *            MISALIGNED, TOO_LARGE. Where a count is 0 its pointer is not
 *            followed. Whether memory is really there cannot be checked; a
 *            pointer to freed memory or to another kind of object is undefined
 *            behaviour, as everywhere in C.
 *
 * Counts     are uint64_t and count elements, never bytes. Strides count bytes.
 *            Vertex, corner and face indices are uint32_t, counted from 0. A
 *            host with int32_t indices passes them cast: a negative one is out
 *            of range and answered as such.
 *
 * Buffers    An output buffer is the caller's and comes with its capacity. One
 *            that is too small is refused before work starts; one that is
 *            larger is used from its start and the rest stays untouched. A
 *            counts query (carvel_mesh_counts, carvel_hierarchy_counts,
 *            carvel_predict_counts) tells the size. Outputs must not overlap
 *            inputs or each other; interleaved records of equal stride may lie
 *            between each other, but for those of carvel_stencils.
 *
 * Structs    that may grow start with `struct_size`, the size that the caller
 *            was compiled with, and have an _init function that takes it and
 *            sets defaults. Zero is the default of every field, so that a
 *            zeroed struct with `struct_size` set is the same. A smaller size
 *            that ends between two fields is read as an older version: the rest
 *            takes its default. One below 16 bytes is a mistake, and a larger
 *            one means that the library is older than the caller: both are
 *            refused with CARVEL_STATUS_STRUCT_SIZE.
 *
 * Values     live on vertices, or at the corners of faces where they differ
 *            between the faces of a vertex, such as texture coordinates with
 *            seams: carvel_channel.
 *
 * Numbers    Level n has the same vertices and faces, in the same order, from a
 *            refiner and in a hierarchy, whose meshes tell adjacency and edges.
 *
 * Again      To refine a result again, give its faces to carvel_mesh_create with
 *            carvel_mesh_desc.anchored as carvel_refine_output.anchored says, or
 *            its boundary is rounded off anew. The surface is the one that more
 *            levels at once give, numbered otherwise.
 *
 * Threads    A mesh, scheme, hierarchy, context, stencil table, surface, search, tessellation or
 *            mask may be used by any number of threads at once. A refiner serves one call at a time and answers
 *            CARVEL_STATUS_BUSY to another. An error belongs to one thread at
 *            a time. There is no global state that a caller could see, no
 *            hidden thread pool.
 *
 * Results    are the same bytes on every number of threads, on every processor
 *            and in every call.
 *
 * Defects    of the library itself are caught at this border: the call returns
 *            CARVEL_STATUS_PANIC and every object that it was given answers
 *            CARVEL_STATUS_POISONED from then on. Destroy them and go on; and
 *            please report it.
 *
 * Memory     Arrays that grow with the mesh are had from the system in a way
 *            that can fail: CARVEL_STATUS_OUT_OF_RESOURCES. Objects of a few
 *            hundred bytes are not, and a process that cannot have those ends.
 *
 * docs/abi.md, installed beside the licences, says what may change from version
 * to version.
 */
#ifndef CARVEL_H
#define CARVEL_H

#include <stdint.h>

#define CARVEL_VERSION_MAJOR 0
#define CARVEL_VERSION_MINOR 1
#define CARVEL_VERSION_PATCH 0
#define CARVEL_VERSION_STRING "0.1.0"
/* A number that orders: two digits each for minor and patch. */
#define CARVEL_VERSION \
    (CARVEL_VERSION_MAJOR * 10000 + CARVEL_VERSION_MINOR * 100 + CARVEL_VERSION_PATCH)

/* CARVEL_API marks what is stable; CARVEL_EXPERIMENTAL what may still change in
 * any version (docs/abi.md). Define CARVEL_STATIC before including this file to
 * link the static library on Windows. */
#if defined(_WIN32) && !defined(CARVEL_STATIC)
#define CARVEL_API __declspec(dllimport)
#else
#define CARVEL_API
#endif
#define CARVEL_EXPERIMENTAL CARVEL_API

#ifdef __cplusplus
extern "C" {
#endif

/* ==========================================================================
 * Version and status
 * ========================================================================== */

/* The version of the library that is running, such as "0.1.0". The string is
 * static. Compare with CARVEL_VERSION_STRING, which was compiled in. */
CARVEL_API const char *carvel_version(void);

/* The same as a number, like CARVEL_VERSION. */
CARVEL_API uint32_t carvel_version_number(void);

/* What a call came to: one of enum carvel_status_code. The numbers are never
 * changed or used again; later versions add to them. */
typedef int32_t carvel_status;

enum carvel_status_code {
    CARVEL_STATUS_OK = 0,

    /* Meshes. */
    /* A face names a vertex that does not exist. */
    CARVEL_STATUS_INDEX_OUT_OF_RANGE = 1,
    /* A face has fewer than three vertices. */
    CARVEL_STATUS_FACE_TOO_SMALL = 2,
    /* A vertex occurs twice in one face. */
    CARVEL_STATUS_REPEATED_VERTEX = 3,
    /* Two faces run through an edge in the same direction. */
    CARVEL_STATUS_INCONSISTENT_ORIENTATION = 4,
    /* More than two faces share an edge. */
    CARVEL_STATUS_NON_MANIFOLD_EDGE = 5,
    /* The faces around a vertex form more than one fan. */
    CARVEL_STATUS_NON_MANIFOLD_VERTEX = 6,
    /* A size does not fit the index type. */
    CARVEL_STATUS_TOO_LARGE = 7,
    /* A mesh marked anchored does not have the shape that a dual step leaves. */
    CARVEL_STATUS_NOT_ANCHORED = 8,
    /* A tag names an element that cannot carry it, or says what it cannot be. */
    CARVEL_STATUS_INVALID_TAG = 9,

    /* Data and parameters. */
    /* An array has another length than the mesh asks for. */
    CARVEL_STATUS_LENGTH_MISMATCH = 10,
    /* A coordinate is NaN or infinite. */
    CARVEL_STATUS_NOT_FINITE = 11,
    /* A finite coordinate left the range of the number type on the way. */
    CARVEL_STATUS_OVERFLOW = 12,
    /* A parameter lies outside its documented range. */
    CARVEL_STATUS_PARAMETER_OUT_OF_RANGE = 13,
    /* A fraction has the denominator 0, or a term that cannot be negated. */
    CARVEL_STATUS_INVALID_NUMBER = 14,

    /* Resources. */
    /* The work would need more memory than the context's ceiling allows. */
    CARVEL_STATUS_MEMORY_CEILING = 15,
    /* The system refused memory or threads. */
    CARVEL_STATUS_OUT_OF_RESOURCES = 16,
    /* The progress callback or carvel_context_cancel asked to stop. */
    CARVEL_STATUS_CANCELLED = 17,

    /* Files. */
    /* A file could not be opened, read or written. */
    CARVEL_STATUS_IO = 18,
    /* A file is cut off, changed, or another kind of file. */
    CARVEL_STATUS_SYNTAX = 19,
    /* A scheme has no rule for what it was given. The C++ layer answers this, too,
     * for what it cannot take from another library. */
    CARVEL_STATUS_UNSUPPORTED = 20,

    /* A stored invariant does not hold: a defect of the library. */
    CARVEL_STATUS_BROKEN_INVARIANT = 21,

    /* Calls. */
    /* A pointer that is needed is NULL. */
    CARVEL_STATUS_NULL_POINTER = 101,
    /* A pointer or a stride is not a multiple of its type's alignment. */
    CARVEL_STATUS_MISALIGNED = 102,
    /* An output overlaps an input or another output. */
    CARVEL_STATUS_OVERLAP = 103,
    /* A struct_size is one that this version of the library does not know. */
    CARVEL_STATUS_STRUCT_SIZE = 104,
    /* An output buffer holds fewer elements than are to be written. */
    CARVEL_STATUS_BUFFER_TOO_SMALL = 105,
    /* A stride is smaller than the record that it steps over. */
    CARVEL_STATUS_INVALID_STRIDE = 106,
    /* The refiner is at work for another thread. */
    CARVEL_STATUS_BUSY = 107,
    /* A defect of the library was caught in this call. */
    CARVEL_STATUS_PANIC = 108,
    /* A defect was caught in an earlier call with this object. */
    CARVEL_STATUS_POISONED = 109
};

/* A status in a few English words, a static string; "unknown status" for
 * numbers that this version does not have. Any thread, no cost. */
CARVEL_API const char *carvel_status_string(carvel_status status);

/* ==========================================================================
 * carvel_error: why a call failed
 *
 * Made once, passed to any number of calls, one thread at a time. It holds a
 * status, a message of one line, and a list of entries: every defect of a mesh
 * that was refused, otherwise the failure itself. Entries name elements.
 * Strings from an error are valid until the next call that fills it, as its last
 * argument. Every function below looks things up; none costs more than its result.
 * Where `error` may be NULL the functions answer as for an empty error.
 * ========================================================================== */

typedef struct carvel_error carvel_error;

enum carvel_element_kind {
    /* A vertex: `index`. */
    CARVEL_ELEMENT_VERTEX = 1,
    /* A face, in the order of the call's own arrays: `index`. */
    CARVEL_ELEMENT_FACE = 2,
    /* An edge: its vertices `index` and `second`. */
    CARVEL_ELEMENT_EDGE = 3,
    /* A line of a file, counted from 1: `index`. */
    CARVEL_ELEMENT_LINE = 4,
    /* A byte of a file: `index`. */
    CARVEL_ELEMENT_BYTE = 5
};

/* An element that an error speaks of. The layout is final. */
typedef struct carvel_element {
    /* One of enum carvel_element_kind; 0 if there is no such element. */
    uint64_t kind;
    uint64_t index;
    uint64_t second;
} carvel_element;

/* Makes an empty error.
 * out: receives the error; must not be NULL.
 * Errors: NULL_POINTER, MISALIGNED. */
CARVEL_API carvel_status carvel_error_create(carvel_error **out);

/* Destroys an error and the strings had from it; NULL is allowed. */
CARVEL_API void carvel_error_destroy(carvel_error *error);

/* The status of the last call that was given this error; OK for NULL. */
CARVEL_API carvel_status carvel_error_status(const carvel_error *error);

/* One line for people, UTF-8, naming elements; "" after success and for NULL. */
CARVEL_API const char *carvel_error_message(const carvel_error *error);

/* The number of entries: 0 after success, otherwise at least 1. */
CARVEL_API uint64_t carvel_error_entry_count(const carvel_error *error);

/* The status of an entry; OK if there is no such entry. */
CARVEL_API carvel_status carvel_error_entry_status(const carvel_error *error, uint64_t entry);

/* The message of an entry, made when asked for: valid until the next call of this
 * function with this error, too. "" if there is no such entry. */
CARVEL_API const char *carvel_error_entry_message(carvel_error *error, uint64_t entry);

/* The number of elements that an entry names: the vertex or the edge first,
 * then the faces. 0 if there is no such entry. */
CARVEL_API uint64_t carvel_error_element_count(const carvel_error *error, uint64_t entry);

/* An element of an entry; kind 0 if there is no such element. */
CARVEL_API carvel_element carvel_error_element(const carvel_error *error, uint64_t entry,
                                               uint64_t element);

/* ==========================================================================
 * carvel_context: threads, memory ceiling, progress, cancellation
 *
 * A context owns its threads and is worth keeping: starting threads costs more
 * than a small job. Wherever a context is asked for, NULL means the calling
 * thread alone, no ceiling, no callback.
 * ========================================================================== */

typedef struct carvel_context carvel_context;

/* Told how much of a call is done, from 0 to 1, on the thread that made the
 * call; a non-zero answer cancels it, the last one too. carvel_refiner_refine,
 * carvel_hierarchy_create and carvel_hierarchy_refine call it when work begins,
 * after each level, and between the faces and the values of the last; other
 * calls, and the work in between, notice carvel_context_cancel only. Calls
 * that run at the same time with one context report each from its own thread.
 * It must return: throwing a C++ exception or longjmp out of it is
 * undefined behaviour. It must not call functions with the objects that the
 * running call writes to, nor destroy any that it was given. */
typedef int32_t (*carvel_progress)(double done, void *user_data);

typedef struct carvel_context_desc {
    /* sizeof(carvel_context_desc). */
    uint32_t struct_size;
    /* Threads to use, at most 1024: 0 for all cores, 1 for the calling thread
     * alone. */
    uint32_t thread_count;
    /* Bytes that one call may allocate in all, as predicted before it does; the
     * caller's own buffers are not counted. 0 for no ceiling. */
    uint64_t memory_ceiling;
    /* May be NULL. */
    carvel_progress progress;
    /* Handed to `progress`; never looked at. */
    void *user_data;
} carvel_context_desc;

/* Sets defaults: all cores, no ceiling, no callback.
 * desc: not NULL. struct_size: sizeof *desc.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_context_desc_init(carvel_context_desc *desc,
                                                  uint32_t struct_size);

/* Makes a context and starts its threads.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for more
 * than 1024 threads; OUT_OF_RESOURCES if the system refuses them. */
CARVEL_API carvel_status carvel_context_create(const carvel_context_desc *desc,
                                               carvel_context **out, carvel_error *error);

/* Ends the threads and destroys the context; NULL is allowed. No call may be
 * running with it. */
CARVEL_API void carvel_context_destroy(carvel_context *context);

/* The number of threads that work is spread over; 1 for NULL. */
CARVEL_API uint32_t carvel_context_thread_count(const carvel_context *context);

/* Asks the calls running with this context to stop. They return CANCELLED soon,
 * and so does every later call, until carvel_context_reset. Any thread may ask,
 * at any time; so may a signal handler. NULL is ignored. */
CARVEL_API void carvel_context_cancel(carvel_context *context);

/* Takes the request back. Any thread. NULL is ignored. */
CARVEL_API void carvel_context_reset(carvel_context *context);

/* 1 once a stop was asked for, otherwise 0. Any thread. */
CARVEL_API int32_t carvel_context_is_cancelled(const carvel_context *context);

/* ==========================================================================
 * carvel_scheme: a subdivision scheme with its parameters
 * ========================================================================== */

typedef struct carvel_scheme carvel_scheme;

/* An exact number. Denominators are not 0, and no term is INT64_MIN. The layout
 * is final. */
typedef struct carvel_fraction {
    int64_t numerator;
    int64_t denominator;
} carvel_fraction;

/* A step of a scheme splits every face in one of three ways:
 *   corner     dual: a new vertex for every corner of a face;
 *   quad       primal: a quad for every corner, about the middle of the face;
 *   triangle   primal: four triangles for every triangle. */
enum carvel_scheme_family {
    /* Doo and Sabin 1978: biquadratic B-splines, C1. Corner split. */
    CARVEL_SCHEME_DOO_SABIN = 0,
    /* The three-point family, univariate mask [w, 1/4+w, 3/4-2w, ...]; C2 for
     * w = 1/32. Corner split. */
    CARVEL_SCHEME_THREE_POINT = 1,
    /* Tensor-product quartic B-splines, C3. Corner split. */
    CARVEL_SCHEME_QUARTIC = 2,
    /* Tensor-product B-splines of any degree: corner split for an even one, quad
     * split for an odd one. Degree 3 is Catmull and Clark's scheme on regular
     * meshes alone. */
    CARVEL_SCHEME_B_SPLINE = 3,
    /* The corner split followed by any list of smoothing passes M_t. */
    CARVEL_SCHEME_AVERAGING = 4,
    /* Catmull and Clark 1978: bicubic B-splines, C2 but at extraordinary vertices;
     * OpenSubdiv's SCHEME_CATMARK. Quad split. Heeds creases and sharp vertices. */
    CARVEL_SCHEME_CATMULL_CLARK = 5,
    /* Loop 1987: quartic box splines, C2 but at extraordinary vertices; OpenSubdiv's
     * SCHEME_LOOP. Triangle split: every face must be a triangle. Heeds creases
     * and sharp vertices. */
    CARVEL_SCHEME_LOOP = 6,
    /* Midpoints of edges and means of faces, nothing is smoothed; OpenSubdiv's
     * SCHEME_BILINEAR. Quad split. */
    CARVEL_SCHEME_BILINEAR = 7,
    /* The quad split followed by any list of smoothing passes M_t. */
    CARVEL_SCHEME_PRIMAL = 8
};

/* Which corner operator smoothing passes use on n-gons that are no quads. For the
 * families that average: not CATMULL_CLARK, LOOP and BILINEAR. */
enum carvel_corner_rule {
    /* Doo and Sabin's cosine weights. */
    CARVEL_CORNER_RULE_COSINE = 0,
    /* Mean of vertex, edge midpoints and centroid (Catmull and Clark 1978). */
    CARVEL_CORNER_RULE_AVERAGE = 1
};

/* What happens along a boundary, in OpenSubdiv's vocabulary; its own default is
 * NONE. BILINEAR, PRIMAL and B-splines of odd degree do the same in all three:
 * the boundary is the univariate curve of the boundary polygon. */
enum carvel_boundary {
    /* The boundary curve is the univariate curve of the boundary polygon;
     * tagged corners and vertices with a single face are interpolated.
     * VTX_BOUNDARY_EDGE_AND_CORNER. */
    CARVEL_BOUNDARY_EDGE_AND_CORNER = 0,
    /* The same, but only tagged corners are interpolated. VTX_BOUNDARY_EDGE_ONLY. */
    CARVEL_BOUNDARY_EDGE = 1,
    /* Corner split: no added points, the surface ends half a cell inside.
     * CATMULL_CLARK and LOOP: every face at a boundary vertex is a hole, see
     * carvel_scheme_holes; it is refined all the same. VTX_BOUNDARY_NONE. */
    CARVEL_BOUNDARY_NONE = 2
};

/* What a step leaves of the sharpness of a semi-sharp crease. */
enum carvel_creasing {
    /* One less. CREASE_UNIFORM. */
    CARVEL_CREASING_UNIFORM = 0,
    /* One less than three quarters of its own and one quarter of the mean of the
     * other semi-sharp edges at that end, so that sharpness varies smoothly along
     * a crease. CREASE_CHAIKIN. */
    CARVEL_CREASING_CHAIKIN = 1
};

/* What Catmull and Clark's scheme does with the triangles of a control mesh. */
enum carvel_triangle_rule {
    /* The same as with other faces. TRI_SUB_CATMARK. */
    CARVEL_TRIANGLE_RULE_CATMULL_CLARK = 0,
    /* Other weights on edges beside triangles. TRI_SUB_SMOOTH. */
    CARVEL_TRIANGLE_RULE_SMOOTH = 1
};

/* The weight b of each neighbour of an interior vertex in Loop's scheme, by the
 * vertex's valence n. */
enum carvel_loop_weights {
    /* Loop's own, which OpenSubdiv has: (5/8 - (3/8 + cos(2 pi/n)/4)^2) / n. */
    CARVEL_LOOP_WEIGHTS_LOOP = 0,
    /* Warren's: 3/(8 n), and 3/16 for n = 3. */
    CARVEL_LOOP_WEIGHTS_WARREN = 1
};

/* What THREE_POINT with w = 1/32 does around faces that are no quads. */
enum carvel_extraordinary {
    /* Split and pass, as everywhere: curvature grows or vanishes in the middle. */
    CARVEL_EXTRAORDINARY_DEFAULT = 0,
    /* Stencils that keep the curvature bounded and away from zero, around faces of 3
     * to 32 sides, at interior vertices of valence 4 without a second such face. They
     * count from the second step on: in the first one only on a mesh that is marked
     * anchored. The step of a hierarchy is then one stage, see carvel_hierarchy_rows. */
    CARVEL_EXTRAORDINARY_TUNED = 1
};

typedef struct carvel_scheme_desc {
    /* sizeof(carvel_scheme_desc). */
    uint32_t struct_size;
    /* One of enum carvel_scheme_family. */
    int32_t family;
    /* Families that average only: one of enum carvel_corner_rule. */
    int32_t corner_rule;
    /* One of enum carvel_boundary. */
    int32_t boundary;
    /* THREE_POINT only: the parameter, 0 <= w <= 1/16; 0/0 for 1/32. */
    carvel_fraction w;
    /* B_SPLINE only: the degree, 1 to 65. */
    uint64_t degree;
    /* AVERAGING and PRIMAL only: the passes, in order, |t| <= 1000, at most 64. */
    const carvel_fraction *passes;
    uint64_t pass_count;
    /* CATMULL_CLARK and LOOP only: one of enum carvel_creasing. */
    int32_t creasing;
    /* CATMULL_CLARK only: one of enum carvel_triangle_rule. */
    int32_t triangle_rule;
    /* LOOP only: one of enum carvel_loop_weights. */
    int32_t loop_weights;
    /* THREE_POINT only: one of enum carvel_extraordinary; TUNED for w = 1/32 alone. */
    int32_t extraordinary;
} carvel_scheme_desc;

/* Sets defaults: Doo-Sabin, cosine, edge and corner, uniform creasing.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_scheme_desc_init(carvel_scheme_desc *desc,
                                                 uint32_t struct_size);

/* Makes a scheme. A field that belongs to another family must have its default.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE, PARAMETER_OUT_OF_RANGE,
 * INVALID_NUMBER for a fraction, UNSUPPORTED for TUNED with another w. No cost to speak
 * of. */
CARVEL_API carvel_status carvel_scheme_create(const carvel_scheme_desc *desc,
                                              carvel_scheme **out, carvel_error *error);

/* Destroys a scheme; NULL is allowed. */
CARVEL_API void carvel_scheme_destroy(carvel_scheme *scheme);

/* The smoothing passes that the scheme comes down to, in lowest terms; none for
 * CATMULL_CLARK, LOOP and BILINEAR.
 * out: `capacity` fractions; may be NULL if capacity is 0.
 * count: receives the number of passes, at most 64, also if the buffer is too
 * small: a first call with capacity 0 asks. May be NULL.
 * Errors: NULL_POINTER, MISALIGNED, BUFFER_TOO_SMALL (not for capacity 0). */
CARVEL_API carvel_status carvel_scheme_passes(const carvel_scheme *scheme, carvel_fraction *out,
                                              uint64_t capacity, uint64_t *count,
                                              carvel_error *error);

/* The faces of a mesh, ascending in its own order, that are holes under a scheme:
 * those tagged as such and, for CATMULL_CLARK and LOOP with boundary NONE, all
 * those at a boundary vertex. Holes are refined like other faces and their
 * children are in every result; what is drawn leaves out each refined face whose
 * control face (carvel_refine_output.face_sources) is one.
 * out: `capacity` faces; may be NULL if capacity is 0.
 * count: receives the number of holes, also if the buffer is too small: a first
 * call with capacity 0 asks. May be NULL. O(boundary and holes).
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL (not for capacity 0),
 * OUT_OF_RESOURCES. */
struct carvel_mesh;
CARVEL_API carvel_status carvel_scheme_holes(const carvel_scheme *scheme,
                                             const struct carvel_mesh *mesh, uint32_t *out,
                                             uint64_t capacity, uint64_t *count,
                                             carvel_error *error);

/* ==========================================================================
 * carvel_mesh: the topology of a mesh, checked
 *
 * An orientable 2-manifold of polygons (or, under CARVEL_NON_MANIFOLD_SHARPEN,
 * what comes near to one), closed or with boundary, of any number of components;
 * no positions. Corners are the places of the concatenated
 * face-vertex array. Faces that are no quads come first (no triangles, in a mesh
 * of triangles alone) and keep the caller's order within that rule, unless a
 * large mesh comes in no order at all and is put in one; carvel_mesh_face_sources
 * leads back. Vertices keep their numbers.
 * ========================================================================== */

typedef struct carvel_mesh carvel_mesh;

/* What to do with edges of more than two faces or of faces that run through
 * them in the same direction, and vertices of more than one fan. */
enum carvel_non_manifold {
    /* Refuse the mesh. */
    CARVEL_NON_MANIFOLD_REFUSE = 0,
    /* Make every face side at such an edge a boundary edge, and give every extra
     * fan of a vertex its own copy of it; carvel_mesh_vertex_sources tells. */
    CARVEL_NON_MANIFOLD_CUT = 1,
    /* Keep them as they are, infinitely sharp, as OpenSubdiv does: an edge is one
     * for all its faces. So are their vertices, but for those that just two such
     * edges and no boundary meet at, which form a crease. For CATMULL_CLARK, LOOP
     * and linear refinement; other schemes answer UNSUPPORTED. */
    CARVEL_NON_MANIFOLD_SHARPEN = 2
};

/* Faces as the caller has them, in one of three layouts:
 *   face_sizes    the size of every face (USD, OpenSubdiv);
 *   face_offsets  the first corner of every face, and the number of corners as
 *                 the last entry, face_count + 1 in all (VTK, Blender);
 *   face_size     one size for all faces, and no array.
 * Exactly one is given, its pointer being what tells; for no faces it may be none.
 * The arrays are read where they are; face_sizes costs no
 * copy, the other two one of 4 bytes for each face while the mesh is built. */
typedef struct carvel_mesh_desc {
    /* sizeof(carvel_mesh_desc). */
    uint32_t struct_size;
    /* Vertices of every face, or 0. */
    uint32_t face_size;
    uint64_t vertex_count;
    uint64_t face_count;
    /* face_count entries, or NULL. */
    const uint32_t *face_sizes;
    /* face_count + 1 entries, the first 0, none below the one before, or NULL. */
    const uint32_t *face_offsets;
    /* The vertices of all faces, counter-clockwise seen from outside. */
    const uint32_t *face_vertices;
    /* Their number: the sum of the sizes, below 2^32 - 1. */
    uint64_t face_vertex_count;
    /* One of enum carvel_non_manifold. */
    int32_t non_manifold;
    /* 1 if the mesh is the result of a corner split with a boundary rule other
     * than NONE (a further step must not round its boundary off again),
     * otherwise 0. */
    int32_t anchored;
    /* Boundary vertices to interpolate although they have several faces. */
    const uint32_t *corner_tags;
    uint64_t corner_tag_count;
    /* Creases, edges that subdivision keeps sharp: the two vertices of each in
     * either order, 2 * crease_count entries, and its sharpness, crease_count.
     *
     * Sharpness, of creases and of vertices, is a number from 0 up. It counts
     * steps: each takes 1 off (see enum carvel_creasing), and what is left of a
     * last fraction blends the sharp and the smooth rule. 0 is smooth; 10 and more
     * never ends. The boundary is infinitely sharp without being told, and what
     * is said of its edges is not kept. */
    const uint32_t *crease_vertices;
    const float *crease_sharpness;
    uint64_t crease_count;
    /* Sharp vertices and the sharpness of each. One that never ends is
     * interpolated: a corner, inside or on the boundary. */
    const uint32_t *sharp_vertices;
    const float *vertex_sharpness;
    uint64_t sharp_vertex_count;
    /* Faces, in the order of these arrays, that are refined but left out of what
     * is drawn: see carvel_scheme_holes. */
    const uint32_t *holes;
    uint64_t hole_count;
} carvel_mesh_desc;

/* Sets defaults: no faces, refuse what is not manifold, not anchored, no tags, no
 * creases, no sharp vertices, no holes.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_mesh_desc_init(carvel_mesh_desc *desc, uint32_t struct_size);

/* Builds a mesh; O(corners), and O(n log n) in the tags. A mesh without faces or
 * vertices is allowed. Copies of vertices are as sharp as their sources.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for an
 * unknown policy, for `anchored` other than 0 and 1, for no layout or for several,
 * and for offsets that fall or do not begin at 0;
 * LENGTH_MISMATCH, TOO_LARGE; INDEX_OUT_OF_RANGE to NON_MANIFOLD_VERTEX for the
 * first defect, with all of them as entries of the error; NOT_ANCHORED;
 * INVALID_TAG for a tag, crease, sharp vertex or hole that names no such element, a
 * sharpness that is negative or NaN, and two sharpnesses of one element;
 * MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_mesh_create(const carvel_context *context,
                                            const carvel_mesh_desc *desc, carvel_mesh **out,
                                            carvel_error *error);

/* Destroys a mesh; NULL is allowed. */
CARVEL_API void carvel_mesh_destroy(carvel_mesh *mesh);

/* Sizes of a mesh or of a level. */
typedef struct carvel_counts {
    /* sizeof(carvel_counts). */
    uint32_t struct_size;
    /* The level that the counts belong to; 0 for a mesh. */
    uint32_t level;
    /* Vertices, isolated ones included. */
    uint64_t vertices;
    uint64_t faces;
    /* The sum of the face sizes. */
    uint64_t corners;
    uint64_t edges;
    /* Edges with one face only. */
    uint64_t boundary_edges;
    /* Faces at the front that are no quads (no triangles, in a mesh of triangles
     * alone). */
    uint64_t irregular_faces;
} carvel_counts;

/* Prepares the struct for a counts query.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_counts_init(carvel_counts *counts, uint32_t struct_size);

/* The sizes of a mesh; counts->struct_size must be set. No cost.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_mesh_counts(const carvel_mesh *mesh, carvel_counts *counts,
                                            carvel_error *error);

/* What a mesh is like. */
typedef struct carvel_survey {
    /* sizeof(carvel_survey). */
    uint32_t struct_size;
    /* 1 if a dual scheme's anchor row lies along the boundary already. */
    int32_t anchored;
    /* Connected components, isolated vertices not counted. */
    uint64_t components;
    uint64_t boundary_loops;
    /* Vertices without a face. */
    uint64_t isolated_vertices;
    /* V - E + F, isolated vertices not counted. */
    int64_t euler_characteristic;
    /* Tagged corners, those of copies included. */
    uint64_t corner_tags;
    /* Bytes held by the topology. */
    uint64_t bytes;
    /* Sharp edges that are not on the boundary. */
    uint64_t creases;
    /* Sharp vertices, those of copies and those of SHARPEN included. */
    uint64_t sharp_vertices;
    /* Faces tagged as holes; in a refined level those that descend from a hole. */
    uint64_t holes;
} carvel_survey;

/* Prepares the struct for a survey.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_survey_init(carvel_survey *survey, uint32_t struct_size);

/* Looks at the whole mesh once, O(corners); survey->struct_size must be set.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE, OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_mesh_survey(const carvel_mesh *mesh, carvel_survey *survey,
                                            carvel_error *error);

/* What a histogram counts. */
enum carvel_histogram {
    /* Faces by size. */
    CARVEL_HISTOGRAM_FACE_SIZES = 1,
    /* Interior vertices by number of faces. */
    CARVEL_HISTOGRAM_INTERIOR_VALENCES = 2,
    /* Boundary vertices by number of faces. */
    CARVEL_HISTOGRAM_BOUNDARY_VALENCES = 3
};

/* A histogram: `count` elements have `value`. The layout is final. */
typedef struct carvel_histogram_entry {
    uint64_t value;
    uint64_t count;
} carvel_histogram_entry;

/* A histogram by ascending value, without empty entries; O(corners).
 * which: one of enum carvel_histogram.
 * out: `capacity` entries; may be NULL if capacity is 0.
 * count: receives the number of entries, also if the buffer is too small: a
 * first call with capacity 0 asks. May be NULL.
 * Errors: NULL_POINTER, MISALIGNED, PARAMETER_OUT_OF_RANGE, BUFFER_TOO_SMALL
 * (not for capacity 0), OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_mesh_histogram(const carvel_mesh *mesh, int32_t which,
                                               carvel_histogram_entry *out, uint64_t capacity,
                                               uint64_t *count, carvel_error *error);

/* The arrays of a mesh. Each function fills a caller's buffer of `capacity`
 * entries; the number written is given below in terms of carvel_counts.
 * Errors: NULL_POINTER, MISALIGNED, TOO_LARGE, BUFFER_TOO_SMALL. Linear cost. */

/* The size of every face: `faces` entries. */
CARVEL_API carvel_status carvel_mesh_face_sizes(const carvel_mesh *mesh, uint32_t *out,
                                                uint64_t capacity, carvel_error *error);

/* The first corner of every face, and the number of corners: `faces` + 1. */
CARVEL_API carvel_status carvel_mesh_face_offsets(const carvel_mesh *mesh, uint32_t *out,
                                                  uint64_t capacity, carvel_error *error);

/* The vertex of every corner, counter-clockwise: `corners`. */
CARVEL_API carvel_status carvel_mesh_face_vertices(const carvel_mesh *mesh, uint32_t *out,
                                                   uint64_t capacity, carvel_error *error);

/* The two vertices of every edge: 2 * `edges`. Edges are numbered by their
 * first corner. */
CARVEL_API carvel_status carvel_mesh_edges(const carvel_mesh *mesh, uint32_t *out,
                                           uint64_t capacity, carvel_error *error);

/* The edge from every corner to the next one of its face: `corners`. */
CARVEL_API carvel_status carvel_mesh_corner_edges(const carvel_mesh *mesh, uint32_t *out,
                                                  uint64_t capacity, carvel_error *error);

/* The corner across that edge: `corners`. UINT32_MAX on a boundary, and where
 * CARVEL_NON_MANIFOLD_SHARPEN has kept an edge that is not manifold. */
CARVEL_API carvel_status carvel_mesh_corner_twins(const carvel_mesh *mesh, uint32_t *out,
                                                  uint64_t capacity, carvel_error *error);

/* The number of faces around every vertex: `vertices`. */
CARVEL_API carvel_status carvel_mesh_valences(const carvel_mesh *mesh, uint32_t *out,
                                              uint64_t capacity, carvel_error *error);

/* 1 for every vertex on a boundary or on an edge that is not manifold, otherwise 0:
 * `vertices`. */
CARVEL_API carvel_status carvel_mesh_boundary_flags(const carvel_mesh *mesh, uint8_t *out,
                                                    uint64_t capacity, carvel_error *error);

/* The face of the caller's arrays that became each face: `faces`. For the mesh
 * of a refined level every face is its own source. */
CARVEL_API carvel_status carvel_mesh_face_sources(const carvel_mesh *mesh, uint32_t *out,
                                                  uint64_t capacity, carvel_error *error);

/* The caller's vertex that each vertex is or is a copy of (CARVEL_NON_MANIFOLD_CUT
 * copies; the copies come last): `vertices`. Positions for the mesh are those of
 * the sources. */
CARVEL_API carvel_status carvel_mesh_vertex_sources(const carvel_mesh *mesh, uint32_t *out,
                                                    uint64_t capacity, carvel_error *error);

/* The tagged corner vertices, ascending: `corner_tags` of carvel_survey. */
CARVEL_API carvel_status carvel_mesh_corner_tags(const carvel_mesh *mesh, uint32_t *out,
                                                 uint64_t capacity, carvel_error *error);

/* The creases, by the two vertices of each: 2 * `creases` of carvel_survey; and
 * their sharpness, above 0 and at most 10: `creases`. For the mesh of a refined
 * level, what is left there. */
CARVEL_API carvel_status carvel_mesh_crease_vertices(const carvel_mesh *mesh, uint32_t *out,
                                                     uint64_t capacity, carvel_error *error);
CARVEL_API carvel_status carvel_mesh_crease_sharpness(const carvel_mesh *mesh, float *out,
                                                      uint64_t capacity, carvel_error *error);

/* The sharp vertices, ascending, and their sharpness: `sharp_vertices` of
 * carvel_survey. */
CARVEL_API carvel_status carvel_mesh_sharp_vertices(const carvel_mesh *mesh, uint32_t *out,
                                                    uint64_t capacity, carvel_error *error);
CARVEL_API carvel_status carvel_mesh_vertex_sharpness(const carvel_mesh *mesh, float *out,
                                                      uint64_t capacity, carvel_error *error);

/* The faces tagged as holes, in the mesh's order, ascending: `holes` of
 * carvel_survey. carvel_scheme_holes adds what a scheme makes holes of. */
CARVEL_API carvel_status carvel_mesh_holes(const carvel_mesh *mesh, uint32_t *out,
                                           uint64_t capacity, carvel_error *error);

/* 1 if every edge has at most two faces, which agree in orientation, and the faces
 * around every vertex form one fan; 0 if CARVEL_NON_MANIFOLD_SHARPEN has kept
 * something else, and for NULL. No cost. */
CARVEL_API int32_t carvel_mesh_is_manifold(const carvel_mesh *mesh);

/* Checks every stored invariant; O(corners).
 * Errors: NULL_POINTER, MISALIGNED, OUT_OF_RESOURCES; BROKEN_INVARIANT is a defect
 * of the library. */
CARVEL_API carvel_status carvel_mesh_validate(const carvel_mesh *mesh, carvel_error *error);

/* ==========================================================================
 * carvel_channel: values at the corners of a mesh's faces, with seams
 *
 * Says which value each corner of a mesh takes; the values themselves come with
 * each refinement. Corners of one vertex that take the same value share it. Where
 * the faces beside an edge take different values at either end, the edge is a
 * seam, in the input and at every level. For CATMULL_CLARK, LOOP and BILINEAR;
 * the other families answer UNSUPPORTED. Immutable and shared freely. OpenSubdiv
 * calls this a face-varying channel.
 * ========================================================================== */

typedef struct carvel_channel carvel_channel;

/* How smooth values are along the boundaries of a channel: its seams, and the
 * boundary of the mesh. Elsewhere they follow the scheme's own rows. OpenSubdiv's
 * names; its own default is ALL. */
enum carvel_face_varying {
    /* Boundaries are smooth curves, but values of a single face stay.
     * FVAR_LINEAR_CORNERS_ONLY. */
    CARVEL_FACE_VARYING_CORNERS = 0,
    /* Corners are rounded off, too, but for those that the scheme keeps as vertices.
     * FVAR_LINEAR_NONE. */
    CARVEL_FACE_VARYING_SMOOTH = 1,
    /* As CORNERS, and values stay where three and more meet at a vertex, or where
     * one of two is not one piece. FVAR_LINEAR_CORNERS_PLUS1. */
    CARVEL_FACE_VARYING_CORNERS_PLUS1 = 2,
    /* And at the ends of seams, and both where one of two is of a single face.
     * FVAR_LINEAR_CORNERS_PLUS2. */
    CARVEL_FACE_VARYING_CORNERS_PLUS2 = 3,
    /* Boundaries are refined linearly. FVAR_LINEAR_BOUNDARIES. */
    CARVEL_FACE_VARYING_BOUNDARIES = 4,
    /* Everything is refined linearly. FVAR_LINEAR_ALL. */
    CARVEL_FACE_VARYING_ALL = 5
};

typedef struct carvel_channel_desc {
    /* sizeof(carvel_channel_desc). */
    uint32_t struct_size;
    /* One of enum carvel_face_varying. */
    int32_t mode;
    /* The value of every corner, in the order of the arrays that the mesh was made
     * of; for the mesh of a refined level, in its own. */
    const uint32_t *indices;
    /* Their number: the mesh's `corners`. */
    uint64_t index_count;
    /* The number of values; some may be taken by no corner. */
    uint64_t value_count;
} carvel_channel_desc;

/* Sets defaults: no corners, corners stay.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_channel_desc_init(carvel_channel_desc *desc,
                                                  uint32_t struct_size);

/* Makes a channel for a mesh, which is shared, not copied, and may be destroyed.
 * O(corners).
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for an
 * unknown mode; LENGTH_MISMATCH unless there is one index for each corner;
 * INDEX_OUT_OF_RANGE for one that is no value, naming the face in the order of
 * `indices`; TOO_LARGE, OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_channel_create(const carvel_mesh *mesh,
                                               const carvel_channel_desc *desc,
                                               carvel_channel **out, carvel_error *error);

/* Destroys a channel; NULL is allowed. */
CARVEL_API void carvel_channel_destroy(carvel_channel *channel);

/* The number of edges inside the mesh that are seams; 0 for NULL. O(corners). */
CARVEL_API uint64_t carvel_channel_seam_edges(const carvel_channel *channel);

/* ==========================================================================
 * Predictions: what a level will cost, before anything is built
 * ========================================================================== */

/* Bytes that a refinement needs. All stop at UINT64_MAX. */
typedef struct carvel_bytes {
    /* sizeof(carvel_bytes). */
    uint32_t struct_size;
    /* The level that was asked for. */
    uint32_t level;
    /* The adjacency of levels 1 to `level` in a carvel_hierarchy. */
    uint64_t topology;
    /* Scratch memory of a refiner while it writes that level, without what
     * face_sources (4 bytes for each face of all levels), records with gaps
     * (a copy of them) and channels take. */
    uint64_t scratch;
    /* Faces (sizes and vertices) and values of that level. */
    uint64_t output;
} carvel_bytes;

/* Prepares the struct for a prediction.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_bytes_init(carvel_bytes *bytes, uint32_t struct_size);

/* The counts of a level under a scheme; counts->struct_size must be set. Costs a
 * look at the boundary and the irregular vertices.
 * level: 0 to 64; the counts may exceed what 32-bit indices can hold.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; TOO_LARGE if a count leaves 64
 * bits, and for more than 64 levels; UNSUPPORTED for a mesh that the scheme has no
 * rule for: LOOP on a face that is no triangle, which the error names; sharp
 * features, or edges and vertices that are not manifold, under a scheme that does
 * not heed them; OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_predict_counts(const carvel_mesh *mesh,
                                               const carvel_scheme *scheme, uint32_t level,
                                               carvel_counts *counts, carvel_error *error);

/* The bytes of refining to a level; bytes->struct_size must be set.
 * width: values for each vertex, the 3 coordinates and all attributes together,
 * 1 to 65536.
 * value_size: 4 for f32, 8 for f64.
 * Errors: as carvel_predict_counts, and PARAMETER_OUT_OF_RANGE. */
CARVEL_API carvel_status carvel_predict_bytes(const carvel_mesh *mesh,
                                              const carvel_scheme *scheme, uint32_t level,
                                              uint32_t width, uint32_t value_size,
                                              carvel_bytes *bytes, carvel_error *error);

/* What a refinement is estimated to take: seconds of wall time for a carvel_refiner that
 * writes faces and values of one level. Within a factor of two (of three for schemes with
 * smoothing passes), from 10000 faces on, on the machine that the constants were measured on (src/hierarchy/cost.rs); a machine of
 * another speed scales all of them. All are finite and not negative. */
typedef struct carvel_seconds {
    /* sizeof(carvel_seconds). */
    uint32_t struct_size;
    /* The level that was asked for. */
    uint32_t level;
    /* Levels that are done one after the other. */
    double steps;
    /* The last levels, where they are done in one step. */
    double last;
    /* Touching fresh memory, the result's and scratch; a call with a refiner and into
     * arrays that were used before does without. */
    double memory;
    /* All of it. */
    double total;
} carvel_seconds;

/* Prepares the struct for a prediction.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_seconds_init(carvel_seconds *seconds, uint32_t struct_size);

/* The time of refining to a level; seconds->struct_size must be set. Costs as
 * carvel_predict_counts.
 * width, value_size: as carvel_predict_bytes.
 * threads: of the context, 1 to 1024; each is taken to have a processor of its own.
 * Errors: as carvel_predict_bytes. */
CARVEL_API carvel_status carvel_predict_seconds(const carvel_mesh *mesh,
                                                const carvel_scheme *scheme, uint32_t level,
                                                uint32_t width, uint32_t value_size,
                                                uint32_t threads, carvel_seconds *seconds,
                                                carvel_error *error);

/* The number of values that a channel has at a level under a scheme; those of level
 * 0 are the caller's. Costs as carvel_predict_counts.
 * values: receives the number; not NULL.
 * Errors: NULL_POINTER, MISALIGNED; TOO_LARGE as carvel_predict_counts; UNSUPPORTED
 * for a scheme without rules for channels, but at level 0; OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_predict_channel(const carvel_channel *channel,
                                                const carvel_scheme *scheme, uint32_t level,
                                                uint64_t *values, carvel_error *error);

/* ==========================================================================
 * Arrays of values and indices
 * ========================================================================== */

/* Values to read, one record for each vertex, or for each value of a channel.
 * `count` must be their number. The layouts are final. */
typedef struct carvel_const_values_f32 {
    const float *data;
    /* Records. */
    uint64_t count;
    /* Values in a record, 1 to 65536; 3 for positions. */
    uint64_t width;
    /* Bytes from record to record, a multiple of the value's alignment and at
     * least a record's size; 0 for records one after the other. Those are read
     * in place, others through a copy. */
    uint64_t stride;
} carvel_const_values_f32;

typedef struct carvel_const_values_f64 {
    const double *data;
    uint64_t count;
    uint64_t width;
    uint64_t stride;
} carvel_const_values_f64;

/* Values to write: the same, but `count` is the number of records that fit, and
 * `width` is that of the input. Bytes between records are left as they are. The
 * layouts are final. */
typedef struct carvel_values_f32 {
    float *data;
    uint64_t count;
    uint64_t width;
    uint64_t stride;
} carvel_values_f32;

typedef struct carvel_values_f64 {
    double *data;
    uint64_t count;
    uint64_t width;
    uint64_t stride;
} carvel_values_f64;

/* By which rows values on vertices are refined. */
enum carvel_interpolation {
    /* The scheme's own, as positions are. OpenSubdiv's vertex data. */
    CARVEL_INTERPOLATION_VERTEX = 0,
    /* Linear, whatever the scheme smooths: old vertices keep their values, those of
     * edges are midpoints, those of faces means. OpenSubdiv's varying data. For
     * schemes with a quad or triangle split; others answer UNSUPPORTED. */
    CARVEL_INTERPOLATION_VARYING = 1
};

/* Indices to write: room for `count` entries. Not wanted if `data` is NULL and
 * `count` is 0. The layout is final. */
typedef struct carvel_indices {
    uint32_t *data;
    uint64_t count;
} carvel_indices;

/* ==========================================================================
 * carvel_refiner: one-shot, the faces and values of level n
 *
 * Keeps its scratch memory from call to call, so that refining the same mesh
 * again touches hardly a fresh page. One call at a time; give each thread its own.
 * To evaluate new positions on fixed topology, or for several levels, see
 * carvel_hierarchy.
 * ========================================================================== */

typedef struct carvel_refiner carvel_refiner;

/* Makes a refiner without memory yet.
 * Errors: NULL_POINTER, MISALIGNED. */
CARVEL_API carvel_status carvel_refiner_create(carvel_refiner **out, carvel_error *error);

/* Destroys a refiner and its scratch memory; NULL is allowed. */
CARVEL_API void carvel_refiner_destroy(carvel_refiner *refiner);

/* Bytes of scratch memory held since the last call that ended; 0 for NULL. Any
 * thread. */
CARVEL_API uint64_t carvel_refiner_bytes(const carvel_refiner *refiner);

/* Values at the corners of faces to refine. The layouts are final. */
typedef struct carvel_channel_input_f32 {
    /* Made for the mesh that is refined, or for one that is like it in everything. */
    const carvel_channel *channel;
    /* A record for each of its values. */
    carvel_const_values_f32 values;
} carvel_channel_input_f32;

typedef struct carvel_channel_input_f64 {
    const carvel_channel *channel;
    carvel_const_values_f64 values;
} carvel_channel_input_f64;

/* Where they go. The layouts are final. */
typedef struct carvel_channel_output_f32 {
    /* The value of every corner, as carvel_refine_output.face_vertices has them:
     * `corners`; not to be left out. */
    carvel_indices indices;
    /* The values: as many records as carvel_predict_channel says. */
    carvel_values_f32 values;
} carvel_channel_output_f32;

typedef struct carvel_channel_output_f64 {
    carvel_indices indices;
    carvel_values_f64 values;
} carvel_channel_output_f64;

/* What to refine. The mesh's own vertices are counted: with
 * CARVEL_NON_MANIFOLD_CUT there may be more than the caller gave. */
typedef struct carvel_refine_input_f32 {
    /* sizeof(carvel_refine_input_f32). */
    uint32_t struct_size;
    /* The number of steps, at most 64; 0 copies the input. */
    uint32_t levels;
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    /* xyz of every vertex: width 3. */
    carvel_const_values_f32 positions;
    /* Further values on vertices; at most 256 of them. */
    const carvel_const_values_f32 *attributes;
    uint64_t attribute_count;
    /* One of enum carvel_interpolation for each attribute; NULL for the scheme's
     * own rows for all. */
    const int32_t *interpolations;
    /* Values at the corners of faces; at most 256 channels. */
    const carvel_channel_input_f32 *channels;
    uint64_t channel_count;
} carvel_refine_input_f32;

typedef struct carvel_refine_input_f64 {
    uint32_t struct_size;
    uint32_t levels;
    const carvel_mesh *mesh;
    const carvel_scheme *scheme;
    carvel_const_values_f64 positions;
    const carvel_const_values_f64 *attributes;
    uint64_t attribute_count;
    const int32_t *interpolations;
    const carvel_channel_input_f64 *channels;
    uint64_t channel_count;
} carvel_refine_input_f64;

/* Where the result goes. Sizes are those of carvel_predict_counts. It must not
 * overlap any buffer. */
typedef struct carvel_refine_output_f32 {
    /* sizeof(carvel_refine_output_f32). */
    uint32_t struct_size;
    /* Set by the call: 1 if a further step on these faces, as a mesh of their
     * own, must have carvel_mesh_desc.anchored set. */
    int32_t anchored;
    /* The size of every face: `faces`. From level 1 on all but the first
     * `irregular_faces` are quads, or all are triangles after a triangle split. */
    carvel_indices face_sizes;
    /* The first corner of every face, and the number of corners: `faces` + 1. */
    carvel_indices face_offsets;
    /* The vertices of all faces: `corners`. */
    carvel_indices face_vertices;
    /* The face of the control mesh, in carvel_mesh's order, that each face
     * descends from: `faces`. */
    carvel_indices face_sources;
    /* xyz of every vertex: `vertices` records. */
    carvel_values_f32 positions;
    /* One for each attribute of the input, of the same width. */
    const carvel_values_f32 *attributes;
    uint64_t attribute_count;
    /* One for each channel of the input, of the same width. */
    const carvel_channel_output_f32 *channels;
    uint64_t channel_count;
} carvel_refine_output_f32;

typedef struct carvel_refine_output_f64 {
    uint32_t struct_size;
    int32_t anchored;
    carvel_indices face_sizes;
    carvel_indices face_offsets;
    carvel_indices face_vertices;
    carvel_indices face_sources;
    carvel_values_f64 positions;
    const carvel_values_f64 *attributes;
    uint64_t attribute_count;
    const carvel_channel_output_f64 *channels;
    uint64_t channel_count;
} carvel_refine_output_f64;

/* Set defaults: everything empty.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_refine_input_f32_init(carvel_refine_input_f32 *input,
                                                      uint32_t struct_size);
CARVEL_API carvel_status carvel_refine_input_f64_init(carvel_refine_input_f64 *input,
                                                      uint32_t struct_size);
CARVEL_API carvel_status carvel_refine_output_f32_init(carvel_refine_output_f32 *output,
                                                       uint32_t struct_size);
CARVEL_API carvel_status carvel_refine_output_f64_init(carvel_refine_output_f64 *output,
                                                       uint32_t struct_size);

/* Refines into the caller's buffers. Everything is checked before anything is
 * written, but for OVERFLOW, CANCELLED, OUT_OF_RESOURCES and PANIC: after those the
 * buffers' content is undefined. Costs O(corners of the last level).
 *
 * TOO_LARGE and MEMORY_CEILING come before BUFFER_TOO_SMALL: a call without
 * buffers, but with their widths and strides, tells whether it is worth making
 * them.
 *
 * The result does not depend on threads. A mesh built anew from the faces of a
 * level gives the same surface, numbered otherwise.
 *
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE, INVALID_STRIDE, OVERLAP,
 * BUFFER_TOO_SMALL; LENGTH_MISMATCH for a wrong count, a width that is not that
 * of the positions or of the input, or a channel of another mesh;
 * PARAMETER_OUT_OF_RANGE for a width or an interpolation that is none and for too
 * many attributes or channels; UNSUPPORTED for a mesh, an interpolation or a channel
 * that the scheme has no rule for; NOT_FINITE, OVERFLOW, which in a channel name a
 * value where they name a vertex elsewhere;
 * TOO_LARGE, MEMORY_CEILING, OUT_OF_RESOURCES; CANCELLED; BUSY. */
CARVEL_API carvel_status carvel_refiner_refine_f32(carvel_refiner *refiner,
                                                   const carvel_context *context,
                                                   const carvel_refine_input_f32 *input,
                                                   carvel_refine_output_f32 *output,
                                                   carvel_error *error);
CARVEL_API carvel_status carvel_refiner_refine_f64(carvel_refiner *refiner,
                                                   const carvel_context *context,
                                                   const carvel_refine_input_f64 *input,
                                                   carvel_refine_output_f64 *output,
                                                   carvel_error *error);

/* ==========================================================================
 * carvel_hierarchy: all levels, kept
 *
 * Topology once, values as often as wanted: for animation on a fixed topology,
 * for adjacency and lineage of refined levels. Immutable and shared freely.
 * ========================================================================== */

typedef struct carvel_hierarchy carvel_hierarchy;

/* Builds levels 1 to `levels` of a mesh under a scheme, all with adjacency. The
 * mesh is shared, not copied, and may be destroyed.
 * levels: 0 to 64.
 * Errors: NULL_POINTER, MISALIGNED, TOO_LARGE, MEMORY_CEILING, OUT_OF_RESOURCES,
 * CANCELLED; UNSUPPORTED as carvel_predict_counts. O(corners of the last level). */
CARVEL_API carvel_status carvel_hierarchy_create(const carvel_context *context,
                                                 const carvel_mesh *mesh,
                                                 const carvel_scheme *scheme, uint32_t levels,
                                                 carvel_hierarchy **out, carvel_error *error);

/* Destroys a hierarchy; meshes had from it live on. NULL is allowed. */
CARVEL_API void carvel_hierarchy_destroy(carvel_hierarchy *hierarchy);

/* The number of the last level; 0 for NULL. */
CARVEL_API uint32_t carvel_hierarchy_last_level(const carvel_hierarchy *hierarchy);

/* The sizes of a level; counts->struct_size must be set. No cost.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for a
 * level that was not built. */
CARVEL_API carvel_status carvel_hierarchy_counts(const carvel_hierarchy *hierarchy,
                                                 uint32_t level, carvel_counts *counts,
                                                 carvel_error *error);

/* The mesh of a level, for its arrays and adjacency. It is shared, not copied;
 * destroy it like any other mesh. No cost.
 * Errors: NULL_POINTER, MISALIGNED, PARAMETER_OUT_OF_RANGE. */
CARVEL_API carvel_status carvel_hierarchy_mesh(const carvel_hierarchy *hierarchy, uint32_t level,
                                               carvel_mesh **out, carvel_error *error);

/* Refines values on the control vertices to a level: a record for every control
 * vertex in, one of the same width for every vertex of that level out. For
 * positions, and for anything else that lives on vertices. Everything is checked
 * before anything is written, but for OVERFLOW, CANCELLED, OUT_OF_RESOURCES and
 * PANIC: after those the buffer's content is undefined. O(vertices of the level).
 * Errors: NULL_POINTER, MISALIGNED, INVALID_STRIDE, OVERLAP, BUFFER_TOO_SMALL,
 * LENGTH_MISMATCH, TOO_LARGE, PARAMETER_OUT_OF_RANGE, NOT_FINITE, OVERFLOW,
 * MEMORY_CEILING,
 * OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_hierarchy_refine_f32(const carvel_hierarchy *hierarchy,
                                                     const carvel_context *context,
                                                     uint32_t level,
                                                     const carvel_const_values_f32 *values,
                                                     const carvel_values_f32 *out,
                                                     carvel_error *error);
CARVEL_API carvel_status carvel_hierarchy_refine_f64(const carvel_hierarchy *hierarchy,
                                                     const carvel_context *context,
                                                     uint32_t level,
                                                     const carvel_const_values_f64 *values,
                                                     const carvel_values_f64 *out,
                                                     carvel_error *error);

/* The same by rows of choice: one of enum carvel_interpolation.
 * Errors: as carvel_hierarchy_refine, PARAMETER_OUT_OF_RANGE for an interpolation
 * that is none, and UNSUPPORTED for one that the scheme does not have. */
CARVEL_API carvel_status carvel_hierarchy_interpolate_f32(const carvel_hierarchy *hierarchy,
                                                          const carvel_context *context,
                                                          uint32_t level, int32_t interpolation,
                                                          const carvel_const_values_f32 *values,
                                                          const carvel_values_f32 *out,
                                                          carvel_error *error);
CARVEL_API carvel_status carvel_hierarchy_interpolate_f64(const carvel_hierarchy *hierarchy,
                                                          const carvel_context *context,
                                                          uint32_t level, int32_t interpolation,
                                                          const carvel_const_values_f64 *values,
                                                          const carvel_values_f64 *out,
                                                          carvel_error *error);

/* Kinds of origin, and the steps after which an element has them. Faces of triangles
 * have a triangle at each corner, and one in the middle that comes from the face. */
enum carvel_origin_kind {
    /* A face of the level before. For vertices: the middle of the face (quad split).
     * For faces: the smaller face inside (corner split), or the middle triangle. */
    CARVEL_ORIGIN_FACE = 1,
    /* An edge, by a corner that it leads away from, any one inside. Its number
     * is the same from all in carvel_mesh_corner_edges. For vertices: the middle of
     * the edge (quad and triangle split). For faces: the one along it (corner
     * split). */
    CARVEL_ORIGIN_EDGE = 2,
    /* A vertex. For vertices: the one that stayed (quad and triangle split), or a
     * corner of the boundary or an isolated vertex (corner split). For faces: the
     * one around it (corner split). */
    CARVEL_ORIGIN_VERTEX = 3,
    /* A corner of a face. For vertices: corner split. For faces: the quad or the
     * triangle in that corner (quad and triangle split). */
    CARVEL_ORIGIN_CORNER = 4,
    /* The boundary edge that leads away from a corner, near its start (corner
     * split). */
    CARVEL_ORIGIN_EDGE_START = 5,
    /* The same, near its end. */
    CARVEL_ORIGIN_EDGE_END = 6
};

/* The element of the level before that an element descends from; faces and
 * corners in the order of that level's mesh. The layout is final. */
typedef struct carvel_origin {
    /* One of enum carvel_origin_kind. */
    uint32_t kind;
    uint32_t index;
} carvel_origin;

/* Where the vertices of a level come from: `vertices` of that level entries. After a
 * quad or triangle split these are, in order, all vertices of the level before, all
 * its edges by their first corner and, after a quad split, all its faces.
 * level: 1 to the last. Linear cost.
 * Errors: NULL_POINTER, MISALIGNED, PARAMETER_OUT_OF_RANGE, BUFFER_TOO_SMALL,
 * OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_hierarchy_vertex_origins(const carvel_hierarchy *hierarchy,
                                                         uint32_t level, carvel_origin *out,
                                                         uint64_t capacity, carvel_error *error);

/* Where the faces of a level come from: `faces` of that level entries. After a quad
 * split these are all corners of the level before, in order: face c begins at the
 * vertex of corner c and goes on through the edge that leads away, the middle of the
 * face and the edge before. After a triangle split faces 4 f to 4 f + 2 are those in
 * the corners of face f, from the vertex through the two edges, and 4 f + 3 is the
 * one in the middle. */
CARVEL_API carvel_status carvel_hierarchy_face_origins(const carvel_hierarchy *hierarchy,
                                                       uint32_t level, carvel_origin *out,
                                                       uint64_t capacity, carvel_error *error);

/* The weights of one stage of a step as a sparse matrix in CSR form. Stage 0 is
 * the split, from the vertices of `level` - 1 to those of `level`; stage k is the
 * k-th smoothing pass, on the vertices of `level`: those of carvel_scheme_passes. With
 * CARVEL_EXTRAORDINARY_TUNED stage 0 is the whole step and there is no other. Whole
 * steps and levels are carvel_stencils.
 *
 * offsets: `vertices` of the level + 1 entries.
 * indices, weights: one for each entry; an index may occur twice in a row. With
 * capacity 0 both may be NULL and only `offsets` and `count` are written.
 * count: receives the number of entries; may be NULL.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, PARAMETER_OUT_OF_RANGE for a level
 * or a stage that there is not, BUFFER_TOO_SMALL, TOO_LARGE, OUT_OF_RESOURCES. */
CARVEL_EXPERIMENTAL carvel_status carvel_hierarchy_rows(const carvel_hierarchy *hierarchy,
                                                        uint32_t level, uint32_t stage,
                                                        uint64_t *offsets,
                                                        uint64_t offset_capacity,
                                                        uint32_t *indices, double *weights,
                                                        uint64_t capacity, uint64_t *count,
                                                        carvel_error *error);

/* ==========================================================================
 * carvel_stencils: rows of weights
 *
 * A sparse matrix: row i says by which weights value i of a level is made of the
 * values of a coarser level. Made once for a topology, applied as often as the
 * control points move; its transpose carries gradients back. Immutable and shared
 * freely; what it makes when it is asked for first (the transpose, the rows that
 * depend on a column) is kept.
 *
 * A table takes 4 bytes for a row, 4 and a weight for an entry: 6 to 17 entries for a
 * row. Refining once by a carvel_refiner costs less than making a table.
 * ========================================================================== */

typedef struct carvel_stencils carvel_stencils;

/* Number types of weights. */
enum carvel_precision {
    CARVEL_PRECISION_F32 = 0,
    CARVEL_PRECISION_F64 = 1
};

/* Which table. */
typedef struct carvel_stencils_desc {
    uint32_t struct_size;
    /* The level that columns belong to; 0 for the control mesh. */
    uint32_t from_level;
    /* The level that rows belong to: from `from_level` to one beyond the last level of
     * the hierarchy, whose mesh is all that those rows need. `level` - 1 as
     * `from_level` gives the table of a single step. */
    uint32_t level;
    /* One of enum carvel_interpolation. */
    int32_t interpolation;
    /* One of enum carvel_precision: weights are computed in double precision and
     * rounded once. */
    int32_t precision;
    /* 0. */
    uint32_t reserved;
    /* The vertices of `level` that get a row, in the order of the rows, each as often
     * as it is listed; NULL with the count 0 for all. Only what they need is computed. */
    const uint32_t *vertices;
    uint64_t vertex_count;
} carvel_stencils_desc;

/* The size of a table. */
typedef struct carvel_stencil_counts {
    uint32_t struct_size;
    /* One of enum carvel_precision. */
    int32_t precision;
    /* Values that are made. */
    uint64_t rows;
    /* Values that they are made of. */
    uint64_t columns;
    /* Weights; none is 0. */
    uint64_t entries;
    /* Memory held, with what was made since. */
    uint64_t bytes;
} carvel_stencil_counts;

/* Sets every field to its default: struct_size is sizeof(carvel_stencils_desc).
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_stencils_desc_init(carvel_stencils_desc *desc,
                                                   uint32_t struct_size);
CARVEL_API carvel_status carvel_stencil_counts_init(carvel_stencil_counts *counts,
                                                    uint32_t struct_size);

/* Makes a table. The hierarchy is not needed afterwards. O(entries of the table),
 * some tens of nanoseconds for each row.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for levels, an
 * interpolation, a precision or `reserved`; INDEX_OUT_OF_RANGE for a vertex;
 * UNSUPPORTED for varying rows of a dual scheme; TOO_LARGE for 4294967295 weights and
 * more, OVERFLOW, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_stencils_create(const carvel_context *context,
                                                const carvel_hierarchy *hierarchy,
                                                const carvel_stencils_desc *desc,
                                                carvel_stencils **out, carvel_error *error);

/* Makes the table of where the vertices of a level go: 3 rows for each of its V vertices, on
 * the same V vertices as columns. Rows 0 to V - 1 are limit positions; V to 2V - 1 a tangent of
 * the surface there, 2V to 3V - 1 another, counter-clockwise from the first seen from outside,
 * so that their cross product points along the normal. Lengths of tangents mean nothing; their
 * rows are empty where the surface has no tangent plane, and those of one side on creases and at
 * corners. A product with the table of the level gives all this on the control vertices. Under a
 * dual scheme the limit of a vertex is that of the middle of the faces in its place. O(V), some
 * microseconds for each vertex.
 * Errors: NULL_POINTER, MISALIGNED; PARAMETER_OUT_OF_RANGE for a level or a precision
 * (carvel_precision); UNSUPPORTED where the surface has no such point or the mesh is not
 * manifold; TOO_LARGE, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_stencils_create_limits(const carvel_context *context,
                                                       const carvel_hierarchy *hierarchy,
                                                       uint32_t level, int32_t precision,
                                                       carvel_stencils **out,
                                                       carvel_error *error);

/* The table that does what `first` and then `then` do; both of one precision, which
 * it has as well. O(pairs of entries that meet).
 * Errors: NULL_POINTER, MISALIGNED, LENGTH_MISMATCH unless `then` has a column for each
 * row of `first`, PARAMETER_OUT_OF_RANGE for different precisions, OVERFLOW, TOO_LARGE,
 * MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_stencils_product(const carvel_context *context,
                                                 const carvel_stencils *first,
                                                 const carvel_stencils *then,
                                                 carvel_stencils **out, carvel_error *error);

/* The table with rows and columns exchanged. O(entries).
 * Errors: NULL_POINTER, MISALIGNED, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_stencils_transpose(const carvel_context *context,
                                                   const carvel_stencils *stencils,
                                                   carvel_stencils **out, carvel_error *error);

/* Destroys a table. NULL is allowed. */
CARVEL_API void carvel_stencils_destroy(carvel_stencils *stencils);

/* The sizes of a table; counts->struct_size must be set. No cost.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_stencils_counts(const carvel_stencils *stencils,
                                                carvel_stencil_counts *counts,
                                                carvel_error *error);

/* The table in CSR form, in the number type asked for.
 * offsets: `rows` + 1 entries, where the entries of each row begin, the last being the
 * number of entries.
 * indices, weights: `entries` entries; no column comes twice in a row.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL, TOO_LARGE. */
CARVEL_API carvel_status carvel_stencils_csr_f32(const carvel_stencils *stencils,
                                                 uint64_t *offsets, uint64_t offset_capacity,
                                                 uint32_t *indices, float *weights,
                                                 uint64_t capacity, carvel_error *error);
CARVEL_API carvel_status carvel_stencils_csr_f64(const carvel_stencils *stencils,
                                                 uint64_t *offsets, uint64_t offset_capacity,
                                                 uint32_t *indices, double *weights,
                                                 uint64_t capacity, carvel_error *error);

/* Computes all values: a record for every column in, one of the same width for every
 * row out. Weights are rounded to the values' number type; products are added in the
 * order of the entries. Records with a stride are read and written where they are, so
 * that those of `out` may not lie between those of `values`. NaN and infinities go
 * through as arithmetic has it. After CANCELLED and OUT_OF_RESOURCES the buffer's
 * content is undefined. O(entries), and a copy of the values in four-lane records.
 * Errors: NULL_POINTER, MISALIGNED, INVALID_STRIDE, OVERLAP, BUFFER_TOO_SMALL,
 * LENGTH_MISMATCH, PARAMETER_OUT_OF_RANGE for a width, TOO_LARGE, OUT_OF_RESOURCES,
 * CANCELLED. */
CARVEL_API carvel_status carvel_stencils_apply_f32(const carvel_stencils *stencils,
                                                   const carvel_context *context,
                                                   const carvel_const_values_f32 *values,
                                                   const carvel_values_f32 *out,
                                                   carvel_error *error);
CARVEL_API carvel_status carvel_stencils_apply_f64(const carvel_stencils *stencils,
                                                   const carvel_context *context,
                                                   const carvel_const_values_f64 *values,
                                                   const carvel_values_f64 *out,
                                                   carvel_error *error);

/* The same, added to what `out` holds. */
CARVEL_API carvel_status carvel_stencils_apply_add_f32(const carvel_stencils *stencils,
                                                       const carvel_context *context,
                                                       const carvel_const_values_f32 *values,
                                                       const carvel_values_f32 *out,
                                                       carvel_error *error);
CARVEL_API carvel_status carvel_stencils_apply_add_f64(const carvel_stencils *stencils,
                                                       const carvel_context *context,
                                                       const carvel_const_values_f64 *values,
                                                       const carvel_values_f64 *out,
                                                       carvel_error *error);

/* The transpose applied, for gradients: a record for every row in, one for every column
 * out. The same bits on every number of threads. The first call makes the transpose
 * and keeps it, which doubles the memory of the table.
 * Errors: as carvel_stencils_apply, MEMORY_CEILING. */
CARVEL_API carvel_status carvel_stencils_apply_transpose_f32(
    const carvel_stencils *stencils, const carvel_context *context,
    const carvel_const_values_f32 *values, const carvel_values_f32 *out, carvel_error *error);
CARVEL_API carvel_status carvel_stencils_apply_transpose_f64(
    const carvel_stencils *stencils, const carvel_context *context,
    const carvel_const_values_f64 *values, const carvel_values_f64 *out, carvel_error *error);

/* Computes again what depends on the columns `changed`, listed in any order, and leaves
 * the rest of `out` as it is: the same bits as carvel_stencils_apply. O(entries of those
 * rows, rows, columns). The first call finds the rows of every column and keeps them, 4
 * bytes for an entry.
 * Errors: as carvel_stencils_apply, INDEX_OUT_OF_RANGE for a column, MEMORY_CEILING. */
CARVEL_API carvel_status carvel_stencils_update_f32(const carvel_stencils *stencils,
                                                    const carvel_context *context,
                                                    const uint32_t *changed,
                                                    uint64_t changed_count,
                                                    const carvel_const_values_f32 *values,
                                                    const carvel_values_f32 *out,
                                                    carvel_error *error);
CARVEL_API carvel_status carvel_stencils_update_f64(const carvel_stencils *stencils,
                                                    const carvel_context *context,
                                                    const uint32_t *changed,
                                                    uint64_t changed_count,
                                                    const carvel_const_values_f64 *values,
                                                    const carvel_values_f64 *out,
                                                    carvel_error *error);

/* Writes a table to a file of the library's own format, with a version and a checksum;
 * a file that is there is replaced. After an error the file may be incomplete, which
 * carvel_stencils_load tells.
 * path: UTF-8; on Unix any bytes.
 * Errors: NULL_POINTER, IO. */
CARVEL_API carvel_status carvel_stencils_save(const carvel_stencils *stencils,
                                              const char *path, carvel_error *error);

/* Reads a table that carvel_stencils_save wrote, on any machine. Memory is taken as the
 * file is read, never for what it only promises.
 * Errors: NULL_POINTER, MISALIGNED, IO; SYNTAX, naming the byte, for a file that is cut
 * off, changed or another kind of file; UNSUPPORTED for one of a later version;
 * OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_stencils_load(const char *path, carvel_stencils **out,
                                              carvel_error *error);

/* ==========================================================================
 * carvel_surface: the limit surface
 *
 * Positions and derivatives at any point of the surface that refining for ever leads to,
 * without refining. Around regular cells it is evaluated in closed form; elsewhere a few
 * of the scheme's own steps lead to such a cell. Those steps are found once for a mesh.
 * Immutable and shared freely; the control vertices may move as they like.
 * ========================================================================== */

typedef struct carvel_surface carvel_surface;

/* A point of the surface: a face of the control mesh and coordinates in it.
 *
 * On a quad of any scheme but Loop's, u and v are within 0 and 1: corner 0 lies at (0, 0),
 * corner 1 at (1, 0), corner 2 at (1, 1). Any other face has a sector for each corner, with
 * that vertex at (0, 0), the middle of the corner's outgoing edge at (1, 0), and the face's
 * middle at (1, 1). On a triangle of Loop's scheme corner 0 lies at (0, 0), corner 1 at
 * (1, 0), corner 2 at (0, 1), and u + v is at most 1. The layout is final. */
typedef struct carvel_sample {
    /* In the mesh's order. */
    uint32_t face;
    /* The corner of the face whose sector it is; 0 where there are none. */
    uint32_t sector;
    double u;
    double v;
} carvel_sample;

/* What to evaluate beside the position. */
enum carvel_derivatives {
    /* One record for a sample: the position. */
    CARVEL_DERIVATIVES_NONE = 0,
    /* Three: the position, its derivatives by u and by v. */
    CARVEL_DERIVATIVES_FIRST = 1,
    /* Six: those three, then the derivatives by uu, uv and vv. */
    CARVEL_DERIVATIVES_SECOND = 2
};

/* Finds the cells of a surface. The mesh and the scheme are not needed afterwards. Time and
 * memory grow with the corners of the mesh, and with the number of ways in which its
 * irregular parts look different.
 * Errors: NULL_POINTER, MISALIGNED; PARAMETER_OUT_OF_RANGE for a scheme that does not take
 * the mesh; UNSUPPORTED for a mesh that is not manifold or is anchored with a boundary, and for
 * a scheme that does not converge on regular grids; TOO_LARGE, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_surface_create(const carvel_context *context,
                                               const carvel_mesh *mesh,
                                               const carvel_scheme *scheme,
                                               carvel_surface **out, carvel_error *error);

/* The surface of a channel's values, such as texture coordinates: samples are as on the
 * surface of the channel's mesh, values those of the channel, continuous but across seams: a
 * record for each value where that surface takes one for each vertex. The same as refining the
 * channel for ever. The channel is not needed afterwards.
 * Errors: NULL_POINTER, MISALIGNED; as carvel_surface_create; UNSUPPORTED for a scheme without
 * rules for such values, and, naming the vertex, where values depend on semi-sharp edges
 * beyond a seam. */
CARVEL_API carvel_status carvel_surface_create_channel(const carvel_context *context,
                                                       const carvel_channel *channel,
                                                       const carvel_scheme *scheme,
                                                       carvel_surface **out,
                                                       carvel_error *error);

/* Destroys a surface. NULL is allowed. */
CARVEL_API void carvel_surface_destroy(carvel_surface *surface);

/* The sectors of a face: 1, or one for each corner. No cost.
 * Errors: NULL_POINTER, MISALIGNED, PARAMETER_OUT_OF_RANGE for a face. */
CARVEL_API carvel_status carvel_surface_sectors(const carvel_surface *surface, uint32_t face,
                                                uint32_t *sectors, carvel_error *error);

/* Evaluates samples from values of the control vertices, a record for each: `out` gets 1, 3
 * or 6 records of their width for each sample.
 * derivatives: one of enum carvel_derivatives. At a sharp edge or a knot they are those of
 * the sample's own face, from the side of larger coordinates.
 * All is computed in double precision. After an error that names a sample's face the
 * buffer's content is undefined, and so after CANCELLED and OUT_OF_RESOURCES. Some hundred
 * nanoseconds for each sample, in proportion to the number of digits of its coordinates
 * that are looked at near an extraordinary vertex.
 * Errors: NULL_POINTER, MISALIGNED, INVALID_STRIDE, OVERLAP, BUFFER_TOO_SMALL,
 * LENGTH_MISMATCH, TOO_LARGE, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED;
 * PARAMETER_OUT_OF_RANGE for a width or derivatives that are none. For the first sample
 * concerned, naming its face: PARAMETER_OUT_OF_RANGE for a face, sector or coordinates;
 * NOT_FINITE for a value that it depends on, or for one that does not fit `out`;
 * UNSUPPORTED in a hole, where the surface of a dual scheme ends before the boundary or is
 * not regular beside it, for derivatives that the scheme does not have, or exactly at an
 * extraordinary vertex or an irregular boundary. */
CARVEL_API carvel_status carvel_surface_evaluate_f32(const carvel_surface *surface,
                                                     const carvel_context *context,
                                                     const carvel_sample *samples,
                                                     uint64_t sample_count, int32_t derivatives,
                                                     const carvel_const_values_f32 *values,
                                                     const carvel_values_f32 *out,
                                                     carvel_error *error);
CARVEL_API carvel_status carvel_surface_evaluate_f64(const carvel_surface *surface,
                                                     const carvel_context *context,
                                                     const carvel_sample *samples,
                                                     uint64_t sample_count, int32_t derivatives,
                                                     const carvel_const_values_f64 *values,
                                                     const carvel_values_f64 *out,
                                                     carvel_error *error);

/* Makes the table that does the same: the rows of a sample are its records, the columns are
 * the control vertices. For samples that stay where they are while vertices move; the
 * transpose carries gradients back. Each sample costs as much as evaluating as many values
 * as its face has control vertices.
 * precision: one of enum carvel_precision; weights are computed in double precision and
 * rounded once.
 * Errors: NULL_POINTER, MISALIGNED; as carvel_surface_evaluate for samples and derivatives;
 * PARAMETER_OUT_OF_RANGE for a precision; NOT_FINITE for a weight beyond the precision's
 * range, very near an extraordinary vertex; TOO_LARGE for 4294967295 rows or weights and
 * more, MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_surface_stencils(const carvel_context *context,
                                                 const carvel_surface *surface,
                                                 const carvel_sample *samples,
                                                 uint64_t sample_count, int32_t derivatives,
                                                 int32_t precision, carvel_stencils **out,
                                                 carvel_error *error);

/* ==========================================================================
 * carvel_search: closest points and rays
 *
 * The point of a limit surface that is nearest to another, and the first one on a ray. The
 * surface is cut into parts with bounds, which lead to what is asked for; docs/search.md says
 * how far they are proven. Immutable and shared freely.
 * ========================================================================== */

typedef struct carvel_search carvel_search;

/* The point of a surface nearest to another. Where nothing was found the face of `sample` is
 * UINT32_MAX and the distance infinite. The layout is final. */
typedef struct carvel_closest {
    /* Where it is: carvel_surface_evaluate has the derivatives there. */
    carvel_sample sample;
    double point[3];
    double distance;
} carvel_closest;

/* A ray, or a segment: the points origin + t direction, t being in a range. The layout is
 * final. */
typedef struct carvel_ray {
    /* Finite. */
    double origin[3];
    /* Finite, not zero, of any length. */
    double direction[3];
    /* The smallest and the largest t, which may be infinite. */
    double range[2];
} carvel_ray;

/* The first point of a surface on a ray. Where there is none the face of `sample` is UINT32_MAX
 * and t infinite. The layout is final. */
typedef struct carvel_hit {
    carvel_sample sample;
    double point[3];
    double t;
} carvel_hit;

/* Cuts a surface into parts. The surface may be destroyed; the positions, three numbers for
 * each control vertex, are copied. Time and memory grow with the faces: about a kilobyte for a
 * regular one, ten for each extraordinary corner of another.
 * Errors: NULL_POINTER, MISALIGNED, INVALID_STRIDE; LENGTH_MISMATCH for other than three numbers
 * for each vertex; NOT_FINITE, naming the vertex; UNSUPPORTED, naming the face, where the
 * surface is not evaluated all over it, unless it is a hole; TOO_LARGE, MEMORY_CEILING,
 * OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_search_create_f32(const carvel_context *context,
                                                  const carvel_surface *surface,
                                                  const carvel_const_values_f32 *positions,
                                                  carvel_search **out, carvel_error *error);
CARVEL_API carvel_status carvel_search_create_f64(const carvel_context *context,
                                                  const carvel_surface *surface,
                                                  const carvel_const_values_f64 *positions,
                                                  carvel_search **out, carvel_error *error);

/* Destroys a search. NULL is allowed. */
CARVEL_API void carvel_search_destroy(carvel_search *search);

/* For each of the points, three numbers each, the nearest point of the surface: `out` has room for
 * as many. The same at any number of threads. No other point of the surface is nearer by more
 * than 1e-9 of the distance, or 1e-12 of the largest coordinate, unless the surface has no area,
 * where a query that takes long becomes less exact (docs/search.md).
 * reach: how far away it may be, 0 to infinity.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, TOO_LARGE; NOT_FINITE and PARAMETER_OUT_OF_RANGE for
 * a point, whose number the message has, and for a reach; MEMORY_CEILING, OUT_OF_RESOURCES,
 * CANCELLED. After the last three the content of `out` is undefined. */
CARVEL_API carvel_status carvel_search_closest(const carvel_search *search,
                                               const carvel_context *context,
                                               const double *points, uint64_t point_count,
                                               double reach, carvel_closest *out,
                                               carvel_error *error);

/* For each of the rays the first point of the surface on it; `out` has room for as many. The
 * surface has two sides. Points within 1e-12 of the largest coordinate from a ray are on it, unless
 * the surface has no area, as above.
 * Errors: as carvel_search_closest, for rays. */
CARVEL_API carvel_status carvel_search_intersect(const carvel_search *search,
                                                 const carvel_context *context,
                                                 const carvel_ray *rays, uint64_t ray_count,
                                                 carvel_hit *out, carvel_error *error);

/* ==========================================================================
 * carvel_tessellation: triangles on the limit surface
 *
 * Small where they have to be, within a tolerance of the surface or short on a screen,
 * without cracks: points on edges are shared by the faces there, bit for bit. Holes are left
 * out. docs/tessellation.md says how far the tolerance is proven.
 *
 * A place is a vertex as a point of one face or sector: inside a face a vertex has one, on
 * an edge one for each side, so that normals may differ across a crease.
 * carvel_surface_evaluate of the places gives any other values.
 * ========================================================================== */

typedef struct carvel_tessellation carvel_tessellation;

/* When triangles are small enough. */
enum carvel_fineness {
    /* When no point of the surface is farther from them than `tolerance`, in units of the
     * positions. */
    CARVEL_FINENESS_CHORD = 0,
    /* When their edges are no longer than `tolerance` on a screen, in pixels, wherever they
     * may be in view. */
    CARVEL_FINENESS_PIXELS = 1
};

typedef struct carvel_tessellation_desc {
    uint32_t struct_size;
    /* One of enum carvel_fineness. */
    int32_t fineness;
    /* Finite and above 0; there is no default. */
    double tolerance;
    /* Halvings of a face's sides at most, 1 to 24; 0 for 20. */
    uint32_t max_levels;
    /* 1 to leave out faces, or sectors of them, that have no surface somewhere, as beside
     * a boundary where a dual scheme ends inside; 0 to refuse them. */
    uint32_t partial;
    /* The most triangles; 0 for 4294967295. */
    uint64_t max_triangles;
    /* For pixels: the matrix, by rows, that takes (x, y, z, 1) to clip coordinates, where
     * (x, y, z, w) is in view if |x| <= w, |y| <= w and -w <= z. Finite. */
    double matrix[16];
    /* For pixels: width and height of the picture. Finite and above 0. */
    double viewport[2];
} carvel_tessellation_desc;

/* The size of a tessellation, and what it came to. */
typedef struct carvel_triangle_counts {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t vertices;
    uint64_t triangles;
    uint64_t places;
    /* The bound on the distance from the surface, or the longest edge in view in pixels. */
    double measure;
    /* Cells that `max_levels` left coarser than asked for. */
    uint64_t coarse;
    /* Faces, or sectors, that `partial` left out. */
    uint64_t missing;
} carvel_triangle_counts;

/* Sets every field to its default: struct_size is sizeof(carvel_tessellation_desc).
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_tessellation_desc_init(carvel_tessellation_desc *desc,
                                                       uint32_t struct_size);
CARVEL_API carvel_status carvel_triangle_counts_init(carvel_triangle_counts *counts,
                                                     uint32_t struct_size);

/* Cuts a surface into triangles. The surface is not needed afterwards. The same at any
 * number of threads. Some microseconds and 150 bytes for each triangle, which the context's
 * ceiling bounds as they come to be known.
 * positions: those of the control vertices, three numbers each, finite.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE, INVALID_STRIDE; LENGTH_MISMATCH for other
 * than three numbers for each vertex; PARAMETER_OUT_OF_RANGE for a field; NOT_FINITE, naming
 * the vertex; UNSUPPORTED, naming the face, where the surface is not evaluated; TOO_LARGE for
 * more triangles than may be; MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_tessellation_create_f32(const carvel_context *context,
                                                        const carvel_surface *surface,
                                                        const carvel_const_values_f32 *positions,
                                                        const carvel_tessellation_desc *desc,
                                                        carvel_tessellation **out,
                                                        carvel_error *error);
CARVEL_API carvel_status carvel_tessellation_create_f64(const carvel_context *context,
                                                        const carvel_surface *surface,
                                                        const carvel_const_values_f64 *positions,
                                                        const carvel_tessellation_desc *desc,
                                                        carvel_tessellation **out,
                                                        carvel_error *error);

/* Destroys a tessellation. NULL is allowed. */
CARVEL_API void carvel_tessellation_destroy(carvel_tessellation *tessellation);

/* Its sizes; counts->struct_size must be set. No cost.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_tessellation_counts(const carvel_tessellation *tessellation,
                                                    carvel_triangle_counts *counts,
                                                    carvel_error *error);

/* The triangles, counter-clockwise as the faces are; those of a face stand together, in the
 * order of the faces. Each list may be NULL and is then left out.
 * vertices: three vertices for each triangle.
 * places: three places for each triangle, all in its face and sector.
 * faces: the control face of each triangle, in the mesh's order.
 * capacity: triangles that the lists have room for.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL, TOO_LARGE. */
CARVEL_API carvel_status carvel_tessellation_triangles(const carvel_tessellation *tessellation,
                                                       uint32_t *vertices, uint32_t *places,
                                                       uint32_t *faces, uint64_t capacity,
                                                       carvel_error *error);

/* The places: where they are on the surface, and the vertex of each. A vertex has the
 * position of its first place. Either list may be NULL and is then left out.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL, TOO_LARGE. */
CARVEL_API carvel_status carvel_tessellation_places(const carvel_tessellation *tessellation,
                                                    carvel_sample *samples, uint32_t *vertices,
                                                    uint64_t capacity, carvel_error *error);

/* The positions of the vertices, three numbers each.
 * Errors: NULL_POINTER, MISALIGNED, INVALID_STRIDE, OVERLAP, BUFFER_TOO_SMALL, TOO_LARGE;
 * LENGTH_MISMATCH for another width; NOT_FINITE for a point beyond the range of floats;
 * OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_tessellation_positions_f32(
    const carvel_tessellation *tessellation, const carvel_values_f32 *out, carvel_error *error);
CARVEL_API carvel_status carvel_tessellation_positions_f64(
    const carvel_tessellation *tessellation, const carvel_values_f64 *out, carvel_error *error);

/* Unit normals of the places, the same for all of a vertex unless the surface is not smooth
 * there. Where it has no derivatives they are those of points beside, or of the triangles;
 * zero where these have none.
 * Errors: as carvel_tessellation_positions. */
CARVEL_API carvel_status carvel_tessellation_normals_f32(
    const carvel_tessellation *tessellation, const carvel_values_f32 *out, carvel_error *error);
CARVEL_API carvel_status carvel_tessellation_normals_f64(
    const carvel_tessellation *tessellation, const carvel_values_f64 *out, carvel_error *error);

/* ==========================================================================
 * carvel_mask: a scheme of polygons
 *
 * The mask of a stationary scheme of arity m: new point i is the sum of a(i - m j) times
 * old point j. It is exact; points are float or double, of any width. A scheme whose rules
 * change from level to level, or from edge to edge, has no mask, but refines polygons.
 * Immutable and shared freely.
 * ========================================================================== */

typedef struct carvel_mask carvel_mask;

/* Whether a polygon is closed, and what a step does at the ends of an open one. */
enum carvel_ends {
    /* The last point is followed by the first. One point at least. */
    CARVEL_ENDS_CLOSED = 0,
    /* New points whose rule reaches beyond the ends are dropped. */
    CARVEL_ENDS_DROPPED = 1,
    /* The ends stay: the polygon goes on by its images in them. For symmetric masks; two
     * points at least. */
    CARVEL_ENDS_KEPT = 2,
    /* The same, the first and the last point being half an interval away from their
     * neighbours: what a step with KEPT makes where new points do not fall on old ones.
     * Three points at least. */
    CARVEL_ENDS_ANCHORED = 3
};

/* Where new points lie, by the shift tau of a mask. */
enum carvel_parametrisation {
    /* tau is an integer: on old points, and between them. */
    CARVEL_PARAMETRISATION_PRIMAL = 0,
    /* tau is an odd multiple of 1/2: on both sides of old points. */
    CARVEL_PARAMETRISATION_DUAL = 1,
    CARVEL_PARAMETRISATION_OTHER = 2
};

/* The size of a refined polygon. */
typedef struct carvel_polygon_counts {
    uint32_t struct_size;
    /* One of enum carvel_ends: those of the result, to go on from. */
    int32_t ends;
    uint64_t points;
} carvel_polygon_counts;

/* What is known of a mask. Proofs are in rational arithmetic, or with every rounding
 * counted. A fraction whose terms do not fit 64 bits is 0/0. */
typedef struct carvel_mask_analysis {
    uint32_t struct_size;
    /* New points for each old one. */
    uint32_t arity;
    /* The index of the first coefficient. */
    int64_t offset;
    /* The largest k for which the limit is proved C^k; -1 if it is not proved to be
     * continuous. */
    int32_t continuity;
    /* One of enum carvel_parametrisation. */
    int32_t parametrisation;
    /* 1 if the mask reads the same from both ends. */
    int32_t is_symmetric;
    /* 1 if old points are kept. */
    int32_t is_interpolating;
    /* The k of the best proof by contractivity, -1 for none: the norm of the
     * `proof_power`-th power of the scheme of differences is `proof_norm` < 1. */
    int32_t proof_continuity;
    uint32_t proof_power;
    carvel_fraction proof_norm;
    /* Bounds on the Hoelder exponent: for all alpha below it the limit is C^alpha. */
    double holder_low;
    double holder_high;
    /* The width of the limit function's support, in intervals between control points. */
    carvel_fraction support;
    /* The shift of the parametrisation: new point i belongs to (i - tau)/arity. */
    carvel_fraction tau;
    /* Factors 1 + z + ... + z^(arity-1) of the symbol. */
    uint32_t smoothing_factors;
    /* Polynomials up to this degree are limits of some polygon, */
    uint32_t generation_degree;
    /* and up to this one, of their own values. */
    uint32_t reproduction_degree;
    /* 0. */
    uint32_t reserved;
} carvel_mask_analysis;

/* Sets every field to its default: struct_size is sizeof the struct.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_polygon_counts_init(carvel_polygon_counts *counts,
                                                    uint32_t struct_size);
CARVEL_API carvel_status carvel_mask_analysis_init(carvel_mask_analysis *analysis,
                                                   uint32_t struct_size);

/* Makes a mask.
 * text: UTF-8: a name of the catalogue with its parameters, such as "three-point:1/32" or
 * "tension-four-point:0.5" (docs/curves.md lists all), or coefficients such as
 * "1/4,3/4,3/4,1/4" or "[1,3,3,1]/4", whose middle is then at 0 or -1/2.
 * Numbers are fractions or decimals, with exponents up to 400, and exact.
 * arity: that of coefficients, 2 to 64; 0 for 2, and for a name.
 * Errors: NULL_POINTER, MISALIGNED; INVALID_NUMBER for an unknown name and for what is no
 * number; PARAMETER_OUT_OF_RANGE for an arity, an exponent, a parameter, or coefficients that
 * do not sum to 1 for each residue; TOO_LARGE for more than 1024 coefficients or long ones. */
CARVEL_API carvel_status carvel_mask_create(const char *text, uint32_t arity,
                                            carvel_mask **out, carvel_error *error);

/* The same with the index of the first coefficient, which decides where new points lie; zeros
 * at the beginning count. A name has an offset of its own.
 * offset: -1048576 to 1048576.
 * Errors: as carvel_mask_create, and PARAMETER_OUT_OF_RANGE for an offset or a name. */
CARVEL_API carvel_status carvel_mask_create_with_offset(const char *text, uint32_t arity,
                                                        int64_t offset, carvel_mask **out,
                                                        carvel_error *error);

/* Destroys a mask; NULL is allowed. */
CARVEL_API void carvel_mask_destroy(carvel_mask *mask);

/* The coefficients, that of the lowest index first, in lowest terms. With capacity 0
 * `out` may be NULL and only `count`, which may be NULL, is written.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL; UNSUPPORTED where there is
 * no mask; TOO_LARGE for one that does not fit 64 bits. */
CARVEL_API carvel_status carvel_mask_coefficients(const carvel_mask *mask,
                                                  carvel_fraction *out, uint64_t capacity,
                                                  uint64_t *count, carvel_error *error);

/* Makes the scheme on meshes whose regular rule is the mask's tensor square: a dual or
 * primal split and smoothing passes, with the defaults of carvel_scheme_desc otherwise.
 * Errors: NULL_POINTER, MISALIGNED; UNSUPPORTED, with the reason, for what is no split with
 * passes; PARAMETER_OUT_OF_RANGE for passes beyond those of carvel_scheme_desc. */
CARVEL_API carvel_status carvel_mask_scheme(const carvel_mask *mask, carvel_scheme **out,
                                            carvel_error *error);

/* Analyses a mask; analysis->struct_size must be set. Milliseconds for usual masks,
 * seconds for long ones.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE, CANCELLED; UNSUPPORTED where there is no
 * mask. */
CARVEL_API carvel_status carvel_mask_analyse(const carvel_mask *mask,
                                             const carvel_context *context,
                                             carvel_mask_analysis *analysis,
                                             carvel_error *error);

/* Samples of the limit function, what a 1 among zeros becomes, or of a derivative: sample i is
 * the value at (first + i) / arity^levels, in intervals between control points. Computed
 * exactly and rounded once; beyond the samples the function is 0. With capacity 0 `out` may be
 * NULL and only `first` and `count` are written, each of which may be NULL; that costs as much.
 * derivative: its order, 0 for the function itself.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL; UNSUPPORTED where there is no
 * mask, no limit or no such derivative; TOO_LARGE for more than 2^20 samples; OVERFLOW for one
 * beyond doubles; MEMORY_CEILING; CANCELLED. */
CARVEL_API carvel_status carvel_mask_sample_limit(const carvel_mask *mask,
                                                  const carvel_context *context,
                                                  uint32_t derivative, uint32_t levels,
                                                  int64_t *first, double *out,
                                                  uint64_t capacity, uint64_t *count,
                                                  carvel_error *error);

/* The points, and the ends, that some steps, 64 at most, make of a polygon of so many
 * points; counts->struct_size must be set. No cost.
 * ends: one of enum carvel_ends.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; PARAMETER_OUT_OF_RANGE for ends or
 * steps; LENGTH_MISMATCH for too few points; UNSUPPORTED for ends that stay under a mask
 * that is not symmetric; TOO_LARGE. */
CARVEL_API carvel_status carvel_mask_counts(const carvel_mask *mask, int32_t ends,
                                            uint64_t points, uint32_t steps,
                                            carvel_polygon_counts *counts,
                                            carvel_error *error);

/* Refines a polygon, `steps` times: a record for every point in, and out, of the same
 * width, as many as carvel_mask_counts says. Some nanoseconds for each point, and twice
 * the memory of the result on the way.
 * Errors: as carvel_mask_counts; INVALID_STRIDE, OVERLAP, BUFFER_TOO_SMALL; LENGTH_MISMATCH
 * for different widths, and for numbers of a scheme that are not one for each edge;
 * PARAMETER_OUT_OF_RANGE for such a number; NOT_FINITE, OVERFLOW, naming the point;
 * MEMORY_CEILING, OUT_OF_RESOURCES, CANCELLED. */
CARVEL_API carvel_status carvel_mask_refine_f32(const carvel_mask *mask,
                                                const carvel_context *context, int32_t ends,
                                                uint32_t steps,
                                                const carvel_const_values_f32 *points,
                                                const carvel_values_f32 *out,
                                                carvel_error *error);
CARVEL_API carvel_status carvel_mask_refine_f64(const carvel_mask *mask,
                                                const carvel_context *context, int32_t ends,
                                                uint32_t steps,
                                                const carvel_const_values_f64 *points,
                                                const carvel_values_f64 *out,
                                                carvel_error *error);

/* The points, and the ends, of carvel_mask_limit_f32; counts->struct_size must be set.
 * Errors: as carvel_mask_limit_f32, without those of records. */
CARVEL_API carvel_status carvel_mask_limit_counts(const carvel_mask *mask, int32_t ends,
                                                  uint64_t points, uint32_t derivative,
                                                  carvel_polygon_counts *counts,
                                                  carvel_error *error);

/* Points of the limit curve that belong to the points of a polygon, as many as
 * carvel_mask_limit_counts says, or derivatives of some order by a parameter that grows by
 * 1 from point to point. Anchors stay, and have no derivatives.
 * Errors: as carvel_mask_refine_f32; UNSUPPORTED where there is no mask, no limit or no
 * such derivative. */
CARVEL_API carvel_status carvel_mask_limit_f32(const carvel_mask *mask,
                                               const carvel_context *context, int32_t ends,
                                               uint32_t derivative,
                                               const carvel_const_values_f32 *points,
                                               const carvel_values_f32 *out,
                                               carvel_error *error);
CARVEL_API carvel_status carvel_mask_limit_f64(const carvel_mask *mask,
                                               const carvel_context *context, int32_t ends,
                                               uint32_t derivative,
                                               const carvel_const_values_f64 *points,
                                               const carvel_values_f64 *out,
                                               carvel_error *error);

/* Refines a grid, `steps` times, by the tensor product of two masks: `down` from row to
 * row and `along` the rows. Points are row by row, `columns` to a row; the result has the
 * rows that carvel_mask_counts says for `down` and the columns that it says for `along`.
 * Errors: as carvel_mask_refine_f32, and LENGTH_MISMATCH for points that are no full rows. */
CARVEL_API carvel_status carvel_mask_refine_grid_f32(const carvel_mask *down,
                                                     const carvel_mask *along,
                                                     const carvel_context *context,
                                                     int32_t ends_down, int32_t ends_along,
                                                     uint64_t columns, uint32_t steps,
                                                     const carvel_const_values_f32 *points,
                                                     const carvel_values_f32 *out,
                                                     carvel_error *error);
CARVEL_API carvel_status carvel_mask_refine_grid_f64(const carvel_mask *down,
                                                     const carvel_mask *along,
                                                     const carvel_context *context,
                                                     int32_t ends_down, int32_t ends_along,
                                                     uint64_t columns, uint32_t steps,
                                                     const carvel_const_values_f64 *points,
                                                     const carvel_values_f64 *out,
                                                     carvel_error *error);

/* ==========================================================================
 * carvel_grid_mask: a scheme of grids
 *
 * A mask of two directions, such as that of a box spline, where carvel_mask_refine_grid_f32
 * has products of two masks: new point (i, j) is the sum of a(i - m k, j - n l) times old point
 * (k, l). Immutable and shared freely.
 * ========================================================================== */

typedef struct carvel_grid_mask carvel_grid_mask;

/* Makes a mask of two directions, `down` from row to row and `along` the rows.
 * coefficients: `count` of them, 2^20 at most, row by row, `columns` to a row.
 * arity_down, arity_along: new rows and columns for each old one, 2 to 64.
 * offset_down, offset_along: the index of the first coefficient, -1048576 to 1048576.
 * Errors: NULL_POINTER, MISALIGNED; INVALID_NUMBER for a denominator 0 and INT64_MIN;
 * PARAMETER_OUT_OF_RANGE for an arity, an offset, coefficients that are no full rows or do not
 * sum to 1 for each pair of residues; TOO_LARGE; OUT_OF_RESOURCES. */
CARVEL_API carvel_status carvel_grid_mask_create(const carvel_fraction *coefficients,
                                                 uint64_t count, uint64_t columns,
                                                 uint32_t arity_down, uint32_t arity_along,
                                                 int64_t offset_down, int64_t offset_along,
                                                 carvel_grid_mask **out, carvel_error *error);

/* Destroys a mask; NULL is allowed. */
CARVEL_API void carvel_grid_mask_destroy(carvel_grid_mask *mask);

/* The rows and columns that some steps, 64 at most, make of a grid. No cost.
 * ends_down, ends_along: CARVEL_ENDS_CLOSED or CARVEL_ENDS_DROPPED.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP; PARAMETER_OUT_OF_RANGE for ends or steps;
 * LENGTH_MISMATCH for too few rows or columns; UNSUPPORTED for ends that stay; TOO_LARGE. */
CARVEL_API carvel_status carvel_grid_mask_counts(const carvel_grid_mask *mask,
                                                 int32_t ends_down, int32_t ends_along,
                                                 uint64_t rows, uint64_t columns,
                                                 uint32_t steps, uint64_t *refined_rows,
                                                 uint64_t *refined_columns,
                                                 carvel_error *error);

/* Refines a grid, `steps` times. Points are row by row, `columns` to a row; the result has the
 * rows and columns that carvel_grid_mask_counts says.
 * Errors: as carvel_mask_refine_f32 and carvel_grid_mask_counts, and LENGTH_MISMATCH for points
 * that are no full rows. */
CARVEL_API carvel_status carvel_grid_mask_refine_f32(const carvel_grid_mask *mask,
                                                     const carvel_context *context,
                                                     int32_t ends_down, int32_t ends_along,
                                                     uint64_t columns, uint32_t steps,
                                                     const carvel_const_values_f32 *points,
                                                     const carvel_values_f32 *out,
                                                     carvel_error *error);
CARVEL_API carvel_status carvel_grid_mask_refine_f64(const carvel_grid_mask *mask,
                                                     const carvel_context *context,
                                                     int32_t ends_down, int32_t ends_along,
                                                     uint64_t columns, uint32_t steps,
                                                     const carvel_const_values_f64 *points,
                                                     const carvel_values_f64 *out,
                                                     carvel_error *error);

/* ==========================================================================
 * Catalogue: the schemes of polygons that have names
 *
 * Texts are UTF-8, end with a zero byte and stay as long as the library is loaded.
 * ========================================================================== */

/* A scheme, or a family of them with parameters. */
typedef struct carvel_catalogue_entry {
    uint32_t struct_size;
    /* 1 if it has a mask; 0 if its rules change from level to level or from edge to edge. */
    int32_t is_stationary;
    /* What carvel_mask_create takes; parameters follow after a colon, with commas. */
    const char *name;
    /* One line about it. */
    const char *summary;
    const char *authors;
    /* Of publication: "1974; 1975" where there are several. */
    const char *year;
    /* Of the mask or its symbol, or of the rules. */
    const char *formula;
    /* How sure it is that the formula is the authors': "textbook", "derived", "memory" or
     * "reconstructed" (docs/curves.md). */
    const char *attribution;
    /* Of rules that change: the scheme they become where nothing does. Otherwise empty. */
    const char *limit;
    /* Parameters of the mask; 0 for rules that change. */
    uint64_t parameter_count;
} carvel_catalogue_entry;

/* A parameter of a family. */
typedef struct carvel_catalogue_parameter {
    uint32_t struct_size;
    /* 1 if the mask is linear in it and any number is a value; 0 if it counts something. */
    int32_t is_free;
    const char *name;
    /* Which values make sense, in words. */
    const char *range;
    /* The value that is taken if none is given, a number as in a mask. */
    const char *default_value;
} carvel_catalogue_parameter;

/* Values of a parameter for which the schemes of a family are C^k: all that were sampled from
 * low_inside to high_inside. Proved is it for those two; the schemes of low_outside and
 * high_outside are proved to have an exponent of k at most, and are not C^k if the shifts of
 * their limit functions are stable; 0/0 where the search ended before. A value that is alone has
 * both insides. The layout is final. */
typedef struct carvel_parameter_range {
    carvel_fraction low_outside;
    carvel_fraction low_inside;
    carvel_fraction high_inside;
    carvel_fraction high_outside;
} carvel_parameter_range;

/* Sets every field to its default: struct_size is sizeof the struct.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE. */
CARVEL_API carvel_status carvel_catalogue_entry_init(carvel_catalogue_entry *entry,
                                                     uint32_t struct_size);
CARVEL_API carvel_status carvel_catalogue_parameter_init(carvel_catalogue_parameter *parameter,
                                                         uint32_t struct_size);

/* The number of schemes. */
CARVEL_API uint64_t carvel_catalogue_count(void);

/* A scheme; entry->struct_size must be set. The order may change with the version.
 * Errors: NULL_POINTER, MISALIGNED, STRUCT_SIZE; INDEX_OUT_OF_RANGE. */
CARVEL_API carvel_status carvel_catalogue_entry_at(uint64_t index,
                                                   carvel_catalogue_entry *entry,
                                                   carvel_error *error);

/* A parameter of a scheme, in the order in which they are given; parameter->struct_size must
 * be set.
 * Errors: as carvel_catalogue_entry_at. */
CARVEL_API carvel_status carvel_catalogue_parameter_at(uint64_t index,
                                                       uint64_t parameter_index,
                                                       carvel_catalogue_parameter *parameter,
                                                       carvel_error *error);

/* For which values of a parameter from `low` to `high` the schemes of a family are
 * C^`continuity`, in ascending order; about a second. Intervals narrower than a 32nd of the
 * search may be missed. With capacity 0 `out` may be NULL and only `count`, which may be NULL,
 * is written; that costs as much.
 * name: as carvel_mask_create takes it, with the values of other parameters.
 * parameter: the name of one that is free.
 * tolerance: between the inside and the outside of an end, where both can be proved.
 * Errors: NULL_POINTER, MISALIGNED, OVERLAP, BUFFER_TOO_SMALL; INVALID_NUMBER for an unknown
 * name, and for a fraction with the denominator 0; PARAMETER_OUT_OF_RANGE for a parameter that
 * is not there or not free, an empty search and a tolerance that is not positive; TOO_LARGE for
 * an end that does not fit 64 bits; CANCELLED. */
CARVEL_API carvel_status carvel_catalogue_ranges(const char *name, const char *parameter,
                                                 const carvel_context *context,
                                                 uint32_t continuity, carvel_fraction low,
                                                 carvel_fraction high,
                                                 carvel_fraction tolerance,
                                                 carvel_parameter_range *out,
                                                 uint64_t capacity, uint64_t *count,
                                                 carvel_error *error);

#ifdef __cplusplus
}
#endif

#endif /* CARVEL_H */
