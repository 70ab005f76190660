#include "protocol/monitor/health_probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace xr3 {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Health = HealthProbe::Health;

constexpr const char* kHello = "{\"op\":\"hello\",\"proto\":1,\"server\":\"xr3 0.1.0\"}\n";
constexpr const char* kPong = "{\"op\":\"pong\",\"id\":\"health\"}\n";

HealthProbe after(std::string_view bytes) {
  HealthProbe probe;
  probe.feed(bytes);
  return probe;
}

TEST(HealthProbe, IsHealthyWhenItsPingIsAnswered) {
  HealthProbe probe;
  EXPECT_EQ(probe.opening() + probe.feed(kHello), "{\"op\":\"ping\",\"id\":\"health\"}\n");
  EXPECT_EQ(probe.health(), Health::kUnknown);
  EXPECT_EQ(probe.feed(kPong), "");
  EXPECT_EQ(probe.health(), Health::kHealthy);
}

TEST(HealthProbe, AcceptsBytesInPieces) {
  HealthProbe probe;
  std::string sent;
  for (const char byte : std::string(kHello) + kPong) sent += probe.feed({&byte, 1});
  EXPECT_EQ(sent, after("").feed(kHello)) << "one ping";
  EXPECT_EQ(probe.health(), Health::kHealthy);
  EXPECT_EQ(after(std::string(kHello) + kPong).health(), Health::kHealthy);
}

TEST(HealthProbe, NamesTheStepThatFailed) {
  EXPECT_THAT(after("").trouble(), HasSubstr("sends nothing"));
  EXPECT_THAT(after(kHello).trouble(), HasSubstr("does not answer"));
  EXPECT_THAT(after("login: ").trouble(), HasSubstr("is not xr3: it sends \"login: \""));
}

TEST(HealthProbe, AFullPortIsNoFailure) {
  EXPECT_EQ(after("{\"op\":\"bye\",\"why\":\"full\",\"message\":\"\"}\n").health(), Health::kFull);
  EXPECT_EQ(after("{\"op\":\"bye\",\"why\":\"shutdown\",\"message\":\"\"}\n").health(),
            Health::kUnhealthy);
}

TEST(HealthProbe, RecognisesOtherServers) {
  for (const char* line :
       {"HTTP/1.1 400 Bad Request\r\n", "{\"op\":\"hello\",\"server\":\"other\"}\n", "{}\n", "\n",
        "[1]\n", "{\"op\":7}\n", "\xff\xfe\n", "{\"op\":\"pong\",\"id\":\"health\"}\n"}) {
    const HealthProbe probe = after(line);
    EXPECT_EQ(probe.health(), Health::kUnhealthy) << line;
    EXPECT_THAT(probe.trouble(), StartsWith("is not xr3")) << line;
  }
  EXPECT_THAT(after("HTTP/1.1 400 Bad Request\r\n").trouble(),
              HasSubstr("\"HTTP/1.1 400 Bad Request\""));
}

TEST(HealthProbe, QuotesBytesShortenedAndWithoutControlCharacters) {
  const std::string words = after("\x1B[2Jhi\a" + std::string(1000, 'x') + "\n").trouble();
  EXPECT_THAT(words, HasSubstr("\"?[2Jhi?xx"));
  EXPECT_LT(words.size(), 100U);
}

TEST(HealthProbe, AnEndlessLineIsNotXr3) {
  HealthProbe probe;
  const std::string part(1024, 'x');
  for (std::size_t sent = 0; sent <= HealthProbe::kMaxLineBytes; sent += part.size())
    probe.feed(part);
  EXPECT_EQ(probe.health(), Health::kUnhealthy);
}

TEST(HealthProbe, AByeIsUnhealthy) {
  const std::string bye = "{\"op\":\"bye\",\"why\":\"shutdown\",\"message\":\"too many\"}\n";
  for (const std::string& bytes : {bye, kHello + bye}) {
    EXPECT_EQ(after(bytes).health(), Health::kUnhealthy);
    EXPECT_THAT(after(bytes).trouble(), HasSubstr("too many"));
  }
}

TEST(HealthProbe, IgnoresOtherMessagesAfterHello) {
  HealthProbe probe = after(kHello);
  probe.feed("{\"op\":\"new\"}\n{\"op\":\"pong\",\"id\":1}\n");
  EXPECT_EQ(probe.health(), Health::kUnknown);
  probe.feed(kPong);
  EXPECT_EQ(probe.health(), Health::kHealthy);
}

TEST(HealthProbe, ReadsReadinessOverHttp) {
  EXPECT_EQ(ready_request("[::1]:9601"),
            "GET /readyz HTTP/1.1\r\nHost: [::1]:9601\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(trouble_with_readiness("HTTP/1.1 200 OK\r\n\r\nok\n"), "");
}

TEST(HealthProbe, ReportsWhyTheServerIsNotReady) {
  const std::string body =
      R"({"error":{"code":"not_ready","message":"every line is in use","hint":"wait"}})";
  EXPECT_EQ(trouble_with_readiness("HTTP/1.1 503 Service Unavailable\r\n\r\n" + body),
            "is not ready: every line is in use");
}

TEST(HealthProbe, AnInvalidResponseIsNotReady) {
  EXPECT_EQ(trouble_with_readiness(""), "does not say whether it is ready");
  for (const char* answer : {"HTTP/1.1 503 No\r\n\r\n{}", "HTTP/1.1 503 No\r\n\r\n[1",
                             "HTTP/1.1 20", "HTTP/1.1 404 Not Found", "200 ", "\x1b[2J"}) {
    EXPECT_THAT(trouble_with_readiness(answer), HasSubstr("is not xr3: it sends \"")) << answer;
  }
}

}  // namespace
}  // namespace xr3
