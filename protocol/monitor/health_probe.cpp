#include "protocol/monitor/health_probe.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/member_reader.hpp"

namespace xr3 {
namespace {

constexpr const char* kId = "health";
constexpr std::size_t kMaxQuotedLength = 60;

/// The beginning of a foreign server's first line, quoted, without control characters.
std::string quoted(std::string_view text) {
  std::string line(text.substr(0, std::min(kMaxQuotedLength, text.find_first_of("\r\n"))));
  const auto is_strange = [](char c) { return c < ' ' || c > '~'; };
  std::replace_if(line.begin(), line.end(), is_strange, '?');
  return "\"" + line + "\"";
}

std::string is_another(std::string_view line) { return "is not xr3: it sends " + quoted(line); }

}  // namespace

std::string HealthProbe::feed(std::string_view bytes) {
  std::string to_send;
  for (std::size_t end = 0; (end = bytes.find('\n')) != std::string_view::npos;) {
    line_ += bytes.substr(0, end);
    bytes.remove_prefix(end + 1);
    if (health_ == Health::kUnknown) to_send += handle_line();
    line_.clear();
  }
  line_ += bytes;
  if (line_.size() > kMaxLineBytes) refuse(is_another(line_));
  return to_send;
}

std::string HealthProbe::handle_line() {
  const Json message = Json::parse(line_, nullptr, false);
  const auto op = monitor::value_of<std::string>(message, "op");
  if (op == "bye" && monitor::value_of<std::string>(message, "why") == "full") {
    health_ = Health::kFull;
  } else if (op == "bye") {
    refuse("ends the connection: " + monitor::value_of<std::string>(message, "message"));
  } else if (is_greeted_) {
    if (op == "pong" && monitor::member(message, "id") == kId) health_ = Health::kHealthy;
  } else if (op == "hello" &&
             monitor::value_of<std::string>(message, "server").starts_with("xr3 ")) {
    is_greeted_ = true;
    return Json({{"op", "ping"}, {"id", kId}}).dump().substr(opening().size()) + "\n";
  } else {
    refuse(is_another(line_));
  }
  return {};
}

void HealthProbe::refuse(std::string why) {
  if (health_ != Health::kUnknown) return;
  health_ = Health::kUnhealthy;
  why_ = std::move(why);
}

std::string HealthProbe::trouble() const {
  if (!why_.empty()) return why_;
  if (is_greeted_) return "sends hello, but does not answer a ping";
  return line_.empty() ? "accepts the connection, but sends nothing" : is_another(line_);
}

std::string ready_request(const std::string& host) {
  return "GET /readyz HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
}

std::string trouble_with_readiness(std::string_view answer) {
  constexpr std::string_view kStatus = "HTTP/1.1 ";
  if (answer.empty()) return "does not say whether it is ready";
  if (answer.starts_with(kStatus) && answer.substr(kStatus.size()).starts_with("200 ")) return {};
  const std::size_t head = std::min(answer.find("\r\n\r\n"), answer.size());
  const Json body = Json::parse(answer.substr(head), nullptr, false);
  const auto message = monitor::value_of<std::string>(monitor::member(body, "error"), "message");
  return message.empty() ? is_another(answer) : "is not ready: " + message;
}

}  // namespace xr3
