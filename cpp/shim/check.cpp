#include "carvel-peers/shim/check.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "carvel-peers/src/bridge.rs.h"

namespace carvel_peers {

namespace {

std::vector<std::uint32_t> faces_around(const Soup &soup) {
  std::vector<std::uint32_t> count(soup.positions.size() / 3);
  for (auto v : soup.indices) ++count[v];
  return count;
}

}  // namespace

void check_soup(const Soup &soup) {
  std::size_t corners = 0;
  for (auto size : soup.sizes) {
    if (size < 3) throw std::invalid_argument("a face has fewer than three vertices");
    corners += size;
  }
  check_length("indices", soup.indices.size(), corners);
  if (soup.positions.size() % 3 != 0) throw std::invalid_argument("positions are not xyz");
  const auto vertices = soup.positions.size() / 3;
  if (vertices > INT32_MAX || corners > INT32_MAX) throw std::length_error("32-bit indices");
  for (auto v : soup.indices)
    if (v >= vertices) throw std::out_of_range("vertex " + std::to_string(v) + " is not there");
}

void check_no_isolated(const Soup &soup) {
  if (valences(soup).least == 0) throw std::invalid_argument("a vertex has no face");
}

void check_triangles(const Soup &soup) {
  for (auto size : soup.sizes)
    if (size != 3) throw std::invalid_argument("the scheme is for triangles only");
}

Valences valences(const Soup &soup) {
  const auto count = faces_around(soup);
  if (count.empty()) return {0, 0};
  const auto ends = std::minmax_element(count.begin(), count.end());
  return {*ends.first, *ends.second};
}

void check_length(const char *what, std::size_t length, std::size_t expected) {
  if (length != expected)
    throw std::length_error(std::string(what) + ": " + std::to_string(length) +
                            " entries, expected " + std::to_string(expected));
}

}  // namespace carvel_peers
