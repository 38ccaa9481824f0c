/* Handles: who owns what, and what empty ones answer. */
#include "check.hpp"

#include <type_traits>

template <class T>
constexpr bool moves_only = std::is_nothrow_move_constructible_v<T> &&
                            std::is_nothrow_move_assignable_v<T> &&
                            !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;

static_assert(moves_only<carvel::Mesh> && moves_only<carvel::Scheme>);
static_assert(moves_only<carvel::Context> && moves_only<carvel::Refiner>);
static_assert(moves_only<carvel::Hierarchy>);
/* A raw pointer is never taken over by accident. */
static_assert(!std::is_convertible_v<carvel_mesh *, carvel::Mesh>);

static void handles_move_and_self_move()
{
    carvel::Mesh a = carvel::Mesh::create(Pyramid().faces());
    carvel_mesh *const raw = a.get();
    carvel::Mesh b = std::move(a);
    CHECK(b.get() == raw);
    CHECK(!a); // NOLINT: what is left of `a` is the point.
    carvel::Mesh &same = b;
    b = std::move(same);
    CHECK(b.get() == raw);
    CHECK(b.counts().faces == 5);
    b = carvel::Mesh::create(Pyramid().faces());
    CHECK(b && b.counts().vertices == 5);
}

static void release_and_raw_are_inverse()
{
    carvel::Mesh mesh = carvel::Mesh::create(Pyramid().faces());
    carvel_mesh *const raw = mesh.release();
    CHECK(!mesh);
    carvel::Mesh again(raw);
    CHECK(again.get() == raw && again.counts().corners == 16);
    carvel_mesh_destroy(again.release());

    carvel::Scheme scheme(carvel::Scheme::create().release());
    carvel::Refiner refiner(carvel::Refiner::create().release());
    mesh = carvel::Mesh::create(Pyramid().faces());
    carvel::Hierarchy hierarchy(carvel::Hierarchy::create(mesh, scheme, 1).release());
    CHECK(scheme && refiner && hierarchy);
}

static void empty_handles_are_answered()
{
    const carvel::Mesh mesh;
    const carvel::Hierarchy hierarchy;
    CHECK(THROWN(mesh.counts()) == CARVEL_STATUS_NULL_POINTER);
    CHECK(THROWN(mesh.edges()) == CARVEL_STATUS_NULL_POINTER);
    CHECK(THROWN(mesh.corner_tags()) == CARVEL_STATUS_NULL_POINTER);
    CHECK(THROWN(mesh.validate()) == CARVEL_STATUS_NULL_POINTER);
    CHECK(THROWN(carvel::Scheme().passes()) == CARVEL_STATUS_NULL_POINTER);
    CHECK(THROWN(hierarchy.mesh(0)) == CARVEL_STATUS_NULL_POINTER);
    CHECK(hierarchy.last_level() == 0 && carvel::Refiner().bytes() == 0);
    const carvel::Mesh pyramid = carvel::Mesh::create(Pyramid().faces());
    const carvel::Scheme scheme = carvel::Scheme::create();
    CHECK(THROWN(carvel::Refiner().refine(pyramid, scheme, 1, Pyramid().points)) ==
          CARVEL_STATUS_NULL_POINTER);

    carvel::Context context;
    CHECK(context.thread_count() == 1 && !context.is_cancelled());
    context.cancel();
    CHECK(carvel::refine(pyramid, scheme, 1, Pyramid().points, &context).face_count() == 18);
}

/* Objects outlive what they were made of. */
static void hierarchies_keep_what_they_need()
{
    carvel::Hierarchy hierarchy;
    {
        const carvel::Mesh mesh = carvel::Mesh::create(Pyramid().faces());
        hierarchy = carvel::Hierarchy::create(mesh, carvel::Scheme::create(), 2);
    }
    carvel::Mesh level = hierarchy.mesh(2);
    const carvel::Counts counts = hierarchy.counts(2);
    hierarchy = carvel::Hierarchy();
    CHECK(level.counts().faces == counts.faces);
    level.validate();
}

int main()
{
    handles_move_and_self_move();
    release_and_raw_are_inverse();
    empty_handles_are_answered();
    hierarchies_keep_what_they_need();
    std::puts("handles: ok");
}
