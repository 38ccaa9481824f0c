#include "carvel-peers/shim/stencils.hpp"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <array>
#include <stdexcept>

#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/shim/osd_topology.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace Far = OpenSubdiv::Far;

namespace {

void check_level(std::uint32_t level) {
  if (level > 15) throw std::invalid_argument("OpenSubdiv counts levels in four bits");
}

std::unique_ptr<Far::TopologyRefiner> refined(const Topology &topology, std::uint32_t level) {
  check_level(level);
  auto refiner = topology.refiner();
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(int(level)));
  osd_check();
  return refiner;
}

// Values and how they are copied; the tables differ in how they are applied.
template <typename Real>
class Applied : public Stencils {
 public:
  explicit Applied(const Soup &soup) : control_(xyz_of<Real>(soup.positions)) {}

  void create() override { throw std::logic_error("not the table of a level"); }
  void clear() override {}
  std::size_t rows() const override { return values_[0].size(); }
  std::size_t bytes() const override { return 0; }

  void copy_values(std::uint8_t which, rust::Slice<double> out) const override {
    if (which >= values_.size()) throw std::out_of_range("no such values");
    const std::vector<Xyz<Real>> &values = values_[which];
    check_length("values", out.size(), 3 * values.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = values[i / 3].at[i % 3];
  }

 protected:
  std::vector<Xyz<Real>> control_;
  std::array<std::vector<Xyz<Real>>, 3> values_;
};

template <typename Real>
class Uniform final : public Applied<Real> {
 public:
  Uniform(const Soup &soup, const Topology &topology, std::uint32_t level)
      : Applied<Real>(soup), refiner_(refined(topology, level)) {
    create();
    this->values_[0].resize(table_->GetNumStencils());
  }

  void create() override {
    using Factory = Far::StencilTableFactoryReal<Real>;
    typename Factory::Options options;
    options.generateIntermediateLevels = false;
    options.generateControlVerts = refiner_->GetMaxLevel() == 0;
    options.maxLevel = refiner_->GetMaxLevel();
    table_.reset(Factory::Create(*refiner_, options));
    osd_check();
    if (!table_) throw std::runtime_error("no stencil table");
  }

  void clear() override { table_.reset(); }

  void update() override {
    if (!table_) throw std::logic_error("no stencil table");
    table_->UpdateValues(this->control_.data(), this->values_[0].data());
  }

  std::size_t bytes() const override {
    if (!table_) return 0;
    return sizeof(int) * (table_->GetSizes().capacity() + table_->GetOffsets().capacity() +
                          table_->GetControlIndices().capacity()) +
           sizeof(Real) * table_->GetWeights().capacity();
  }

 private:
  std::unique_ptr<const Far::TopologyRefiner> refiner_;
  std::unique_ptr<const Far::StencilTableReal<Real>> table_;
};

// No table: PrimvarRefiner through all levels, each of which keeps its array.
template <typename Real>
class Levels final : public Applied<Real> {
 public:
  Levels(const Soup &soup, const Topology &topology, std::uint32_t level)
      : Applied<Real>(soup), refiner_(refined(topology, level)), between_(level ? level - 1 : 0) {
    for (std::uint32_t n = 1; n <= level; ++n)
      values(n).resize(refiner_->GetLevel(int(n)).GetNumVertices());
    if (level == 0) this->values_[0] = this->control_;
  }

  void update() override {
    const Far::PrimvarRefinerReal<Real> primvar(*refiner_);
    const Xyz<Real> *from = this->control_.data();
    for (int n = 1; n <= refiner_->GetMaxLevel(); ++n) {
      Xyz<Real> *to = values(std::uint32_t(n)).data();
      primvar.Interpolate(n, from, to);
      from = to;
    }
    osd_check();
  }

 private:
  std::vector<Xyz<Real>> &values(std::uint32_t level) {
    return level <= between_.size() ? between_[level - 1] : this->values_[0];
  }

  std::unique_ptr<const Far::TopologyRefiner> refiner_;
  std::vector<std::vector<Xyz<Real>>> between_;
};

template <typename Real>
class Limit final : public Applied<Real> {
  using Factory = Far::LimitStencilTableFactoryReal<Real>;

 public:
  Limit(const Soup &soup, const Topology &topology, std::uint32_t isolation,
        rust::Slice<const std::uint32_t> faces, rust::Slice<const double> parameters)
      : Applied<Real>(soup) {
    check_level(isolation);
    check_length("parameters", parameters.size(), 2 * faces.size());
    const auto refiner = topology.refiner();
    const int last = Far::PtexIndices(*refiner).GetNumFaces();
    const std::vector<Real> st(parameters.begin(), parameters.end());
    typename Factory::LocationArrayVec places(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i] >= std::uint32_t(last)) throw std::out_of_range("no such ptex face");
      places[i].ptexIdx = int(faces[i]);
      places[i].numLocations = 1;
      places[i].s = &st[2 * i];
      places[i].t = &st[2 * i + 1];
    }
    refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(int(isolation)));
    table_.reset(Factory::Create(*refiner, places));
    osd_check();
    if (!table_) throw std::runtime_error("no limit stencil table");
    for (auto &values : this->values_) values.resize(table_->GetNumStencils());
  }

  void update() override {
    auto &[points, along_s, along_t] = this->values_;
    table_->UpdateValues(this->control_.data(), points.data());
    table_->UpdateDerivs(this->control_.data(), along_s.data(), along_t.data());
  }

 private:
  std::unique_ptr<const Far::LimitStencilTableReal<Real>> table_;
};

}  // namespace

std::unique_ptr<Stencils> stencils_new(const Soup &soup, const Tags &tags,
                                       const OsdOptions &options, Precision precision,
                                       std::uint32_t level) {
  const Topology topology(soup, tags, options);
  if (precision == Precision::Single)
    return std::make_unique<Uniform<float>>(soup, topology, level);
  return std::make_unique<Uniform<double>>(soup, topology, level);
}

std::unique_ptr<Stencils> levels_new(const Soup &soup, const Tags &tags, const OsdOptions &options,
                                     Precision precision, std::uint32_t level) {
  const Topology topology(soup, tags, options);
  if (precision == Precision::Single) return std::make_unique<Levels<float>>(soup, topology, level);
  return std::make_unique<Levels<double>>(soup, topology, level);
}

std::unique_ptr<Stencils> limit_stencils_new(const Soup &soup, const Tags &tags,
                                             const OsdOptions &options, Precision precision,
                                             std::uint32_t isolation,
                                             rust::Slice<const std::uint32_t> faces,
                                             rust::Slice<const double> parameters) {
  const Topology topology(soup, tags, options);
  if (precision == Precision::Single)
    return std::make_unique<Limit<float>>(soup, topology, isolation, faces, parameters);
  return std::make_unique<Limit<double>>(soup, topology, isolation, faces, parameters);
}

}  // namespace carvel_peers
