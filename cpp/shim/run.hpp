// A control mesh in a library's own memory and one call that refines it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>

#include "rust/cxx.h"

namespace carvel_peers {

struct Soup;
struct Counts;
enum class Precision : std::uint8_t;

class Run {
 public:
  virtual ~Run() = default;
  // Puts the control mesh back.
  virtual void prepare() = 0;
  // Leaves faces and positions of the last level in memory.
  virtual void refine(std::uint32_t levels) = 0;
  virtual void clear() = 0;
  virtual Counts counts() const = 0;
  virtual void copy(rust::Slice<std::uint32_t> sizes, rust::Slice<std::uint32_t> indices,
                    rust::Slice<double> positions) const = 0;
};

}  // namespace carvel_peers

namespace rust {
namespace behavior {

// Whatever is thrown ends here; cxx itself knows std::exception only.
template <typename Try, typename Fail>
static void trycatch(Try &&body, Fail &&fail) noexcept try {
  body();
} catch (const std::exception &error) {
  fail(error.what());
} catch (...) {
  fail("an exception of an unknown type");
}

}  // namespace behavior
}  // namespace rust
