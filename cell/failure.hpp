// Failures that end the process. An exception in something that all connections share (the cell, its
// frames, the robot port) may leave it half changed, so no connection may go on with it.
#pragma once

#include <array>
#include <exception>
#include <string_view>

namespace xr3 {

/// An exception that no connection may swallow. It allocates nothing, since memory may be what is missing.
class VitalFailure : public std::exception {
 public:
  /// `what` is cut to kMaxBytes.
  VitalFailure(std::string_view where, std::string_view what) noexcept;
  const char* what() const noexcept override { return text_.data(); }
  static constexpr std::size_t kMaxBytes = 256;

 private:
  std::array<char, kMaxBytes> text_{};
};

/// Throws `failure` again, as a VitalFailure whose text begins with `where`.
[[noreturn]] void fail_vitally(const char* where, const std::exception_ptr& failure);

/// Does work on what connections share: an exception leaves it as a VitalFailure.
template <class Work>
decltype(auto) vital(const char* where, const Work& work) {
  try {
    return work();
  } catch (const VitalFailure&) {
    throw;
  } catch (...) {
    fail_vitally(where, std::current_exception());
  }
}

}  // namespace xr3
