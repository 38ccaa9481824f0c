// What every library takes for granted of its input, and what callers get wrong.
#pragma once

#include <cstdint>

#include "rust/cxx.h"

namespace carvel_peers {

struct Soup;

// Throws unless sizes and indices agree and name existing vertices.
void check_soup(const Soup &soup);
// Throws if a vertex has no face: the masks of OpenMesh and CGAL divide by its valence.
void check_no_isolated(const Soup &soup);
// Throws if a face is no triangle.
void check_triangles(const Soup &soup);
// The number of faces around the busiest vertex, and the quietest.
struct Valences {
  std::uint32_t least, most;
};
Valences valences(const Soup &soup);
// Throws unless the buffer has the length.
void check_length(const char *what, std::size_t length, std::size_t expected);

}  // namespace carvel_peers
