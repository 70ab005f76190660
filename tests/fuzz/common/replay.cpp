// Runs a fuzzer's property checks on every file of the given folders, with each effort, without
// libFuzzer. The test fuzz_replay.x does so in every build with unit tests.
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

void replay(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string input(std::istreambuf_iterator<char>(file), {});
  // Printed first: if the input breaks a property, the process ends.
  std::printf("%s, %zu bytes\n", path.filename().c_str(), input.size());
  std::fflush(stdout);
  for (const auto effort : {xr3::fuzz::Effort::kQuick, xr3::fuzz::Effort::kFull})
    xr3::fuzz::run_within_limits(input, effort);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER...\nReplays every file of each folder.\n", argv[0]);
    return 2;
  }
  for (int i = 1; i < argc; ++i) {
    const Paths files = files_of(argv[i]);
    if (files.empty()) {
      std::fprintf(stderr, "%s: this folder has no inputs\n", argv[i]);
      return 1;
    }
    std::for_each(files.begin(), files.end(), replay);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
  return 1;
}
