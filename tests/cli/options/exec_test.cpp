#include "cli/options/exec.hpp"

#include <gtest/gtest.h>

#include "cli/options/options.hpp"
#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::parse;
using test::refused;
using Words = std::vector<std::string>;

TEST(ExecOptions, HaveTheDocumentedDefaults) {
  const auto command = std::get<ExecCommand>(parse({"exec", "--", "python3", "a.py"}));
  EXPECT_EQ(command.exec.command, (Words{"python3", "a.py"}));
  EXPECT_EQ(command.exec.limits.sim_ticks, 600'000);
  EXPECT_EQ(command.exec.limits.wall_s, 60);
  EXPECT_EQ(command.exec.limits.bytes, 0U);
  EXPECT_EQ(command.exec.limits.memory_mib, 512U);
  EXPECT_EQ(command.exec.limits.processes, 64U);
  EXPECT_EQ(command.exec.monitor, MonitorAccess::kNone);
  EXPECT_EQ(command.exec.repeat, 1);
  EXPECT_FALSE(command.exec.vary || command.exec.has_input || command.exec.is_quiet);
  EXPECT_EQ(command.server.clock.mode, ClockMode::kBytes);
  EXPECT_EQ(command.server.log_level, "off");
}

TEST(ExecOptions, AllAreRead) {
  const auto command = std::get<ExecCommand>(parse({"exec",      "--robot",
                                                    "adept-one", "--goals",
                                                    "g.json",    "--max-sim-seconds",
                                                    "1.5",       "--max-seconds",
                                                    "2",         "--max-bytes",
                                                    "9",         "--memory",
                                                    "64",        "--processes",
                                                    "3",         "--repeat",
                                                    "4",         "--vary",
                                                    "7:25,10",   "--monitor",
                                                    "control",   "--stdin",
                                                    "--quiet",   "--junit",
                                                    "j.xml",     "--json",
                                                    "j.json",    "--markdown",
                                                    "m.md",      "--github",
                                                    "g.txt",     "--out",
                                                    "folder",    "--record",
                                                    "r.xr3rec",  "--clock",
                                                    "bytes:500", "--",
                                                    "./a",       "-v",
                                                    "--goals"}));
  EXPECT_EQ(command.server.robot, "adept-one");
  EXPECT_EQ(command.server.clock.bytes.inquiry_ms, 500);
  EXPECT_EQ(command.server.record, "r.xr3rec");
  EXPECT_EQ(command.exec.limits.sim_ticks, 1500);
  EXPECT_EQ(command.exec.limits.memory_mib, 64U);
  EXPECT_EQ(command.exec.limits.processes, 3U);
  EXPECT_EQ(command.exec.vary, (Variation{7, 25'000, 10'000'000}));
  EXPECT_EQ(command.exec.monitor, MonitorAccess::kControl);
  EXPECT_TRUE(command.exec.has_input && command.exec.is_quiet);
  EXPECT_EQ(command.exec.command, (Words{"./a", "-v", "--goals"})) << "after --, all is its own";
}

TEST(ExecOptions, WrongOnesAreRefused) {
  EXPECT_EQ(refused({"exec"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"exec", "--repeat", "0", "--", "a"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"exec", "--monitor", "all", "--", "a"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"exec", "--max-seconds", "-1", "--", "a"}).code, ExitCode::kBadInput);
  for (const char* text : {"", "x", "-1", "1.5", "7:", "7:1,", "7:1,181", "7:1,2,3", "7:x"})
    EXPECT_EQ(refused({"exec", "--vary", text, "--", "a"}).code, ExitCode::kBadInput) << text;
}

TEST(GradeOptions, NeedGoalsAndAReport) {
  const auto command = std::get<GradeCommand>(parse(
      {"grade", "class", "--goals", "g", "--report", "r", "--jobs", "3", "--", "python3", "{}"}));
  EXPECT_EQ(command.grade.folder, "class");
  EXPECT_EQ(command.grade.report, "r");
  EXPECT_EQ(command.grade.jobs, 3U);
  EXPECT_EQ(command.exec.command, (Words{"python3", "{}"}));
  EXPECT_TRUE(command.exec.is_sandboxed);
  EXPECT_FALSE(command.grade.has_only_missing);
  EXPECT_EQ(refused({"grade", "class", "--report", "r", "--", "a"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"grade", "class", "--goals", "g", "--", "a"}).code, ExitCode::kBadInput);
}

Options graded(const char* option, const char* value = "--") {
  return parse({"grade", "class", "--goals", "g", "--report", "r", option, value, "--", "{}"});
}

TEST(GradeOptions, LeaveTheSandboxOnlyIfItIsSaid) {
  EXPECT_FALSE(std::get<GradeCommand>(graded("--no-sandbox")).exec.is_sandboxed);
  EXPECT_TRUE(std::get<GradeCommand>(graded("--read", "folder")).exec.is_sandboxed);
  EXPECT_TRUE(std::holds_alternative<Leave>(graded("--monitor", "read")));
  EXPECT_EQ(refused({"grade", "class", "--goals", "g", "--report", "r", "--no-sandbox", "--read",
                     "folder", "--", "{}"})
                .code,
            ExitCode::kBadInput);
}

}  // namespace
}  // namespace xr3
