#include "tests/fuzz/common/fuzz.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "tests/support/allocations.hpp"

namespace xr3::fuzz {
namespace {

constexpr std::size_t kMaxAllocated = 64UL * 1024 * 1024;
constexpr std::clock_t kMaxSeconds = 5;  // with sanitizers; quick inputs take a millisecond
// Two threads need half of it.
constexpr std::chrono::milliseconds kSurelyQuick{kMaxSeconds * 1000 / 2};
constexpr std::uint64_t kFullInterval = 1024;

/// FNV-1a.
std::uint64_t hash_of(std::string_view input) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : input) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

// Reading the processor time takes a system call, a tenth of the time of the quickest inputs. So it
// is measured only if an input took long: perhaps the machine had other work.
void measure_again(const Fuzzer& fuzzer, std::string_view input, Effort effort) {
  const std::clock_t start = std::clock();
  fuzzer.run(input, effort);
  require(std::clock() - start <= kMaxSeconds * CLOCKS_PER_SEC,
          "an input needs at most 5 s of processor time");
}

/// A local variable, so that it exists before the first registration.
std::vector<Fuzzer>& registered() {
  static std::vector<Fuzzer> fuzzers;
  return fuzzers;
}

}  // namespace

Registration::Registration(const Fuzzer& fuzzer) { registered().push_back(fuzzer); }

const std::vector<Fuzzer>& fuzzers() { return registered(); }

Effort effort_for(std::string_view input) {
  constexpr unsigned kHighBits = 32;  // they depend on every byte of the input
  const std::uint64_t bits = hash_of(input) >> kHighBits;
  return bits % kFullInterval == 0 ? Effort::kFull : Effort::kQuick;
}

void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", property);
  std::abort();
}

void run_within_limits(const Fuzzer& fuzzer, std::string_view input, Effort effort) {
  const test::Allocations allocations;
  const auto start = std::chrono::steady_clock::now();
  fuzzer.run(input, effort);
  require(allocations.peak() <= kMaxAllocated, "an input needs at most 64 MiB");
  if (std::chrono::steady_clock::now() - start > kSurelyQuick) measure_again(fuzzer, input, effort);
}

}  // namespace xr3::fuzz
