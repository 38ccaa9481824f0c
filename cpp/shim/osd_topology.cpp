#include "carvel-peers/shim/osd_topology.hpp"

#include <opensubdiv/far/error.h>

#include <mutex>
#include <stdexcept>
#include <string>

#include "carvel-peers/shim/check.hpp"
#include "carvel-peers/shim/opensubdiv.hpp"
#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

thread_local std::string errors;
thread_local std::vector<std::string> warnings;

template <typename T>
std::vector<int> ints(const T &slice) {
  return std::vector<int>(slice.begin(), slice.end());
}

// The library refines a mesh with a bad index in silence.
void check_below(const char *what, const std::vector<int> &indices, std::size_t end) {
  for (int i : indices)
    if (i < 0 || std::size_t(i) >= end)
      throw std::out_of_range(std::string(what) + " " + std::to_string(i) + " is not there");
}

Sdc::SchemeType scheme_of(std::uint8_t scheme) {
  if (scheme > Sdc::SCHEME_LOOP) throw std::invalid_argument("OpenSubdiv does not have the scheme");
  return Sdc::SchemeType(scheme);
}

Sdc::Options options_of(const OsdOptions &given) {
  if (given.boundary > Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER ||
      given.face_varying > Sdc::Options::FVAR_LINEAR_ALL ||
      given.creasing > Sdc::Options::CREASE_CHAIKIN ||
      given.triangles > Sdc::Options::TRI_SUB_SMOOTH)
    throw std::invalid_argument("an option is out of range");
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VtxBoundaryInterpolation(given.boundary));
  options.SetFVarLinearInterpolation(Sdc::Options::FVarLinearInterpolation(given.face_varying));
  options.SetCreasingMethod(Sdc::Options::CreasingMethod(given.creasing));
  options.SetTriangleSubdivision(Sdc::Options::TriangleSubdivision(given.triangles));
  return options;
}

}  // namespace

Topology::Topology(const Soup &soup, const Tags &tags, const OsdOptions &options)
    : sizes_(ints(soup.sizes)),
      indices_(ints(soup.indices)),
      crease_ends_(ints(tags.crease_ends)),
      corners_(ints(tags.corners)),
      holes_(ints(tags.holes)),
      channel_indices_(ints(tags.channel_indices)),
      channel_values_(ints(tags.channel_values)),
      crease_sharpness_(tags.crease_sharpness.begin(), tags.crease_sharpness.end()),
      corner_sharpness_(tags.corner_sharpness.begin(), tags.corner_sharpness.end()),
      vertices_(soup.positions.size() / 3),
      scheme_(scheme_of(options.scheme)),
      options_(options_of(options)) {
  check_soup(soup);
  if (scheme_ == Sdc::SCHEME_LOOP) check_triangles(soup);
  check_length("crease ends", crease_ends_.size(), 2 * crease_sharpness_.size());
  check_length("corners", corners_.size(), corner_sharpness_.size());
  check_length("channels", channel_indices_.size(), channel_values_.size() * indices_.size());
  check_below("crease vertex", crease_ends_, vertices_);
  check_below("corner", corners_, vertices_);
  check_below("hole", holes_, sizes_.size());
  for (std::size_t i = 0; i < channel_indices_.size(); ++i)
    check_below("value", {channel_indices_[i]}, channel_values_[i / indices_.size()]);
}

std::unique_ptr<Far::TopologyRefiner> Topology::refiner() const {
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Far::TopologyDescriptor about;
  about.numVertices = int(vertices_);
  about.numFaces = int(sizes_.size());
  about.numVertsPerFace = sizes_.data();
  about.vertIndicesPerFace = indices_.data();
  about.numCreases = int(crease_sharpness_.size());
  about.creaseVertexIndexPairs = crease_ends_.data();
  about.creaseWeights = crease_sharpness_.data();
  about.numCorners = int(corners_.size());
  about.cornerVertexIndices = corners_.data();
  about.cornerWeights = corner_sharpness_.data();
  about.numHoles = int(holes_.size());
  about.holeIndices = holes_.data();
  std::vector<Far::TopologyDescriptor::FVarChannel> channels(channel_values_.size());
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i].numValues = channel_values_[i];
    channels[i].valueIndices = channel_indices_.data() + i * indices_.size();
  }
  about.numFVarChannels = int(channels.size());
  about.fvarChannels = channels.data();
  osd_listen();
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(about, Factory::Options(scheme_, options_)));
  osd_check();
  if (!refiner) throw std::invalid_argument("OpenSubdiv does not take the mesh");
  return refiner;
}

void osd_listen() {
  static std::once_flag once;
  std::call_once(once, [] {
    Far::SetErrorCallback([](Far::ErrorType, const char *message) {
      errors += errors.empty() ? "" : "; ";
      errors += message;
    });
    Far::SetWarningCallback([](const char *message) { warnings.emplace_back(message); });
  });
}

void osd_check() {
  if (errors.empty()) return;
  const std::string text = std::move(errors);
  errors.clear();
  throw std::runtime_error(text);
}

rust::Vec<rust::String> osd_take_warnings() {
  rust::Vec<rust::String> all;
  for (const auto &warning : warnings) all.push_back(rust::String::lossy(warning));
  warnings.clear();
  return all;
}

}  // namespace carvel_peers
