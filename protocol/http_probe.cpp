#include "protocol/http_probe.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "protocol/http_guard.hpp"
#include "protocol/http_head.hpp"
#include "protocol/json_source.hpp"

namespace xr3::http {
namespace {

constexpr std::string_view kSafetyFields =
    "Cache-Control: no-store\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Content-Security-Policy: default-src 'self'; frame-ancestors 'none'; base-uri 'none'\r\n"
    "Connection: close\r\n";

struct Answer {
  std::string status;
  std::string type;
  std::string body;
  std::string fields;  ///< further ones, each with its line end
};

Answer error(std::string status, const char* code, const std::string& message,
             const std::string& hint) {
  const Json json = {{"error", {{"code", code}, {"message", message}, {"hint", hint}}}};
  const std::string body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return {std::move(status), "application/json", body, ""};
}

Answer bad_request(const std::string& message) {
  return error("400 Bad Request", "bad_request", message,
               "GET /healthz HTTP/1.1 with one Host, lines ended by CR LF");
}

std::optional<Answer> refuse_head(HeadFault fault) {
  switch (fault) {
    case HeadFault::kNone: return std::nullopt;
    case HeadFault::kIncomplete: return bad_request("the request ends within its head");
    case HeadFault::kMalformed: return bad_request("this is no HTTP/1 request");
    case HeadFault::kVersion:
      return error("505 HTTP Version Not Supported", "version_not_supported",
                   "only HTTP/1.0 and HTTP/1.1 are spoken", "tell the client to use HTTP/1.1");
    case HeadFault::kTargetTooLong:
      return error("414 URI Too Long", "target_too_long", "a target has at most 8192 bytes",
                   "ask for /healthz or /readyz");
    case HeadFault::kTooLarge:
      return error("431 Request Header Fields Too Large", "head_too_large",
                   "a head has at most 16384 bytes and 64 fields", "send fewer and shorter fields");
  }
  return std::nullopt;
}

std::optional<Answer> refuse_stranger(const Head& head) {
  const auto hosts = head.values("Host");
  const auto origins = head.values("Origin");
  if (hosts.size() != 1) return bad_request("a request has exactly one Host");
  if (origins.size() > 1) return bad_request("a request has at most one Origin");
  if (!is_local_host(hosts.front())) {
    return error("403 Forbidden", "wrong_host", "this server does not answer to that Host",
                 "use its IP address, localhost or a name under localhost");
  }
  if (!origins.empty() && origins.front() != "http://" + std::string(hosts.front())) {
    return error("403 Forbidden", "wrong_origin", "a page from another origin may not read this",
                 "open the page from this server's own address");
  }
  return std::nullopt;
}

Answer not_allowed() {
  Answer answer = error("405 Method Not Allowed", "method_not_allowed",
                        "only GET and HEAD are answered; nothing was changed",
                        "calls go as JSON lines: {\"op\":\"call\",\"fn\":\"pause\"}");
  answer.fields = "Allow: GET, HEAD\r\n";
  return answer;
}

Answer resource(std::string_view path, Readiness readiness) {
  const Answer good{"200 OK", "text/plain; charset=utf-8", "ok\n", ""};
  if (path == "/healthz") return good;
  if (path != "/readyz")
    return error("404 Not Found", "not_found", "there is nothing here",
                 "there is /healthz and /readyz");
  if (readiness == Readiness::kReady) return good;
  return error("503 Service Unavailable", "not_ready", "the server is starting or stopping",
               "try again, or start it again");
}

Answer decide(const Head& head, Readiness readiness) {
  if (auto refused = refuse_head(head.fault)) return *std::move(refused);
  if (auto refused = refuse_stranger(head)) return *std::move(refused);
  if (head.method != "GET" && head.method != "HEAD") return not_allowed();
  if (!head.target.starts_with('/')) return bad_request("the target is a path that begins with /");
  return resource(head.target.substr(0, head.target.find('?')), readiness);
}

}  // namespace

bool is_head_decided(std::string_view received) {
  return read_head(received).fault != HeadFault::kIncomplete;
}

std::string answer(std::string_view received, Readiness readiness) {
  const Head head = read_head(received);
  const Answer answer = decide(head, readiness);
  std::string text = "HTTP/1.1 " + answer.status + "\r\nContent-Type: " + answer.type +
                     "\r\nContent-Length: " + std::to_string(answer.body.size()) + "\r\n" +
                     answer.fields;
  text.append(kSafetyFields).append("\r\n");
  return head.method == "HEAD" ? text : text + answer.body;
}

}  // namespace xr3::http
