#include "cli/options/environment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::Environment;
using test::parse;
using test::refused;
using ::testing::HasSubstr;
using ::testing::StartsWith;

ServeOptions serve(std::initializer_list<const char*> words = {"serve"}) {
  return std::get<ServeOptions>(parse(words));
}

TEST(OptionsEnvironment, SetsEveryOptionOfServe) {
  const Environment environment({{"XR3_ROBOT", "adept-one"},
                                 {"XR3_WORKCELL", "w.json"},
                                 {"XR3_LISTEN", "0.0.0.0"},
                                 {"XR3_ROBOT_PORT", "0"},
                                 {"XR3_MONITOR_PORT", "7"},
                                 {"XR3_COMPAT", "mark3"},
                                 {"XR3_CLOCK", "real:2.5"},
                                 {"XR3_MAX_LINES", "3"},
                                 {"XR3_PORT_FILE", "p.json"},
                                 {"XR3_LOG_LEVEL", "debug"},
                                 {"XR3_TOKEN_FILE", "t"},
                                 {"XR3_PRIVATE", "1"},
                                 {"XR3_ALLOW_HOST", "a.lab,b"},
                                 {"XR3_ALLOW_ORIGIN", "https://page.lab"},
                                 {"XR3_INSECURE", "true"}});
  const ServeOptions options = serve();
  EXPECT_EQ(options.robot, "adept-one");
  EXPECT_EQ(options.workcell, "w.json");
  EXPECT_EQ(options.listen, "0.0.0.0");
  EXPECT_EQ(options.robot_port, 0);
  EXPECT_EQ(options.monitor_port, 7);
  EXPECT_EQ(options.profile, Profile::kMark3);
  EXPECT_EQ(options.clock.rate.millionths, 2'500'000);
  EXPECT_EQ(options.max_lines, 3U);
  EXPECT_EQ(options.port_file, "p.json");
  EXPECT_EQ(options.log_level, "debug");
  EXPECT_EQ(std::get<TokenFile>(options.token).path, "t");
  EXPECT_TRUE(options.is_private);
  EXPECT_EQ(options.allow_hosts, (std::vector<std::string>{"a.lab", "b"}));
  EXPECT_EQ(options.allow_origins, (std::vector<std::string>{"https://page.lab"}));
  EXPECT_TRUE(options.is_insecure);
  EXPECT_EQ(options.option_sources.size(), 15U);
  EXPECT_EQ(source_of(options.option_sources, "--max-lines"), "XR3_MAX_LINES");
}

TEST(OptionsEnvironment, ArgumentsOverrideIt) {
  const Environment environment({{"XR3_ROBOT", "adept-one"},
                                 {"XR3_CLOCK", "nonsense"},
                                 {"XR3_ALLOW_HOST", "a"},
                                 {"XR3_INSECURE", "1"}});
  const ServeOptions options = serve({"serve", "--robot", "rhino-xr3", "--clock", "manual",
                                      "--allow-host", "b", "--insecure=false"});
  EXPECT_EQ(options.robot, "rhino-xr3");
  EXPECT_EQ(options.clock.mode, ClockMode::kManual);
  EXPECT_EQ(options.allow_hosts, std::vector<std::string>{"b"});
  EXPECT_FALSE(options.is_insecure);
  EXPECT_TRUE(options.option_sources.empty());
}

TEST(OptionsEnvironment, AnEmptyVariableIsNotSet) {
  const Environment environment({{"XR3_ROBOT", ""},
                                 {"XR3_MONITOR_PORT", ""},
                                 {"XR3_INSECURE", ""},
                                 {"XR3_ALLOW_HOST", ""},
                                 {"XR3_TOKEN_FILE", ""},
                                 {"XR3_TOKEN", ""}});
  const ServeOptions options = serve();
  EXPECT_EQ(options.robot, "rhino-xr3");
  EXPECT_EQ(options.monitor_port, 9601);
  EXPECT_FALSE(options.is_insecure);
  EXPECT_TRUE(options.allow_hosts.empty());
  EXPECT_TRUE(std::holds_alternative<NoToken>(options.token));
  EXPECT_THAT(refused({"serve", "--listen", "::"}).to_stderr, HasSubstr("--token-file"))
      << "an empty token is not a token";
  EXPECT_THAT(refused({"serve", "--private"}).to_stderr, HasSubstr("needs a token"));
}

TEST(OptionsEnvironment, FlagsAcceptYesAndNo) {
  for (const char* yes : {"1", "true", "TRUE", "yes", "on"}) {
    const Environment environment({{"XR3_INSECURE", yes}});
    EXPECT_TRUE(serve().is_insecure) << yes;
  }
  for (const char* no : {"0", "false", "False", "no", "off"}) {
    const Environment environment({{"XR3_INSECURE", no}});
    EXPECT_FALSE(serve().is_insecure) << no;
    EXPECT_TRUE(serve({"serve", "--insecure"}).is_insecure) << no;
  }
}

TEST(OptionsEnvironment, AnInvalidValueIsReportedWithItsVariable) {
  for (const auto& [name, value, allowed] :
       std::initializer_list<std::tuple<const char*, const char*, const char*>>{
           {"XR3_ROBOT_PORT", "x", "0 to 65535"},
           {"XR3_MONITOR_PORT", "65536", "0 to 65535"},
           {"XR3_LISTEN", "nowhere", "127.0.0.1"},
           {"XR3_COMPAT", "mark4", "paper or mark3"},
           {"XR3_CLOCK", "fast", "manual"},
           {"XR3_MAX_LINES", "0", "20000"},
           {"XR3_MAX_LINES", "many", "many"},
           {"XR3_LOG_LEVEL", "loud", "debug"},
           {"XR3_PRIVATE", "maybe", "yes or no"},
           {"XR3_INSECURE", "2", "1 or 0"},
           {"XR3_ALLOW_HOST", "good,a:80", "a:80"},
           {"XR3_ALLOW_ORIGIN", "page.lab", "https://"},
           {"XR3_ALLOW_FRAME", "page.lab", "https://"},
           {"XR3_LISTEN", "0.0.0.0", "--insecure"},
           {"XR3_PRIVATE", "1", "needs a token"}}) {
    const Environment environment({{name, value}});
    const Leave leave = refused({"serve"});
    EXPECT_EQ(leave.code, ExitCode::kBadInput);
    EXPECT_THAT(leave.to_stderr, StartsWith(std::string("xr3: ") + name));
    EXPECT_THAT(leave.to_stderr, HasSubstr(allowed)) << name;
  }
}

TEST(OptionsEnvironment, AnInvalidArgumentIsNotReportedAsAVariable) {
  const Environment environment({{"XR3_ROBOT", "adept-one"}});
  EXPECT_THAT(refused({"serve", "--clock", "fast"}).to_stderr, StartsWith("xr3: --clock"));
  EXPECT_THAT(refused({"serve", "--dance"}).to_stderr, HasSubstr("--dance"));
}

TEST(OptionsEnvironment, AppliesOnlyToTheGivenCommand) {
  const Environment environment({{"XR3_CLOCK", "nonsense"}, {"XR3_PORT_FILE", "p"}});
  EXPECT_TRUE(std::holds_alternative<CheckOptions>(parse({"check", "x.json"})));
  EXPECT_TRUE(std::holds_alternative<WatchOptions>(parse({"watch"})));
  EXPECT_EQ(std::get<HealthOptions>(parse({"healthcheck"})).port_file, "p");
}

TEST(OptionsEnvironment, InvalidValuesDoNotPreventHelp) {
  const Environment environment({{"XR3_CLOCK", "nonsense"}});
  const Leave leave = refused({"serve", "--help"});
  EXPECT_EQ(leave.code, ExitCode::kGood);
  for (const char* name : {"XR3_ROBOT", "XR3_LISTEN", "XR3_ALLOW_ORIGIN", "XR3_INSECURE"})
    EXPECT_THAT(leave.to_stdout, HasSubstr(name));
}

TEST(OptionsEnvironment, ATokenArgumentOverridesTheEnvironment) {
  const Environment environment({{"XR3_TOKEN_FILE", "t"}, {"XR3_TOKEN", "sixteen letters!"}});
  EXPECT_TRUE(std::holds_alternative<TokenFile>(serve().token));
  EXPECT_TRUE(std::holds_alternative<FreshToken>(serve({"serve", "--token", "auto"}).token));
  EXPECT_EQ(std::get<TokenFile>(serve({"serve", "--token-file", "u"}).token).path, "u");
}

}  // namespace
}  // namespace xr3
