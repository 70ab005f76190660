#include "protocol/recording/running_check.hpp"

#include <array>

namespace xr3::recording {
namespace {

constexpr std::uint32_t kPolynomial = 0x1864CFB;
constexpr std::uint32_t kHighest = 0x1000000;  // the bit above the CRC
constexpr std::uint32_t kCrcBits = 0xFFFFFF;
constexpr unsigned kByteBits = 8;

constexpr std::uint32_t shifted(std::uint32_t crc) {
  crc <<= 1U;
  return (crc & kHighest) != 0 ? crc ^ kPolynomial : crc;
}

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte << 16U;
    for (unsigned bit = 0; bit < kByteBits; ++bit) crc = shifted(crc);
    table[byte] = crc & kCrcBits;
  }
  return table;
}

constexpr auto kCrcTable = crc_table();

}  // namespace

void RunningCheck::add(std::string_view bytes) {
  for (const char byte : bytes) {
    const std::uint32_t index = (crc_ >> 16U) ^ static_cast<std::uint8_t>(byte);
    crc_ = ((crc_ << kByteBits) & kCrcBits) ^ kCrcTable[index & UINT8_MAX];
  }
}

std::string RunningCheck::text() const {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string digits;
  for (const unsigned shift : {18U, 12U, 6U, 0U}) digits += kDigits[(crc_ >> shift) & 63U];
  return digits;
}

}  // namespace xr3::recording
