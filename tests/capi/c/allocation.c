/* Memory that runs out: this program's own malloc fails the n-th large request,
 * for n = 1, 2, 3 ... until a call does without the n-th. Every call must answer
 * OUT_OF_RESOURCES, leave every object usable, and leak nothing. Argument 1:
 * quads along a side of the mesh. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "fixture.h"

#include <errno.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------- interposition */

/* Requests below this are those of small objects, which may end a process. */
enum { LARGE = 32 * 1024 };

/* The C library's own, under names that stay when malloc is another. */
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

/* The large request to fail, counted from 1, and whether all after it fail too;
 * 0 for none. Threads of a context allocate as well: all counts are atomic. */
static long fail_at = 0;
static int fail_all = 0;
static long requests = 0;
static long failed = 0;
/* Bytes had and not given back. */
static long live = 0;

/* 1 if a request is to be refused. */
static int refuse(size_t size)
{
    long number;
    if (size < LARGE || __sync_fetch_and_add(&fail_at, 0) == 0)
        return 0;
    number = __sync_add_and_fetch(&requests, 1);
    if (number != fail_at && !(fail_all && number > fail_at))
        return 0;
    __sync_fetch_and_add(&failed, 1);
    errno = ENOMEM;
    return 1;
}

static void *had(void *memory)
{
    if (memory != NULL)
        __sync_fetch_and_add(&live, (long)malloc_usable_size(memory));
    return memory;
}

static void given_back(void *memory)
{
    if (memory != NULL)
        __sync_fetch_and_sub(&live, (long)malloc_usable_size(memory));
}

void *malloc(size_t size)
{
    return refuse(size) ? NULL : had(__libc_malloc(size));
}

void *calloc(size_t count, size_t size)
{
    size_t bytes = size != 0 && count > (size_t)-1 / size ? (size_t)-1 : count * size;
    return refuse(bytes) ? NULL : had(__libc_calloc(count, size));
}

void *realloc(void *old, size_t size)
{
    void *memory;
    if (refuse(size))
        return NULL;
    given_back(old);
    memory = __libc_realloc(old, size);
    return had(memory != NULL || size == 0 ? memory : old);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return refuse(size) ? NULL : had(__libc_memalign(alignment, size));
}

int posix_memalign(void **out, size_t alignment, size_t size)
{
    void *memory = aligned_alloc(alignment, size);
    if (memory == NULL)
        return ENOMEM;
    *out = memory;
    return 0;
}

void free(void *memory)
{
    given_back(memory);
    __libc_free(memory);
}

static void begin_failing(long number, int all)
{
    requests = failed = 0;
    fail_all = all;
    __sync_synchronize();
    fail_at = number;
}

static void end_failing(void)
{
    fail_at = 0;
    __sync_synchronize();
}

/* ---------------------------------------------------------------------- calls */

/* Everything that calls need, and what they should come to. */
typedef struct setup {
    poly *control, *shuffled;
    /* Refused for thousands of edges; for faces that cannot be used as well. */
    poly *broken, *unusable;
    uint32_t levels;
    carvel_context *context;
    carvel_mesh *mesh, *ordered;
    carvel_scheme *scheme;
    carvel_hierarchy *hierarchy;
    /* A mesh of its own, a quarter as large, and a sample on each of its faces. */
    poly *patch;
    carvel_mesh *patch_mesh;
    carvel_surface *surface;
    carvel_sample *samples;
    level64 expected, level;
    /* Room for any array of a call: the test's own memory must not run out. */
    double *room;
} setup;

/* Faces at one edge of the broken mesh: a list of them alone is a large request. */
enum { HUB = 4200 };

/* A call: makes what it makes and takes it back; the answer is its status. */
typedef carvel_status (*call)(setup *it);

static carvel_status build(const setup *it, const carvel_mesh_desc *desc)
{
    carvel_mesh *mesh = NULL;
    carvel_status status = carvel_mesh_create(it->context, desc, &mesh, failure);
    end_failing();
    if (status == CARVEL_STATUS_OK)
        CHECK_OK(carvel_mesh_validate(mesh, failure));
    carvel_mesh_destroy(mesh);
    return status;
}

static carvel_status create_mesh(setup *it)
{
    carvel_mesh_desc desc;
    poly_describe(it->control, &desc);
    return build(it, &desc);
}

static carvel_status create_mesh_by_size(setup *it)
{
    carvel_mesh_desc desc;
    poly_describe(it->control, &desc);
    desc.face_sizes = NULL;
    desc.face_size = 4;
    return build(it, &desc);
}

/* Faces in no order, so that the mesh puts them in one; cut apart. */
static carvel_status create_shuffled(setup *it)
{
    carvel_mesh_desc desc;
    poly_describe(it->shuffled, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    return build(it, &desc);
}

/* Everything that the error says of a mesh with so many defects. */
static void read_defects(void)
{
    uint64_t entries = carvel_error_entry_count(failure), entry, element, most = 0;
    CHECK(entries > 200);
    for (entry = 0; entry < entries; entry++) {
        uint64_t elements = carvel_error_element_count(failure, entry);
        carvel_status status = carvel_error_entry_status(failure, entry);
        CHECK(status >= CARVEL_STATUS_REPEATED_VERTEX &&
              status <= CARVEL_STATUS_NON_MANIFOLD_VERTEX);
        CHECK(carvel_error_entry_message(failure, entry)[0] != '\0');
        for (element = 0; element < elements; element++)
            CHECK(carvel_error_element(failure, entry, element).kind != 0);
        most = elements > most ? elements : most;
    }
    /* The edge that all faces of the hub share. */
    CHECK(most > HUB);
}

static carvel_status create_broken_mesh(const setup *it, const poly *soup)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    carvel_status status;
    poly_describe(soup, &desc);
    status = carvel_mesh_create(it->context, &desc, &mesh, failure);
    CHECK(mesh == NULL);
    CHECK_UINT(status, carvel_error_status(failure));
    if (status != CARVEL_STATUS_OUT_OF_RESOURCES)
        read_defects();
    else
        CHECK_UINT(1, carvel_error_entry_count(failure));
    return status;
}

static carvel_status create_broken(setup *it)
{
    return create_broken_mesh(it, it->broken);
}

static carvel_status create_unusable(setup *it)
{
    return create_broken_mesh(it, it->unusable);
}

/* What is refused without it is cut apart. */
static carvel_status create_cut(setup *it)
{
    carvel_mesh_desc desc;
    poly_describe(it->broken, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    return build(it, &desc);
}

static carvel_status refine(setup *it)
{
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(it->mesh, it->scheme, it->levels, it->control->positions);
    carvel_status status = carvel_refiner_refine_f64(refiner, it->context, &input,
                                                     &it->level.output, failure);
    carvel_refiner_destroy(refiner);
    return status;
}

/* The same refiner after a failure is as good as new. */
static carvel_status refine_again(setup *it)
{
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(it->mesh, it->scheme, it->levels, it->control->positions);
    carvel_status status = carvel_refiner_refine_f64(refiner, it->context, &input,
                                                     &it->level.output, failure);
    end_failing();
    CHECK_OK(carvel_refiner_refine_f64(refiner, it->context, &input, &it->level.output,
                                       failure));
    CHECK_BYTES(it->expected.output.positions.data, it->level.output.positions.data,
                (size_t)it->expected.counts.vertices * 3 * sizeof(double));
    carvel_refiner_destroy(refiner);
    return status;
}

/* With gaps between records, through copies. */
static carvel_status refine_strided(setup *it)
{
    carvel_refiner *refiner = refiner_of();
    carvel_refine_input_f64 input = input64(it->mesh, it->scheme, it->levels, it->control->positions);
    carvel_refine_output_f64 output = it->level.output;
    carvel_status status;
    output.positions.data = it->room;
    output.positions.stride = 4 * sizeof(double);
    status = carvel_refiner_refine_f64(refiner, it->context, &input, &output, failure);
    carvel_refiner_destroy(refiner);
    return status;
}

static carvel_status create_hierarchy(setup *it)
{
    carvel_hierarchy *hierarchy = NULL;
    carvel_status status =
        carvel_hierarchy_create(it->context, it->mesh, it->scheme, it->levels, &hierarchy, failure);
    CHECK((hierarchy != NULL) == (status == CARVEL_STATUS_OK));
    carvel_hierarchy_destroy(hierarchy);
    return status;
}

static carvel_status refine_hierarchy(setup *it)
{
    carvel_const_values_f64 in;
    memset(&in, 0, sizeof in);
    in.data = it->control->positions;
    in.count = it->control->vertices;
    in.width = 3;
    return carvel_hierarchy_refine_f64(it->hierarchy, it->context, it->levels, &in,
                                       &it->level.output.positions, failure);
}

static carvel_status ask_origins(setup *it)
{
    uint64_t count = it->level.counts.vertices, faces = it->level.counts.faces;
    carvel_origin *origins = (carvel_origin *)(void *)it->room;
    carvel_status status = carvel_hierarchy_vertex_origins(it->hierarchy, it->levels,
                                                           origins, count, failure);
    if (status == CARVEL_STATUS_OK)
        status = carvel_hierarchy_face_origins(it->hierarchy, it->levels, origins, faces,
                                               failure);
    return status;
}

static carvel_status create_surface(setup *it)
{
    carvel_surface *surface = NULL;
    carvel_status status =
        carvel_surface_create(it->context, it->patch_mesh, it->scheme, &surface, failure);
    CHECK((surface != NULL) == (status == CARVEL_STATUS_OK));
    carvel_surface_destroy(surface);
    return status;
}

/* Into records with gaps, through a copy. */
static carvel_status evaluate_surface(setup *it)
{
    carvel_const_values_f64 in;
    carvel_values_f64 out;
    memset(&in, 0, sizeof in);
    in.data = it->patch->positions;
    in.count = it->patch->vertices;
    in.width = 3;
    out.data = it->room;
    out.count = it->patch->faces;
    out.width = 3;
    out.stride = 4 * sizeof(double);
    return carvel_surface_evaluate_f64(it->surface, it->context, it->samples, it->patch->faces,
                                       CARVEL_DERIVATIVES_NONE, &in, &out, failure);
}

static carvel_status surface_stencils(setup *it)
{
    uint64_t count = it->patch->faces / 2;
    carvel_stencils *table = NULL;
    carvel_status status =
        carvel_surface_stencils(it->context, it->surface, it->samples, count,
                                CARVEL_DERIVATIVES_FIRST, CARVEL_PRECISION_F64, &table, failure);
    CHECK((table != NULL) == (status == CARVEL_STATUS_OK));
    carvel_stencils_destroy(table);
    return status;
}

static carvel_status survey(setup *it)
{
    carvel_survey all;
    CHECK_OK(carvel_survey_init(&all, sizeof all));
    return carvel_mesh_survey(it->ordered, &all, failure);
}

static carvel_status histogram(setup *it)
{
    return carvel_mesh_histogram(it->ordered, CARVEL_HISTOGRAM_FACE_SIZES, NULL, 0, NULL,
                                 failure);
}

static carvel_status rows(setup *it)
{
    uint64_t count = it->level.counts.vertices + 1;
    return carvel_hierarchy_rows(it->hierarchy, it->levels, 0, (uint64_t *)(void *)it->room,
                                 count, NULL, NULL, 0, NULL, failure);
}

static carvel_status predict(setup *it)
{
    carvel_counts counts;
    CHECK_OK(carvel_counts_init(&counts, sizeof counts));
    return carvel_predict_counts(it->ordered, it->scheme, it->levels, &counts, failure);
}

static carvel_status validate(setup *it)
{
    return carvel_mesh_validate(it->ordered, failure);
}

/* --------------------------------------------------------------------- failing */

/* Calls with one failure at each large request, or with all from there on; the
 * number of requests that were made to fail. */
static long fail_each(setup *it, call run, int all, carvel_status expected)
{
    long number, before;
    carvel_status status;
    for (number = 1;; number++) {
        before = live;
        begin_failing(number, all);
        status = run(it);
        end_failing();
        if (failed == 0)
            break;
        CHECK_STATUS(CARVEL_STATUS_OUT_OF_RESOURCES, status);
        /* A refused call says so in words, which are a small allocation. */
        CHECK(live < before + 4096);
        if (!CHECK(number < 1000))
            break;
    }
    CHECK_STATUS(expected, status);
    /* As good as ever. */
    CHECK_STATUS(expected, run(it));
    return number - 1;
}

static void check_answer(setup *it, const char *name, call run, carvel_status expected)
{
    long once, from;
    check_context(name);
    /* What is made once and kept is made now. */
    CHECK_STATUS(expected, run(it));
    fprintf(stderr, "%s:", name);
    once = fail_each(it, run, 0, expected);
    from = fail_each(it, run, 1, expected);
    fprintf(stderr, " %ld and %ld failures\n", once, from);
    CHECK_UINT(once, from);
}

static void check_call(setup *it, const char *name, call run)
{
    check_answer(it, name, run, CARVEL_STATUS_OK);
}

static void check_all(setup *it)
{
    check_call(it, "create mesh", create_mesh);
    check_call(it, "create mesh by size", create_mesh_by_size);
    check_call(it, "create shuffled mesh", create_shuffled);
    check_answer(it, "create broken mesh", create_broken, CARVEL_STATUS_NON_MANIFOLD_EDGE);
    check_answer(it, "create unusable mesh", create_unusable, CARVEL_STATUS_REPEATED_VERTEX);
    check_call(it, "cut broken mesh", create_cut);
    check_call(it, "refine", refine);
    check_call(it, "refine again", refine_again);
    check_call(it, "refine strided", refine_strided);
    check_call(it, "create hierarchy", create_hierarchy);
    check_call(it, "refine hierarchy", refine_hierarchy);
    check_call(it, "origins", ask_origins);
    check_call(it, "create surface", create_surface);
    check_call(it, "evaluate surface", evaluate_surface);
    check_call(it, "surface stencils", surface_stencils);
    check_call(it, "survey", survey);
    check_call(it, "histogram", histogram);
    check_call(it, "rows", rows);
    check_call(it, "predict", predict);
    check_call(it, "validate", validate);
}

/* The quads of a grid in a random order, triangles among them. */
static poly *shuffle(const poly *grid)
{
    uint64_t state = 1, f, k;
    uint32_t *indices = TAKE(uint32_t, grid->corners), *sizes = TAKE(uint32_t, grid->faces);
    uint32_t *at = indices;
    poly *it;
    memcpy(indices, grid->indices, (size_t)grid->corners * sizeof *indices);
    for (f = grid->faces - 1; f > 0; f--) {
        uint32_t other[4], with = random_below(&state, (uint32_t)f + 1);
        memcpy(other, indices + 4 * f, sizeof other);
        memcpy(indices + 4 * f, indices + 4 * (uint64_t)with, sizeof other);
        memcpy(indices + 4 * (uint64_t)with, other, sizeof other);
    }
    for (f = 0; f < grid->faces; f++) {
        sizes[f] = f % 5 == 0 ? 3 : 4;
        for (k = 0; k < sizes[f]; k++)
            *at++ = indices[4 * f + k];
    }
    it = poly_of(grid->vertices, grid->faces, sizes, indices);
    free(sizes);
    free(indices);
    return it;
}

/* The grid with every second face reversed and `HUB` triangles at one edge, so that
 * most edges are defects. Unusable ones: large faces with a repeated vertex as well,
 * one of them so large that looking at it alone takes much memory. */
static poly *break_grid(const poly *grid, int unusable)
{
    enum { LARGE_FACES = 300, SIZE = 40, HUGE_SIZE = 20000 };
    uint64_t faces = grid->faces + HUB + (unusable ? LARGE_FACES + 1 : 0), f, k, n = grid->vertices;
    uint32_t *sizes = TAKE(uint32_t, faces), *size = sizes, *indices, *at;
    poly *it;
    at = indices = TAKE(uint32_t, grid->corners + 3 * HUB + LARGE_FACES * SIZE + HUGE_SIZE);
    for (f = 0; f < grid->faces; f++) {
        for (k = 0; k < 4; k++)
            *at++ = grid->indices[4 * f + (f % 2 == 0 ? k : 3 - k)];
        *size++ = 4;
    }
    for (f = 0; f < HUB; f++) {
        *at++ = 0;
        *at++ = 1;
        *at++ = (uint32_t)(2 + f % (n - 2));
        *size++ = 3;
    }
    for (f = 0; unusable && f <= LARGE_FACES; f++) {
        uint32_t corners = f < LARGE_FACES ? SIZE : HUGE_SIZE;
        for (k = 0; k + 1 < corners; k++)
            *at++ = (uint32_t)((f + k) % n);
        /* The first again. */
        *at++ = (uint32_t)(f % n);
        *size++ = corners;
    }
    it = poly_of(n, faces, sizes, indices);
    free(sizes);
    free(indices);
    return it;
}

static carvel_mesh *cut(const poly *it)
{
    carvel_mesh *mesh = NULL;
    carvel_mesh_desc desc;
    poly_describe(it, &desc);
    desc.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    CHECK_OK(carvel_mesh_create(NULL, &desc, &mesh, failure));
    return mesh;
}

static void setup_take(setup *it, uint32_t side, uint32_t levels)
{
    uint64_t f;
    it->levels = levels;
    it->control = poly_grid(side, side);
    it->shuffled = shuffle(it->control);
    it->broken = break_grid(it->control, 0);
    it->unusable = break_grid(it->control, 1);
    it->mesh = poly_mesh(it->control);
    it->ordered = cut(it->shuffled);
    it->scheme = scheme_of(CARVEL_SCHEME_THREE_POINT, 0);
    it->hierarchy = hierarchy_of(it->mesh, it->scheme, levels);
    it->context = NULL;
    it->patch = poly_grid(side / 2, side / 2);
    it->patch_mesh = poly_mesh(it->patch);
    it->surface = NULL;
    CHECK_OK(carvel_surface_create(NULL, it->patch_mesh, it->scheme, &it->surface, failure));
    it->samples = TAKE(carvel_sample, it->patch->faces);
    for (f = 0; f < it->patch->faces; f++) {
        it->samples[f].face = (uint32_t)f;
        it->samples[f].sector = 0;
        it->samples[f].u = it->samples[f].v = 0.25;
    }
    level64_refine(&it->expected, NULL, it->mesh, it->scheme, levels, it->control->positions);
    level64_take(&it->level, &it->expected.counts);
    it->room = TAKE(double, 4 * it->expected.counts.vertices);
}

static void setup_free(setup *it)
{
    free(it->room);
    level64_free(&it->level);
    level64_free(&it->expected);
    free(it->samples);
    carvel_surface_destroy(it->surface);
    carvel_mesh_destroy(it->patch_mesh);
    poly_free(it->patch);
    carvel_hierarchy_destroy(it->hierarchy);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->ordered);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->unusable);
    poly_free(it->broken);
    poly_free(it->shuffled);
    poly_free(it->control);
}

static void run_out(uint32_t side, uint32_t levels, uint32_t threads)
{
    setup it;
    fprintf(stderr, "%lu by %lu quads, %lu levels, %lu threads\n", (unsigned long)side,
            (unsigned long)side, (unsigned long)levels, (unsigned long)threads);
    setup_take(&it, side, levels);
    if (threads > 1)
        it.context = context_of(threads);
    check_all(&it);
    carvel_context_destroy(it.context);
    setup_free(&it);
}

int main(int count, char **arguments)
{
    uint32_t side = (uint32_t)size_argument(count, arguments, 200);
    check_begin();
    run_out(side, 1, 1);
    run_out(side, 1, 2);
    run_out(side / 4, 3, 1);
    return check_end();
}
