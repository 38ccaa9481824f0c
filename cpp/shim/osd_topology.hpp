// A topology refiner from flat arrays, and OpenSubdiv's messages as exceptions.
#pragma once

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <vector>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

struct Tags;
struct OsdOptions;

// The input in OpenSubdiv's types. It keeps what a TopologyDescriptor points to.
class Topology {
 public:
  Topology(const Soup &soup, const Tags &tags, const OsdOptions &options);

  // A refiner at level 0. Throws what the library calls an error.
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner() const;

  std::size_t vertices() const { return vertices_; }

 private:
  std::vector<int> sizes_, indices_, crease_ends_, corners_, holes_, channel_indices_;
  std::vector<int> channel_values_;
  std::vector<float> crease_sharpness_, corner_sharpness_;
  std::size_t vertices_;
  OpenSubdiv::Sdc::SchemeType scheme_;
  OpenSubdiv::Sdc::Options options_;
};

// OpenSubdiv reports to process-wide callbacks. They are set once; each message goes to
// the thread that caused it.
void osd_listen();
// Throws the errors that this thread has caused since it last asked.
void osd_check();

// A record of `Real`s that the library's templates can blend.
template <typename Real>
struct Xyz {
  Real at[3];

  void Clear() { at[0] = at[1] = at[2] = 0; }
  void AddWithWeight(const Xyz &other, Real weight) {
    for (int k = 0; k < 3; ++k) at[k] += weight * other.at[k];
  }
};

template <typename Real>
std::vector<Xyz<Real>> xyz_of(rust::Slice<const double> positions) {
  std::vector<Xyz<Real>> all(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i) all[i / 3].at[i % 3] = Real(positions[i]);
  return all;
}

}  // namespace carvel_peers
