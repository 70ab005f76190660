// The plain HTTP answers: who is answered, who is refused, and that a head may come in any pieces.
#include "protocol/http_probe.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace xr3::http {
namespace {

const std::string kHost = "Host: localhost:9601\r\n";

std::string get(const std::string& target, const std::string& fields = kHost) {
  return "GET " + target + " HTTP/1.1\r\n" + fields + "\r\n";
}

std::string status_of(const std::string& request, Readiness readiness = Readiness::kReady) {
  return answer(request, readiness).substr(9, 3);
}

std::string body_of(const std::string& text) { return text.substr(text.find("\r\n\r\n") + 4); }

TEST(HttpProbe, AliveAndReady) {
  EXPECT_EQ(
      answer(get("/healthz"), Readiness::kNotReady),
      "HTTP/1.1 200 OK\r\n"
      "Content-Type: text/plain; charset=utf-8\r\n"
      "Content-Length: 3\r\n"
      "Cache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\n"
      "Content-Security-Policy: default-src 'self'; frame-ancestors 'none'; base-uri 'none'\r\n"
      "Connection: close\r\n"
      "\r\n"
      "ok\n");
  EXPECT_EQ(status_of(get("/readyz")), "200");
  EXPECT_EQ(status_of(get("/readyz"), Readiness::kNotReady), "503");
  EXPECT_EQ(status_of(get("/healthz?verbose=1")), "200");
}

TEST(HttpProbe, HeadHasNoBody) {
  const std::string head = answer("HEAD /healthz HTTP/1.1\r\n" + kHost + "\r\n", Readiness::kReady);
  EXPECT_EQ(head + "ok\n", answer(get("/healthz"), Readiness::kReady));
  const std::string missing = answer("HEAD /x HTTP/1.1\r\n" + kHost + "\r\n", Readiness::kReady);
  EXPECT_EQ(missing.substr(9, 3), "404");
  EXPECT_EQ(body_of(missing), "");
}

TEST(HttpProbe, EveryAnswerIsGuarded) {
  const std::vector<std::string> requests = {get("/healthz"),
                                             get("/x"),
                                             "POST / HTTP/1.1\r\n" + kHost + "\r\n",
                                             get("/healthz", "Host: evil.example\r\n"),
                                             "HELP\r\n",
                                             std::string(kMostHeadBytes, 'A'),
                                             "PRI * HTTP/2.0\r\n"};
  for (const std::string& request : requests) {
    const std::string text = answer(request, Readiness::kReady);
    const std::string body = body_of(text);
    EXPECT_NE(text.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos) << request;
    EXPECT_NE(text.find("Cross-Origin-Resource-Policy: same-origin\r\n"), std::string::npos);
    EXPECT_NE(text.find("Content-Security-Policy: default-src 'self';"), std::string::npos);
    EXPECT_NE(text.find("Connection: close\r\n"), std::string::npos);
    EXPECT_NE(text.find("Content-Length: " + std::to_string(body.size()) + "\r\n"),
              std::string::npos);
    EXPECT_EQ(text.find("Access-Control"), std::string::npos);
    if (body == "ok\n") continue;
    const auto error = nlohmann::json::parse(body).at("error");
    for (const char* member : {"code", "message", "hint"})
      EXPECT_TRUE(error.at(member).is_string());
  }
}

TEST(HttpProbe, OtherMethodsAreNotAllowed) {
  for (const std::string method :
       {"POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT", "GETX", "Get"}) {
    const std::string text =
        answer(method + " /healthz HTTP/1.1\r\n" + kHost + "\r\n", Readiness::kReady);
    EXPECT_EQ(text.substr(9, 3), "405") << method;
    EXPECT_NE(text.find("\r\nAllow: GET, HEAD\r\n"), std::string::npos);
  }
  EXPECT_EQ(status_of("OPTIONS * HTTP/1.1\r\n" + kHost + "\r\n"), "405");
  EXPECT_EQ(status_of("CONNECT localhost:80 HTTP/1.1\r\n" + kHost + "\r\n"), "405");
}

TEST(HttpProbe, WhatIsNoRequest) {
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"HELP\r\n", "400"},
      {"GET\r\n", "400"},
      {"GET /\r\n", "400"},
      {"GET  HTTP/1.1\r\n", "400"},
      {"GET / / HTTP/1.1\r\n", "400"},
      {"G@T / HTTP/1.1\r\n", "400"},
      {"GET / XTTP/1.1\r\n", "400"},
      {"GET / HTTP/1.1x\r\n", "400"},
      {"GET / HTTP/1.1\n", "400"},
      {"GET /\x01 HTTP/1.1\r\n", "400"},
      {"PRI * HTTP/2.0\r\n", "505"},
      {"GET / HTTP/0.9\r\n", "505"},
      {"GET / HTTP/1.1\r\nno colon\r\n", "400"},
      {"GET / HTTP/1.1\r\nHost : x\r\n", "400"},
      {"GET / HTTP/1.1\r\n: x\r\n", "400"},
      {"GET / HTTP/1.1\r\nA: b\r\n folded: x\r\n", "400"},
      {"GET / HTTP/1.1\r\nA: b\x01\r\n", "400"},
      {"GET / HTTP/1.1\r\nA: b\n", "400"},
      {"GET http://localhost/healthz HTTP/1.1\r\n" + kHost + "\r\n", "400"},
      {get("/healthz", ""), "400"},
      {get("/healthz", kHost + kHost), "400"},
      {get("/healthz", kHost + "Origin: a\r\nOrigin: a\r\n"), "400"},
      {"GET /healthz HTTP/1.1\r\n" + kHost, "400"},  // cut off
      {"GET", "400"},
  };
  for (const auto& [request, status] : rows) EXPECT_EQ(status_of(request), status) << request;
  EXPECT_EQ(status_of("GET /healthz HTTP/1.0\r\n" + kHost + "\r\n"), "200");
}

TEST(HttpProbe, TooMuch) {
  std::string fields = kHost;
  for (std::size_t i = 1; i < kMostFields; ++i) fields += "X: y\r\n";
  EXPECT_EQ(status_of(get("/healthz", fields)), "200");
  EXPECT_EQ(status_of(get("/healthz", fields + "X: y\r\n")), "431");
  EXPECT_EQ(status_of(get("/healthz", kHost + "X: " + std::string(kMostHeadBytes, 'y') + "\r\n")),
            "431");
  const std::string longest = "/healthz?" + std::string(kMostTargetBytes - 9, 'x');
  EXPECT_EQ(status_of(get(longest)), "200");
  EXPECT_EQ(status_of(get(longest + "x")), "414");
  EXPECT_EQ(status_of("GET /" + std::string(kMostHeadBytes, 'x')), "414");
  EXPECT_EQ(status_of(std::string(kMostHeadBytes, 'X')), "431");
}

TEST(HttpProbe, HeadsToTheByte) {
  const std::string start = "GET /healthz HTTP/1.1\r\n" + kHost + "X: ";
  const std::string fits = start + std::string(kMostHeadBytes - start.size() - 4, 'y') + "\r\n\r\n";
  ASSERT_EQ(fits.size(), kMostHeadBytes);
  EXPECT_EQ(status_of(fits), "200");
  EXPECT_EQ(status_of(fits + "a body that nobody reads"), "200");
  const std::string over = start + std::string(kMostHeadBytes - start.size() - 3, 'y') + "\r\n\r\n";
  EXPECT_EQ(status_of(over), "431");
}

TEST(HttpProbe, DecidedAtTheLastByteAndNotBefore) {
  const std::string request = get("/readyz");
  for (std::size_t size = 0; size < request.size(); ++size) {
    EXPECT_FALSE(is_head_decided(request.substr(0, size))) << size;
  }
  EXPECT_TRUE(is_head_decided(request));
  EXPECT_TRUE(is_head_decided("HELP\r\n"));
  EXPECT_TRUE(is_head_decided("HELP\n"));
  EXPECT_FALSE(is_head_decided(std::string(kMostHeadBytes - 1, 'X')));
  EXPECT_TRUE(is_head_decided(std::string(kMostHeadBytes, 'X')));
}

TEST(HttpProbe, HostsThatNoNameServerCanForge) {
  for (const char* host : {"localhost", "LOCALHOST:9601", "localhost:", "127.0.0.1", "127.0.0.1:80",
                           "10.1.2.3:65535", "255.255.255.255", "[::1]", "[::1]:9601", "[fe80::1]",
                           "[::ffff:127.0.0.1]:1", "robot.localhost", "a.b-1.localhost:9601"}) {
    EXPECT_TRUE(is_local_host(host)) << host;
  }
  for (const char* host : {"",
                           ":9601",
                           "evil.example",
                           "evil.example:9601",
                           "localhost.evil.example",
                           "evillocalhost",
                           ".localhost",
                           "a..localhost",
                           "localhost.",
                           "localhost:x",
                           "localhost:1234567",
                           "127.0.0",
                           "127.0.0.256",
                           "127.0.0.1.",
                           "127.0.0.1.evil.example",
                           "1.2.3.4.5",
                           "0x7f.1",
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
    EXPECT_NE(status_of(get("/healthz", std::string("Host: ") + host + "\r\n")), "200") << host;
  }
  EXPECT_EQ(status_of(get("/healthz", "Host: evil.example\r\n")), "403");
}

TEST(HttpProbe, PagesOfOtherOriginsAreRefused) {
  const auto with = [](const std::string& origin) {
    return status_of(get("/healthz", kHost + "Origin: " + origin + "\r\n"));
  };
  EXPECT_EQ(with("http://localhost:9601"), "200");
  for (const char* origin :
       {"null", "", "http://localhost", "http://localhost:9600", "https://localhost:9601",
        "http://evil.example", "http://localhost:9601/", "localhost:9601"}) {
    EXPECT_EQ(with(origin), "403") << origin;
  }
}

TEST(HttpProbe, NamesOfFieldsInAnyCase) {
  EXPECT_EQ(status_of(get("/healthz", "hOST:localhost\r\nORIGIN: \thttp://localhost \r\n")), "200");
}

}  // namespace
}  // namespace xr3::http
