// Hosts and origins: which pages may access the monitor port.
#include "protocol/monitor/http_guard.hpp"

#include <gtest/gtest.h>

namespace xr3::http {
namespace {

const GuardRules kHere;
const GuardRules kBeyond{HostReach::kBeyond, {}, {}};
const GuardRules kNamed{
    HostReach::kThisMachine, {"robot.lab.example", "Arm"}, {"https://page.example:8443"}};

TEST(HttpGuard, AcceptsHostsThatDnsCannotRebind) {
  for (const char* host : {"localhost", "LOCALHOST:9601", "localhost:", "127.0.0.1", "127.0.0.1:80",
                           "10.1.2.3:65535", "255.255.255.255", "[::1]", "[::1]:9601", "[fe80::1]",
                           "[::ffff:127.0.0.1]:1", "robot.localhost", "a.b-1.localhost:9601",
                           "localhost.", "localhost.:9601", "robot.localhost."}) {
    EXPECT_TRUE(is_local_host(host)) << host;
    EXPECT_TRUE(is_host_allowed(host, kHere)) << host;
  }
}

TEST(HttpGuard, RejectsHostsThatDnsCanRebind) {
  for (const char* host : {"",
                           ":9601",
                           "evil.example",
                           "evil.example:9601",
                           "localhost.evil.example",
                           "evillocalhost",
                           ".localhost",
                           "a..localhost",
                           "localhost..",
                           ".",
                           "localhost:x",
                           "localhost:1234567",
                           "127.0.0",
                           "127.0.0.256",
                           "127.0.0.1.",
                           "127.0.0.1.evil.example",
                           "1.2.3.4.5",
                           "0x7f.1",
                           "0x7f000001",
                           "2130706433",
                           "[evil]",
                           "[]",
                           "[::1",
                           "::1",
                           "[::1]x",
                           "[::1].evil.example",
                           "localhost, evil.example",
                           "a b.localhost",
                           "user@localhost",
                           "localhost/x"}) {
    EXPECT_FALSE(is_local_host(host)) << host;
    EXPECT_FALSE(is_host_allowed(host, kHere)) << host;
    if (std::string(host) == "evillocalhost") continue;  // a name without a dot
    EXPECT_FALSE(is_host_allowed(host, kBeyond)) << host;
  }
}

TEST(HttpGuard, AcceptsNamesWithoutADotOnlyBeyondLoopback) {
  for (const char* host : {"xr3", "XR3:9601", "lab-7", "my_service:80"}) {
    EXPECT_FALSE(is_host_allowed(host, kHere)) << host;
    EXPECT_TRUE(is_host_allowed(host, kBeyond)) << host;
  }
}

TEST(HttpGuard, AcceptsNamesOfTheRules) {
  for (const char* host :
       {"robot.lab.example", "ROBOT.lab.example:9601", "arm", "robot.lab.example.", "arm.:9601"})
    EXPECT_TRUE(is_host_allowed(host, kNamed)) << host;
  for (const char* host : {"lab.example", "x.robot.lab.example", "robot.lab.example..", "arms"})
    EXPECT_FALSE(is_host_allowed(host, kNamed)) << host;
}

TEST(HttpGuard, AcceptsOnlyTheServersOwnOrigins) {
  EXPECT_TRUE(is_origin_allowed("http://localhost:9601", "localhost:9601", kHere));
  for (const char* origin :
       {"null", "", "http://localhost", "http://localhost:9600", "https://localhost:9601",
        "http://evil.example", "http://localhost:9601/", "localhost:9601"}) {
    EXPECT_FALSE(is_origin_allowed(origin, "localhost:9601", kHere)) << origin;
    EXPECT_FALSE(is_origin_allowed(origin, "localhost:9601", kNamed)) << origin;
  }
  EXPECT_TRUE(is_origin_allowed("https://page.example:8443", "localhost", kNamed));
  EXPECT_FALSE(is_origin_allowed("https://page.example", "localhost", kNamed));
}

TEST(HttpGuard, AcceptsDesktopAppsOnlyByTheirWord) {
  GuardRules rules;
  EXPECT_FALSE(is_desktop_allowed("null", rules));
  rules.origins = {"https://page.example", "desktop"};
  for (const char* origin : {"null", "file://", "file:///index.html"}) {
    EXPECT_TRUE(is_desktop_allowed(origin, rules)) << origin;
    EXPECT_FALSE(is_origin_allowed(origin, "localhost", rules)) << origin;
  }
  for (const char* origin : {"", "nulls", "https://file://", "http://evil.example"})
    EXPECT_FALSE(is_desktop_allowed(origin, rules)) << origin;
}

TEST(HttpGuard, ValidatesRules) {
  for (const char* name : {"a", "robot.lab.example", "my_arm-2"})
    EXPECT_TRUE(is_host_name(name)) << name;
  for (const char* name : {"", "*", "*.example", "a:1", "a.", ".a", "a..b", "a/b", "http://a"})
    EXPECT_FALSE(is_host_name(name)) << name;
  for (const char* origin : {"http://a", "https://a.example:8443", "http://[::1]:80"})
    EXPECT_TRUE(is_origin(origin)) << origin;
  for (const char* origin : {"", "null", "*", "http://", "http://a/", "ftp://a",
                             "http://a:", "http://a:x", "http://*", "a.example"})
    EXPECT_FALSE(is_origin(origin)) << origin;
}

}  // namespace
}  // namespace xr3::http
