/* The returning style alone, as compiled with -fno-exceptions. */
#include <carvel.hpp>

#include <cstdio>

template <class M, class = void>
struct Throws : std::false_type {};
template <class M>
struct Throws<M, std::void_t<decltype(std::declval<const M &>().counts())>> : std::true_type {};
static_assert(!Throws<carvel::Mesh>::value, "no throwing function without exceptions");

static carvel::Result<std::vector<float>> smooth(const std::vector<std::uint32_t> &corners,
                                                 const carvel::Context &context)
{
    const carvel::Result<carvel::Mesh> mesh =
        carvel::Mesh::try_create(carvel::Faces::of_size(4, 3, corners));
    if (!mesh)
        return mesh.error();
    const carvel::Result<carvel::Scheme> scheme = carvel::Scheme::try_create();
    if (!scheme)
        return scheme.error();
    const std::vector<float> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    carvel::Result<carvel::Refined<float>> refined =
        carvel::try_refine(*mesh, *scheme, 3, points, &context);
    if (!refined)
        return refined.error();
    return std::move(refined->positions);
}

int main()
{
    bool stop = false;
    const carvel::Result<carvel::Context> context =
        carvel::Context::try_create({1, 0, [&](double) { return stop; }});
    if (!context || context->thread_count() != 1)
        return 1;
    const auto good = smooth({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, *context);
    if (!good || good->size() < 3)
        return 2;
    const auto bad = smooth({0, 2, 1, 0, 1, 4}, *context);
    if (bad || bad.error().status() != CARVEL_STATUS_INDEX_OUT_OF_RANGE)
        return 3;
    if (bad.error().entries().at(0).elements.empty() || bad.error().message().empty())
        return 4;
    stop = true;
    const auto cancelled = smooth({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, *context);
    if (cancelled || cancelled.error().status() != CARVEL_STATUS_CANCELLED)
        return 5;
    carvel::detail::Call call;
    std::vector<double> vector;
    if (call.grow(vector, std::uint64_t(1) << 58) || call.result())
        return 6;
    std::puts("no_exceptions: ok");
    return 0;
}
