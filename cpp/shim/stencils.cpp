#include "carvel-peers/shim/stencils.hpp"

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

// Values and how they are copied; the tables differ in how they are applied.
template <typename Real>
class Applied : public Stencils {
 public:
  explicit Applied(const Soup &soup) : control_(xyz_of<Real>(soup.positions)) {}

  std::size_t rows() const override { return values_[0].size(); }

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
  Uniform(const Soup &soup, const Topology &topology, std::uint32_t level) : Applied<Real>(soup) {
    check_level(level);
    const auto refiner = topology.refiner();
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(int(level)));
    using Factory = Far::StencilTableFactoryReal<Real>;
    typename Factory::Options options;
    options.generateIntermediateLevels = false;
    options.generateControlVerts = level == 0;
    options.maxLevel = level;
    table_.reset(Factory::Create(*refiner, options));
    osd_check();
    if (!table_) throw std::runtime_error("no stencil table");
    this->values_[0].resize(table_->GetNumStencils());
  }

  void update() override {
    table_->UpdateValues(this->control_.data(), this->values_[0].data());
  }

 private:
  std::unique_ptr<const Far::StencilTableReal<Real>> table_;
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
