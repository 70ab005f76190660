#include "protocol/foxglove/wire.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/message.hpp"

namespace xr3::foxglove {
namespace {

using monitor::text_of;

constexpr char kMessageData = 0x01;
constexpr char kTime = 0x02;

/// Appends the lowest `bytes` bytes, the lowest first.
void append(std::string& to, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8U) to += static_cast<char>(value & 0xFFU);
}

int channel_of(Topic topic) { return static_cast<int>(topic) + 1; }

/// The whole number, if it has 32 bits.
std::optional<std::uint32_t> number_in(JsonValue value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.number();
  if (!(number >= 0 && number <= std::numeric_limits<std::uint32_t>::max())) return std::nullopt;
  if (number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

std::optional<Topic> topic_of(JsonValue channel) {
  const std::optional<std::uint32_t> number = number_in(channel);
  if (!number || *number < 1 || *number > kTopics) return std::nullopt;
  return static_cast<Topic>(*number - 1);
}

/// A short part of a client's message.
std::string shown(JsonValue value) {
  constexpr std::size_t kMost = 40;
  if (!value) return "nothing";
  return value.json_size(kMost) > kMost ? "a longer value" : text_of(value.to_json());
}

}  // namespace

// --- To the client.

std::string server_info_text(std::string_view name, std::string_view session) {
  return text_of(Json::object({{"op", "serverInfo"},
                               {"name", name},
                               {"capabilities", {"time"}},
                               {"supportedEncodings", {"json"}},
                               {"metadata", Json::object()},
                               {"sessionId", session}}));
}

std::string advertise_text(const Model& model) {
  Json channels = Json::array();
  for (const TopicInfo& info : topics()) {
    channels.push_back(Json::object({{"id", channel_of(info.topic)},
                                     {"topic", info.name},
                                     {"encoding", "json"},
                                     {"schemaName", info.schema},
                                     {"schemaEncoding", "jsonschema"},
                                     {"schema", schema_text(info.topic, model)}}));
  }
  return text_of(Json::object({{"op", "advertise"}, {"channels", std::move(channels)}}));
}

std::string status_text(StatusLevel level, std::string_view message) {
  return text_of(Json::object({{"op", "status"}, {"level", level}, {"message", message}}));
}

std::string time_bytes(Nanoseconds time) {
  std::string bytes(1, kTime);
  append(bytes, time, 8);
  return bytes;
}

std::string message_head(std::uint32_t subscription, Nanoseconds time) {
  std::string bytes(1, kMessageData);
  append(bytes, subscription, 4);
  append(bytes, time, 8);
  return bytes;
}

// --- From the client.

Subscriptions::Subscribed Subscriptions::carry_out(std::string_view message) {
  const JsonDocument document(message);
  const JsonValue request = document.root();
  if (!request.is_object())
    return {{}, "a message is a JSON object, such as {\"op\":\"subscribe\"}"};
  Subscribed outcome;
  const auto note = [&](std::string complaint) {
    if (outcome.complaint.empty()) outcome.complaint = std::move(complaint);
  };
  const JsonValue op = request.find("op");
  if (op.is("subscribe") && request.find("subscriptions").is_list()) {
    for (const JsonValue each : request.find("subscriptions")) note(subscribe(each, outcome));
  } else if (op.is("unsubscribe") && request.find("subscriptionIds").is_list()) {
    for (const JsonValue each : request.find("subscriptionIds")) note(unsubscribe(each));
  } else {
    note("op " + shown(op) +
         " is not carried out: this server is read-only, and takes subscribe with a list "
         "subscriptions, and unsubscribe with a list subscriptionIds");
  }
  return outcome;
}

/// Returns a complaint; empty if it was done.
std::string Subscriptions::subscribe(JsonValue wanted, Subscribed& outcome) {
  const std::optional<std::uint32_t> number = number_in(wanted.find("id"));
  const std::optional<Topic> topic = topic_of(wanted.find("channelId"));
  if (!topic)
    return "there is no channel " + shown(wanted.find("channelId")) + ": they are 1 to " +
           std::to_string(kTopics) + ", as advertised";
  if (!number)
    return "the id of a subscription is " + shown(wanted.find("id")) +
           ", but must be a whole number of 32 bits";
  const bool is_used = std::any_of(numbers_.begin(), numbers_.end(),
                                   [&](const auto& each) { return each.second == *number; });
  if (is_used) return "the id " + std::to_string(*number) + " has a subscription already";
  if (!numbers_.emplace(*topic, *number).second)
    return "channel " + std::to_string(channel_of(*topic)) +
           " has a subscription already: unsubscribe first";
  outcome.added.push_back(*topic);
  return {};
}

std::string Subscriptions::unsubscribe(JsonValue number) {
  const std::optional<std::uint32_t> wanted = number_in(number);
  const auto found = std::find_if(numbers_.begin(), numbers_.end(),
                                  [&](const auto& each) { return each.second == wanted; });
  if (found == numbers_.end()) return "there is no subscription with the id " + shown(number);
  numbers_.erase(found);
  return {};
}

std::optional<std::uint32_t> Subscriptions::find(Topic topic) const {
  const auto found = numbers_.find(topic);
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

}  // namespace xr3::foxglove
