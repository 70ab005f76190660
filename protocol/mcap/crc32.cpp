#include "protocol/mcap/crc32.hpp"

#include <array>

namespace xr3::mcap {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0xEDB88320;
constexpr unsigned kBitsOfByte = 8;

constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte;
    for (unsigned bit = 0; bit < kBitsOfByte; ++bit)
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? kReflectedPolynomial : 0);
    table[byte] = crc;
  }
  return table;
}

constexpr auto kCrc32Table = crc32_table();

}  // namespace

void Crc32::add(std::string_view bytes) {
  for (const char byte : bytes)
    crc_ =
        (crc_ >> kBitsOfByte) ^ kCrc32Table[(crc_ ^ static_cast<std::uint8_t>(byte)) & UINT8_MAX];
}

std::uint32_t crc32(std::string_view bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace xr3::mcap
