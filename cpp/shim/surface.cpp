#include "carvel-peers/shim/surface.hpp"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>

#include <stdexcept>
#include <vector>

#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/shim/osd_topology.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

namespace {

constexpr std::size_t most_records = 6;
// Which records are derivatives, how often by either parameter.
constexpr int order[most_records] = {0, 1, 1, 2, 2, 2};

// Samples and results; the two differ in what a sample is looked up in.
template <typename Real>
class Sampled : public Patches {
 public:
  void place(rust::Slice<const std::uint32_t> faces, rust::Slice<const std::uint32_t> sectors,
             rust::Slice<const double> parameters) override {
    check_length("sectors", sectors.size(), faces.size());
    check_length("parameters", parameters.size(), 2 * faces.size());
    samples_.clear();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const std::size_t sides = sides_of(faces[i]);
      const bool whole = sides == regular_;
      if (sectors[i] >= (whole ? 1 : sides)) throw std::out_of_range("no such sector");
      samples_.push_back(
          sample(faces[i], sectors[i], !whole, parameters[2 * i], parameters[2 * i + 1]));
    }
    out_.resize(most_records * faces.size());
  }

  void copy(rust::Slice<double> out) const override {
    check_length("values", out.size(), 3 * samples_.size() * records_);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::size_t record = i / 3 % records_;
      const Real scale = samples_[i / 3 / records_].scale;
      Real value = out_[i / 3].at[i % 3];
      for (int k = 0; k < order[record]; ++k) value *= scale;
      out[i] = value;
    }
  }

 protected:
  struct Sample {
    // A ptex face of Far, a face of Bfr.
    int face;
    Real u, v;
    // Derivatives by the parameters asked for over those of the library.
    Real scale;
  };

  Sampled(const Soup &soup, const OsdOptions &options)
      : sizes_(soup.sizes.begin(), soup.sizes.end()),
        regular_(options.scheme == OpenSubdiv::Sdc::SCHEME_LOOP ? 3 : 4) {}

  virtual Sample sample(std::uint32_t face, std::uint32_t sector, bool of_sector, double u,
                        double v) const = 0;

  void start(std::uint8_t records) {
    if (records != 1 && records != 3 && records != 6) throw std::invalid_argument("records");
    records_ = records;
  }

  std::vector<Sample> samples_;
  std::vector<Xyz<Real>> out_;
  std::size_t records_ = 1;

 private:
  std::size_t sides_of(std::uint32_t face) const {
    if (face >= sizes_.size()) throw std::out_of_range("no such face");
    return sizes_[face];
  }

  std::vector<std::uint32_t> sizes_;
  std::size_t regular_;
};

template <typename Real>
class FarPatches final : public Sampled<Real> {
  using typename Sampled<Real>::Sample;

 public:
  FarPatches(const Soup &soup, const Tags &tags, const OsdOptions &given, std::uint32_t isolation)
      : Sampled<Real>(soup, given) {
    const auto refiner = Topology(soup, tags, given).refiner();
    const Far::PtexIndices ptex(*refiner);
    for (int f = 0; f < refiner->GetLevel(0).GetNumFaces(); ++f) first_.push_back(ptex.GetFaceId(f));
    Far::PatchTableFactory::Options options(isolation);
    options.template SetPatchPrecision<Real>();
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.useInfSharpPatch = true;
    options.generateLegacySharpCornerPatches = false;
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    table_.reset(Far::PatchTableFactory::Create(*refiner, options));
    osd_check();
    if (!table_) throw std::runtime_error("no patch table");
    map_ = std::make_unique<Far::PatchMap>(*table_);
    refine(*refiner, soup);
  }

  void evaluate(std::uint8_t records) override {
    this->start(records);
    switch (records) {
      case 1: run<1>(); break;
      case 3: run<3>(); break;
      default: run<6>();
    }
  }

 private:
  // Control points, those of all levels, those of end caps.
  void refine(const Far::TopologyRefiner &refiner, const Soup &soup) {
    points_ = xyz_of<Real>(soup.positions);
    const Far::PrimvarRefinerReal<Real> primvar(refiner);
    std::vector<Xyz<Real>> now = points_, next;
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
      next.resize(refiner.GetLevel(level).GetNumVertices());
      const Xyz<Real> *from = now.data();
      Xyz<Real> *to = next.data();
      primvar.Interpolate(level, from, to);
      points_.insert(points_.end(), next.begin(), next.end());
      now.swap(next);
    }
    const auto *local = table_->template GetLocalPointStencilTable<Real>();
    if (local && local->GetNumStencils() > 0) {
      const std::size_t refined = points_.size();
      points_.resize(refined + local->GetNumStencils());
      const Xyz<Real> *from = points_.data();
      local->UpdateValues(from, points_.data() + refined);
    }
    osd_check();
  }

  Sample sample(std::uint32_t face, std::uint32_t sector, bool of_sector, double u,
                double v) const override {
    if (!map_->FindPatch(first_[face] + int(sector), u, v))
      throw std::invalid_argument("a sample has no patch");
    // Patches in a face that is no quad count their depth, by which derivatives are scaled,
    // from the face.
    return {first_[face] + int(sector), Real(u), Real(v), of_sector ? Real(0.5) : Real(1)};
  }

  template <std::size_t records>
  void run() {
    // As many as a Gregory patch has.
    Real weights[most_records][20];
    Xyz<Real> *out = this->out_.data();
    for (const Sample &at : this->samples_) {
      const Far::PatchMap::Handle &handle = *map_->FindPatch(at.face, at.u, at.v);
      if constexpr (records == 1)
        table_->EvaluateBasis(handle, at.u, at.v, weights[0]);
      else if constexpr (records == 3)
        table_->EvaluateBasis(handle, at.u, at.v, weights[0], weights[1], weights[2]);
      else
        table_->EvaluateBasis(handle, at.u, at.v, weights[0], weights[1], weights[2], weights[3],
                              weights[4], weights[5]);
      const Far::ConstIndexArray points = table_->GetPatchVertices(handle);
      Xyz<Real> sums[records];
      for (Xyz<Real> &sum : sums) sum.Clear();
      for (int i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < records; ++k)
          sums[k].AddWithWeight(points_[points[i]], weights[k][i]);
      for (std::size_t k = 0; k < records; ++k) *out++ = sums[k];
    }
  }

  std::unique_ptr<const Far::PatchTable> table_;
  std::unique_ptr<const Far::PatchMap> map_;
  std::vector<Xyz<Real>> points_;
  std::vector<int> first_;
};

template <typename Real>
class BfrPatches final : public Sampled<Real> {
  using typename Sampled<Real>::Sample;

 public:
  BfrPatches(const Soup &soup, const Tags &tags, const OsdOptions &given, std::uint32_t isolation)
      : Sampled<Real>(soup, given), refiner_(Topology(soup, tags, given).refiner()) {
    using Factory = Bfr::RefinerSurfaceFactory<>;
    Factory::Options options;
    options.SetApproxLevelSmooth(int(isolation)).SetApproxLevelSharp(int(isolation));
    const Factory factory(*refiner_, options);
    const auto control = xyz_of<Real>(soup.positions);
    const typename Bfr::Surface<Real>::PointDescriptor xyz(3);
    surfaces_.resize(factory.GetNumFaces());
    starts_.resize(surfaces_.size());
    for (int f = 0; f < factory.GetNumFaces(); ++f) {
      Bfr::Surface<Real> &surface = surfaces_[f];
      if (!factory.InitVertexSurface(f, &surface)) continue;
      starts_[f] = points_.size();
      points_.resize(points_.size() + surface.GetNumPatchPoints());
      surface.PreparePatchPoints(control[0].at, xyz, points_[starts_[f]].at, xyz);
    }
    osd_check();
  }

  void evaluate(std::uint8_t records) override {
    this->start(records);
    const typename Bfr::Surface<Real>::PointDescriptor xyz(3);
    Xyz<Real> *out = this->out_.data();
    for (const Sample &at : this->samples_) {
      const Bfr::Surface<Real> &surface = surfaces_[at.face];
      const Real uv[2] = {at.u, at.v};
      const Real *points = points_[starts_[at.face]].at;
      if (records == 1)
        surface.Evaluate(uv, points, xyz, out[0].at);
      else if (records == 3)
        surface.Evaluate(uv, points, xyz, out[0].at, out[1].at, out[2].at);
      else
        surface.Evaluate(uv, points, xyz, out[0].at, out[1].at, out[2].at, out[3].at, out[4].at,
                         out[5].at);
      out += records;
    }
  }

 private:
  Sample sample(std::uint32_t face, std::uint32_t sector, bool of_sector, double u,
                double v) const override {
    const Bfr::Surface<Real> &surface = surfaces_[face];
    if (!surface.IsValid()) throw std::invalid_argument("a face has no surface");
    const double in_sector[2] = {u, v};
    double uv[2] = {u, v};
    if (of_sector)
      surface.GetParameterization().ConvertNormalizedSubFaceToCoord(int(sector), in_sector, uv);
    // A face that is no quad is tiled with sectors half a unit wide.
    return {int(face), Real(uv[0]), Real(uv[1]), of_sector ? Real(0.5) : Real(1)};
  }

  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::vector<Bfr::Surface<Real>> surfaces_;
  std::vector<std::size_t> starts_;
  std::vector<Xyz<Real>> points_;
};

template <template <typename> class Of>
std::unique_ptr<Patches> patches(const Soup &soup, const Tags &tags, const OsdOptions &options,
                                 Precision precision, std::uint32_t isolation) {
  // Far counts in four bits, of which Bfr takes ten.
  if (isolation > 10) throw std::invalid_argument("features are isolated to level 10 at most");
  if (precision == Precision::Single)
    return std::make_unique<Of<float>>(soup, tags, options, isolation);
  return std::make_unique<Of<double>>(soup, tags, options, isolation);
}

}  // namespace

std::unique_ptr<Patches> far_patches_new(const Soup &soup, const Tags &tags,
                                         const OsdOptions &options, Precision precision,
                                         std::uint32_t isolation) {
  return patches<FarPatches>(soup, tags, options, precision, isolation);
}

std::unique_ptr<Patches> bfr_patches_new(const Soup &soup, const Tags &tags,
                                         const OsdOptions &options, Precision precision,
                                         std::uint32_t isolation) {
  return patches<BfrPatches>(soup, tags, options, precision, isolation);
}

}  // namespace carvel_peers
