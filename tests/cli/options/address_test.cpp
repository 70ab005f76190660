#include "cli/options/address.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "cli/options/term.hpp"
#include "cli/options/watch.hpp"
#include "tests/support/command_line.hpp"

namespace xr3 {
namespace {

using test::parse;
using test::refused;

PortAddress watched(std::initializer_list<const char*> words) {
  return std::get<WatchOptions>(parse(words)).address;
}

TEST(Address, ABareNumberIsAPortOfThisMachine) {
  const PortAddress address = watched({"watch", "9701"});
  EXPECT_EQ(address.host, "localhost");
  EXPECT_EQ(address.port, "9701");
  EXPECT_EQ(address.text, "localhost:9701");
  EXPECT_EQ(std::get<TermOptions>(parse({"term", "9700"})).peer, "localhost:9700");
}

TEST(Address, TheAddressOfThePageIsUnderstood) {
  for (const char* text : {"http://localhost:9701/", "http://localhost:9701", "localhost:9701",
                           "http://localhost:9701/#token=sixteen-letters!"}) {
    const PortAddress address = watched({"watch", text});
    EXPECT_EQ(address.text, "localhost:9701") << text;
    EXPECT_EQ(address.host, "localhost") << text;
    EXPECT_EQ(address.port, "9701") << text;
  }
  EXPECT_EQ(watched({"watch", "http://[::1]:9701/"}).host, "::1");
  EXPECT_EQ(watched({"watch", "http://lab-pc/"}).port, "9601");
}

TEST(Address, ThePortMayBeAWordOfItsOwn) {
  EXPECT_EQ(watched({"watch", "lab-pc", "9701"}).text, "lab-pc:9701");
  EXPECT_EQ(watched({"watch", "::1", "9701"}).text, "[::1]:9701");
  const auto term = std::get<TermOptions>(parse({"term", "localhost", "9700"}));
  EXPECT_EQ(term.peer, "localhost:9700");
  EXPECT_EQ(term.address.host, "localhost");
  EXPECT_EQ(term.address.port, "9700");
}

TEST(Address, OthersAreRefusedWithTheAllowedForm) {
  for (const char* text : {"70000", "0", "9701:9601", "https://localhost:9601", "",
                           "http://localhost:9601/cell/2", "http://", "a:b"}) {
    const Leave leave = refused({"watch", text});
    EXPECT_EQ(leave.code, ExitCode::kBadInput) << text;
    EXPECT_NE(leave.to_stderr.find("an address is HOST:PORT, as in localhost:9601, or the PORT"),
              std::string::npos)
        << text << ": " << leave.to_stderr;
  }
  EXPECT_NE(refused({"watch", "localhost:1", "2"}).to_stderr.find("has a port already"),
            std::string::npos);
  EXPECT_NE(refused({"term", "localhost", "x"}).to_stderr.find("a port is a number"),
            std::string::npos);
  EXPECT_NE(refused({"term", "/dev/x", "9600"}).to_stderr.find("a path has no port"),
            std::string::npos);
}

}  // namespace
}  // namespace xr3
