#include "cli/options/replay.hpp"

#include <gtest/gtest.h>

#include "cli/options/options.hpp"
#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::parse;
using test::refused;

TEST(ReplayOptions, HaveTheDocumentedDefaults) {
  const auto command = std::get<ReplayCommand>(parse({"replay", "a.xr3"}));
  EXPECT_EQ(command.replay.file, "a.xr3");
  EXPECT_FALSE(command.replay.until || command.replay.is_serving);
  EXPECT_EQ(command.replay.every_ms, 100);
  EXPECT_EQ(command.replay.print, ReplayPrint::kNothing);
}

TEST(ReplayOptions, AllAreRead) {
  const auto command = std::get<ReplayCommand>(
      parse({"replay", "a", "--until", "2:500", "--print", "status", "--svg", "o.svg", "--csv",
             "o.csv", "--every", "20", "--serve", "--robot-port", "0"}));
  EXPECT_EQ(command.replay.until, (ReplayTime{2, 500}));
  EXPECT_EQ(command.replay.print, ReplayPrint::kStatus);
  EXPECT_EQ(command.replay.every_ms, 20);
  EXPECT_TRUE(command.replay.is_serving);
  EXPECT_EQ(command.server.robot_port, 0);
  EXPECT_EQ(parse_replay_time("77"), (ReplayTime{0, 77}));
}

TEST(ReplayOptions, WrongOnesAreRefused) {
  for (const char* time : {"", "x", "-1", "1:", ":1", "1:2:3", "9007199254740992"})
    EXPECT_EQ(refused({"replay", "a", "--until", time}).code, ExitCode::kBadInput) << time;
  EXPECT_EQ(refused({"replay"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"replay", "a", "--print", "all"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"replay", "a", "--every", "5"}).code, ExitCode::kBadInput) << "without --csv";
  EXPECT_EQ(refused({"replay", "a", "--robot-port", "5"}).code, ExitCode::kBadInput)
      << "without --serve";
  EXPECT_EQ(refused({"replay", "a", "--serve", "--listen", "0.0.0.0"}).code, ExitCode::kBadInput);
}

TEST(ReplayOptions, ServeRecordsIntoAFile) {
  const auto options = std::get<ServeOptions>(
      parse({"serve", "--record", "a.xr3", "--record-max", "5", "--record-total", "9"}));
  EXPECT_EQ(options.record, "a.xr3");
  EXPECT_EQ(options.record_max_mib, 5U);
  EXPECT_EQ(options.record_total_mib, 9U);
  EXPECT_EQ(refused({"serve", "--record-max", "0"}).code, ExitCode::kBadInput);
  EXPECT_EQ(refused({"serve", "--record-total", "0"}).code, ExitCode::kBadInput);
}

}  // namespace
}  // namespace xr3
