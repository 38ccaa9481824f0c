/* Every function of tessellations: triangles that hang together, points that are those of
 * the surface, lists that may be left out; and every wrong call. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 3 };

static const double TOLERANCE = 1e-2;

/* An octahedron under Loop, which is smooth. */
typedef struct fixture {
    poly *soup;
    carvel_mesh *mesh;
    carvel_scheme *scheme;
    carvel_surface *surface;
    carvel_context *context;
    carvel_tessellation_desc desc;
} fixture;

static void set_up(fixture *it)
{
    it->soup = poly_octahedron();
    it->mesh = poly_mesh(it->soup);
    it->scheme = scheme_of(CARVEL_SCHEME_LOOP, 0);
    it->context = context_of(2);
    it->surface = NULL;
    CHECK_OK(carvel_surface_create(it->context, it->mesh, it->scheme, &it->surface, failure));
    CHECK_OK(carvel_tessellation_desc_init(&it->desc, sizeof it->desc));
    it->desc.tolerance = TOLERANCE;
}

static void tear_down(fixture *it)
{
    carvel_surface_destroy(it->surface);
    carvel_context_destroy(it->context);
    carvel_scheme_destroy(it->scheme);
    carvel_mesh_destroy(it->mesh);
    poly_free(it->soup);
}

static carvel_const_values_f64 control64(const fixture *it)
{
    carvel_const_values_f64 values;
    values.data = it->soup->positions;
    values.count = it->soup->vertices;
    values.width = WIDTH;
    values.stride = 0;
    return values;
}

static carvel_values_f64 to64(double *data, uint64_t count)
{
    carvel_values_f64 values;
    values.data = data;
    values.count = count;
    values.width = WIDTH;
    values.stride = 0;
    return values;
}

static carvel_tessellation *made64(const fixture *it)
{
    carvel_const_values_f64 from = control64(it);
    carvel_tessellation *made = NULL;
    CHECK_OK(carvel_tessellation_create_f64(it->context, it->surface, &from, &it->desc, &made,
                                            failure));
    return made;
}

static carvel_triangle_counts counts_of_made(const carvel_tessellation *made)
{
    carvel_triangle_counts counts;
    CHECK_OK(carvel_triangle_counts_init(&counts, sizeof counts));
    CHECK_OK(carvel_tessellation_counts(made, &counts, failure));
    return counts;
}

/* --------------------------------------------------------------------- lists */

/* Closed, of the Euler characteristic of a sphere; places are in the triangles' faces, and
 * positions and normals those of the surface there. */
static void check_triangles(const fixture *with)
{
    carvel_tessellation *made = made64(with);
    const carvel_triangle_counts n = counts_of_made(made);
    uint32_t *vertices = TAKE(uint32_t, 3 * n.triangles), *corners = TAKE(uint32_t, 3 * n.triangles);
    uint32_t *faces = TAKE(uint32_t, n.triangles), *of_places = TAKE(uint32_t, n.places);
    carvel_sample *places = TAKE(carvel_sample, n.places);
    double *points = TAKE(double, WIDTH * n.vertices), *normals = TAKE(double, WIDTH * n.places);
    double *surface = TAKE(double, WIDTH * n.places);
    carvel_const_values_f64 from = control64(with);
    carvel_values_f64 to = to64(points, n.vertices), to_normals = to64(normals, n.places);
    carvel_values_f64 to_surface = to64(surface, n.places);
    uint64_t i, k;
    CHECK(n.triangles > 8 && n.triangles % 2 == 0);
    CHECK_UINT(n.triangles, 2 * (n.vertices - 2));
    CHECK(n.measure > 0 && n.measure <= TOLERANCE);
    CHECK_UINT(0, n.coarse + n.missing);
    CHECK_OK(carvel_tessellation_triangles(made, vertices, corners, faces, n.triangles, failure));
    CHECK_OK(carvel_tessellation_places(made, places, of_places, n.places, failure));
    CHECK_OK(carvel_tessellation_positions_f64(made, &to, failure));
    CHECK_OK(carvel_tessellation_normals_f64(made, &to_normals, failure));
    CHECK_OK(carvel_surface_evaluate_f64(with->surface, NULL, places, n.places,
                                         CARVEL_DERIVATIVES_NONE, &from, &to_surface, failure));
    for (i = 0; i < 3 * n.triangles; i++) {
        CHECK(corners[i] < n.places && vertices[i] < n.vertices);
        CHECK_UINT(vertices[i], of_places[corners[i]]);
        CHECK_UINT(faces[i / 3], places[corners[i]].face);
        CHECK(i < 3 || faces[i / 3 - 1] <= faces[i / 3]);
    }
    for (i = 0; i < n.places; i++) {
        double length = 0, outwards = 0;
        for (k = 0; k < WIDTH; k++) {
            double at = points[WIDTH * of_places[i] + k], normal = normals[WIDTH * i + k];
            CHECK(fabs(surface[WIDTH * i + k] - at) < 1e-13);
            length += normal * normal;
            outwards += normal * at;
        }
        CHECK(fabs(length - 1) < 1e-12 && outwards > 0);
    }
    carvel_tessellation_destroy(made);
    free(vertices), free(corners), free(faces), free(of_places), free(places);
    free(points), free(normals), free(surface);
}

/* Floats with gaps, which stay as they are; lists that are not asked for. */
static void check_floats(const fixture *with)
{
    enum { GAP = WIDTH + 1 };
    float *control = poly_floats(with->soup);
    carvel_const_values_f32 from;
    carvel_values_f32 to;
    carvel_tessellation *made = NULL, *same = made64(with);
    carvel_triangle_counts n;
    uint32_t *faces;
    float *points, *normals;
    uint64_t i;
    from.data = control;
    from.count = with->soup->vertices;
    from.width = WIDTH;
    from.stride = 0;
    CHECK_OK(carvel_tessellation_create_f32(NULL, with->surface, &from, &with->desc, &made,
                                            failure));
    n = counts_of_made(made);
    CHECK_UINT(counts_of_made(same).triangles, n.triangles);
    faces = TAKE(uint32_t, n.triangles);
    points = TAKE(float, GAP * n.vertices);
    normals = TAKE(float, WIDTH * n.places);
    for (i = 0; i < GAP * n.vertices; i++)
        points[i] = 777;
    to.data = points;
    to.count = n.vertices;
    to.width = WIDTH;
    to.stride = GAP * sizeof *points;
    CHECK_OK(carvel_tessellation_positions_f32(made, &to, failure));
    for (i = 0; i < GAP * n.vertices; i++)
        CHECK(i % GAP == WIDTH ? points[i] == 777 : fabsf(points[i]) <= 1);
    to.data = normals;
    to.count = n.places;
    to.stride = 0;
    CHECK_OK(carvel_tessellation_normals_f32(made, &to, failure));
    for (i = 0; i < n.places; i++) {
        const float *at = normals + WIDTH * i;
        CHECK(fabsf(at[0] * at[0] + at[1] * at[1] + at[2] * at[2] - 1) < 1e-5f);
    }
    CHECK_OK(carvel_tessellation_triangles(made, NULL, NULL, faces, n.triangles, failure));
    CHECK_UINT(with->soup->faces - 1, faces[n.triangles - 1]);
    CHECK_OK(carvel_tessellation_triangles(made, NULL, NULL, NULL, 0, failure));
    CHECK_OK(carvel_tessellation_places(made, NULL, NULL, 0, failure));
    carvel_tessellation_destroy(same);
    carvel_tessellation_destroy(made);
    free(control), free(faces), free(points), free(normals);
}

/* -------------------------------------------------------------------- fields */

static void check_pixels(const fixture *with)
{
    fixture other = *with;
    carvel_tessellation *fine, *coarse;
    carvel_triangle_counts n;
    /* From above, two units to the picture's side. */
    other.desc.fineness = CARVEL_FINENESS_PIXELS;
    other.desc.matrix[0] = other.desc.matrix[5] = 1;
    other.desc.matrix[10] = 0.5;
    other.desc.matrix[15] = 1;
    other.desc.viewport[0] = other.desc.viewport[1] = 100;
    other.desc.tolerance = 20;
    coarse = made64(&other);
    n = counts_of_made(coarse);
    CHECK(n.measure <= 20 && n.measure > 5);
    other.desc.tolerance = 5;
    fine = made64(&other);
    CHECK(counts_of_made(fine).triangles > 4 * n.triangles);
    carvel_tessellation_destroy(coarse);
    carvel_tessellation_destroy(fine);
}

static void check_limits(const fixture *with)
{
    fixture other = *with;
    carvel_const_values_f64 from = control64(with);
    carvel_tessellation *made;
    other.desc.tolerance = 1e-6;
    other.desc.max_levels = 2;
    made = made64(&other);
    CHECK(counts_of_made(made).coarse > 0);
    CHECK_UINT(8 * 16, counts_of_made(made).triangles);
    carvel_tessellation_destroy(made);
    other.desc.max_triangles = 127;
    CHECK_STATUS(CARVEL_STATUS_TOO_LARGE,
                 carvel_tessellation_create_f64(NULL, with->surface, &from, &other.desc, &made,
                                                failure));
    CHECK(made == NULL);
}

/* Under Doo-Sabin the surface of an open mesh ends inside where nothing is said of the
 * boundary: `partial` leaves those parts out. */
static void check_partial(void)
{
    carvel_tessellation *made = NULL;
    fixture with;
    carvel_const_values_f64 from;
    with.soup = poly_grid(3, 3);
    with.mesh = poly_mesh(with.soup);
    with.scheme = scheme_of(CARVEL_SCHEME_DOO_SABIN, CARVEL_BOUNDARY_NONE);
    with.context = context_of(1);
    with.surface = NULL;
    CHECK_OK(carvel_surface_create(NULL, with.mesh, with.scheme, &with.surface, failure));
    CHECK_OK(carvel_tessellation_desc_init(&with.desc, sizeof with.desc));
    with.desc.tolerance = 1;
    from = control64(&with);
    CHECK_STATUS(CARVEL_STATUS_UNSUPPORTED,
                 carvel_tessellation_create_f64(NULL, with.surface, &from, &with.desc, &made,
                                                failure));
    CHECK_UINT(CARVEL_ELEMENT_FACE, carvel_error_element(failure, 0, 0).kind);
    with.desc.partial = 1;
    made = made64(&with);
    CHECK_UINT(8, counts_of_made(made).missing);
    carvel_tessellation_destroy(made);
    tear_down(&with);
}

/* -------------------------------------------------------------------- misuse */

#define REFUSE(status, call) CHECK_STATUS(CARVEL_STATUS_##status, call)
/* A pointer that is not aligned. */
#define OFF(type, pointer) ((type *)(void *)((char *)(void *)(uintptr_t)(pointer) + 1))

static void check_wrong_makers(const fixture *with)
{
    carvel_const_values_f64 from = control64(with), f;
    carvel_tessellation_desc desc;
    carvel_tessellation *made = NULL;
    double *points = with->soup->positions, before = points[4];
#define CREATE(status, surface, from, desc, out) \
    (REFUSE(status, carvel_tessellation_create_f64(with->context, (surface), (from), (desc), \
                                                   (out), failure)), \
     CHECK(made == NULL))
#define FIELD(status, change) \
    (desc = with->desc, (change), CREATE(status, with->surface, &from, &desc, &made))
    CREATE(NULL_POINTER, NULL, &from, &with->desc, &made);
    CREATE(NULL_POINTER, with->surface, NULL, &with->desc, &made);
    CREATE(NULL_POINTER, with->surface, &from, NULL, &made);
    CREATE(NULL_POINTER, with->surface, &from, &with->desc, NULL);
    CREATE(MISALIGNED, with->surface, &from, &with->desc, OFF(carvel_tessellation *, &made));
    FIELD(STRUCT_SIZE, desc.struct_size = 17);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.fineness = 2);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.tolerance = 0);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.tolerance = (double)NAN);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.max_levels = 25);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.partial = 2);
    FIELD(PARAMETER_OUT_OF_RANGE, desc.fineness = CARVEL_FINENESS_PIXELS);
    f = from, f.width = 2;
    CREATE(LENGTH_MISMATCH, with->surface, &f, &with->desc, &made);
    f = from, f.count++;
    CREATE(LENGTH_MISMATCH, with->surface, &f, &with->desc, &made);
    f = from, f.stride = 8;
    CREATE(INVALID_STRIDE, with->surface, &f, &with->desc, &made);
    points[4] = (double)INFINITY;
    CREATE(NOT_FINITE, with->surface, &from, &with->desc, &made);
    CHECK_UINT(CARVEL_ELEMENT_VERTEX, carvel_error_element(failure, 0, 0).kind);
    CHECK_UINT(1, carvel_error_element(failure, 0, 0).index);
    points[4] = before;
    carvel_context_cancel(with->context);
    CREATE(CANCELLED, with->surface, &from, &with->desc, &made);
    carvel_context_reset(with->context);
    carvel_tessellation_destroy(NULL);
}

static void check_wrong_lists(const fixture *with)
{
    carvel_tessellation *made = made64(with);
    carvel_triangle_counts n = counts_of_made(made);
    uint32_t *list = TAKE(uint32_t, 7 * n.triangles);
    carvel_sample *places = TAKE(carvel_sample, n.places);
    double *points = TAKE(double, WIDTH * n.places);
    carvel_values_f64 to = to64(points, n.vertices - 1), t;
    REFUSE(NULL_POINTER, carvel_tessellation_counts(NULL, &n, failure));
    REFUSE(NULL_POINTER, carvel_tessellation_counts(made, NULL, failure));
    n.struct_size = 17;
    REFUSE(STRUCT_SIZE, carvel_tessellation_counts(made, &n, failure));
    REFUSE(NULL_POINTER,
           carvel_tessellation_triangles(NULL, list, NULL, NULL, n.triangles, failure));
    REFUSE(BUFFER_TOO_SMALL,
           carvel_tessellation_triangles(made, NULL, NULL, list, n.triangles - 1, failure));
    REFUSE(MISALIGNED, carvel_tessellation_triangles(made, NULL, OFF(uint32_t, list), NULL,
                                                     n.triangles, failure));
    REFUSE(OVERLAP, carvel_tessellation_triangles(made, list, NULL, list + 3 * n.triangles - 1,
                                                  n.triangles, failure));
    REFUSE(NULL_POINTER, carvel_tessellation_places(NULL, places, NULL, n.places, failure));
    REFUSE(BUFFER_TOO_SMALL, carvel_tessellation_places(made, places, NULL, 0, failure));
    REFUSE(OVERLAP, carvel_tessellation_places(made, places, (uint32_t *)(void *)places, n.places,
                                               failure));
    REFUSE(BUFFER_TOO_SMALL, carvel_tessellation_positions_f64(made, &to, failure));
    REFUSE(NULL_POINTER, carvel_tessellation_positions_f64(made, NULL, failure));
    REFUSE(NULL_POINTER, carvel_tessellation_normals_f64(NULL, &to, failure));
    t = to, t.count = n.places, t.width = 4;
    REFUSE(LENGTH_MISMATCH, carvel_tessellation_normals_f64(made, &t, failure));
    t.width = WIDTH, t.stride = 20;
    REFUSE(INVALID_STRIDE, carvel_tessellation_normals_f64(made, &t, failure));
    carvel_tessellation_destroy(made);
    free(list), free(places), free(points);
}

/* Doubles that no float is. */
static void check_range(const fixture *with)
{
    double *points = with->soup->positions;
    uint64_t i, n = WIDTH * with->soup->vertices;
    fixture other = *with;
    carvel_tessellation *made;
    carvel_values_f32 to;
    for (i = 0; i < n; i++)
        points[i] *= 1e60;
    other.desc.tolerance = 1e59;
    made = made64(&other);
    to.count = counts_of_made(made).vertices;
    to.data = TAKE(float, WIDTH * to.count);
    to.width = WIDTH;
    to.stride = 0;
    REFUSE(NOT_FINITE, carvel_tessellation_positions_f32(made, &to, failure));
    free(to.data);
    carvel_tessellation_destroy(made);
    for (i = 0; i < n; i++)
        points[i] /= 1e60;
}

int main(void)
{
    fixture with;
    check_begin();
    set_up(&with);
    check_triangles(&with);
    check_floats(&with);
    check_pixels(&with);
    check_limits(&with);
    check_wrong_makers(&with);
    check_wrong_lists(&with);
    check_range(&with);
    tear_down(&with);
    check_partial();
    return check_end();
}
