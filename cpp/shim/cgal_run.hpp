// The run of one number type; included by the two translation units of CGAL.
#pragma once

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include "carvel-peers/shim/cgal.hpp"
#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

template <typename Real>
class CgalRun final : public Run {
  using Point = typename CGAL::Simple_cartesian<Real>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;

 public:
  CgalRun(const Soup &soup, std::uint8_t scheme) : scheme_(scheme) {
    std::vector<typename Mesh::Vertex_index> face;
    for (std::size_t i = 0; i < soup.positions.size(); i += 3)
      control_.add_vertex(Point(Real(soup.positions[i]), Real(soup.positions[i + 1]),
                                Real(soup.positions[i + 2])));
    auto next = soup.indices.begin();
    for (auto size : soup.sizes) {
      face.clear();
      for (std::uint32_t i = 0; i < size; ++i)
        face.push_back(typename Mesh::Vertex_index(*next++));
      if (control_.add_face(face) == Mesh::null_face())
        throw std::invalid_argument("CGAL does not take a face: not a manifold");
    }
  }

  void prepare() override { mesh_ = control_; }

  void refine(std::uint32_t levels) override {
    if (!mesh_) throw std::logic_error("no control mesh");
    namespace method = CGAL::Subdivision_method_3;
    const auto steps = CGAL::parameters::number_of_iterations(levels);
    switch (scheme_) {
      case 0: return method::CatmullClark_subdivision(*mesh_, steps);
      case 1: return method::Loop_subdivision(*mesh_, steps);
      case 2: return method::Sqrt3_subdivision(*mesh_, steps);
      default: return method::DooSabin_subdivision(*mesh_, steps);
    }
  }

  void clear() override { mesh_.reset(); }

  Counts counts() const override {
    const Mesh &it = mesh();
    std::size_t corners = 0;
    for (auto face : it.faces()) corners += it.degree(face);
    // Its own num_vertices() counts those that were removed.
    return {it.number_of_vertices(), it.number_of_faces(), corners};
  }

  void copy(rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
            rust::Slice<double> positions) const override {
    const Mesh &it = mesh();
    const Counts expected = counts();
    check_length("sizes", sizes.size(), expected.faces);
    check_length("indices", indices.size(), expected.corners);
    check_length("positions", positions.size(), 3 * expected.vertices);
    std::vector<std::uint32_t> number(it.num_vertices());
    std::uint32_t next = 0;
    for (auto v : it.vertices()) {
      for (int k = 0; k < 3; ++k) positions[3 * next + k] = it.point(v)[k];
      number[std::size_t(v)] = next++;
    }
    std::size_t face = 0, corner = 0;
    for (auto f : it.faces()) {
      sizes[face++] = it.degree(f);
      for (auto v : it.vertices_around_face(it.halfedge(f)))
        indices[corner++] = number[std::size_t(v)];
    }
  }

 private:
  const Mesh &mesh() const { return mesh_ ? *mesh_ : control_; }

  std::uint8_t scheme_;
  Mesh control_;
  std::optional<Mesh> mesh_;
};

}  // namespace carvel_peers
