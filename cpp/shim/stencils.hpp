// New positions on a topology that is ready, by OpenSubdiv: composed stencil tables, of a
// uniform level and of places on the limit, and level by level without a table.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

struct Tags;
struct OsdOptions;

class Stencils {
 public:
  virtual ~Stencils() = default;
  // Makes the table anew; only that of a level can be.
  virtual void create() = 0;
  virtual void clear() = 0;
  virtual void update() = 0;
  virtual std::size_t rows() const = 0;
  // Bytes of the table; 0 without one.
  virtual std::size_t bytes() const = 0;
  virtual void copy_values(std::uint8_t which, rust::Slice<double> out) const = 0;
};

std::unique_ptr<Stencils> stencils_new(const Soup &soup, const Tags &tags,
                                       const OsdOptions &options, Precision precision,
                                       std::uint32_t level);
std::unique_ptr<Stencils> levels_new(const Soup &soup, const Tags &tags, const OsdOptions &options,
                                     Precision precision, std::uint32_t level);
std::unique_ptr<Stencils> limit_stencils_new(const Soup &soup, const Tags &tags,
                                             const OsdOptions &options, Precision precision,
                                             std::uint32_t isolation,
                                             rust::Slice<const std::uint32_t> faces,
                                             rust::Slice<const double> parameters);

}  // namespace carvel_peers
