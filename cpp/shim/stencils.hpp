// OpenSubdiv's composed stencil tables, of a uniform level and of places on the limit.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

struct Tags;
struct OsdOptions;

class Stencils {
 public:
  virtual ~Stencils() = default;
  virtual void update() = 0;
  virtual std::size_t rows() const = 0;
  virtual void copy_values(std::uint8_t which, rust::Slice<double> out) const = 0;
};

std::unique_ptr<Stencils> stencils_new(const Soup &soup, const Tags &tags,
                                       const OsdOptions &options, Precision precision,
                                       std::uint32_t level);
std::unique_ptr<Stencils> limit_stencils_new(const Soup &soup, const Tags &tags,
                                             const OsdOptions &options, Precision precision,
                                             std::uint32_t isolation,
                                             rust::Slice<const std::uint32_t> faces,
                                             rust::Slice<const double> parameters);

}  // namespace carvel_peers
