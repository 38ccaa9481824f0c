/* Progress functions: what they are told, and what becomes of what they throw. */
#include "check.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

struct Stop {
    int code;
};

static const Pyramid pyramid;

static carvel::Mesh mesh() { return carvel::Mesh::create(pyramid.faces()); }
static carvel::Scheme scheme() { return carvel::Scheme::create({CARVEL_SCHEME_THREE_POINT}); }

static void progress_is_told_and_kept_alive()
{
    const auto told = std::make_shared<std::vector<double>>();
    carvel::Context context = carvel::Context::create({2, 0, [told](double done) {
                                                           told->push_back(done);
                                                           return false;
                                                       }});
    CHECK(told.use_count() == 2);
    CHECK(context.thread_count() == 2);
    carvel::Context moved = std::move(context);
    const auto smooth = carvel::refine(mesh(), scheme(), 4, pyramid.points, &moved);
    CHECK(smooth.face_count() > 0);
    CHECK(told->size() >= 4 && told->back() == 1.0);
    for (std::size_t i = 0; i < told->size(); ++i)
        CHECK((*told)[i] >= 0 && (*told)[i] <= 1 && (i == 0 || (*told)[i - 1] <= (*told)[i]));
    moved = carvel::Context();
    CHECK(told.use_count() == 1);
}

static void true_cancels_the_call()
{
    const carvel::Context context =
        carvel::Context::create({1, 0, [](double) { return true; }});
    CHECK(THROWN(carvel::refine(mesh(), scheme(), 2, pyramid.points, &context)) ==
          CARVEL_STATUS_CANCELLED);
    CHECK(THROWN(carvel::Hierarchy::create(mesh(), scheme(), 2, &context)) ==
          CARVEL_STATUS_CANCELLED);
}

static void what_is_thrown_comes_out_of_the_call()
{
    bool armed = true;
    const carvel::Context context = carvel::Context::create({2, 0, [&](double done) {
                                                                 if (armed && done > 0.1)
                                                                     throw Stop{7};
                                                                 return false;
                                                             }});
    int code = 0;
    try {
        carvel::refine(mesh(), scheme(), 3, pyramid.points, &context);
    } catch (const Stop &stop) {
        code = stop.code;
    }
    CHECK(code == 7);
    try {
        carvel::Hierarchy::create(mesh(), scheme(), 3, &context);
    } catch (const Stop &stop) {
        code += stop.code;
    }
    CHECK(code == 14);

    const auto result = carvel::try_refine(mesh(), scheme(), 3, pyramid.points, &context);
    CHECK(!result && result.error().status() == CARVEL_STATUS_CANCELLED);
    CHECK(result.error().exception());
    try {
        result.error().raise();
    } catch (const Stop &stop) {
        code += stop.code;
    }
    CHECK(code == 21);

    armed = false;
    CHECK(carvel::refine(mesh(), scheme(), 3, pyramid.points, &context).face_count() > 0);
}

/* A progress function may use the library itself, and fail there. */
static void calls_may_nest()
{
    const carvel::Context inner =
        carvel::Context::create({1, 0, [](double) -> bool { throw Stop{1}; }});
    int caught = 0;
    bool armed = false;
    const carvel::Context outer = carvel::Context::create(
        {1, 0, [&](double) {
             caught += carvel::try_refine(mesh(), scheme(), 1, pyramid.points, &inner) ? 0 : 1;
             return armed ? throw Stop{3} : false;
         }});
    CHECK(carvel::refine(mesh(), scheme(), 2, pyramid.points, &outer).face_count() > 0);
    CHECK(caught > 0);
    /* What it throws after a call of its own still comes out of the outer one. */
    armed = true;
    int code = 0;
    try {
        carvel::refine(mesh(), scheme(), 2, pyramid.points, &outer);
    } catch (const Stop &stop) {
        code = stop.code;
    }
    CHECK(code == 3);
}

/* Two threads share context and mesh; each gets what it threw itself. */
static void every_thread_gets_its_own()
{
    const carvel::Mesh shared = mesh();
    const carvel::Scheme rule = scheme();
    const std::thread::id main_thread = std::this_thread::get_id();
    const carvel::Context context = carvel::Context::create(
        {1, 0, [&](double) -> bool { throw Stop{std::this_thread::get_id() == main_thread}; }});
    const auto code = [&] {
        try {
            carvel::refine(shared, rule, 2, pyramid.points, &context);
        } catch (const Stop &stop) {
            return stop.code;
        }
        return -1;
    };
    std::atomic<int> other{-1};
    std::thread thread([&] { other = code(); });
    CHECK(code() == 1);
    thread.join();
    CHECK(other == 0);
}

static void cancel_holds_until_reset()
{
    const carvel::Context context = carvel::Context::create({1, 0, {}});
    std::thread([&] { context.cancel(); }).join();
    CHECK(context.is_cancelled());
    CHECK(THROWN(carvel::refine(mesh(), scheme(), 2, pyramid.points, &context)) ==
          CARVEL_STATUS_CANCELLED);
    context.reset();
    CHECK(carvel::refine(mesh(), scheme(), 2, pyramid.points, &context).face_count() > 0);
}

int main()
{
    progress_is_told_and_kept_alive();
    true_cancels_the_call();
    what_is_thrown_comes_out_of_the_call();
    calls_may_nest();
    every_thread_gets_its_own();
    cancel_holds_until_reset();
    std::puts("progress: ok");
}
