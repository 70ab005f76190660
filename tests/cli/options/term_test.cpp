// The command line of `xr3 term`.
#include "cli/options/term.hpp"

#include <gtest/gtest.h>

#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::parse;
using test::refused;

TermOptions term_with(std::initializer_list<const char*> words) {
  return std::get<TermOptions>(parse(words));
}

TEST(TermOptions, TheDefaultIsTheRobotPortOfThisMachine) {
  const TermOptions options = term_with({"term"});
  EXPECT_EQ(options.peer, "localhost:9600");
  EXPECT_FALSE(options.is_path);
  EXPECT_EQ(options.address.host, "localhost");
  EXPECT_EQ(options.address.port, "9600");
  EXPECT_EQ(text_of(options.settings), "9600-7e2");
  EXPECT_EQ(options.view, TermView::kText);
  EXPECT_FALSE(options.edits_lines);
}

TEST(TermOptions, AcceptAddressesAndPaths) {
  EXPECT_EQ(term_with({"term", "lab-pc"}).address.port, "9600");
  EXPECT_EQ(term_with({"term", "lab-pc:7"}).address.port, "7");
  EXPECT_EQ(term_with({"term", "[::1]:7"}).address.host, "::1");
  EXPECT_EQ(term_with({"term", "::1"}).address.host, "::1");
  EXPECT_TRUE(term_with({"term", "/dev/ttyUSB0"}).is_path);
  EXPECT_TRUE(term_with({"term", "./rhino"}).is_path);
  EXPECT_EQ(term_with({"term", "./rhino"}).peer, "./rhino");
}

TEST(TermOptions, AcceptEveryOption) {
  const TermOptions options =
      term_with({"term", "--rfc2217", "--line-settings", "1200-8n1", "--hex", "--line", "--robot",
                 "r", "--workcell", "w", "--compat", "mark3", "--timeout", "0.5", "host:1"});
  EXPECT_TRUE(options.is_rfc2217);
  EXPECT_EQ(text_of(options.settings), "1200-8n1");
  EXPECT_EQ(options.view, TermView::kHex);
  EXPECT_TRUE(options.edits_lines);
  EXPECT_EQ(options.robot, "r");
  EXPECT_EQ(options.workcell, "w");
  EXPECT_EQ(options.profile, Profile::kMark3);
  EXPECT_EQ(options.timeout_s, 0.5);
  EXPECT_EQ(term_with({"term", "--raw"}).view, TermView::kRaw);
  EXPECT_EQ(term_with({"term", "--text"}).view, TermView::kText);
  EXPECT_EQ(text_of(term_with({"term", "/dev/x", "--line-settings", "300"}).settings), "300-7e2");
}

TEST(TermOptions, RejectWhatDoesNotFitTogether) {
  for (const auto& words : std::initializer_list<std::initializer_list<const char*>>{
           {"term", "localhost:"},
           {"term", ":9600"},
           {"term", "localhost:x"},
           {"term", "a", "b"},
           {"term", "--hex", "--raw"},
           {"term", "--text", "--hex"},
           {"term", "--timeout", "0"},
           {"term", "--line-settings", "9600-9x9", "/dev/x"},
           {"term", "--line-settings", "9600-8n1"},
           {"term", "--rfc2217", "/dev/x"}}) {
    const Leave leave = refused(words);
    EXPECT_EQ(leave.code, ExitCode::kBadInput);
    EXPECT_NE(leave.to_stderr, "");
  }
}

}  // namespace
}  // namespace xr3
