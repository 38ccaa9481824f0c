// The limit surface at points of faces: position and derivatives.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

struct Tags;
struct OsdOptions;

// Patches that are ready, with the control positions in them, and samples to evaluate.
class Patches {
 public:
  virtual ~Patches() = default;
  // Samples: a face, the corner of it whose quarter it is unless that is the whole face, and
  // (u, v). Makes room for six records of each.
  virtual void place(rust::Slice<const std::uint32_t> faces,
                     rust::Slice<const std::uint32_t> sectors,
                     rust::Slice<const double> parameters) = 0;
  // One record per sample, three, or six.
  virtual void evaluate(std::uint8_t records) = 0;
  // What the last call left, in the parameters of the samples.
  virtual void copy(rust::Slice<double> out) const = 0;
};

// Far::PatchTable with Gregory end caps, found by Far::PatchMap.
std::unique_ptr<Patches> far_patches_new(const Soup &soup, const Tags &tags,
                                         const OsdOptions &options, Precision precision,
                                         std::uint32_t isolation);
// Bfr::Surface of each face; `isolation` for smooth and sharp features.
std::unique_ptr<Patches> bfr_patches_new(const Soup &soup, const Tags &tags,
                                         const OsdOptions &options, Precision precision,
                                         std::uint32_t isolation);

}  // namespace carvel_peers
