// Collects the parts of a state as bytes, for a digest: the same on every machine, and different if
// any part differs. Independent of the meaning of the parts.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace xr3 {

class StateWriter {
 public:
  /// Adds integers, enumerators, texts, arrays and optional values of these, and objects that have
  /// write_state(), in order.
  template <class... Parts>
  void add(const Parts&... parts) {
    (put(parts), ...);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class Part>
    requires std::integral<Part> || std::is_enum_v<Part>
  void put(Part part) {
    constexpr int kBits = 8;
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): a negative number is not a character
    auto rest = static_cast<std::uint64_t>(part);
    for (std::size_t i = 0; i < sizeof rest; ++i, rest >>= kBits)
      bytes_.push_back(static_cast<char>(rest & UINT8_MAX));
  }
  void put(std::string_view text) {
    put(text.size());
    bytes_ += text;
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class Part, std::size_t N>
  void put(const std::array<Part, N>& parts) {
    for (const Part& part : parts) put(part);
  }
  template <class Part>
  void put(const std::optional<Part>& part) {
    put(part.has_value());
    if (part) put(*part);
  }
  template <class Part>
    requires requires(const Part& part, StateWriter& out) { part.write_state(out); }
  void put(const Part& part) {
    part.write_state(*this);
  }

  std::string bytes_;
};

}  // namespace xr3
