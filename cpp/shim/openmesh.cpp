#include "carvel-peers/shim/openmesh.hpp"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/config.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3InterpolatingSubdividerLabsikGreinerT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace {

namespace uniform = OpenMesh::Subdivider::Uniform;

// Nothing but points: what a mesh does not carry costs neither time nor memory.
template <typename Real>
struct Traits : OpenMesh::DefaultTraits {
  typedef OpenMesh::VectorT<Real, 3> Point;
  typedef OpenMesh::VectorT<Real, 3> Normal;
};

template <typename Mesh>
Mesh mesh_of(const Soup &soup) {
  Mesh mesh;
  using Point = typename Mesh::Point;
  using Real = typename Point::value_type;
  std::vector<typename Mesh::VertexHandle> face;
  for (std::size_t i = 0; i < soup.positions.size(); i += 3)
    mesh.add_vertex(Point(Real(soup.positions[i]), Real(soup.positions[i + 1]),
                          Real(soup.positions[i + 2])));
  auto next = soup.indices.begin();
  for (auto size : soup.sizes) {
    face.clear();
    for (std::uint32_t i = 0; i < size; ++i)
      face.push_back(typename Mesh::VertexHandle(int(*next++)));
    if (!mesh.add_face(face).is_valid())
      throw std::invalid_argument("OpenMesh does not take a face: not a manifold");
  }
  return mesh;
}

template <typename Mesh, typename Subdivider>
class OpenMeshRun final : public Run {
 public:
  explicit OpenMeshRun(const Soup &soup) : control_(mesh_of<Mesh>(soup)) {}

  void prepare() override { mesh_ = control_; }

  void refine(std::uint32_t levels) override {
    if (!mesh_) throw std::logic_error("no control mesh");
    Subdivider subdivider;
    if (!subdivider.attach(*mesh_) || !subdivider(levels))
      throw std::runtime_error("OpenMesh could not subdivide");
    subdivider.detach();
  }

  void clear() override { mesh_.reset(); }

  Counts counts() const override {
    const Mesh &it = mesh();
    std::size_t corners = 0;
    for (auto face : it.faces()) corners += it.valence(face);
    return {it.n_vertices(), it.n_faces(), corners};
  }

  void copy(rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
            rust::Slice<double> positions) const override {
    const Mesh &it = mesh();
    const Counts expected = counts();
    check_length("sizes", sizes.size(), expected.faces);
    check_length("indices", indices.size(), expected.corners);
    check_length("positions", positions.size(), 3 * expected.vertices);
    std::size_t corner = 0;
    for (auto face : it.faces()) {
      sizes[face.idx()] = it.valence(face);
      for (auto v : it.fv_range(face)) indices[corner++] = v.idx();
    }
    for (auto v : it.vertices())
      for (int k = 0; k < 3; ++k) positions[3 * v.idx() + k] = it.point(v)[k];
  }

 private:
  const Mesh &mesh() const { return mesh_ ? *mesh_ : control_; }

  Mesh control_;
  std::optional<Mesh> mesh_;
};

// OpenMesh tabulates its weights by valence and reads past the end of the table.
void check_valences(const Soup &soup, std::uint32_t least, std::uint32_t most) {
  const Valences found = valences(soup);
  if (found.least < least || found.most > most)
    throw std::invalid_argument("OpenMesh's weights are for valences " + std::to_string(least) +
                                " to " + std::to_string(most));
}

template <typename Real>
std::unique_ptr<Run> make(const Soup &soup, std::uint8_t scheme) {
  using Poly = OpenMesh::PolyMesh_ArrayKernelT<Traits<Real>>;
  using Tri = OpenMesh::TriMesh_ArrayKernelT<Traits<Real>>;
  if (scheme == 0) return std::make_unique<OpenMeshRun<Poly, uniform::CatmullClarkT<Poly>>>(soup);
  check_triangles(soup);
  switch (scheme) {
    case 1:
      check_valences(soup, 1, 49);
      return std::make_unique<OpenMeshRun<Tri, uniform::LoopT<Tri>>>(soup);
    case 2:
      check_valences(soup, 1, 49);
      return std::make_unique<OpenMeshRun<Tri, uniform::Sqrt3T<Tri>>>(soup);
    case 3:
      check_valences(soup, 1, 1000);
      return std::make_unique<OpenMeshRun<Tri, uniform::ModifiedButterflyT<Tri>>>(soup);
    case 4:
      check_valences(soup, 1, 49);
      return std::make_unique<OpenMeshRun<Tri, uniform::InterpolatingSqrt3LGT<Tri>>>(soup);
    default:
      throw std::invalid_argument("OpenMesh does not have the scheme");
  }
}

}  // namespace

rust::String openmesh_version() {
  return std::to_string((OM_VERSION & 0xf0000) >> 16) + "." +
         std::to_string((OM_VERSION & 0x0ff00) >> 8);
}

std::unique_ptr<Run> openmesh_run(const Soup &soup, std::uint8_t scheme, Precision precision) {
  // A refused face is an exception here, and no line on the standard error.
  ::omerr().disconnect(std::cerr);
  check_soup(soup);
  check_no_isolated(soup);
  return precision == Precision::Single ? make<float>(soup, scheme) : make<double>(soup, scheme);
}

}  // namespace carvel_peers
