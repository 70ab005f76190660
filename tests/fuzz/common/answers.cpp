#include "tests/fuzz/common/answers.hpp"

#include <algorithm>
#include <variant>

#include "protocol/monitor/request_error.hpp"

namespace xr3::fuzz {
namespace {

bool asks_for_frame(const std::string& message) {
  if (message.find("get") == message.npos && message.find('\\') == message.npos) return false;
  const auto reading = monitor::read_request(message);
  const auto* request = std::get_if<monitor::Request>(&reading);
  const auto* get = request == nullptr ? nullptr : std::get_if<monitor::Get>(&request->what);
  if (get == nullptr) return false;
  const monitor::Channel channel = get->selection.channel;
  return channel != monitor::Channel::kEvent && channel != monitor::Channel::kLine &&
         channel != monitor::Channel::kImage;
}

}  // namespace

bool is_answer(std::string_view message) {
  return message.starts_with(R"({"op":"result")") || message.starts_with(R"({"op":"pong")");
}

std::size_t answers_to(const std::vector<std::string>& messages) {
  return messages.size() -
         static_cast<std::size_t>(std::count_if(messages.begin(), messages.end(), asks_for_frame));
}

}  // namespace xr3::fuzz
