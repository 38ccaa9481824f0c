/* Everything else of carvel.h, reached through C++. */
#include "check.hpp"

#include <algorithm>
#include <array>
#include <cstring>

static const Pyramid pyramid;

static void versions_agree()
{
    CHECK(std::strcmp(carvel::version(), CARVEL_VERSION_STRING) == 0);
}

static void schemes_take_every_parameter()
{
    CHECK(carvel::Scheme::create().passes().empty());
    const carvel::Fraction w = {1, 64};
    carvel::SchemeDesc desc = {CARVEL_SCHEME_THREE_POINT};
    desc.w = w;
    const std::vector<carvel::Fraction> pass = carvel::Scheme::create(desc).passes();
    CHECK(pass.size() == 1 && pass[0].numerator == 3 && pass[0].denominator == 4);
    desc = {CARVEL_SCHEME_B_SPLINE};
    desc.degree = 8;
    CHECK(carvel::Scheme::create(desc).passes().size() == 3);
    const carvel::Fraction passes[] = {{1, 2}, {2, 8}};
    desc = {CARVEL_SCHEME_AVERAGING, CARVEL_CORNER_RULE_AVERAGE, CARVEL_BOUNDARY_NONE};
    desc.passes = passes;
    const std::vector<carvel::Fraction> given = carvel::Scheme::create(desc).passes();
    CHECK(given.size() == 2 && given[1].numerator == 1 && given[1].denominator == 4);
}

static void meshes_tell_what_they_are()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Counts counts = mesh.counts();
    CHECK(counts.vertices == 5 && counts.faces == 5 && counts.corners == 16);
    CHECK(counts.edges == 8 && counts.boundary_edges == 0 && counts.irregular_faces == 4);
    const carvel::Survey survey = mesh.survey();
    CHECK(survey.components == 1 && survey.euler_characteristic == 2 && survey.bytes > 0);
    const auto sizes = mesh.histogram(CARVEL_HISTOGRAM_FACE_SIZES);
    CHECK(sizes.size() == 2 && sizes[0].value == 3 && sizes[0].count == 4);
    const auto valences = mesh.histogram(CARVEL_HISTOGRAM_INTERIOR_VALENCES);
    CHECK(valences.size() == 2 && valences[1].value == 4 && valences[1].count == 1);
    CHECK(mesh.histogram(CARVEL_HISTOGRAM_BOUNDARY_VALENCES).empty());
    mesh.validate();
}

static void meshes_give_their_arrays()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const Indices sizes = mesh.face_sizes();
    const Indices offsets = mesh.face_offsets();
    const Indices vertices = mesh.face_vertices();
    const Indices sources = mesh.face_sources();
    const Indices edges = mesh.edges();
    const Indices corner_edges = mesh.corner_edges();
    const Indices twins = mesh.corner_twins();
    CHECK((sizes == Indices{3, 3, 3, 3, 4}) && (offsets == Indices{0, 3, 6, 9, 12, 16}));
    CHECK((sources == Indices{1, 2, 3, 4, 0}) && edges.size() == 16);
    CHECK(vertices.size() == 16 && corner_edges.size() == 16 && twins.size() == 16);
    for (std::size_t i = 0; i < 16; ++i) {
        CHECK(twins[twins[i]] == i && corner_edges[twins[i]] == corner_edges[i]);
        const std::size_t e = 2 * corner_edges[i];
        CHECK(edges[e] == vertices[i] || edges[e + 1] == vertices[i]);
    }
    CHECK((mesh.valences() == Indices{3, 3, 3, 3, 4}));
    CHECK(mesh.boundary_flags() == std::vector<std::uint8_t>(5, 0));
    CHECK((mesh.vertex_sources() == Indices{0, 1, 2, 3, 4}) && mesh.corner_tags().empty());
}

static void options_reach_the_mesh()
{
    const std::uint32_t strip[] = {0, 1, 4, 3, 1, 2, 5, 4};
    const std::uint32_t tags[] = {1};
    carvel::MeshOptions options;
    options.corner_tags = tags;
    const carvel::Mesh tagged = carvel::Mesh::create(carvel::Faces::of_size(6, 4, strip), options);
    CHECK(tagged.corner_tags() == Indices{1} && tagged.counts().boundary_edges == 6);
    CHECK(tagged.boundary_flags() == std::vector<std::uint8_t>(6, 1));

    const std::uint32_t book[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    options = {};
    options.non_manifold = CARVEL_NON_MANIFOLD_CUT;
    const carvel::Mesh cut = carvel::Mesh::create(carvel::Faces::of_size(5, 3, book), options);
    CHECK(cut.counts().vertices > 5 && cut.vertex_sources().size() == cut.counts().vertices);

    const carvel::Scheme scheme = carvel::Scheme::create();
    const carvel::Mesh plain = carvel::Mesh::create(carvel::Faces::of_size(6, 4, strip));
    const std::vector<float> points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    const carvel::Refined<float> once = carvel::refine(plain, scheme, 1, points);
    CHECK(once.anchored);
    options = {};
    options.anchored = once.anchored;
    const carvel::Mesh anchored = carvel::Mesh::create(
        {once.vertex_count(), once.face_sizes, once.face_vertices}, options);
    CHECK(anchored.survey().anchored == 1);
    CHECK(carvel::refine(anchored, scheme, 1, once.positions).face_count() ==
          carvel::predict_counts(plain, scheme, 2).faces);
}

/* Tags go in, come out, and tell in the surface. */
static void tags_reach_the_mesh()
{
    const std::uint32_t ring[] = {0, 1, 1, 2, 2, 3, 3, 0};
    const float by[] = {10.0F, 10.0F, 10.0F, 2.5F};
    const std::uint32_t top[] = {4};
    const float one[] = {1.0F};
    const std::uint32_t base[] = {0};
    carvel::MeshOptions options;
    options.crease_vertices = ring;
    options.crease_sharpness = by;
    options.sharp_vertices = top;
    options.vertex_sharpness = one;
    options.holes = base;
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces(), options);
    CHECK(mesh.crease_vertices().size() == 8 && mesh.crease_sharpness().size() == 4);
    CHECK(mesh.sharp_vertices() == Indices{4} && mesh.vertex_sharpness()[0] == 1.0F);
    CHECK(mesh.holes() == Indices{4} && mesh.is_manifold() && !carvel::Mesh().is_manifold());
    const carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_CATMULL_CLARK});
    CHECK(scheme.holes(mesh) == Indices{4});
    const carvel::Refined<double> once = carvel::refine(mesh, scheme, 1, pyramid.points);
    CHECK(once.positions[12] == 1.0 && once.positions[14] == 2.0);
    const auto left = carvel::Hierarchy::create(mesh, scheme, 1).mesh(1).crease_sharpness();
    CHECK(left.size() == 8 && std::count(left.begin(), left.end(), 1.5F) == 2);
    const auto open = carvel::Scheme::create(
        {CARVEL_SCHEME_CATMULL_CLARK, CARVEL_CORNER_RULE_COSINE, CARVEL_BOUNDARY_NONE});
    const std::uint32_t strip[] = {0, 1, 4, 3, 1, 2, 5, 4};
    const carvel::Mesh rim = carvel::Mesh::create(carvel::Faces::of_size(6, 4, strip));
    CHECK((open.holes(rim) == Indices{0, 1}));
    CHECK(THROWN(open.holes(carvel::Mesh())) == CARVEL_STATUS_NULL_POINTER);

    options.crease_sharpness = one;
    CHECK(THROWN(carvel::Mesh::create(pyramid.faces(), options)) ==
          CARVEL_STATUS_LENGTH_MISMATCH);
    options.crease_sharpness = by;
    options.vertex_sharpness = {};
    CHECK(THROWN(carvel::Mesh::create(pyramid.faces(), options)) ==
          CARVEL_STATUS_LENGTH_MISMATCH);

    const std::uint32_t book[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    options = {};
    options.non_manifold = CARVEL_NON_MANIFOLD_SHARPEN;
    const carvel::Mesh pages = carvel::Mesh::create(carvel::Faces::of_size(5, 3, book), options);
    CHECK(!pages.is_manifold() && pages.counts().vertices == 5 && pages.counts().edges == 7);
}

static void primal_options_reach_the_scheme()
{
    const Indices triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const carvel::Mesh mesh = carvel::Mesh::create(carvel::Faces::of_size(4, 3, triangles));
    const std::vector<double> points = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const auto first = [&](const carvel::SchemeDesc &desc) {
        return carvel::refine(mesh, carvel::Scheme::create(desc), 1, points).positions;
    };
    carvel::SchemeDesc desc = {CARVEL_SCHEME_LOOP};
    const std::vector<double> loop = first(desc);
    CHECK(loop.size() == 3 * (4 + 6));
    desc.creasing = CARVEL_CREASING_CHAIKIN;
    desc.loop_weights = CARVEL_LOOP_WEIGHTS_WARREN;
    /* The two agree at valence 3. */
    CHECK(first(desc) == loop);
    const carvel::SchemeDesc three_point = {CARVEL_SCHEME_THREE_POINT};
    carvel::SchemeDesc tuned = three_point;
    tuned.extraordinary = CARVEL_EXTRAORDINARY_TUNED;
    /* The first step that leaves a triangle among quads is the second one. */
    const auto third = [&](const carvel::SchemeDesc &by) {
        return carvel::refine(mesh, carvel::Scheme::create(by), 3, points).positions;
    };
    CHECK(first(tuned) == first(three_point) && third(tuned) != third(three_point));
    tuned.family = CARVEL_SCHEME_QUARTIC;
    CHECK(THROWN(carvel::Scheme::create(tuned)) == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    desc = {CARVEL_SCHEME_CATMULL_CLARK};
    const std::vector<double> plain = first(desc);
    desc.triangle_rule = CARVEL_TRIANGLE_RULE_SMOOTH;
    CHECK(first(desc) != plain);
    desc.loop_weights = CARVEL_LOOP_WEIGHTS_WARREN;
    CHECK(THROWN(carvel::Scheme::create(desc)) == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
    const carvel::Fraction pass[] = {{0, 1}};
    desc = {CARVEL_SCHEME_PRIMAL};
    desc.passes = pass;
    CHECK(carvel::Scheme::create(desc).passes().size() == 1);
}

static void varying_values_stay_linear()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_CATMULL_CLARK});
    const carvel::Scheme linear = carvel::Scheme::create({CARVEL_SCHEME_BILINEAR});
    const std::vector<double> expected = carvel::refine(mesh, linear, 2, pyramid.points).positions;
    const carvel::Hierarchy hierarchy = carvel::Hierarchy::create(mesh, scheme, 2);
    CHECK(hierarchy.interpolate(2, CARVEL_INTERPOLATION_VARYING, pyramid.points) == expected);
    std::vector<double> out(expected.size());
    hierarchy.interpolate_into(2, CARVEL_INTERPOLATION_VARYING, pyramid.points, out);
    CHECK(out == expected);
    hierarchy.refine_into(2, pyramid.points, out);
    CHECK(out != expected && out == hierarchy.refine(2, pyramid.points));
    const carvel::ConstValues<double> attributes[] = {carvel::values(pyramid.points),
                                                      carvel::values(pyramid.points)};
    const std::int32_t kinds[] = {CARVEL_INTERPOLATION_VERTEX, CARVEL_INTERPOLATION_VARYING};
    carvel::RefineInput<double> input{mesh, scheme, 2, attributes[0], attributes, kinds};
    const carvel::Refined<double> refined = carvel::refine(input);
    CHECK(refined.attributes[0] == refined.positions && refined.attributes[1] == expected);
    input.interpolations = {kinds, 1};
    CHECK(THROWN(carvel::refine(input)) == CARVEL_STATUS_LENGTH_MISMATCH);
    const carvel::Scheme dual = carvel::Scheme::create();
    const auto none = carvel::Hierarchy::create(mesh, dual, 1)
                          .try_interpolate(1, CARVEL_INTERPOLATION_VARYING, pyramid.points);
    CHECK(!none && none.error().status() == CARVEL_STATUS_UNSUPPORTED);
}

/* Two quads with a seam between them: 8 values on 6 vertices. */
static void channels_keep_their_seams()
{
    const std::uint32_t strip[] = {0, 1, 4, 3, 1, 2, 5, 4};
    const std::vector<float> points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    const std::uint32_t own[] = {0, 1, 2, 3, 4, 5, 6, 7};
    const std::vector<std::array<float, 2>> uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1},
                                                  {5, 5}, {6, 5}, {6, 6}, {5, 6}};
    const carvel::Mesh mesh = carvel::Mesh::create(carvel::Faces::of_size(6, 4, strip));
    const carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_CATMULL_CLARK});
    const carvel::Channel cut = carvel::Channel::create(mesh, own, uv.size());
    const carvel::Channel whole = carvel::Channel::create(mesh, strip, 6, CARVEL_FACE_VARYING_ALL);
    CHECK(cut.seam_edges() == 1 && whole.seam_edges() == 0 && carvel::Channel().seam_edges() == 0);
    CHECK(carvel::predict_channel(cut, scheme, 1) == 18);
    const carvel::ChannelInput<float> channels[] = {{cut, carvel::values(uv)},
                                                    {whole, carvel::values(points)}};
    carvel::RefineInput<float> input{mesh, scheme, 1, carvel::values(points)};
    input.channels = channels;
    const carvel::Refined<float> refined = carvel::refine(input);
    CHECK(refined.channels.size() == 2 && refined.channels[0].indices.size() == 32);
    CHECK(refined.channels[0].values.size() == 36);
    for (std::size_t corner = 0; corner < 8; ++corner) {
        /* Single faces keep their values; the second channel is linear. */
        const std::size_t at = refined.channels[0].indices[4 * corner];
        CHECK(refined.channels[0].values[2 * at] == uv[corner][0]);
        CHECK(refined.channels[0].values[2 * at + 1] == uv[corner][1]);
        const std::size_t linear = refined.channels[1].indices[4 * corner];
        CHECK(refined.channels[1].values[3 * linear] == points[3 * strip[corner]]);
    }
    CHECK(THROWN(carvel::Channel::create(mesh, own, 7)) == CARVEL_STATUS_INDEX_OUT_OF_RANGE);
    const carvel::Scheme dual = carvel::Scheme::create();
    const carvel::RefineInput<float> other{mesh, dual, 1, carvel::values(points), {}, {}, channels};
    CHECK(THROWN(carvel::refine(other)) == CARVEL_STATUS_UNSUPPORTED);
    CHECK(THROWN(carvel::predict_channel(cut, dual, 1)) == CARVEL_STATUS_UNSUPPORTED);
    std::vector<std::uint32_t> few(31);
    std::vector<float> room(36);
    std::vector<float> positions(3 * refined.vertex_count());
    const carvel::ChannelOutput<float> narrow[] = {{few, carvel::values(room, 2)}};
    carvel::RefineOutput<float> output;
    output.positions = carvel::values(positions);
    output.channels = narrow;
    input.channels = {channels, 1};
    CHECK(THROWN(carvel::Refiner::create().refine_into(input, output)) ==
          CARVEL_STATUS_BUFFER_TOO_SMALL);
}

static void predictions_hold()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create();
    const carvel::Counts counts = carvel::predict_counts(mesh, scheme, 3);
    const carvel::Hierarchy hierarchy = carvel::Hierarchy::create(mesh, scheme, 3);
    CHECK(hierarchy.last_level() == 3 && hierarchy.counts(3).corners == counts.corners);
    CHECK(hierarchy.mesh(3).counts().edges == counts.edges && counts.level == 3);
    const carvel::Bytes bytes = carvel::predict_bytes(mesh, scheme, 3, 3, sizeof(float));
    CHECK(bytes.output == 4 * (counts.faces + counts.corners + 3 * counts.vertices));
    CHECK(bytes.topology > 0 && bytes.scratch > 0);
    CHECK(carvel::predict_bytes(mesh, scheme, 3, 3, sizeof(double)).output > bytes.output);
    const carvel::Seconds seconds = carvel::predict_seconds(mesh, scheme, 3, 3, sizeof(float));
    CHECK(seconds.level == 3 && seconds.total > 0 && seconds.total < 1);
    CHECK(carvel::predict_seconds(mesh, scheme, 3, 3, sizeof(float), 2).total < seconds.total);
}

/* Values refined by hand, with the rows that the library tells. */
static void lineage_and_rows_are_told()
{
    const carvel::Mesh mesh = carvel::Mesh::create(pyramid.faces());
    const carvel::Scheme scheme = carvel::Scheme::create({CARVEL_SCHEME_THREE_POINT});
    const carvel::Hierarchy hierarchy = carvel::Hierarchy::create(mesh, scheme, 1);
    const carvel::Counts counts = hierarchy.counts(1);
    const auto faces = hierarchy.face_origins(1);
    CHECK(faces.size() == counts.faces && hierarchy.vertex_origins(1).size() == counts.vertices);
    std::uint64_t kinds[7] = {};
    for (const carvel::Origin &origin : faces)
        ++kinds[origin.kind];
    CHECK(kinds[CARVEL_ORIGIN_FACE] == 5 && kinds[CARVEL_ORIGIN_EDGE] == 8);
    CHECK(kinds[CARVEL_ORIGIN_VERTEX] == 5);
    CHECK(hierarchy.vertex_origins(1)[0].kind == CARVEL_ORIGIN_CORNER);

    std::vector<double> values = pyramid.points;
    for (std::uint32_t stage = 0; stage < 2; ++stage) {
        const carvel::Rows rows = hierarchy.rows(1, stage);
        std::vector<double> next(3 * counts.vertices);
        CHECK(rows.offsets.size() == counts.vertices + 1);
        CHECK(rows.offsets.back() == rows.indices.size());
        for (std::size_t i = 0; i < counts.vertices; ++i)
            for (std::size_t j = rows.offsets[i]; j < rows.offsets[i + 1]; ++j)
                for (std::size_t k = 0; k < 3; ++k)
                    next[3 * i + k] += rows.weights[j] * values[3 * rows.indices[j] + k];
        values = next;
    }
    const std::vector<double> refined = hierarchy.refine(1, pyramid.points);
    for (std::size_t i = 0; i < refined.size(); ++i)
        CHECK(refined[i] - values[i] < 1e-12 && values[i] - refined[i] < 1e-12);
    const auto missing = hierarchy.try_rows(1, 2);
    CHECK(!missing && missing.error().status() == CARVEL_STATUS_PARAMETER_OUT_OF_RANGE);
}

int main()
{
    versions_agree();
    schemes_take_every_parameter();
    meshes_tell_what_they_are();
    meshes_give_their_arrays();
    options_reach_the_mesh();
    tags_reach_the_mesh();
    primal_options_reach_the_scheme();
    varying_values_stay_linear();
    channels_keep_their_seams();
    predictions_hold();
    lineage_and_rows_are_told();
    std::puts("queries: ok");
}
