#include "carvel-peers/shim/opensubdiv.hpp"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/version.h>

#include <stdexcept>
#include <string>

#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/shim/osd_topology.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace Far = OpenSubdiv::Far;

namespace {

// Records of any width in one array, blended in double.
struct Record {
  double *at;
  std::size_t width;

  void Clear() const {
    for (std::size_t k = 0; k < width; ++k) at[k] = 0;
  }
  void AddWithWeight(const Record &other, double weight) const {
    for (std::size_t k = 0; k < width; ++k) at[k] += weight * other.at[k];
  }
};

struct Records {
  double *base;
  std::size_t width;

  Record operator[](int i) const { return {base + std::size_t(i) * width, width}; }
};

enum class Kind : std::uint8_t { vertex, varying, face_varying };

template <typename Real>
class OsdOf final : public Osd {
 public:
  OsdOf(const Soup &soup, const Tags &tags, const OsdOptions &options)
      : topology_(soup, tags, options), control_(xyz_of<Real>(soup.positions)) {
    prepare();
  }

  void prepare() override {
    clear();
    refiner_ = topology_.refiner();
  }

  // The library's own path for uniform levels: refine, interpolate level by level,
  // read the last level's faces.
  void refine(std::uint32_t levels) override {
    if (!refiner_) throw std::logic_error("no control mesh");
    if (levels > 15) throw std::invalid_argument("OpenSubdiv counts levels in four bits");
    refiner_->RefineUniform(Far::TopologyRefiner::UniformOptions(int(levels)));
    osd_check();
    interpolate_positions(int(levels));
    osd_check();
    read_faces(refiner_->GetLevel(int(levels)));
  }

  void clear() override {
    refiner_.reset();
    positions_ = {};
    faces_ = {};
  }

  Counts counts() const override { return level_counts(std::uint32_t(last())); }

  void copy(rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
            rust::Slice<double> positions) const override {
    const Far::TopologyLevel &level = refiner().GetLevel(last());
    check_length("sizes", sizes.size(), level.GetNumFaces());
    check_length("indices", indices.size(), faces_.size());
    check_length("positions", positions.size(), 3 * positions_.size());
    for (std::size_t f = 0; f < sizes.size(); ++f) sizes[f] = level.GetFaceVertices(int(f)).size();
    for (std::size_t i = 0; i < faces_.size(); ++i) indices[i] = faces_[i];
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = positions_[i / 3].at[i % 3];
  }

  Counts level_counts(std::uint32_t level) const override {
    const Far::TopologyLevel &it = level_at(level);
    return {std::size_t(it.GetNumVertices()), std::size_t(it.GetNumFaces()),
            std::size_t(it.GetNumFaceVertices())};
  }

  void copy_faces(std::uint32_t level, rust::Slice<std::uint32_t> sizes,
                  rust::Slice<std::uint32_t> indices,
                  rust::Slice<std::uint8_t> holes) const override {
    const Far::TopologyLevel &it = level_at(level);
    check_length("sizes", sizes.size(), it.GetNumFaces());
    check_length("indices", indices.size(), it.GetNumFaceVertices());
    check_length("holes", holes.size(), it.GetNumFaces());
    std::size_t corner = 0;
    for (int f = 0; f < it.GetNumFaces(); ++f) {
      const Far::ConstIndexArray face = it.GetFaceVertices(f);
      sizes[f] = face.size();
      holes[f] = it.IsFaceHole(f);
      for (int v : face) indices[corner++] = v;
    }
  }

  void copy_lineage(std::uint32_t level, rust::Slice<std::uint8_t> kinds,
                    rust::Slice<std::uint32_t> parents,
                    rust::Slice<std::uint32_t> face_parents) const override {
    if (level == 0) throw std::invalid_argument("level 0 has no parents");
    const Far::TopologyLevel &child = level_at(level), &parent = level_at(level - 1);
    check_length("kinds", kinds.size(), child.GetNumVertices());
    check_length("parents", parents.size(), 2 * kinds.size());
    check_length("face parents", face_parents.size(), child.GetNumFaces());
    const auto set = [&](int vertex, std::uint8_t kind, int a, int b) {
      if (vertex < 0) return;
      kinds[vertex] = kind;
      parents[2 * vertex] = a;
      parents[2 * vertex + 1] = b;
    };
    for (int v = 0; v < parent.GetNumVertices(); ++v)
      set(parent.GetVertexChildVertex(v), 0, v, v);
    for (int e = 0; e < parent.GetNumEdges(); ++e) {
      const Far::ConstIndexArray ends = parent.GetEdgeVertices(e);
      set(parent.GetEdgeChildVertex(e), 1, ends[0], ends[1]);
    }
    // A triangle split puts no vertex in a face, and the library keeps no array to ask.
    const bool in_faces = refiner().GetSchemeType() != OpenSubdiv::Sdc::SCHEME_LOOP;
    for (int f = 0; in_faces && f < parent.GetNumFaces(); ++f)
      set(parent.GetFaceChildVertex(f), 2, f, f);
    for (int f = 0; f < child.GetNumFaces(); ++f) face_parents[f] = child.GetFaceParentFace(f);
  }

  std::size_t channel_size(std::uint32_t channel) const override {
    check_channel(channel);
    return refiner().GetLevel(last()).GetNumFVarValues(int(channel));
  }

  void copy_channel(std::uint32_t channel, rust::Slice<std::uint32_t> indices) const override {
    check_channel(channel);
    const Far::TopologyLevel &it = refiner().GetLevel(last());
    check_length("channel indices", indices.size(), it.GetNumFaceVertices());
    std::size_t corner = 0;
    for (int f = 0; f < it.GetNumFaces(); ++f)
      for (int value : it.GetFaceFVarValues(f, int(channel))) indices[corner++] = value;
  }

  void interpolate(std::uint8_t kind, std::uint32_t channel, rust::Slice<const double> values,
                   std::size_t width, rust::Slice<double> out) const override {
    if (kind > 2) throw std::invalid_argument("values are vertex, varying or face-varying");
    if (Kind(kind) == Kind::face_varying) check_channel(channel);
    const auto size = [&](int level) {
      const Far::TopologyLevel &it = refiner().GetLevel(level);
      return width * std::size_t(Kind(kind) == Kind::face_varying
                                     ? it.GetNumFVarValues(int(channel))
                                     : it.GetNumVertices());
    };
    check_length("values", values.size(), size(0));
    check_length("refined values", out.size(), size(last()));
    std::vector<double> now(values.begin(), values.end()), next;
    const Far::PrimvarRefinerReal<double> primvar(refiner());
    for (int level = 1; level <= last(); ++level) {
      next.resize(size(level));
      const Records from{now.data(), width};
      Records to{next.data(), width};
      switch (Kind(kind)) {
        case Kind::vertex: primvar.Interpolate(level, from, to); break;
        case Kind::varying: primvar.InterpolateVarying(level, from, to); break;
        case Kind::face_varying: primvar.InterpolateFaceVarying(level, from, to, int(channel));
      }
      osd_check();
      now.swap(next);
    }
    std::copy(now.begin(), now.end(), out.begin());
  }

 private:
  const Far::TopologyRefiner &refiner() const {
    if (!refiner_) throw std::logic_error("no control mesh");
    return *refiner_;
  }

  int last() const { return refiner().GetMaxLevel(); }

  const Far::TopologyLevel &level_at(std::uint32_t level) const {
    if (int(level) > last()) throw std::out_of_range("no such level");
    return refiner().GetLevel(int(level));
  }

  void check_channel(std::uint32_t channel) const {
    if (int(channel) >= refiner().GetNumFVarChannels()) throw std::out_of_range("no such channel");
  }

  void interpolate_positions(int levels) {
    const Far::PrimvarRefinerReal<Real> primvar(*refiner_);
    std::vector<Xyz<Real>> now;
    const Xyz<Real> *from = control_.data();
    positions_ = {};
    if (levels == 0) positions_ = control_;
    for (int level = 1; level <= levels; ++level) {
      positions_ = std::vector<Xyz<Real>>(refiner_->GetLevel(level).GetNumVertices());
      Xyz<Real> *to = positions_.data();
      primvar.Interpolate(level, from, to);
      if (level == levels) break;
      now.swap(positions_);
      from = now.data();
    }
  }

  void read_faces(const Far::TopologyLevel &level) {
    faces_ = {};
    faces_.reserve(level.GetNumFaceVertices());
    for (int f = 0; f < level.GetNumFaces(); ++f) {
      const Far::ConstIndexArray face = level.GetFaceVertices(f);
      faces_.insert(faces_.end(), face.begin(), face.end());
    }
  }

  Topology topology_;
  std::vector<Xyz<Real>> control_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::vector<Xyz<Real>> positions_;
  std::vector<int> faces_;
};

}  // namespace

rust::String osd_version() {
  return std::to_string(OPENSUBDIV_VERSION_MAJOR) + "." + std::to_string(OPENSUBDIV_VERSION_MINOR) +
         "." + std::to_string(OPENSUBDIV_VERSION_PATCH);
}

std::unique_ptr<Osd> osd_new(const Soup &soup, const Tags &tags, const OsdOptions &options,
                             Precision precision) {
  if (precision == Precision::Single) return std::make_unique<OsdOf<float>>(soup, tags, options);
  return std::make_unique<OsdOf<double>>(soup, tags, options);
}

std::unique_ptr<Run> osd_into_run(std::unique_ptr<Osd> osd) { return osd; }

void osd_limits(const Soup &soup, const Tags &tags, const OsdOptions &options,
                std::uint32_t level, rust::Slice<double> points, rust::Slice<double> first,
                rust::Slice<double> second) {
  if (level > 15) throw std::invalid_argument("OpenSubdiv counts levels in four bits");
  const auto refiner = Topology(soup, tags, options).refiner();
  Far::TopologyRefiner::UniformOptions uniform(static_cast<int>(level));
  // Limits ask for the neighbours of the last level's vertices.
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  osd_check();
  const Far::PrimvarRefinerReal<double> primvar(*refiner);
  auto now = xyz_of<double>(soup.positions);
  for (int n = 1; n <= refiner->GetMaxLevel(); ++n) {
    std::vector<Xyz<double>> next(refiner->GetLevel(n).GetNumVertices());
    const Xyz<double> *from = now.data();
    Xyz<double> *to = next.data();
    primvar.Interpolate(n, from, to);
    now.swap(next);
  }
  std::vector<Xyz<double>> limits[3];
  for (auto &list : limits) list.resize(now.size());
  const Xyz<double> *from = now.data();
  Xyz<double> *to[3] = {limits[0].data(), limits[1].data(), limits[2].data()};
  primvar.Limit(from, to[0], to[1], to[2]);
  osd_check();
  rust::Slice<double> out[3] = {points, first, second};
  for (int k = 0; k < 3; ++k) {
    check_length("limits", out[k].size(), 3 * now.size());
    for (std::size_t i = 0; i < out[k].size(); ++i) out[k][i] = limits[k][i / 3].at[i % 3];
  }
}

void osd_refine(Osd &osd, std::uint32_t levels) { osd.refine(levels); }

void osd_copy(const Osd &osd, rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
              rust::Slice<double> positions) {
  osd.copy(sizes, indices, positions);
}

}  // namespace carvel_peers
