// Streams of bytes such as a line might carry: mostly what clients send, some of it junk, some
// telnet. The same seed gives the same stream everywhere.
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

  /// One command, fragment of telnet, or lump of junk.
  std::string piece();
  /// So many pieces.
  std::string stream(int pieces);

 private:
  std::string command();
  std::string number();
  std::string telnet();
  std::string junk();

  std::mt19937 engine_;
};

}  // namespace xr3::test
