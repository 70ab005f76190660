// One look at a monitor port, to see that xr3 is there and answers: what to send, and what is known
// after each lot of bytes. It knows no socket, and asks for nothing that needs a token.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace xr3 {

class HealthProbe {
 public:
  /// A line of an xr3 is much shorter before it says how long they may be.
  static constexpr std::size_t kMostLineBytes = 64 * 1024;

  enum class Verdict : std::uint8_t { kUnknown, kHealthy, kUnhealthy };

  /// What opens a connection: a program that sends first is greeted at once. One byte says JSON, and
  /// no more: where it meets a serial line, nothing moves.
  static std::string opening() { return "{"; }

  /// Takes bytes as they come, any bytes; returns what to send now, which may be nothing.
  std::string take(std::string_view bytes);

  Verdict verdict() const { return verdict_; }
  /// What is wrong so far, as the end of a sentence that begins with who was asked.
  std::string trouble() const;

 private:
  std::string take_line();
  void refuse(std::string why);

  Verdict verdict_ = Verdict::kUnknown;
  bool is_greeted_ = false;
  std::string line_;  ///< the beginning of the next message
  std::string why_;   ///< it is unhealthy
};

}  // namespace xr3
