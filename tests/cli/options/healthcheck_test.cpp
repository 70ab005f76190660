#include "cli/options/healthcheck.hpp"

#include <gtest/gtest.h>

#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::Environment;
using test::parse;
using test::refused;

HealthOptions health(std::initializer_list<const char*> words) {
  return std::get<HealthOptions>(parse(words));
}

TEST(HealthOptions, TheDefaultsAreThoseOfServe) {
  const HealthOptions options = health({"healthcheck"});
  EXPECT_EQ(options.listen, "localhost");
  EXPECT_EQ(options.monitor_port, 9601);
  EXPECT_EQ(options.port_file, "");
  EXPECT_EQ(options.wait_s, 0);
}

TEST(HealthOptions, AcceptEveryOption) {
  const HealthOptions options = health({"healthcheck", "--listen", "::", "--monitor-port", "7",
                                        "--port-file", "p", "--wait", "2.5"});
  EXPECT_EQ(options.listen, "::");
  EXPECT_EQ(options.monitor_port, 7);
  EXPECT_EQ(options.port_file, "p");
  EXPECT_EQ(options.wait_s, 2.5);
}

TEST(HealthOptions, AreReadFromTheEnvironmentOfServe) {
  const Environment environment(
      {{"XR3_LISTEN", "0.0.0.0"}, {"XR3_MONITOR_PORT", "7"}, {"XR3_PORT_FILE", "p"}});
  EXPECT_EQ(health({"healthcheck"}).listen, "0.0.0.0");
  EXPECT_EQ(health({"healthcheck"}).monitor_port, 7);
  EXPECT_EQ(health({"healthcheck"}).port_file, "p");
  EXPECT_EQ(health({"healthcheck", "--monitor-port", "8"}).monitor_port, 8);
}

TEST(HealthOptions, APortArgumentOverridesAFileOfTheEnvironment) {
  const Environment environment({{"XR3_PORT_FILE", "p"}, {"XR3_MONITOR_PORT", "7"}});
  EXPECT_EQ(health({"healthcheck", "--monitor-port", "8"}).port_file, "");
  EXPECT_EQ(health({"healthcheck", "--monitor-port", "8", "--port-file", "q"}).port_file, "q");
}

TEST(HealthOptions, PortZeroNeedsAPortFile) {
  const Environment environment({{"XR3_MONITOR_PORT", "0"}});
  EXPECT_NE(refused({"healthcheck"}).to_stderr.find("--port-file"), std::string::npos);
  EXPECT_EQ(health({"healthcheck", "--port-file", "p"}).port_file, "p");
}

TEST(HealthOptions, RejectInvalidArguments) {
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"--listen", "nowhere"},
                                                                  {"--monitor-port", "65536"},
                                                                  {"--monitor-port", "x"},
                                                                  {"--monitor-port", "0"},
                                                                  {"--wait", "-1"},
                                                                  {"--wait", "long"},
                                                                  {"--wait", "1e9"}}) {
    EXPECT_EQ(refused({"healthcheck", name, value}).code, ExitCode::kBadInput) << name << value;
  }
}

TEST(HealthOptions, AWildcardAddressIsProbedOnLoopback) {
  EXPECT_EQ(address_to_ask("localhost"), "127.0.0.1");
  EXPECT_EQ(address_to_ask("0.0.0.0"), "127.0.0.1");
  EXPECT_EQ(address_to_ask("::"), "::1");
  EXPECT_EQ(address_to_ask("0::0"), "::1");
  EXPECT_EQ(address_to_ask("192.168.1.7"), "192.168.1.7");
  EXPECT_EQ(address_to_ask("::1"), "::1");
}

}  // namespace
}  // namespace xr3
