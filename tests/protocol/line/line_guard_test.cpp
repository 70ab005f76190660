#include "protocol/line/line_guard.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/explain/diagnostic.hpp"

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

// Chromium sends any token as a method. All of these are commands, too.
const std::string kRequests[] = {
    "E+50 / HTTP/1.1\r\nHost: evil.test:9600\r\n\r\n",
    "I / HTTP/1.1\r\n\r\n",
    "L /a/very/long/path/whose/end/has/not/arrived",
    "P1R2E+50C+33 http://evil.test/",
    "E+50 wss://evil.test/",
    "QUERY / HTTP/1.1\r\n",
    "E+50 nonsense HTTP/1.1\r\n",
    "E+50\r\nF+20 / HTTP/1.1\r\n",
    std::string(kMaxMethod + 1, 'L'),
};

constexpr std::string_view kBinary[] = {
    "\x01\x02\x03\x04\x00\x01\x00\x5c\x21\x12\xa4\x42////E+50/"sv,
    "\x80\x16\x03\x01\x02\x00"sv,
    "\x01\x16\xfe\xfd"sv,
};

// Bytes with which robot programs begin. Some are on 8-bit lines, which any noise may precede.
const std::string kPrograms[] = {
    "E+50\r",
    "E+50 \r",
    "E+50 F-20/C+3\r",
    "I",
    "E?",
    "A**",
    "\r",
    " \r\nE?",
    "\bE?",
    "GET E?",
    "E+50 * /",
    "\x7f",
    std::string("\0E?", 3),
    std::string("\0\0\0\0I", 5),
    "\x80\x81\xfe",
    "\xff\xfb\x01"
    "E?",
    std::string("\xff\xfa\x18\0XTERM\xff\xf0", 11),
    std::string(kMaxMethod, 'I'),
    std::string(3000, 'I').insert(900, "\r"),
};

TEST(LineGuard, RefusesRequestsWithAnyMethod) {
  for (const std::string& request : kRequests) {
    EXPECT_TRUE(is_refused(request, Guard::kNormal)) << request;
    EXPECT_TRUE(is_refused(request, Guard::kStrict)) << request;
    EXPECT_FALSE(is_refused(request, Guard::kOff)) << request;
  }
}

TEST(LineGuard, RefusesSignaturesAfterAnyBinaryBytes) {
  for (const std::string_view bytes : kBinary) {
    EXPECT_TRUE(is_refused(bytes, Guard::kNormal)) << readable(bytes);
    EXPECT_FALSE(is_refused(bytes, Guard::kOff)) << readable(bytes);
  }
}

TEST(LineGuard, AcceptsRobotPrograms) {
  for (const std::string& program : kPrograms)
    EXPECT_FALSE(is_refused(program, Guard::kNormal)) << readable(program);
}

TEST(LineGuard, StrictAcceptsTextAndTelnetOnly) {
  for (const char* text : {"E+50\r", "\r\n\t \bE?",
                           "\xff\xfd\x06"
                           "E?"})
    EXPECT_FALSE(is_refused(text, Guard::kStrict)) << text;
  for (const std::string_view binary : {"\0E?"sv, "E?\x80"sv, "\x7f"sv, "\x01"sv})
    EXPECT_TRUE(is_refused(binary, Guard::kStrict)) << readable(binary);
}

}  // namespace
}  // namespace xr3
