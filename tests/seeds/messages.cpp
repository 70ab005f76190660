#include "tests/seeds/messages.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/document.hpp"

namespace xr3::seeds {
namespace {

std::string text(const Json& json, const char* member) {
  const auto found = json.find(member);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

void Messages::expect(const std::string& id, const std::string& reply) {
  expected_.push_back({id, reply});
}

/// The checks, apart from the header, because JSON is slow to compile.
class Messages::Reader {
 public:
  explicit Reader(Messages& all) : all_(all) {}
  std::string check(const Json& json);

 private:
  std::string check_reply(const Json& json, const std::string& id);
  std::string check_order(const Json& json);
  void begin_ring(const Json& value);

  Messages& all_;
};

// Frames without an id are most of the messages, and took most of the time of a run.
bool Messages::can_skip(std::string_view message) {
  constexpr std::size_t kParsed = 16;  // one of so many
  const auto is_of = [message](std::string_view channel) {
    constexpr std::string_view kOp = R"({"op":")";
    return message.starts_with(kOp) && message.substr(kOp.size()).starts_with(channel);
  };
  const bool is_frame = is_of(R"(state","cell")") || is_of(R"(display","cell")") ||
                        is_of(R"(model","cell")") || is_of(R"(image","cell")");
  return is_frame && message.ends_with('}') && has_hello_ && bye_.empty() &&
         ++frames_ % kParsed != 0;
}

std::string Messages::feed(std::string_view message) {
  if (can_skip(message)) return {};
  const Json json = Json::parse(message, nullptr, false);
  std::string wrong = json.is_object() ? Reader(*this).check(json) : "not a JSON object";
  if (!wrong.empty()) wrong += " in " + std::string(message.substr(0, 300));
  return wrong;
}

std::string Messages::Reader::check(const Json& json) {
  const std::string op = text(json, "op");
  if (!all_.bye_.empty()) return "a message after bye";
  if (op == "bye") {
    all_.bye_ = text(json, "why");
    return {};
  }
  if (!std::exchange(all_.has_hello_, true))
    return op == "hello" ? "" : "hello is not the first message";
  if (op == "hello") return "a second hello";
  const auto id = json.find("id");
  if (id == json.end() || id->is_null()) return check_order(json);
  return check_reply(json, id->is_string() ? id->get<std::string>() : "a number");
}

std::string Messages::Reader::check_reply(const Json& json, const std::string& id) {
  if (!id.starts_with(all_.prefix_)) return "the reply of another client";
  if (all_.expected_.empty() || all_.expected_.front().id != id)
    return "a reply out of order, expected " +
           (all_.expected_.empty() ? "none" : all_.expected_.front().id);
  const std::string op = text(json, "op");
  if (op != all_.expected_.front().reply && op != "result") return {};  // a message of a ring
  all_.expected_.pop_front();
  const auto value = json.find("value");
  if (value == json.end()) return {};
  begin_ring(*value);
  const auto hex = all_.hex_.find(id);
  if (hex != all_.hex_.end() && value->value("hex", "") != hex->second)
    return "the replies are wrong, expected " + hex->second;
  return {};
}

void Messages::Reader::begin_ring(const Json& value) {
  const std::string channel = text(value, "channel");
  const auto since = value.find("since");
  if (since != value.end()) all_.next_seq_[channel] = since->get<std::int64_t>();
}

/// The messages of a subscribed ring continue one another, or a `lag` explains the gap.
std::string Messages::Reader::check_order(const Json& json) {
  const std::string op = text(json, "op");
  const bool is_lag = op == "lag";
  const auto next = all_.next_seq_.find(is_lag ? text(json, "channel") : op);
  if (next == all_.next_seq_.end()) return {};
  const std::int64_t first = json.value(is_lag ? "from_seq" : "seq", std::int64_t{0});
  if (first != next->second) return "a gap: seq " + std::to_string(next->second) + " is missing";
  next->second = 1 + (is_lag ? json.value("to_seq", std::int64_t{0}) : first);
  return {};
}

}  // namespace xr3::seeds
