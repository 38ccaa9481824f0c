// OpenSubdiv's uniform refinement: topology, values, lineage.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

struct Tags;
struct OsdOptions;

class Osd : public Run {
 public:
  virtual Counts level_counts(std::uint32_t level) const = 0;
  virtual void copy_faces(std::uint32_t level, rust::Slice<std::uint32_t> sizes,
                          rust::Slice<std::uint32_t> indices,
                          rust::Slice<std::uint8_t> holes) const = 0;
  virtual void copy_lineage(std::uint32_t level, rust::Slice<std::uint8_t> kinds,
                            rust::Slice<std::uint32_t> parents,
                            rust::Slice<std::uint32_t> face_parents) const = 0;
  virtual std::size_t channel_size(std::uint32_t channel) const = 0;
  virtual void copy_channel(std::uint32_t channel, rust::Slice<std::uint32_t> indices) const = 0;
  virtual void interpolate(std::uint8_t kind, std::uint32_t channel,
                           rust::Slice<const double> values, std::size_t width,
                           rust::Slice<double> out) const = 0;
};

rust::String osd_version();
std::unique_ptr<Osd> osd_new(const Soup &soup, const Tags &tags, const OsdOptions &options,
                             Precision precision);
std::unique_ptr<Run> osd_into_run(std::unique_ptr<Osd> osd);
void osd_refine(Osd &osd, std::uint32_t levels);
void osd_copy(const Osd &osd, rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
              rust::Slice<double> positions);
// Limits of the vertices of a level and two tangents there, xyz each, by PrimvarRefiner::Limit.
void osd_limits(const Soup &soup, const Tags &tags, const OsdOptions &options,
                std::uint32_t level, rust::Slice<double> points, rust::Slice<double> first,
                rust::Slice<double> second);
rust::Vec<rust::String> osd_take_warnings();

}  // namespace carvel_peers
