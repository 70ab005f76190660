#include "protocol/monitor_client.hpp"

#include <utility>

namespace xr3::monitor {
namespace {

RequestError too_long() {
  return {{},
          "too_long",
          "a line has at most 262144 bytes",
          "the connection ends; nothing behind it was read",
          {}};
}

}  // namespace

std::optional<Request> Client::take(std::string_view message) {
  if (has_ended_) return std::nullopt;
  RequestReading reading = read_request(message, cells_);
  if (Request* request = std::get_if<Request>(&reading)) return std::move(*request);
  send(result(std::get<RequestError>(reading)));
  return std::nullopt;
}

void Client::send(Message message) {
  if (has_ended_) return;
  lane_bytes_ += message->size();
  lane_.push_back(std::move(message));
}

void Client::end(Bye why) {
  send(bye(why));
  has_ended_ = true;
}

Message Client::next_output() {
  if (lane_.empty()) return nullptr;
  Message message = std::move(lane_.front());
  lane_.pop_front();
  lane_bytes_ -= message->size();
  return message;
}

std::optional<Request> next_request(Lines& lines, Client& client) {
  while (!client.has_ended() && !client.is_full()) {
    const auto line = lines.next();
    if (!line) break;
    if (auto request = client.take(*line)) return request;
  }
  if (client.is_full() || lines.fault() == LineFault::kNone) return std::nullopt;
  const bool long_line = lines.fault() == LineFault::kTooLong;
  if (long_line) client.send(result(too_long()));
  client.end(long_line ? Bye::kTooLong : Bye::kNotJson);
  return std::nullopt;
}

}  // namespace xr3::monitor
