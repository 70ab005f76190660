// Chance without a generator: a hash of the seed, the fault's name and what the fault concerns
// (line and offset, joint and count, or tick and pixel). The result depends on nothing else, so it
// is the same however often and in whatever order it is computed.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/faults/fault.hpp"

namespace xr3 {

/// The FNV-1a hash (64 bits) of the seed as 8 bytes, lowest first, and of the name.
std::uint64_t salt_of(std::uint64_t seed, std::string_view name);

/// The finalizer of splitmix64: every bit of the result depends on every bit of the number.
constexpr std::uint64_t mixed(std::uint64_t number) {
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EB;
  return number ^ (number >> 31);
}

inline constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;

/// The part of chance_hash() that does not depend on the second number.
constexpr std::uint64_t chance_base(std::uint64_t salt, std::uint64_t first) {
  return mixed(mixed(salt + kGoldenRatio) ^ first);
}

constexpr std::uint64_t chance_after(std::uint64_t base, std::uint64_t second) {
  return mixed(base + kGoldenRatio * (second + 1));
}

/// The hash of a fault's salt and the two numbers that say what it concerns.
constexpr std::uint64_t chance_hash(std::uint64_t salt, std::uint64_t first, std::uint64_t second) {
  return chance_after(chance_base(salt, first), second);
}

/// Whether something with a chance of `parts` in kCertain happens. Uses the upper half of the hash.
constexpr bool happens(std::uint64_t hash, std::uint32_t parts) {
  return (hash >> 32) * kCertain < std::uint64_t{parts} << 32;
}

}  // namespace xr3
