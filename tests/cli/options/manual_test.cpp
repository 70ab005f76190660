#include "cli/options/manual.hpp"

#include <gmock/gmock.h>

#include "cli/options/options.hpp"
#include "cli/options/pose_argument.hpp"

namespace xr3 {
namespace {

using ::testing::HasSubstr;

Options parse_manual(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "xr3");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), " (build)");
}

std::string printed_manual(const std::vector<const char*>& arguments) {
  return std::get<Leave>(parse_manual(arguments)).to_stdout;
}

TEST(Manual, IsThePageOfXr3OrOfACommand) {
  EXPECT_THAT(printed_manual({"manual"}), HasSubstr("xr3\\-serve"));
  EXPECT_THAT(printed_manual({"manual", "serve"}), HasSubstr("\\fB\\-\\-robot\\-port\\fR"));
}

TEST(Manual, RefusesAnUnknownCommandWithTheKnownOnes) {
  try {
    parse_manual({"manual", "sevre"});
    FAIL();
  } catch (const ArgumentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no command sevre; use one of: serve, check"));
  }
}

TEST(Manual, WritesAPageForEachCommandAndThreeCompletions) {
  const auto manual = std::get<ManualFiles>(parse_manual({"manual", "--write", "here"}));
  EXPECT_EQ("here", manual.folder);
  std::vector<std::string> paths;
  for (const ManualFile& file : manual.files) paths.push_back(file.path);
  EXPECT_THAT(paths,
              ::testing::IsSupersetOf(
                  {"man/man1/xr3.1", "man/man1/xr3-grade.1", "bash-completion/completions/xr3",
                   "zsh/vendor-completions/_xr3", "fish/vendor_completions.d/xr3.fish"}));
}

TEST(Completion, PrintsTheNamesOfDataFiles) {
  ::setenv("XR3_DATA", XR3_SOURCE_DIR "/data", 1);
  EXPECT_EQ("adept-one\nintelledex-660\nrhino-xr3\nrhino-xr3-accessories\n",
            printed_manual({"completion", "robots"}));
  ::unsetenv("XR3_DATA");
}

TEST(Completion, RefusesAnUnknownShell) {
  EXPECT_THAT(std::get<Leave>(parse_manual({"completion", "csh"})).to_stderr, HasSubstr("csh"));
}

TEST(Version, NamesTheBuild) {
  EXPECT_EQ("xr3 " XR3_VERSION " (build)\n", printed_manual({"--version"}));
}

}  // namespace
}  // namespace xr3
