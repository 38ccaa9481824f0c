/* Meshes of OpenMesh, there and back. Arguments: the cow's OBJ file. */
#include "check.hpp"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <string>

using Poly = OpenMesh::PolyMesh_ArrayKernelT<>;
using Tri = OpenMesh::TriMesh_ArrayKernelT<>;

struct EigenTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;
    using Normal = Eigen::Vector3d;
    using TexCoord2D = Eigen::Vector2d;
};
using EigenPoly = OpenMesh::PolyMesh_ArrayKernelT<EigenTraits>;

static carvel::Scheme three_point()
{
    return carvel::Scheme::create({CARVEL_SCHEME_THREE_POINT});
}

/* A sheet of n x n quads with texture coordinates like its positions, and a
 * vertex without faces. */
template <class M>
static M sheet(int n)
{
    using Point = typename M::Point;
    using Texture = typename M::TexCoord2D;
    using T = carvel::openmesh::Scalar<M>;
    M mesh;
    mesh.request_vertex_texcoords2D();
    std::vector<typename M::VertexHandle> v;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            v.push_back(mesh.add_vertex(Point(T(i), T(j), T(i * j))));
            mesh.set_texcoord2D(v.back(), Texture(T(i), T(j)));
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto at = [&](int x, int y) {
                return v[static_cast<std::size_t>(x * (n + 1) + y)];
            };
            mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    mesh.set_texcoord2D(mesh.add_vertex(Point(T(9), T(8), T(7))), Texture(T(9), T(8)));
    return mesh;
}

/* What C makes of the same arrays, taken from the mesh by hand. */
template <class M>
static void check_against_c(const M &in, const Poly &out, std::uint32_t levels)
{
    Indices sizes, corners;
    std::vector<float> points;
    for (const auto vertex : in.vertices())
        for (unsigned k = 0; k < 3; ++k)
            points.push_back(in.point(vertex)[k]);
    for (const auto face : in.faces()) {
        sizes.push_back(in.valence(face));
        for (const auto vertex : in.fv_range(face))
            corners.push_back(static_cast<std::uint32_t>(vertex.idx()));
    }
    const carvel::Mesh mesh = carvel::Mesh::create({in.n_vertices(), sizes, corners});
    const carvel::Hierarchy levels_of = carvel::Hierarchy::create(mesh, three_point(), levels);
    const carvel::Counts counts = levels_of.counts(levels);
    CHECK(out.n_vertices() == counts.vertices && out.n_faces() == counts.faces);
    CHECK(out.n_edges() == counts.edges);
    std::uint64_t boundary = 0;
    for (const auto edge : out.edges())
        boundary += out.is_boundary(edge) ? 1 : 0;
    CHECK(boundary == counts.boundary_edges);

    const std::vector<float> expected = levels_of.refine(levels, points);
    const Indices expected_corners = levels_of.mesh(levels).face_vertices();
    std::size_t next = 0;
    for (const auto vertex : out.vertices())
        for (unsigned k = 0; k < 3; ++k)
            CHECK(out.point(vertex)[k] == expected[next++]);
    next = 0;
    for (const auto face : out.faces()) {
        /* OpenMesh may begin a face at another corner. */
        const std::size_t size = out.valence(face);
        const auto first = static_cast<std::uint32_t>(out.cfv_begin(face)->idx());
        std::size_t shift = 0;
        while (shift < size && expected_corners[next + shift] != first)
            ++shift;
        CHECK(shift < size);
        for (const auto vertex : out.fv_range(face))
            CHECK(static_cast<std::uint32_t>(vertex.idx()) ==
                  expected_corners[next + shift++ % size]);
        next += size;
    }
}

static void a_cow_goes_there_and_back(const std::string &path)
{
    Poly cow, smooth;
    CHECK(OpenMesh::IO::read_mesh(cow, path));
    const carvel::ConstValues<float> points = carvel::openmesh::positions(cow);
    CHECK(points.data == cow.points()->data() && points.count == cow.n_vertices());
    carvel::openmesh::refine(cow, three_point(), 2, smooth);
    check_against_c(cow, smooth, 2);
    CHECK(!smooth.has_vertex_texcoords2D());
    /* And in place. */
    carvel::openmesh::refine(cow, three_point(), 2, cow);
    CHECK(cow.n_faces() == smooth.n_faces() && cow.points()[77] == smooth.points()[77]);
}

static void triangles_become_polygons(const std::string &path)
{
    Tri cow;
    Poly smooth;
    CHECK(OpenMesh::IO::read_mesh(cow, path));
    carvel::openmesh::refine(cow, three_point(), 1, smooth);
    check_against_c(cow, smooth, 1);
}

static void boundaries_isolated_vertices_and_texture_survive()
{
    const Poly in = sheet<Poly>(3);
    Poly out;
    carvel::openmesh::refine(in, three_point(), 2, out);
    check_against_c(in, out, 2);
    CHECK(out.has_vertex_texcoords2D());
    int isolated = 0;
    for (const auto vertex : out.vertices()) {
        const auto uv = out.texcoord2D(vertex);
        CHECK(uv[0] == out.point(vertex)[0] && uv[1] == out.point(vertex)[1]);
        if (out.is_isolated(vertex)) {
            CHECK(out.point(vertex) == Poly::Point(9, 8, 7));
            ++isolated;
        }
    }
    CHECK(isolated == 1);
}

static void other_vectors_do_as_well()
{
    const EigenPoly in = sheet<EigenPoly>(3);
    EigenPoly out;
    carvel::openmesh::refine(in, three_point(), 2, out);
    Poly expected;
    carvel::openmesh::refine(sheet<Poly>(3), three_point(), 2, expected);
    CHECK(out.n_faces() == expected.n_faces());
    for (const auto vertex : out.vertices()) {
        CHECK(std::abs(out.point(vertex)[2] - double(expected.point(vertex)[2])) < 1e-4);
        CHECK(out.texcoord2D(vertex)[1] == out.point(vertex)[1]);
    }
}

/* A refined mesh can be read again and refined further. */
static void a_refined_mesh_is_read_again()
{
    const Poly in = sheet<Poly>(2);
    const carvel::Mesh mesh = carvel::openmesh::read(in);
    const auto once = carvel::refine(mesh, three_point(), 1, carvel::openmesh::positions(in));
    Poly middle;
    carvel::openmesh::write(once, middle);
    carvel::MeshOptions options;
    options.anchored = once.anchored;
    const carvel::Mesh again = carvel::openmesh::read(middle, options);
    again.validate();
    CHECK(again.counts().edges == carvel::predict_counts(mesh, three_point(), 1).edges);
    CHECK(carvel::predict_counts(again, three_point(), 1).faces ==
          carvel::predict_counts(mesh, three_point(), 2).faces);
}

static void deleted_elements_are_refused()
{
    Poly mesh = sheet<Poly>(2), out = sheet<Poly>(1);
    mesh.request_face_status();
    mesh.request_edge_status();
    mesh.request_vertex_status();
    mesh.delete_face(mesh.face_handle(1), false);
    const auto result = carvel::openmesh::try_refine(mesh, three_point(), 1, out);
    CHECK(!result && result.error().status() == CARVEL_STATUS_UNSUPPORTED);
    const carvel::Element element = result.error().entries().at(0).elements.at(0);
    CHECK(element.kind == CARVEL_ELEMENT_FACE && element.index == 1);
    CHECK(result.error().message().find("garbage_collection") != std::string::npos);
    CHECK(out.n_faces() == 1); // What was there is still there.
    mesh.garbage_collection();
    CHECK(carvel::openmesh::read(mesh).counts().faces == 3);
    mesh.delete_vertex(mesh.vertex_handle(9), false);
    CHECK(THROWN(carvel::openmesh::read(mesh)) == CARVEL_STATUS_UNSUPPORTED);
}

static void what_either_side_refuses_is_told()
{
    /* Two faces that share a vertex only: OpenMesh has them, carvel does not. */
    Poly bow;
    std::vector<Poly::VertexHandle> v;
    for (int i = 0; i < 5; ++i)
        v.push_back(bow.add_vertex(Poly::Point(float(i), float(i * i), 0)));
    bow.add_face(v[0], v[1], v[2]);
    bow.add_face(v[0], v[3], v[4]);
    Poly out;
    CHECK(THROWN(carvel::openmesh::refine(bow, three_point(), 1, out)) ==
          CARVEL_STATUS_NON_MANIFOLD_VERTEX);

    /* Three faces at an edge: no result of carvel's. */
    carvel::Refined<double> book;
    book.positions.assign(15, 0.0);
    book.face_sizes = {3, 3, 3};
    book.face_vertices = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    const auto result = carvel::openmesh::try_write(book, out);
    CHECK(!result && result.error().status() == CARVEL_STATUS_UNSUPPORTED);
    CHECK(result.error().entries().at(0).elements.at(0).index == 2);

    const Poly empty;
    carvel::openmesh::refine(empty, three_point(), 2, out);
    CHECK(out.n_vertices() == 0 && out.n_faces() == 0);
}

int main(int, char **arguments)
{
    a_cow_goes_there_and_back(arguments[1]);
    triangles_become_polygons(arguments[1]);
    boundaries_isolated_vertices_and_texture_survive();
    other_vectors_do_as_well();
    a_refined_mesh_is_read_again();
    deleted_elements_are_refused();
    what_either_side_refuses_is_told();
    std::puts("openmesh: ok");
}
