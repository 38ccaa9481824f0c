/* Every function of searches: points and rays with answers known by hand, what is out of
 * reach, agreement with evaluation; and every wrong call. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 3 };

/* Two by two unit quads in the plane z = 0, which bilinear refinement leaves there. */
typedef struct fixture {
    poly *soup;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_surface *surface;
    carvel_context *context;
    carvel_search *search;
} fixture;

static carvel_const_values_f64 control64(const fixture *it)
{
    carvel_const_values_f64 values;
    values.data = it->soup->positions;
    values.count = it->soup->vertices;
    values.width = WIDTH;
    values.stride = 0;
    return values;
}

static void set_up(fixture *it)
{
    carvel_const_values_f64 from;
    uint64_t v;
    it->soup = poly_grid(2, 2);
    for (v = 0; v < it->soup->vertices; v++) {
        it->soup->positions[WIDTH * v] = (double)(v % 3);
        it->soup->positions[WIDTH * v + 1] = (double)(v / 3);
        it->soup->positions[WIDTH * v + 2] = 0;
    }
    it->mesh = poly_mesh(it->soup);
    it->scheme = scheme_of(CARVEL_SCHEME_BILINEAR, 0);
    it->context = context_of(2);
    it->surface = NULL;
    it->search = NULL;
    from = control64(it);
    CHECK_OK(carvel_surface_create(it->context, it->mesh, it->scheme, &it->surface, failure));
    CHECK_OK(carvel_search_create_f64(it->context, it->surface, &from, &it->search, failure));
}

static void tear_down(fixture *it)
{
    carvel_search_destroy(it->search);
    carvel_surface_destroy(it->surface);
    carvel_context_destroy(it->context);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->soup);
}

static void check_at(const fixture *with, const carvel_sample *sample, const double *point)
{
    carvel_const_values_f64 from = control64(with);
    double at[WIDTH];
    carvel_values_f64 to;
    uint64_t k;
    to.data = at;
    to.count = 1;
    to.width = WIDTH;
    to.stride = 0;
    CHECK_OK(carvel_surface_evaluate_f64(with->surface, NULL, sample, 1, CARVEL_DERIVATIVES_NONE,
                                         &from, &to, failure));
    for (k = 0; k < WIDTH; k++)
        CHECK(fabs(at[k] - point[k]) < 1e-12);
}

/* ------------------------------------------------------------------- by hand */

/* Feet of perpendiculars, points of the border, and what is out of reach. */
static void check_closest(const fixture *with)
{
    static const double points[4][WIDTH] = {{0.25, 1.5, 2}, {1, 1, -3}, {5, 2, 4}, {9, 9, 9}};
    static const double feet[3][WIDTH] = {{0.25, 1.5, 0}, {1, 1, 0}, {2, 2, 0}};
    static const double distances[3] = {2, 3, 5};
    carvel_closest found[4];
    uint64_t i, k;
    CHECK_OK(carvel_search_closest(with->search, with->context, points[0], 4, 6, found, failure));
    for (i = 0; i < 3; i++) {
        CHECK(fabs(found[i].distance - distances[i]) < 1e-9);
        for (k = 0; k < WIDTH; k++)
            CHECK(fabs(found[i].point[k] - feet[i][k]) < 1e-6);
        CHECK(found[i].sample.face < 4);
        check_at(with, &found[i].sample, found[i].point);
    }
    CHECK_UINT(UINT32_MAX, found[3].sample.face);
    CHECK(found[3].distance > 1e300);
    CHECK_OK(carvel_search_closest(with->search, NULL, points[3], 1, HUGE_VAL, found, failure));
    CHECK(fabs(found[0].distance - sqrt(49 + 49 + 81)) < 1e-9);
    CHECK_OK(carvel_search_closest(with->search, NULL, NULL, 0, 1, NULL, failure));
}

/* From above, slanting, beside, and too short. */
static void check_rays(const fixture *with)
{
    static const carvel_ray rays[4] = {
        {{0.25, 1.5, 2}, {0, 0, -4}, {0, HUGE_VAL}},
        {{0, 0, 1}, {1, 1, -1}, {0, HUGE_VAL}},
        {{3, 1, 1}, {0, 0, -1}, {0, HUGE_VAL}},
        {{1, 1, 1}, {0, 0, -1}, {0, 0.5}},
    };
    carvel_hit found[4];
    CHECK_OK(carvel_search_intersect(with->search, with->context, rays, 4, found, failure));
    CHECK(fabs(found[0].t - 0.5) < 1e-12 && fabs(found[0].point[1] - 1.5) < 1e-9);
    check_at(with, &found[0].sample, found[0].point);
    CHECK(fabs(found[1].t - 1) < 1e-9 && fabs(found[1].point[0] - 1) < 1e-9);
    CHECK_UINT(UINT32_MAX, found[2].sample.face);
    CHECK_UINT(UINT32_MAX, found[3].sample.face);
    CHECK(found[3].t > 1e300);
}

/* Floats with gaps; a search outlives its surface. */
static void check_floats(void)
{
    enum { GAP = WIDTH + 1 };
    static const double above[WIDTH] = {0.5, 0.5, 1};
    fixture with;
    float *control;
    carvel_const_values_f32 from;
    carvel_search *search = NULL;
    carvel_closest found;
    uint64_t i;
    set_up(&with);
    control = TAKE(float, GAP * with.soup->vertices);
    for (i = 0; i < GAP * with.soup->vertices; i++)
        control[i] = i % GAP == WIDTH ? 777 : (float)with.soup->positions[i / GAP * WIDTH + i % GAP];
    from.data = control;
    from.count = with.soup->vertices;
    from.width = WIDTH;
    from.stride = GAP * sizeof *control;
    CHECK_OK(carvel_search_create_f32(NULL, with.surface, &from, &search, failure));
    carvel_surface_destroy(with.surface);
    with.surface = NULL;
    CHECK_OK(carvel_search_closest(search, NULL, above, 1, 2, &found, failure));
    CHECK(fabs(found.distance - 1) < 1e-9);
    carvel_search_destroy(search);
    free(control);
    tear_down(&with);
}

/* -------------------------------------------------------------------- misuse */

#define REFUSE(status, call) CHECK_STATUS(CARVEL_STATUS_##status, call)
/* A pointer that is not aligned. */
#define OFF(type, pointer) ((type *)(void *)((char *)(void *)(uintptr_t)(pointer) + 1))

static void check_wrong_makers(const fixture *with)
{
    carvel_const_values_f64 from = control64(with), f;
    carvel_search *made = NULL;
#define CREATE(status, surface, from, out) \
    (REFUSE(status, carvel_search_create_f64(with->context, (surface), (from), (out), failure)), \
     CHECK(made == NULL))
    CREATE(NULL_POINTER, NULL, &from, &made);
    CREATE(NULL_POINTER, with->surface, NULL, &made);
    CREATE(NULL_POINTER, with->surface, &from, NULL);
    CREATE(MISALIGNED, with->surface, &from, OFF(carvel_search *, &made));
    f = from, f.width = 2;
    CREATE(LENGTH_MISMATCH, with->surface, &f, &made);
    f = from, f.count--;
    CREATE(LENGTH_MISMATCH, with->surface, &f, &made);
    with->soup->positions[4] = (double)NAN;
    CREATE(NOT_FINITE, with->surface, &from, &made);
    with->soup->positions[4] = 0;
    carvel_context_cancel(with->context);
    CREATE(CANCELLED, with->surface, &from, &made);
    carvel_context_reset(with->context);
    carvel_search_destroy(NULL);
}

static void check_wrong_queries(const fixture *with)
{
    double points[2 * WIDTH] = {0, 0, 1, 0, 0, 1};
    carvel_ray rays[2] = {{{0, 0, 1}, {0, 0, 1}, {0, 1}}, {{0, 0, 1}, {0, 0, 1}, {0, 1}}};
    carvel_closest found[2];
    carvel_hit hits[2];
    carvel_search *search = with->search;
#define CLOSEST(status, search, points, count, reach, out) \
    REFUSE(status, carvel_search_closest((search), with->context, (points), (count), (reach), \
                                         (out), failure))
#define RAYS(status, search, rays, count, out) \
    REFUSE(status, carvel_search_intersect((search), with->context, (rays), (count), (out), \
                                           failure))
    CLOSEST(NULL_POINTER, NULL, points, 2, 1, found);
    CLOSEST(NULL_POINTER, search, NULL, 2, 1, found);
    CLOSEST(NULL_POINTER, search, points, 2, 1, NULL);
    CLOSEST(MISALIGNED, search, OFF(double, points), 1, 1, found);
    CLOSEST(MISALIGNED, search, points, 1, 1, OFF(carvel_closest, found));
    CLOSEST(TOO_LARGE, search, points, UINT64_MAX / 2, 1, found);
    CLOSEST(OVERLAP, search, (double *)(void *)found, 1, 1, found);
    CLOSEST(PARAMETER_OUT_OF_RANGE, search, points, 2, -1, found);
    CLOSEST(PARAMETER_OUT_OF_RANGE, search, points, 2, (double)NAN, found);
    points[4] = (double)INFINITY;
    CLOSEST(NOT_FINITE, search, points, 2, 1, found);
    CHECK(strstr(carvel_error_message(failure), "1") != NULL);
    points[4] = 0;
    RAYS(NULL_POINTER, NULL, rays, 2, hits);
    RAYS(NULL_POINTER, search, NULL, 2, hits);
    RAYS(NULL_POINTER, search, rays, 2, NULL);
    RAYS(MISALIGNED, search, OFF(const carvel_ray, rays), 1, hits);
    RAYS(TOO_LARGE, search, rays, UINT64_MAX / 2, hits);
    RAYS(OVERLAP, search, (carvel_ray *)(void *)hits, 1, hits);
    rays[1].direction[2] = 0;
    RAYS(PARAMETER_OUT_OF_RANGE, search, rays, 2, hits);
    rays[1].direction[2] = (double)NAN;
    RAYS(NOT_FINITE, search, rays, 2, hits);
    rays[1].direction[2] = 1;
    rays[1].range[1] = (double)NAN;
    RAYS(NOT_FINITE, search, rays, 2, hits);
    rays[1].range[1] = 1;
    carvel_context_cancel(with->context);
    CLOSEST(CANCELLED, search, points, 2, 1, found);
    RAYS(CANCELLED, search, rays, 2, hits);
    carvel_context_reset(with->context);
}

int main(void)
{
    fixture with;
    check_begin();
    set_up(&with);
    check_closest(&with);
    check_rays(&with);
    check_wrong_makers(&with);
    check_wrong_queries(&with);
    tear_down(&with);
    check_floats();
    return check_end();
}
