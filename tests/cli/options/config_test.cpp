#include "cli/options/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::Environment;
using test::parse;
using test::refused;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class OptionsConfig : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  ServeOptions serve(const std::string& text) const {
    write(text);
    return std::get<ServeOptions>(parse({"serve", "--config", path_.c_str()}));
  }

  /// The error message about the file, without the file's name.
  std::string trouble(const std::string& text) const {
    write(text);
    const Leave leave = refused({"serve", "--config", path_.c_str()});
    EXPECT_EQ(leave.code, ExitCode::kBadInput) << text;
    EXPECT_THAT(leave.to_stderr, StartsWith("xr3: " + path_)) << text;
    return leave.to_stderr.substr(std::min(leave.to_stderr.size(), 5 + path_.size()));
  }

  const std::string path_ = std::filesystem::temp_directory_path() /
                            ("xr3-options-" + std::to_string(::getpid()) + ".toml");
};

TEST_F(OptionsConfig, SetsEveryOption) {
  const ServeOptions options = serve(R"(# a comment
robot = "adept-one"  # another
workcell = 'my cell.json'
listen="::1"
"robot-port" = 0
monitor-port = 7
; an old comment

  compat = mark3
clock = "real:2.5"
max-lines = 3
port-file = p.json
log-level = "debug"
token-file = "t"
private = true
insecure = false
allow-host = ["a.lab", "b"]  # two
allow-origin = "https://page.lab")");
  EXPECT_EQ(options.robot, "adept-one");
  EXPECT_EQ(options.workcell, "my cell.json");
  EXPECT_EQ(options.listen, "::1");
  EXPECT_EQ(options.robot_port, 0);
  EXPECT_EQ(options.monitor_port, 7);
  EXPECT_EQ(options.profile, Profile::kMark3);
  EXPECT_EQ(options.clock.rate.millionths, 2'500'000);
  EXPECT_EQ(options.max_lines, 3U);
  EXPECT_EQ(options.port_file, "p.json");
  EXPECT_EQ(options.log_level, "debug");
  EXPECT_EQ(std::get<TokenFile>(options.token).path, "t");
  EXPECT_TRUE(options.is_private);
  EXPECT_FALSE(options.is_insecure);
  EXPECT_EQ(options.allow_hosts, (std::vector<std::string>{"a.lab", "b"}));
  EXPECT_EQ(options.allow_origins, (std::vector<std::string>{"https://page.lab"}));
  EXPECT_EQ(source_of(options.option_sources, "--robot"), path_ + ":2: robot");
}

TEST_F(OptionsConfig, IgnoresAByteOrderMark) {
  EXPECT_EQ(serve("\xEF\xBB\xBFrobot = \"adept-one\"\n").robot, "adept-one");
}

TEST_F(OptionsConfig, ArgumentsAndEnvironmentOverrideIt) {
  write(
      "robot = \"r2d2\"\nclock = \"manual\"\nmax-lines = 5\nallow-host = \"c\"\ninsecure = true\n");
  const Environment environment(
      {{"XR3_CLOCK", "real"}, {"XR3_ALLOW_HOST", "a,b"}, {"XR3_INSECURE", "0"}});
  const auto options =
      std::get<ServeOptions>(parse({"serve", "--config", path_.c_str(), "--robot", "adept-one"}));
  EXPECT_EQ(options.robot, "adept-one");
  EXPECT_EQ(options.clock.mode, ClockMode::kReal);
  EXPECT_EQ(options.max_lines, 5U);
  EXPECT_EQ(options.allow_hosts, (std::vector<std::string>{"a", "b"}));
  EXPECT_FALSE(options.is_insecure);
}

TEST_F(OptionsConfig, ATokenOfTheEnvironmentOverridesItsTokenFile) {
  write("token-file = t");
  const auto token = [&](std::initializer_list<const char*> words) {
    return std::get<ServeOptions>(parse(words)).token;
  };
  const char* path = path_.c_str();
  EXPECT_EQ(std::get<TokenFile>(token({"serve", "--config", path})).path, "t");
  EXPECT_TRUE(
      std::holds_alternative<FreshToken>(token({"serve", "--config", path, "--token", "auto"})));
  EXPECT_EQ(std::get<TokenFile>(token({"serve", "--config", path, "--token-file", "u"})).path, "u");
  const Environment environment({{"XR3_TOKEN", "sixteen letters!"}});
  EXPECT_TRUE(std::holds_alternative<TokenInEnvironment>(token({"serve", "--config", path})));
}

TEST_F(OptionsConfig, CanBeNamedByTheEnvironment) {
  write("robot = \"adept-one\"\nrobot-port = x\n");
  const Environment environment({{"XR3_CONFIG", path_}});
  EXPECT_THAT(refused({"serve"}).to_stderr,
              StartsWith("xr3: " + path_ + ":2: robot-port: x: a port"));
  EXPECT_EQ(std::get<ServeOptions>(parse({"serve", "--robot-port", "0"})).robot, "adept-one");
}

TEST_F(OptionsConfig, ReportsErrorsWithTheirLines) {
  for (const auto& [text, says] : std::initializer_list<std::pair<const char*, const char*>>{
           {"\n\nrobt = 1", ":3: robt: unknown key; use one of: robot, workcell, "},
           {"monitor_port = 1", ":1: monitor_port: unknown key"},
           {"serve.robot = 1", ":1: serve.robot: unknown key"},
           {"help = true", ":1: help: unknown key"},
           {"config = \"a\"", ":1: config: unknown key"},
           {"# x\nrobot-port = 65536", ":2: robot-port: 65536: a port is"},
           {"robot-port = -1", ":1: robot-port: -1: a port is"},
           {"compat = mark4", ":1: compat: mark4: a controller is paper or mark3"},
           {"max-lines = 0", ":1: max-lines: 0: a whole number from 1 to 20000"},
           {"private = maybe", ":1: private: maybe: a flag is true or false"},
           {"allow-host = [\"a\", \"b:1\"]", ":1: allow-host: b:1: a host is"},
           {"robot = a b", ":1: robot: takes one value"},
           {"compat = [\"paper\", \"mark3\"]", ":1: compat: takes one value"},
           {"robot = \"a\"\n\nrobot = \"b\"", ":3: robot is already set on line 1"},
           {"allow-host = a\nallow-host = b", ":2: allow-host is already set on line 1"},
           {"robot =", ":1: there is no value"},
           {"robot = # none", ":1: there is no value"},
           {"robot = \"\"", ":1: robot: the value is empty"},
           {"private = ''", ":1: private: the value is empty"},
           {"insecure", ":1: not KEY = VALUE"},
           {"x", ":1: not KEY = VALUE"},
           {"= 3", ":1: not KEY = VALUE"},
           {"[serve]\nrobot = \"a\"", ":1: sections are not supported"},
           {"robot = \"my arm#2.json\"", ":1: a quote is not closed"},
           {"robot = 'my arm#2.json'", ":1: a quote is not closed"},
           {"allow-host = [\n\"a\"]", ":1: a list must be on one line"},
           {"listen = 0.0.0.0", ":1: listen 0.0.0.0 accepts other machines"},
           {"private = yes", ":1: private needs a token"}}) {
    EXPECT_THAT(trouble(text), StartsWith(says)) << text;
  }
}

TEST_F(OptionsConfig, RejectsATokenWithoutShowingIt) {
  const std::string words = trouble("token = \"correct horse battery\"");
  EXPECT_THAT(words, StartsWith(":1: token: the token must not be"));
  EXPECT_THAT(words, Not(HasSubstr("horse")));
  EXPECT_THAT(trouble("token = auto"), HasSubstr("token-file"));
}

TEST_F(OptionsConfig, RejectsAMissingFile) {
  EXPECT_THAT(refused({"serve", "--config", "absent"}).to_stderr,
              StartsWith("xr3: --config: absent: "));
  EXPECT_THAT(refused({"healthcheck", "--config", "absent"}).to_stderr, HasSubstr("absent"));
  const Environment environment({{"XR3_CONFIG", "absent"}});
  EXPECT_THAT(refused({"serve"}).to_stderr, StartsWith("xr3: XR3_CONFIG: absent: "));
  EXPECT_EQ(refused({"serve", "--help"}).code, ExitCode::kGood);
}

TEST_F(OptionsConfig, AHealthcheckReadsItsOwnOptions) {
  write("robot = 'x'\nunknown = 1\nlisten = '::'\nmonitor-port = 7\nport-file = 'p'\nwait = 3\n");
  const auto options = std::get<HealthOptions>(parse({"healthcheck", "--config", path_.c_str()}));
  EXPECT_EQ(options.listen, "::");
  EXPECT_EQ(options.monitor_port, 7);
  EXPECT_EQ(options.port_file, "p");
  EXPECT_EQ(options.wait_s, 0);
  write("monitor-port = x\n");
  EXPECT_THAT(refused({"healthcheck", "--config", path_.c_str()}).to_stderr,
              HasSubstr(":1: monitor-port"));
}

TEST_F(OptionsConfig, AnEmptyFileChangesNothing) {
  EXPECT_EQ(serve("").robot, "rhino-xr3");
  EXPECT_EQ(serve("\r\n# only\r\n\r\nrobot = \"adept-one\"\r\n").robot, "adept-one");
}

}  // namespace
}  // namespace xr3
