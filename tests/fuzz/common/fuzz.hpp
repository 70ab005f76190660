// The registration of a fuzzer, and the functions that every fuzzer uses. libFuzzer or the replay
// of the corpus calls run_within_limits() for each input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace xr3::fuzz {

/// The effort for one input. Most inputs are short and quick, so that many fit in an hour.
enum class Effort : std::uint8_t {
  kQuick,  ///< the properties that are cheap to check
  kFull,   ///< all properties, and inputs that expand to the limits of size
};

/// The effort that libFuzzer makes: full for one of 1024 inputs, depending only on the input.
Effort effort_for(std::string_view input);

/// A fuzzer. Each file tests/fuzz/x.cpp registers one, in a namespace of its own.
struct Fuzzer {
  std::string_view name;  ///< x
  /// The length of the longest input that libFuzzer makes. 0: none longer than the longest seed.
  std::size_t max_input;
  /// Checks the fuzzer's properties on one input.
  void (*run)(std::string_view input, Effort effort);
};

/// Enters a fuzzer into fuzzers(). An instance in each file of a fuzzer does so before main().
struct Registration {
  explicit Registration(const Fuzzer& fuzzer);
};

/// All fuzzers that this program links. libFuzzer's programs link one each.
const std::vector<Fuzzer>& fuzzers();

/// Calls run(), twice if it takes long, and requires that it allocates at most 64 MiB at any time
/// and takes at most 5 s of processor time.
void run_within_limits(const Fuzzer& fuzzer, std::string_view input, Effort effort);

/// Ends the process with a message unless the property holds.
void require(bool holds, const char* property);

}  // namespace xr3::fuzz
