// Random input for a line: mostly commands, some unknown bytes, some telnet. The same seed gives
// the same stream on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace xr3::test {

class RandomBytes {
 public:
  explicit RandomBytes(std::uint32_t seed) : engine_(seed) {}

  /// 0...bound-1.
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_() % bound); }
  bool one_in(std::uint32_t chances) { return below(chances) == 0; }

  /// A command, a fragment of telnet, or unknown bytes.
  std::string piece();
  /// A sequence of pieces.
  std::string stream(int pieces);

 private:
  std::string command();
  std::string number();
  std::string telnet();
  std::string junk();

  std::mt19937 engine_;
};

}  // namespace xr3::test
