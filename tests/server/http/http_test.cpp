// HTTP requests without a connection: which are answered or refused, and the responses.
#include <gtest/gtest.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "protocol/files/workcell.hpp"
#include "protocol/json/source.hpp"
#include "server/resources/resources.hpp"
#include "tests/support/cell_host.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using http::HeadFault;
using http::kMaxFields;
using http::kMaxHeadBytes;
using http::kMaxTargetBytes;
using http::read_head;

const std::string kHost = "Host: localhost:9601\r\n";
constexpr const char* kToken = "sixteen letters!";

std::string get(const std::string& target, const std::string& fields = kHost) {
  return "GET " + target + " HTTP/1.1\r\n" + fields + "\r\n";
}

std::string body_of(const std::string& text) { return text.substr(text.find("\r\n\r\n") + 4); }

Json json_of(const std::string& text) { return Json::parse(body_of(text)); }

class HttpTest : public testing::Test {
 protected:
  HttpTest() { service_.stop(); }  // no timer keeps the loop running

  /// The complete response to a request head, which may be truncated.
  std::string answer(const std::string& received) {
    const http::HeadReading head = read_head(received);
    auto refused = http::refuse_head(head.fault);
    if (!refused) refused = resources_.refuse(head.request);
    if (refused) return http::to_bytes(*refused, head.request.method);
    std::string bytes;
    const auto show = [&]() -> asio::awaitable<void> {
      const http::Answer given = co_await resources_.answer(head.request);
      bytes = http::to_bytes(given, head.request.method);
    };
    asio::co_spawn(io_, show(), asio::detached);
    io_.restart();
    io_.run();
    return bytes;
  }
  std::string status_of(const std::string& request) { return answer(request).substr(9, 3); }

  asio::io_context io_{1};
  test::CellHost host_{io_};
  HostedCell& hosted_ = host_.add(test::rhino());
  Cell& cell_ = hosted_.cell();
  AccessPolicy policy_;
  std::string trouble_;
  MonitorService service_{io_, host_.cells, host_.worker, policy_};
  HttpResources resources_{service_, policy_, [this] { return trouble_; },
                           [this] { return service_.counters(); }};
};

// --- Heads.

TEST_F(HttpTest, HealthzAndReadyz) {
  EXPECT_EQ(
      answer(get("/healthz")),
      "HTTP/1.1 200 OK\r\n"
      "Content-Type: text/plain; charset=utf-8\r\n"
      "Content-Length: 3\r\n"
      "Cache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\n"
      "Content-Security-Policy: default-src 'self'; frame-ancestors 'none'; base-uri 'none'\r\n"
      "Connection: keep-alive\r\n"
      "\r\n"
      "ok\n");
  EXPECT_EQ(status_of(get("/readyz")), "200");
  trouble_ = "every line is in use";
  EXPECT_EQ(status_of(get("/readyz")), "503");
  EXPECT_EQ(json_of(answer(get("/readyz")))["error"]["message"], trouble_);
  EXPECT_EQ(status_of(get("/healthz?verbose=1")), "200");
}

TEST_F(HttpTest, HeadHasNoBody) {
  const std::string head = answer("HEAD /healthz HTTP/1.1\r\n" + kHost + "\r\n");
  EXPECT_EQ(head + "ok\n", answer(get("/healthz")));
  const std::string missing = answer("HEAD /x HTTP/1.1\r\n" + kHost + "\r\n");
  EXPECT_EQ(missing.substr(9, 3), "404");
  EXPECT_EQ(body_of(missing), "");
}

TEST_F(HttpTest, EveryResponseHasSecurityHeaders) {
  const std::vector<std::string> requests = {get("/healthz"),
                                             get("/x"),
                                             "POST / HTTP/1.1\r\n" + kHost + "\r\n",
                                             get("/healthz", "Host: evil.example\r\n"),
                                             "HELP\r\n",
                                             std::string(kMaxHeadBytes, 'A'),
                                             "PRI * HTTP/2.0\r\n"};
  for (const std::string& request : requests) {
    const std::string text = answer(request);
    const std::string body = body_of(text);
    EXPECT_NE(text.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos) << request;
    EXPECT_NE(text.find("Cross-Origin-Resource-Policy: same-origin\r\n"), std::string::npos);
    EXPECT_NE(text.find("Content-Security-Policy: default-src 'self';"), std::string::npos);
    EXPECT_NE(text.find("\r\nConnection: "), std::string::npos);
    EXPECT_NE(text.find("Content-Length: " + std::to_string(body.size()) + "\r\n"),
              std::string::npos);
    EXPECT_EQ(text.find("Access-Control"), std::string::npos);
    if (body == "ok\n") continue;
    const auto error = nlohmann::json::parse(body).at("error");
    for (const char* member : {"code", "message", "hint"})
      EXPECT_TRUE(error.at(member).is_string());
  }
}

TEST_F(HttpTest, RejectsOtherMethods) {
  for (const std::string method :
       {"POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT", "GETX", "Get"}) {
    const std::string text = answer(method + " /healthz HTTP/1.1\r\n" + kHost + "\r\n");
    EXPECT_EQ(text.substr(9, 3), "405") << method;
    EXPECT_NE(text.find("\r\nAllow: GET, HEAD\r\n"), std::string::npos);
  }
  EXPECT_EQ(status_of("OPTIONS * HTTP/1.1\r\n" + kHost + "\r\n"), "405");
  EXPECT_EQ(status_of("CONNECT localhost:80 HTTP/1.1\r\n" + kHost + "\r\n"), "405");
}

TEST_F(HttpTest, RejectsMalformedRequests) {
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
      {"GET https://localhost/healthz HTTP/1.1\r\n" + kHost + "\r\n", "400"},
      {"GET http://localhost/healthz HTTP/1.1\r\n\r\n", "400"},
      {get("/healthz", ""), "400"},
      {get("/healthz", kHost + kHost), "400"},
      {get("/healthz", kHost + "Origin: a\r\nOrigin: a\r\n"), "400"},
      {"GET /healthz HTTP/1.1\r\n" + kHost, "400"},  // cut off
      {"GET", "400"},
  };
  for (const auto& [request, status] : rows) EXPECT_EQ(status_of(request), status) << request;
  EXPECT_EQ(status_of("GET /healthz HTTP/1.0\r\n" + kHost + "\r\n"), "200");
}

TEST_F(HttpTest, AcceptsTargetsInAbsoluteForm) {
  const auto of = [this](const std::string& target, const std::string& host) {
    return status_of("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  EXPECT_EQ(of("http://localhost/healthz", "localhost"), "200");
  EXPECT_EQ(of("HTTP://127.0.0.1:9601/state?cell=none", "localhost"), "404");
  EXPECT_EQ(of("http://localhost", "localhost"), "200");
  EXPECT_EQ(of("http://localhost?cell=none", "localhost"), "404");
  // The authority counts, as in a request that a proxy forwards, not the Host beside it.
  EXPECT_EQ(of("http://localhost/healthz", "evil.example"), "200");
  for (const char* authority : {"evil.example", "user@localhost", ""})
    EXPECT_EQ(of(std::string("http://") + authority + "/healthz", "localhost"), "403") << authority;
}

TEST_F(HttpTest, RejectsRequestsAboveTheLimits) {
  std::string fields = kHost;
  for (std::size_t i = 1; i < kMaxFields; ++i) fields += "X: y\r\n";
  EXPECT_EQ(status_of(get("/healthz", fields)), "200");
  EXPECT_EQ(status_of(get("/healthz", fields + "X: y\r\n")), "431");
  EXPECT_EQ(status_of(get("/healthz", kHost + "X: " + std::string(kMaxHeadBytes, 'y') + "\r\n")),
            "431");
  const std::string longest = "/healthz?" + std::string(kMaxTargetBytes - 9, 'x');
  EXPECT_EQ(status_of(get(longest)), "200");
  EXPECT_EQ(status_of(get(longest + "x")), "414");
  EXPECT_EQ(status_of("GET /" + std::string(kMaxHeadBytes, 'x')), "414");
  EXPECT_EQ(status_of(std::string(kMaxHeadBytes, 'X')), "431");
}

TEST_F(HttpTest, TheLimitOfAHeadIsExact) {
  const std::string start = "GET /healthz HTTP/1.1\r\n" + kHost + "X: ";
  const std::string fits = start + std::string(kMaxHeadBytes - start.size() - 4, 'y') + "\r\n\r\n";
  ASSERT_EQ(fits.size(), kMaxHeadBytes);
  EXPECT_EQ(status_of(fits), "200");
  EXPECT_EQ(status_of(fits + "a body that nobody reads"), "200");
  const std::string over = start + std::string(kMaxHeadBytes - start.size() - 3, 'y') + "\r\n\r\n";
  EXPECT_EQ(status_of(over), "431");
}

TEST_F(HttpTest, AHeadIsIncompleteUntilItsLastByte) {
  const auto is_open = [](const std::string& received) {
    return read_head(received).fault == HeadFault::kIncomplete;
  };
  const std::string request = get("/readyz");
  for (std::size_t size = 0; size < request.size(); ++size) {
    EXPECT_TRUE(is_open(request.substr(0, size))) << size;
  }
  EXPECT_FALSE(is_open(request));
  EXPECT_FALSE(is_open("HELP\r\n"));
  EXPECT_FALSE(is_open("HELP\n"));
  EXPECT_TRUE(is_open(std::string(kMaxHeadBytes - 1, 'X')));
  EXPECT_FALSE(is_open(std::string(kMaxHeadBytes, 'X')));
}

TEST_F(HttpTest, TheFirstFaultIsTheSameHoweverTheBytesArrive) {
  const std::string longer(kMaxTargetBytes, 'x');
  std::string many = kHost;
  for (std::size_t i = 0; i < kMaxFields; ++i) many += "A: b\r\n";
  const auto first_fault = [](const std::string& request) {
    std::size_t size = 0;
    HeadFault fault = HeadFault::kIncomplete;
    while (fault == HeadFault::kIncomplete) fault = read_head(request.substr(0, size++)).fault;
    return fault;
  };
  const auto expect_fault = [&](const std::string& request, HeadFault fault) {
    EXPECT_EQ(first_fault(request), fault) << request;
    EXPECT_EQ(read_head(request).fault, fault) << request;
  };
  expect_fault(get("/" + longer, "no colon\r\n"), HeadFault::kTargetTooLong);
  expect_fault(get("/" + longer, many), HeadFault::kTargetTooLong);
  expect_fault(get("/", many + "no colon\r\n"), HeadFault::kTooLarge);
  expect_fault(get("/", "no colon\r\n" + many), HeadFault::kMalformed);
  expect_fault("GET / HTTP/2.0\r\nno colon\r\n\r\n", HeadFault::kVersion);
  expect_fault("GET / HTTP/1.1\r\nA: b\r\n folded\r\n\r\n", HeadFault::kMalformed);
}

TEST_F(HttpTest, RejectsHostsThatDnsCanRebind) {
  for (const char* host : {"evil.example", "xr3", "localhost.evil.example", "", "a b.localhost"})
    EXPECT_EQ(status_of(get("/healthz", std::string("Host: ") + host + "\r\n")), "403") << host;
}

TEST_F(HttpTest, RejectsOtherOrigins) {
  const auto with = [this](const std::string& origin) {
    return status_of(get("/healthz", kHost + "Origin: " + origin + "\r\n"));
  };
  EXPECT_EQ(with("http://localhost:9601"), "200");
  for (const char* origin :
       {"null", "", "http://localhost", "http://localhost:9600", "https://localhost:9601",
        "http://evil.example", "http://localhost:9601/", "localhost:9601"}) {
    EXPECT_EQ(with(origin), "403") << origin;
  }
}

TEST_F(HttpTest, FieldNamesAreCaseInsensitive) {
  EXPECT_EQ(status_of(get("/healthz", "hOST:localhost\r\nORIGIN: \thttp://localhost \r\n")), "200");
}

TEST_F(HttpTest, RefusedRequestsCloseTheConnection) {
  const auto is_kept = [this](const std::string& request) {
    return answer(request).find("Connection: keep-alive\r\n") != std::string::npos;
  };
  EXPECT_TRUE(is_kept(get("/healthz")));
  EXPECT_TRUE(is_kept(get("/nothing")));
  EXPECT_FALSE(is_kept("POST / HTTP/1.1\r\n" + kHost + "\r\n"));
  EXPECT_FALSE(is_kept("HELP\r\n"));
  EXPECT_FALSE(is_kept(get("/healthz", "Host: evil.example\r\n")));
}

TEST_F(HttpTest, TheRequestSelectsKeepAliveOrClose) {
  const auto then = [](const std::string& request) { return read_head(request).request.then; };
  EXPECT_EQ(then(get("/", kHost)), http::Then::kKeep);
  EXPECT_EQ(then(get("/", kHost + "Connection: close\r\n")), http::Then::kClose);
  EXPECT_EQ(then("GET / HTTP/1.0\r\n\r\n"), http::Then::kClose);
  // The server does not read bodies, so a body would be parsed as the next request.
  EXPECT_EQ(then(get("/", kHost + "Content-Length: 5\r\n")), http::Then::kClose);
  for (const std::string coding : {"chunked", "xchunked", "gzip"}) {
    EXPECT_EQ(then(get("/", kHost + "Transfer-Encoding: " + coding + "\r\n")), http::Then::kClose)
        << coding;
  }
  EXPECT_EQ(status_of(get("/", kHost + "Content-Length: 5\r\nContent-Length: 6\r\n")), "400");
}

TEST_F(HttpTest, ParsesParameters) {
  const auto value = [](const std::string& target) {
    return read_head(get(target)).request.parameter("vector");
  };
  EXPECT_EQ(value("/view.svg?vector=1,2,3"), "1,2,3");
  EXPECT_EQ(value("/view.svg?a=b&vector=1%2c2%2C3&vector=4"), "1,2,3");
  EXPECT_EQ(value("/view.svg?vector="), "");
  EXPECT_EQ(value("/view.svg?vector"), "");
  EXPECT_EQ(value("/view.svg?vector=%4"), "");
  EXPECT_EQ(value("/view.svg?vector=%zz"), "");
  EXPECT_EQ(value("/view.svg?x=vector=1"), std::nullopt);
  EXPECT_EQ(value("/view.svg"), std::nullopt);
}

// --- Resources.

TEST_F(HttpTest, ServesTheCurrentCell) {
  cell_.apply(call::AddBlock{{"red", {30'000, 30'000, 30'000}, {250'000, 0, 15'000}, 0, 4}}, 0);
  const Json state = json_of(answer(get("/state")));
  EXPECT_EQ(state["op"], "state");
  EXPECT_EQ(state["blocks"][0]["name"], "red");
  EXPECT_EQ(json_of(answer(get("/robot")))["name"], cell_.model().robot().name);
  const std::string workcell = body_of(answer(get("/workcell")));
  EXPECT_EQ(load_workcell(workcell, "answer").blocks[0].name, "red");
  EXPECT_EQ(status_of(get("/state?cell=main")), "200");
  for (const char* path : {"/state", "/robot", "/workcell", "/camera.png", "/view.svg"}) {
    const std::string other = answer(get(std::string(path) + "?cell=other"));
    EXPECT_EQ(other.substr(9, 3), "404") << path;
    EXPECT_EQ(json_of(other)["error"]["code"], "unknown_cell");
  }
}

TEST_F(HttpTest, WithoutACameraThereIsNoImage) {
  for (const char* path : {"/camera.png", "/camera.pbm"})
    EXPECT_EQ(json_of(answer(get(path)))["error"]["code"], "no_camera") << path;
}

TEST_F(HttpTest, ServesImages) {
  const auto with_camera = std::make_shared<const Model>(
      test::robot_named("rhino-xr3"), test::workcell_named("rhino-xr3"), Profile::kPaper);
  test::CellHost host(io_);
  host.add(with_camera);
  MonitorService service(io_, host.cells, host.worker, policy_);
  service.stop();
  HttpResources resources(service, policy_, [] { return std::string(); }, {});
  const auto show = [&](const std::string& target) {
    std::string body;
    const http::HttpRequest request = read_head(get(target)).request;
    asio::co_spawn(
        io_,
        [&]() -> asio::awaitable<void> {
          body = (co_await resources.answer(request)).body.bytes();
        },
        asio::detached);
    io_.restart();
    io_.run();
    return body;
  };
  EXPECT_TRUE(show("/camera.png").starts_with("\x89PNG\r\n"));
  EXPECT_TRUE(show("/camera.pbm").starts_with("P1\n192 192\n"));
  EXPECT_NE(show("/view.svg?vector=0,0,1").find("seen from (0, 0, 1)"), std::string::npos);
  EXPECT_NE(show("/view.svg").find("seen from (1, 1, 1)"), std::string::npos);
  for (const char* vector : {"", "1,1", "0,0,0", "10,0,0", "1,1,x", "%"}) {
    const Json error = Json::parse(show(std::string("/view.svg?vector=") + vector));
    EXPECT_EQ(error["error"]["code"], "bad_vector") << vector;
  }
}

TEST_F(HttpTest, ServesTheSchemaAndThePage) {
  EXPECT_EQ(json_of(answer(get("/schema/v1.json")))["$schema"].is_string(), true);
  EXPECT_TRUE(answer(get("/")).find("text/html") != std::string::npos);
  EXPECT_EQ(body_of(get("/favicon.ico")), body_of(get("/assets/icon.svg")));
  EXPECT_EQ(status_of(get("/assets/")), "404");
  EXPECT_EQ(status_of(get("/assets/../../etc/passwd")), "404");
}

TEST_F(HttpTest, PrivateReadingNeedsTheToken) {
  policy_ = AccessPolicy({{}, ReadAccess::kWithToken, kToken});
  for (const char* path : {"/state", "/robot", "/workcell", "/camera.png", "/camera.pbm",
                           "/view.svg", "/metrics", "/state?cell=other"}) {
    const std::string refused = answer(get(path));
    EXPECT_EQ(refused.substr(9, 3), "403") << path;
    EXPECT_EQ(json_of(refused)["error"]["code"], "token_required");
  }
  for (const char* path : {"/", "/healthz", "/readyz", "/schema/v1.json"})
    EXPECT_EQ(status_of(get(path)), "200") << path;
}

TEST_F(HttpTest, AcceptsNamesOfTheRules) {
  policy_ = AccessPolicy({{http::HostReach::kBeyond, {"arm.lab"}, {"https://page.lab"}}, {}, ""});
  EXPECT_EQ(status_of(get("/healthz", "Host: xr3:9601\r\n")), "200");
  EXPECT_EQ(status_of(get("/healthz", "Host: arm.lab\r\nOrigin: https://page.lab\r\n")), "200");
  EXPECT_EQ(status_of(get("/healthz", "Host: leg.lab\r\n")), "403");
}

TEST_F(HttpTest, OnlyTheRobotsPageIsForFrames) {
  AccessRules rules;
  rules.frame_origins = {"https://moodle.school", "http://localhost:8888"};
  policy_ = AccessPolicy(rules);
  const std::string allowed = "frame-ancestors https://moodle.school http://localhost:8888; ";
  EXPECT_NE(answer(get("/")).find(allowed), std::string::npos);
  for (const char* path : {"/state", "/assets/icon.svg", "/docs/", "/x"})
    EXPECT_NE(answer(get(path)).find("frame-ancestors 'none'; "), std::string::npos) << path;
}

// --- The WebSocket handshake.

TEST_F(HttpTest, ValidatesWebSocketHandshakes) {
  const std::string upgrade = kHost + "Connection: keep-alive, Upgrade\r\nUpgrade: WebSocket\r\n";
  const std::string key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const std::string version = "Sec-WebSocket-Version: 13\r\n";
  const std::string offer = "Sec-WebSocket-Protocol: ";
  const auto status = [this](const std::string& fields) {
    const auto refused = resources_.refuse_websocket(read_head(get("/ws", fields)).request);
    return refused ? refused->status : 101U;
  };
  EXPECT_EQ(status(upgrade + key + version), 101U);
  EXPECT_EQ(status(upgrade + key + version + offer + "xr3.v1\r\n"), 101U);
  EXPECT_EQ(status(upgrade + key + version + offer + "a, xr3.v1 ,b\r\n"), 101U);
  EXPECT_EQ(status(upgrade + key + version + offer + "a\r\n" + offer + "xr3.v1\r\n"), 101U);
  EXPECT_EQ(status(upgrade + key + version + offer + "xr3.v2\r\n"), 400U);
  EXPECT_EQ(status(upgrade + key + version + offer + "\r\n"), 400U);
  EXPECT_EQ(status(upgrade + version), 400U);
  EXPECT_EQ(status(upgrade + version + "Sec-WebSocket-Key: short==\r\n"), 400U);
  EXPECT_EQ(status(upgrade + key + "Sec-WebSocket-Version: 8\r\n"), 426U);
  EXPECT_EQ(status(upgrade + key), 426U);
  EXPECT_EQ(status(kHost + key + version), 426U);
}

}  // namespace
}  // namespace xr3
