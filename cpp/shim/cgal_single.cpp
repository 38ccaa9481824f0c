#include "carvel-peers/shim/cgal_run.hpp"

namespace carvel_peers {

std::unique_ptr<Run> cgal_run_single(const Soup &soup, std::uint8_t scheme) {
  return std::make_unique<CgalRun<float>>(soup, scheme);
}

}  // namespace carvel_peers
