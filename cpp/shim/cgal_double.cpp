#include <CGAL/version.h>

#include <string>

#include "carvel-peers/shim/cgal_run.hpp"

namespace carvel_peers {

rust::String cgal_version() { return CGAL_STR(CGAL_VERSION); }

std::unique_ptr<Run> cgal_run_double(const Soup &soup, std::uint8_t scheme) {
  return std::make_unique<CgalRun<double>>(soup, scheme);
}

std::unique_ptr<Run> cgal_run(const Soup &soup, std::uint8_t scheme, Precision precision) {
  check_soup(soup);
  check_no_isolated(soup);
  if (scheme > 3) throw std::invalid_argument("CGAL does not have the scheme");
  if (scheme == 1 || scheme == 2) check_triangles(soup);
  return precision == Precision::Single ? cgal_run_single(soup, scheme)
                                        : cgal_run_double(soup, scheme);
}

}  // namespace carvel_peers
