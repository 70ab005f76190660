#include "server/http/answer.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/source.hpp"

namespace xr3::http {
namespace {

Answer unauthorized(const char* code, const char* message) {
  Answer answer = error(401, code, message,
                        "send Authorization: Bearer TOKEN, with that of --metrics-token-file");
  answer.fields.push_back({"WWW-Authenticate", "Bearer"});
  return answer;
}

}  // namespace

Answer closing(Answer answer) {
  answer.then = Then::kClose;
  return answer;
}

Answer text(Body body) { return {200, "text/plain; charset=utf-8", std::move(body), {}}; }

Answer json(Body body) { return {200, "application/json", std::move(body), {}}; }

Answer error(unsigned status, const char* code, const std::string& message,
             const std::string& hint) {
  const Json json = {{"error", {{"code", code}, {"message", message}, {"hint", hint}}}};
  const std::string body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return {status, "application/json", body, {}};
}

Answer bad_request(const std::string& message, const std::string& hint) {
  return closing(error(400, "bad_request", message, hint));
}

Answer not_found(const std::string& message) {
  return error(404, "not_found", message,
               "available: / /healthz /readyz /metrics /state /robot /workcell /schema/v1.json "
               "/camera.png /camera.pbm /view.svg /sites /docs/ /play/ /ws /line and /foxglove");
}

Answer method_not_allowed() {
  Answer answer = closing(error(405, "method_not_allowed",
                                "only GET and HEAD are supported; nothing was changed",
                                "send calls as JSON lines: {\"op\":\"call\",\"fn\":\"pause\"}"));
  answer.fields.push_back({"Allow", "GET, HEAD"});
  return answer;
}

Answer token_required() {
  return error(403, "token_required", "reading needs the token, which HTTP requests cannot carry",
               "connect to /ws or send JSON lines, and first send {\"op\":\"auth\",\"token\":...}");
}

Answer metrics_token_required() {
  return unauthorized("token_required", "reading the metrics needs their token");
}

Answer bad_metrics_token() {
  return closing(unauthorized("bad_token", "this is not the token of the metrics"));
}

Answer too_slow() {
  return closing(error(408, "timeout", "the head of the request did not arrive within 10 s",
                       "send it at once, with an empty line at its end"));
}

Answer full() {
  return closing(error(503, "full", "the maximum number of connections is open",
                       "close some, or try again later"));
}

std::optional<Answer> refuse_head(HeadFault fault) {
  switch (fault) {
    case HeadFault::kNone: return std::nullopt;
    case HeadFault::kIncomplete: return bad_request("the request ends before the end of its head");
    case HeadFault::kMalformed: return bad_request("this is not an HTTP/1 request");
    case HeadFault::kVersion:
      return closing(error(505, "version_not_supported", "only HTTP/1.0 and HTTP/1.1 are supported",
                           "configure the client to use HTTP/1.1"));
    case HeadFault::kTargetTooLong:
      return closing(error(414, "target_too_long", "a target has at most 8192 bytes",
                           "no resource has a name that long"));
    case HeadFault::kTooLarge:
      return closing(error(431, "head_too_large", "a head has at most 16384 bytes and 64 fields",
                           "send fewer and shorter fields"));
  }
  return std::nullopt;
}

std::string head_bytes(const Answer& answer) {
  std::vector<Field> fields{{"Content-Type", answer.type}};
  fields.insert(fields.end(), answer.fields.begin(), answer.fields.end());
  return head_text(answer.status, fields, answer.body.bytes().size(), answer.then);
}

std::string_view body_bytes(const Answer& answer, std::string_view method) {
  return method == "HEAD" ? std::string_view{} : answer.body.bytes();
}

std::string to_bytes(const Answer& answer, std::string_view method) {
  return head_bytes(answer).append(body_bytes(answer, method));
}

}  // namespace xr3::http
