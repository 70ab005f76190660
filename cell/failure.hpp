// Failures that end the process. An exception in an object that all connections share (the cell,
// its frames, the robot port) may leave the object half changed, so no connection may continue to
// use it.
#pragma once

#include <array>
#include <exception>
#include <string_view>

namespace xr3 {

/// An exception that no connection may ignore. It does not allocate, since memory may be exhausted.
class FatalFailure : public std::exception {
 public:
  /// `what` is cut to kMaxBytes.
  FatalFailure(std::string_view where, std::string_view what) noexcept;
  const char* what() const noexcept override { return text_.data(); }
  static constexpr std::size_t kMaxBytes = 256;

 private:
  std::array<char, kMaxBytes> text_{};
};

/// Rethrows `failure` as a FatalFailure whose text begins with `where`.
[[noreturn]] void fail_fatally(const char* where, const std::exception_ptr& failure);

/// Runs work on shared objects. Any exception from it becomes a FatalFailure.
template <class Work>
decltype(auto) fatal_if_throws(const char* where, const Work& work) {
  try {
    return work();
  } catch (const FatalFailure&) {
    throw;
  } catch (...) {
    fail_fatally(where, std::current_exception());
  }
}

}  // namespace xr3
