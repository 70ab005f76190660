// Runs the property checks of a fuzzer on every file of the given folders, with each effort,
// without libFuzzer. The test fuzz_replay.x does so in every build with unit tests.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/common/fuzz.hpp"

namespace {

using xr3::fuzz::Effort;
using xr3::fuzz::Fuzzer;
using Paths = std::vector<std::filesystem::path>;

/// The files of a folder, in the same order on every machine.
Paths files_of(const std::filesystem::path& folder) {
  Paths files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void replay(const Fuzzer& fuzzer, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string input(std::istreambuf_iterator<char>(file), {});
  // Printed first: if the input breaks a property, the process ends.
  std::printf("%s, %zu bytes\n", path.filename().c_str(), input.size());
  std::fflush(stdout);
  for (const auto effort : {Effort::kQuick, Effort::kFull})
    run_within_limits(fuzzer, input, effort);
}

/// Replays a folder; returns the exit code.
int replay_folder(const Fuzzer& fuzzer, const std::filesystem::path& folder) {
  const Paths files = files_of(folder);
  if (files.empty()) {
    std::fprintf(stderr, "%s: this folder has no inputs\n", folder.c_str());
    return 1;
  }
  for (const auto& file : files) replay(fuzzer, file);
  return 0;
}

int usage(const char* program) {
  std::fprintf(stderr,
               "usage: %s FUZZER FOLDER...\nReplays every file of each folder. Fuzzers:", program);
  for (const Fuzzer& each : xr3::fuzz::fuzzers()) std::fprintf(stderr, " %s", each.name.data());
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto& all = xr3::fuzz::fuzzers();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const Fuzzer& each) { return argc > 2 && each.name == argv[1]; });
  if (found == all.end()) return usage(argv[0]);
  int code = 0;
  for (int i = 2; i < argc; ++i) code = std::max(code, replay_folder(*found, argv[i]));
  return code;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
  return 1;
}
