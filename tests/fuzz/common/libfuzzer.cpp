// The functions that libFuzzer calls, and the limits of every fuzzer. They stand here, so that
// ctest, `./test --fuzz` and a fuzzer started by hand have the same limits; an option on the
// command line overrides them.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "tests/fuzz/common/fuzz.hpp"

namespace {

constexpr const char* kLimits[] = {
    // Finds endless waiting. run_within_limits() measures the processor time.
    "-timeout=60",
    // One allocation above the limit is reported where it happens. run_within_limits() measures
    // the sum of an input.
    "-malloc_limit_mb=64",
    // Limits the whole process, to find leaks from input to input. It includes the memory of
    // AddressSanitizer (shadow, red zones, quarantine) and of libFuzzer (corpus, tables). The value
    // is an estimate.
    "-rss_limit_mb=256",
    // Entropic scheduling of inputs takes a third of the time of a quick input.
    "-entropic=0",
    // Looking every second for inputs that another process found takes 2 % of the time.
    "-reload=0",
};

/// Says every minute of processor time how far a long run is. (libFuzzer does so ever more rarely.)
class Progress {
 public:
  void note() {
    if (++inputs_ % kInputs != 0) return;
    const auto seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    if (seconds < next_) return;
    next_ = seconds + kSeconds;
    std::fprintf(stderr, "progress: %zu inputs, %.0f in a second of processor time\n", inputs_,
                 static_cast<double>(inputs_) / seconds);
  }

 private:
  static constexpr std::size_t kInputs = 1024;
  static constexpr double kSeconds = 60;

  std::size_t inputs_ = 0;
  double next_ = kSeconds;
};

/// The one fuzzer of this program.
const xr3::fuzz::Fuzzer& fuzzer() { return xr3::fuzz::fuzzers().at(0); }

}  // namespace

// Freed memory is found while 2 MB more are freed: many quick inputs. The default, 256 MB, would
// hide growth from -rss_limit_mb, and 16 MB do not fit in a processor's cache. The stack of every
// allocation takes a tenth of the time: ASAN_OPTIONS=malloc_context_size=30 shows it when a crash
// is replayed. The tests replay the corpus with detect_stack_use_after_return=1, which the preset
// compiles without, because it is slower.
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=2:thread_local_quarantine_size_kb=256:malloc_context_size=1:"
         "detect_stack_use_after_return=0";
}

// Inserts the limits before the other arguments.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static std::vector<char*> arguments{(*argv)[0]};
  static std::string max_len = "-max_len=" + std::to_string(fuzzer().max_input);
  for (const char* limit : kLimits) arguments.push_back(const_cast<char*>(limit));
  arguments.push_back(max_len.data());
  arguments.insert(arguments.end(), *argv + 1, *argv + *argc);
  *argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  *argv = arguments.data();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  static Progress progress;
  xr3::fuzz::run_within_limits(fuzzer(), input, xr3::fuzz::effort_for(input));
  progress.note();
  return 0;
}
