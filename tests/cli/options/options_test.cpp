#include "cli/options/options.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::Environment;
using test::parse;
using test::refused;

TEST(Options, ServeHasTheDocumentedDefaults) {
  const auto options = std::get<ServeOptions>(parse({"serve"}));
  EXPECT_EQ(options.robot, "rhino-xr3");
  EXPECT_EQ(options.listen, "localhost");
  EXPECT_EQ(options.robot_port, 9600);
  EXPECT_EQ(options.monitor_port, 9601);
  EXPECT_EQ(options.profile, Profile::kPaper);
  EXPECT_EQ(options.clock.mode, ClockMode::kReal);
}

TEST(Options, ServeAcceptsEveryOption) {
  const auto options = std::get<ServeOptions>(
      parse({"serve",  "--robot",      "adept-one", "--workcell",     "w.json", "--listen",
             "::1",    "--robot-port", "0",         "--monitor-port", "7",      "--compat",
             "mark3",  "--clock",      "real:2.5",  "--max-lines",    "3",      "--port-file",
             "p.json", "--log-level",  "debug"}));
  EXPECT_EQ(options.workcell, "w.json");
  EXPECT_EQ(options.profile, Profile::kMark3);
  EXPECT_EQ(options.clock.rate.millionths, 2'500'000);
  EXPECT_EQ(options.max_lines, 3U);
  EXPECT_EQ(options.port_file, "p.json");
}

TEST(Options, TheNumberOfLinesFollowsThatOfCells) {
  const auto max_lines = [](std::initializer_list<const char*> words) {
    return std::get<ServeOptions>(parse(words)).max_lines;
  };
  EXPECT_EQ(max_lines({"serve"}), 64U);
  EXPECT_EQ(max_lines({"serve", "--cells", "5"}), 64U);
  EXPECT_EQ(max_lines({"serve", "--cells", "30"}), 120U);
  EXPECT_EQ(max_lines({"serve", "--cells", "6000", "--max-cells", "6000"}), 20'000U);
  EXPECT_EQ(max_lines({"serve", "--cells", "30", "--max-lines", "30"}), 30U);
  EXPECT_EQ(max_lines({"serve", "--cell-per-connection"}), 1000U);
  EXPECT_EQ(max_lines({"serve", "--cell-per-connection", "--max-cells", "40"}), 40U);
  EXPECT_EQ(max_lines({"serve", "--cell-per-connection", "--max-lines", "2000"}), 2000U);
}

TEST(Options, TheHistoryIsATime) {
  EXPECT_EQ(std::get<ServeOptions>(parse({"serve"})).history_ticks, 3'600'000);
  EXPECT_EQ(parse_duration("90s"), 90'000);
  EXPECT_EQ(parse_duration("10m"), 600'000);
  EXPECT_EQ(parse_duration("24h"), 86'400'000);
  EXPECT_EQ(parse_duration("0"), 0);
  EXPECT_EQ(parse_duration("0s"), 0);
  for (const char* wrong :
       {"", "1", "h", "-1s", "25h", "86401s", "9999999999h", "1.5h", "1h ", "1d"})
    EXPECT_THROW(parse_duration(wrong), std::invalid_argument) << wrong;
}

TEST(Options, ADeviceHasTheSettingsOfAMark3UnlessOthersAreGiven) {
  const auto device = [](const std::string& text) {
    return *std::get<ServeOptions>(parse({"serve", "--serial", text.c_str()})).device;
  };
  EXPECT_EQ(device("/dev/ttyUSB0").path, "/dev/ttyUSB0");
  EXPECT_EQ(text_of(device("/dev/ttyUSB0").settings), "9600-7e2");
  EXPECT_EQ(text_of(device("/dev/ttyUSB0:1200-8n1").settings), "1200-8n1");
  EXPECT_EQ(device("/dev/pci-0:0:1-port0/tty").path, "/dev/pci-0:0:1-port0/tty");
  EXPECT_EQ(device("/dev/pci-0:0/tty:300-7o1").path, "/dev/pci-0:0/tty");
}

TEST(Options, ListeningBeyondLoopbackNeedsInsecure) {
  EXPECT_EQ(refused({"serve", "--listen", "0.0.0.0"}).code, ExitCode::kBadInput);
  EXPECT_NE(refused({"serve", "--listen", "0.0.0.0"}).to_stderr.find("--insecure"),
            std::string::npos);
  EXPECT_TRUE(
      std::holds_alternative<ServeOptions>(parse({"serve", "--listen", "0.0.0.0", "--insecure"})));
}

TEST(Options, ATokenAllowsListeningBeyondLoopback) {
  const auto with_file = std::get<ServeOptions>(
      parse({"serve", "--listen", "0.0.0.0", "--token-file", "t", "--private"}));
  EXPECT_EQ(std::get<TokenFile>(with_file.token).path, "t");
  EXPECT_TRUE(with_file.is_private);
  const auto fresh = std::get<ServeOptions>(parse({"serve", "--token", "auto"}));
  EXPECT_TRUE(std::holds_alternative<FreshToken>(fresh.token));
  EXPECT_NE(refused({"serve", "--listen", "::"}).to_stderr.find("--token-file"), std::string::npos);
}

TEST(Options, ReadsATokenFromTheEnvironment) {
  {
    const Environment environment({{kTokenVariable, "of the environment"}});
    const auto options = std::get<ServeOptions>(parse({"serve", "--listen", "::"}));
    EXPECT_TRUE(std::holds_alternative<TokenInEnvironment>(options.token));
    const auto named = std::get<ServeOptions>(parse({"serve", "--token-file", "t"}));
    EXPECT_TRUE(std::holds_alternative<TokenFile>(named.token));  // an argument takes precedence
  }
  const auto without = std::get<ServeOptions>(parse({"serve"}));
  EXPECT_TRUE(std::holds_alternative<NoToken>(without.token));
}

TEST(Options, RejectsASecretAsArgument) {
  const Leave leave = refused({"serve", "--token", "correct horse battery"});
  EXPECT_EQ(leave.code, ExitCode::kBadInput);
  EXPECT_NE(leave.to_stderr.find("--token-file"), std::string::npos);
  EXPECT_EQ(leave.to_stderr.find("horse"), std::string::npos) << leave.to_stderr;
}

TEST(Options, RepeatedHostsAndOriginsAccumulate) {
  const auto options =
      std::get<ServeOptions>(parse({"serve", "--allow-host", "a.lab", "--allow-host", "b",
                                    "--allow-origin", "https://page.lab,desktop"}));
  EXPECT_EQ(options.allow_hosts, (std::vector<std::string>{"a.lab", "b"}));
  EXPECT_EQ(options.allow_origins, (std::vector<std::string>{"https://page.lab", "desktop"}));
}

TEST(Options, FramesAreForSimulatedRobotsThatAnybodyMayMove) {
  const auto options = std::get<ServeOptions>(
      parse({"serve", "--allow-frame", "https://moodle.school", "--allow-frame",
             "http://localhost:8888,http://127.0.0.1:8889"}));
  EXPECT_EQ(options.allow_frames,
            (std::vector<std::string>{"https://moodle.school", "http://localhost:8888",
                                      "http://127.0.0.1:8889"}));
  for (const auto& [more, value] : {std::pair{"--token-file", "t"}, std::pair{"--token", "auto"},
                                    std::pair{"--serial", "/dev/ttyUSB0"}}) {
    const Leave leave = refused({"serve", "--allow-frame", "http://a", more, value});
    EXPECT_EQ(leave.code, ExitCode::kBadInput);
    EXPECT_EQ(leave.to_stderr.find("xr3: --allow-frame cannot be used with "), 0U)
        << leave.to_stderr;
  }
  for (const char* wrong :
       {"null", "*", "'self'", "moodle.school", "https://moodle.school/", "https:", "ftp://a",
        "https://*.school", "http://a; sandbox", "http://[::1]:80", ""}) {
    const Leave leave = refused({"serve", "--allow-frame", wrong});
    EXPECT_EQ(leave.code, ExitCode::kBadInput) << wrong;
    EXPECT_NE(leave.to_stderr.find("http://localhost:8888"), std::string::npos) << leave.to_stderr;
  }
}

TEST(Options, RecognisesLoopbackAddresses) {
  for (const char* address : {"127.0.0.1", "127.9.9.9", "::1", "localhost"})
    EXPECT_TRUE(is_loopback(address)) << address;
  for (const char* address : {"0.0.0.0", "::", "192.168.1.1", "example", ""})
    EXPECT_FALSE(is_loopback(address)) << address;
}

TEST(Options, TheByteClock) {
  EXPECT_EQ(parse_clock("bytes"), (ClockChoice{ClockMode::kBytes, Rate{}, {}}));
  EXPECT_EQ(parse_clock("bytes:5").bytes.inquiry_ms, 5);
  EXPECT_EQ(parse_clock("bytes:0").bytes.settle_ms, std::nullopt);
  EXPECT_EQ(parse_clock("bytes:20,settle=500").bytes.settle_ms, 500);
  const auto options = std::get<ServeOptions>(
      parse({"serve", "--clock", "bytes", "--concurrent-lines", "--line-speed", "300-8n1"}));
  EXPECT_TRUE(options.has_concurrent_lines);
}

TEST(Options, RejectsInvalidArgumentsWithAMessage) {
  const std::initializer_list<std::initializer_list<const char*>> wrong = {
      {},
      {"fly"},
      {"serve", "--robot-port", "65536"},
      {"serve", "--robot-port", "x"},
      {"serve", "--compat", "mark4"},
      {"serve", "--clock", "fast"},
      {"serve", "--clock", "real:0"},
      {"serve", "--clock", "real:1e9"},
      {"serve", "--clock", "bytes:"},
      {"serve", "--clock", "bytes:-1"},
      {"serve", "--clock", "bytes:60001"},
      {"serve", "--clock", "bytes:20x"},
      {"serve", "--clock", "bytes:20,"},
      {"serve", "--clock", "bytes:20,settle=9"},
      {"serve", "--clock", "bytes:20,settle=600001"},
      {"serve", "--clock", "bytes:20,rest=5"},
      {"serve", "--clock", "bytes", "--serial", "/dev/ttyUSB0"},
      {"serve", "--concurrent-lines"},
      {"serve", "--clock", "bytes:20,settle=50", "--concurrent-lines"},
      {"serve", "--max-lines", "0"},
      {"serve", "--log-level", "loud"},
      {"serve", "extra"},
      {"check"},
      {"serve", "--listen", "nowhere"},
      {"serve", "--private"},
      {"serve", "--metrics-token-file", "t"},
      {"serve", "--token-file", "t", "--token", "auto"},
      {"serve", "--allow-host", "a:80"},
      {"serve", "--allow-host", "*"},
      {"serve", "--allow-origin", "null"},
      {"serve", "--allow-origin", "page.lab"}};
  for (const auto& words : wrong) {
    const Leave leave = refused(words);
    EXPECT_EQ(leave.code, ExitCode::kBadInput);
    EXPECT_FALSE(leave.to_stderr.empty());
    EXPECT_TRUE(leave.to_stdout.empty()) << leave.to_stdout;
  }
}

TEST(Options, ErrorsAreSentencesWithTheNameThatWasMeant) {
  struct Case {
    std::initializer_list<const char*> words;
    const char* sentence;
  };
  const std::initializer_list<Case> cases = {
      {{"sevre"}, "unknown command sevre; perhaps serve was meant; xr3 --help lists the commands"},
      {{"fly"}, "unknown command fly; xr3 --help lists the commands"},
      {{"--robot", "x", "serve"}, "--robot must follow the command, as in xr3 serve --robot"},
      {{"--robto", "x"}, "xr3 has no option --robto; xr3 --help lists the commands"},
      {{"serve", "--robto", "x", "y"},
       "xr3 serve has no option --robto; perhaps --robot was meant; xr3 serve --help lists the "
       "arguments"},
      {{"serve", "--robto=x"},
       "xr3 serve has no option --robto; perhaps --robot was meant; xr3 serve --help lists the "
       "arguments"},
      {{"serve", "--port", "9700"},
       "xr3 serve has no option --port; perhaps --robot-port or --monitor-port was meant; xr3 "
       "serve "
       "--help lists the arguments"},
      {{"serve", "-p", "9700"}, "xr3 serve has no option -p; xr3 serve --help lists the arguments"},
      {{"serve", "first", "second", "--robot", "a"},
       "unexpected argument first; xr3 serve --help lists the arguments"},
      {{"serve", "--robot", "a", "b"},
       "unexpected argument b; xr3 serve --help lists the arguments"},
      {{"serve", "--robot"},
       "--robot needs one value, NAME|FILE; xr3 serve --help lists the arguments"},
      {{"exec", "--vary", "x", "--", "true"},
       "--vary: x: a variation is a seed, mm and degrees such as 7, 7:40 or 7:40,180; xr3 exec "
       "--help lists the arguments"},
      {{"exec", "--"}, "xr3 exec needs PROGRAM [ARG]; xr3 exec --help lists the arguments"},
      {{"serve", "--max-lines", "many"},
       "--max-lines: many: a whole number from 1 to 20000; xr3 serve --help lists the arguments"},
      {{"check"}, "xr3 check needs FILE; xr3 check --help lists the arguments"},
      {{"convert", "a"}, "xr3 convert needs OUT; xr3 convert --help lists the arguments"}};
  for (const auto& [words, sentence] : cases)
    EXPECT_EQ(refused(words).to_stderr, "xr3: " + std::string(sentence) + "\n");
}

TEST(Options, NoCommandListsTheCommands) {
  const Leave leave = refused({});
  EXPECT_EQ(leave.code, ExitCode::kBadInput);
  EXPECT_TRUE(
      leave.to_stderr.starts_with("xr3: a command is missing; xr3 COMMAND --help says more\n"
                                  "  serve        start a robot and its controller\n"
                                  "  check        "))
      << leave.to_stderr;
  EXPECT_NE(leave.to_stderr.find("\n  healthcheck  check that"), std::string::npos);
}

TEST(Options, HelpListsTheOptions) {
  const Leave leave = refused({"serve", "--help"});
  EXPECT_EQ(leave.code, ExitCode::kGood);
  for (const char* word : {"--robot-port", "--clock", "--insecure", "mark3"}) {
    EXPECT_NE(leave.to_stdout.find(word), std::string::npos) << word;
  }
}

TEST(Rate, IsExactToAMillionth) {
  EXPECT_EQ(parse_rate("0.001").millionths, 1'000);
  EXPECT_EQ(parse_rate("100000").millionths, 100'000'000'000);
  for (const char* text : {"", "0", "0.0009", "100001", "-1", "nan", "inf", "1x", "x"}) {
    EXPECT_THROW(parse_rate(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace xr3
