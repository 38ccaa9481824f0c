// OpenMesh's uniform subdividers.
#pragma once

#include <memory>

#include "carvel-peers/shim/run.hpp"

namespace carvel_peers {

rust::String openmesh_version();
// Schemes: 0 Catmull-Clark, 1 Loop, 2 sqrt(3), 3 modified butterfly, 4 Labsik-Greiner.
std::unique_ptr<Run> openmesh_run(const Soup &soup, std::uint8_t scheme, Precision precision);

}  // namespace carvel_peers
