// CGAL's Subdivision_method_3 on Surface_mesh.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

rust::String cgal_version();
// Schemes: 0 Catmull-Clark, 1 Loop, 2 sqrt(3), 3 Doo-Sabin.
std::unique_ptr<Run> cgal_run(const Soup &soup, std::uint8_t scheme, Precision precision);

// One translation unit each, so that they compile side by side.
std::unique_ptr<Run> cgal_run_single(const Soup &soup, std::uint8_t scheme);
std::unique_ptr<Run> cgal_run_double(const Soup &soup, std::uint8_t scheme);

}  // namespace carvel_peers
