#include "core/faults/chance.hpp"

namespace xr3 {
namespace {

constexpr std::uint64_t kOffsetBasis = 0xCBF29CE484222325;
constexpr std::uint64_t kPrime = 0x00000100000001B3;

constexpr std::uint64_t with_byte(std::uint64_t hash, std::uint8_t byte) {
  return (hash ^ byte) * kPrime;
}

}  // namespace

std::uint64_t salt_of(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = kOffsetBasis;
  for (unsigned i = 0; i < 8; ++i) hash = with_byte(hash, static_cast<std::uint8_t>(seed >> 8 * i));
  for (const char c : name) hash = with_byte(hash, static_cast<std::uint8_t>(c));
  return hash;
}

}  // namespace xr3
