/* Arrays of the caller's own: spans, strides, structs, and Eigen's matrices. */
#include "check.hpp"

#include <Eigen/Core>

#include <array>
#if __cplusplus >= 202002L
#include <span>
#endif

static const Pyramid pyramid;

struct Shape {
    carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_QUARTIC});
    carvel::Hierarchy hierarchy = carvel::Hierarchy::create(mesh, scheme, 2);
    carvel::Refined<double> smooth = carvel::refine(mesh, scheme, 2, pyramid.points);
    std::size_t vertices = smooth.vertex_count();
};

static std::vector<float> single()
{
    return {pyramid.points.begin(), pyramid.points.end()};
}

static void spans_borrow_anything_contiguous()
{
    const std::uint32_t c_array[3] = {1, 2, 3};
    const std::array<std::uint32_t, 2> array = {4, 5};
    std::vector<std::uint32_t> vector = {6};
    const carvel::Span<const std::uint32_t> a = c_array;
    const carvel::Span<const std::uint32_t> b = array;
    const carvel::Span<std::uint32_t> c = vector;
    const carvel::Span<const std::uint32_t> d = c;
    CHECK(a.size() == 3 && b[1] == 5 && c.data() == vector.data() && d.data() == c.data());
    c[0] = 8;
    std::uint32_t sum = 0;
    for (const std::uint32_t i : d)
        sum += i;
    CHECK(vector[0] == 8 && sum == 8 && carvel::Span<int>().empty());
    using Const = carvel::Span<const std::uint32_t>;
    static_assert(!std::is_constructible_v<carvel::Span<std::uint32_t>, Const>);
    static_assert(!std::is_constructible_v<Const, std::vector<std::int32_t>>);
    static_assert(!std::is_constructible_v<Const, std::vector<std::uint64_t>>);
#if __cplusplus >= 202002L
    const std::span<const std::uint32_t> standard = a;
    const carvel::Span<const std::uint32_t> back = standard;
    CHECK(standard.size() == 3 && back.data() == c_array);
#endif
    const std::vector<std::int32_t> signed_corners = {0, 1, 2, -1, 1, 2};
    const auto result = carvel::Mesh::try_create(
        carvel::Faces::of_size(3, 3, carvel::as_unsigned(signed_corners)));
    CHECK(!result && result.error().status() == CARVEL_STATUS_INDEX_OUT_OF_RANGE);
}

static void faces_come_in_three_layouts(const Shape &shape)
{
    const Indices offsets = {0, 4, 7, 10, 13, 16};
    const carvel::Mesh mesh =
        carvel::Mesh::create(carvel::Faces::from_offsets(5, offsets, pyramid.corners));
    CHECK(mesh.face_vertices() == shape.mesh.face_vertices());
    CHECK(mesh.face_offsets() == shape.mesh.face_offsets());
    const std::uint32_t tetrahedron[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const carvel::Mesh triangles =
        carvel::Mesh::create(carvel::Faces::of_size(4, 3, tetrahedron));
    CHECK(triangles.counts().faces == 4 && triangles.counts().edges == 6);
    CHECK(carvel::Mesh::create({0, Indices(), Indices()}).counts().faces == 0);
}

/* All ways to hand the same points over give the same bytes. */
static void inputs_of_all_layouts_agree(const Shape &shape)
{
    const auto same = [&](const auto &points) {
        CHECK(carvel::refine(shape.mesh, shape.scheme, 2, points).positions ==
              shape.smooth.positions);
        CHECK(shape.hierarchy.refine(2, points) == shape.smooth.positions);
    };
    struct Vertex {
        std::uint64_t name;
        double position[3];
        std::array<double, 3> copy;
        double x, y, z;
    };
    std::vector<std::array<double, 3>> triples(5);
    std::vector<Vertex> vertices(5);
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> by_row(5, 3);
    Eigen::Matrix<double, 3, Eigen::Dynamic> by_column(3, 5);
    Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(5, 7, -1.0);
    for (std::size_t i = 0; i < 5; ++i) {
        const double *const p = &pyramid.points[3 * i];
        const auto at = static_cast<Eigen::Index>(i);
        triples[i] = {p[0], p[1], p[2]};
        vertices[i] = {i, {p[0], p[1], p[2]}, triples[i], p[0], p[1], p[2]};
        by_row.row(at) << p[0], p[1], p[2];
        by_column.col(at) << p[0], p[1], p[2];
        wide.col(at + 1).segment(1, 3) << p[0], p[1], p[2];
    }
    same(pyramid.points);
    same(triples);
    same(carvel::values(pyramid.points.data(), 5));
    same(carvel::values(vertices, &Vertex::position));
    same(carvel::values(vertices, &Vertex::copy));
    same(carvel::values(vertices, &Vertex::x, 3));
    same(carvel::rows(by_row));
    same(carvel::columns(by_column));
    same(carvel::columns(wide.block(1, 1, 3, 5)));
    same(carvel::columns(Eigen::Map<const Eigen::Matrix3Xd>(pyramid.points.data(), 3, 5)));
    same(carvel::rows(Eigen::Map<const Eigen::Matrix<double, 5, 3, Eigen::RowMajor>>(
        pyramid.points.data())));
}

static void views_are_the_c_structs()
{
    Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> rows(6, 4);
    const auto r = carvel::rows(rows);
    static_assert(std::is_same_v<decltype(r), const carvel::Values<float>>);
    CHECK(r.data == rows.data() && r.count == 6 && r.width == 4 && r.stride == 16);
    const auto three = carvel::rows(rows.leftCols<3>());
    CHECK(three.data == rows.data() && three.count == 6 && three.width == 3);
    CHECK(three.stride == 16);
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(5);
    const auto w = carvel::rows(weights);
    static_assert(std::is_same_v<decltype(w), const carvel::ConstValues<double>>);
    CHECK(w.count == 5 && w.width == 1 && w.stride == 8);
    const Eigen::RowVectorXd flat = weights.transpose();
    CHECK(carvel::columns(flat).count == 5 && carvel::columns(flat).width == 1);
    const std::vector<std::array<float, 2>> uv(3);
    CHECK(carvel::values(uv).width == 2 && carvel::values(uv).count == 3);
    float c_array[6] = {};
    const auto pairs = carvel::values(c_array, 2);
    CHECK(pairs.data == c_array && pairs.count == 3 && pairs.width == 2);
    const std::vector<double> empty;
    CHECK(carvel::values(empty).count == 0 && carvel::values(pyramid.points, 0).count == 0);
    CHECK(carvel::values(pyramid.points, 4).count == 0);
}

/* Outputs with gaps: what lies between stays. */
static void outputs_keep_what_lies_between(const Shape &shape)
{
    struct Vertex {
        float before;
        float position[3];
        float after;
    };
    std::vector<Vertex> vertices(shape.vertices, Vertex{-1, {0, 0, 0}, -2});
    const std::vector<float> points = single();
    shape.hierarchy.refine_into(2, points, carvel::values(vertices, &Vertex::position));
    Eigen::Matrix4Xf matrix =
        Eigen::Matrix4Xf::Constant(4, static_cast<Eigen::Index>(shape.vertices), 5);
    shape.hierarchy.refine_into(2, points, carvel::columns(matrix.topRows<3>()));
    const std::vector<float> tight = shape.hierarchy.refine(2, points);
    for (std::size_t i = 0; i < shape.vertices; ++i) {
        const Vertex &v = vertices[i];
        CHECK(v.before == -1 && v.after == -2);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(v.position[k] == tight[3 * i + k]);
            CHECK(matrix(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) ==
                  tight[3 * i + k]);
        }
        CHECK(matrix(3, static_cast<Eigen::Index>(i)) == 5);
    }
}

/* The into-buffers form, with attributes, against C called by hand. */
static void into_buffers_is_what_c_does(const Shape &shape)
{
    const carvel::Counts counts = carvel::predict_counts(shape.mesh, shape.scheme, 2);
    const std::vector<float> points = single();
    const std::vector<float> heat = {1, 2, 3, 4, 5};
    const std::array<carvel::ConstValues<float>, 2> attributes = {
        carvel::values(heat, 1), carvel::values(points)};

    std::vector<float> positions(3 * counts.vertices);
    std::vector<float> refined_heat(counts.vertices);
    std::vector<float> twin(3 * counts.vertices);
    Indices sizes(counts.faces), offsets(counts.faces + 1), corners(counts.corners);
    const std::array<carvel::Values<float>, 2> out = {carvel::values(refined_heat, 1),
                                                      carvel::values(twin)};
    carvel::RefineOutput<float> output;
    output.face_sizes = sizes;
    output.face_offsets = offsets;
    output.face_vertices = corners;
    output.positions = carvel::values(positions);
    output.attributes = out;
    const carvel::RefineInput<float> input = {shape.mesh, shape.scheme, 2,
                                              carvel::values(points), attributes};
    carvel::Refiner refiner = carvel::Refiner::create();
    refiner.refine_into(input, output);
    CHECK(refiner.bytes() > 0);
    CHECK(output.anchored && twin == positions && offsets.back() == counts.corners);

    std::vector<float> by_c(3 * counts.vertices);
    Indices c_sizes(counts.faces), c_corners(counts.corners), c_sources(counts.faces);
    carvel_refine_input_f32 c_input;
    carvel_refine_output_f32 c_output;
    carvel_refine_input_f32_init(&c_input, sizeof c_input);
    carvel_refine_output_f32_init(&c_output, sizeof c_output);
    c_input.levels = 2;
    c_input.mesh = shape.mesh.get();
    c_input.scheme = shape.scheme.get();
    c_input.positions = {points.data(), 5, 3, 0};
    c_output.face_sizes = {c_sizes.data(), c_sizes.size()};
    c_output.face_vertices = {c_corners.data(), c_corners.size()};
    c_output.face_sources = {c_sources.data(), c_sources.size()};
    c_output.positions = {by_c.data(), counts.vertices, 3, 0};
    CHECK(carvel_refiner_refine_f32(refiner.get(), nullptr, &c_input, &c_output, nullptr) ==
          CARVEL_STATUS_OK);
    CHECK(by_c == positions && c_sizes == sizes && c_corners == corners);

    const carvel::Refined<float> refined = carvel::refine(input);
    CHECK(refined.positions == positions && refined.face_sizes == sizes);
    CHECK(refined.face_vertices == corners && refined.face_sources == c_sources);
    CHECK(refined.attributes.at(0) == refined_heat && refined.attributes.at(1) == twin);
    CHECK(refined.vertex_count() == counts.vertices && refined.face_count() == counts.faces);
    CHECK(refined.anchored == output.anchored);
    CHECK(refiner.refine(input).positions == positions);
    CHECK(refiner.refine(shape.mesh, shape.scheme, 2, points).positions == positions);
}

int main()
{
    const Shape shape;
    spans_borrow_anything_contiguous();
    faces_come_in_three_layouts(shape);
    inputs_of_all_layouts_agree(shape);
    views_are_the_c_structs();
    outputs_keep_what_lies_between(shape);
    into_buffers_is_what_c_does(shape);
    std::puts("arrays: ok");
}
