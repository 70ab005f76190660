#include "protocol/monitor/message.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/fields.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

constexpr int kProtocol = 1;
constexpr int kMaxHz = 60;

Message message_of(const Json& json) { return std::make_shared<const std::string>(text_of(json)); }

Json id_json(const RequestId& id) {
  if (const auto* number = std::get_if<std::int64_t>(&id)) return *number;
  if (const auto* text = std::get_if<std::string>(&id)) return *text;
  return nullptr;
}

Json robot_json(const Model& model) {
  Json joints = Json::array();
  for (int k = 0; k < model.joint_count(); ++k) {
    joints.push_back(std::string(1, model.motor(k).drive.label));
  }
  if (model.carousel()) {
    joints.push_back(std::string(1, model.motor(model.carousel_index()).drive.label));
  }
  const char tool = model.motor(model.tool_index()).drive.label;
  return {{"name", model.robot().name}, {"joints", joints}, {"tool", std::string(1, tool)}};
}

const char* name_of(Access access) {
  switch (access) {
    case Access::kNone: return "none";
    case Access::kRead: return "read";
    case Access::kControl: return "control";
  }
  return "";
}

/// The members of `hello` that describe the cell; JSON null without one.
Json cell_members(const Greeting& greeting) {
  Json members = {{"cell", nullptr},   {"cells", greeting.cells}, {"epoch", nullptr},
                  {"tick", nullptr},   {"tick_hz", kTickHz},      {"clock", nullptr},
                  {"compat", nullptr}, {"robot", nullptr}};
  if (!greeting.cell) return members;
  const auto& [name, model, now] = *greeting.cell;
  members["cell"] = name;
  members["epoch"] = now.epoch;
  members["tick"] = now.tick;
  members["clock"] = clock_json(now.mode, now.rate);
  members["compat"] = model.profile() == Profile::kPaper ? "paper" : "mark3";
  members["robot"] = robot_json(model);
  return members;
}

Json details_json(const std::vector<Detail>& details) {
  Json list = Json::array();
  for (const Detail& detail : details) {
    list.push_back(
        {{"pointer", detail.pointer}, {"found", detail.found}, {"allowed", detail.allowed}});
  }
  return list;
}

struct ByeText {
  const char* why;
  const char* message;
};

ByeText text_of_reason(CloseReason why) {
  switch (why) {
    case CloseReason::kShutdown: return {"shutdown", "the server is stopping"};
    case CloseReason::kNotJson:
      return {"not_json",
              "a line begins with {; send one JSON object a line, such as "
              "{\"op\":\"get\",\"channel\":\"state\"}"};
    case CloseReason::kTooLong: return {"too_long", "a line has at most 262144 bytes"};
    case CloseReason::kBadToken: return {"bad_token", "too many wrong tokens"};
    case CloseReason::kFull: return {"full", "too many connections; close some and try again"};
    case CloseReason::kIdle: return {"idle", "this client has sent nothing for too long"};
    case CloseReason::kDisconnected:
      return {"disconnected", "the connection was closed by the server"};
  }
  return {"internal", ""};
}

/// The members of `hello` that are always the same, with the comma before them and the brace behind
/// them: most of the message.
const std::string& end_of_hello() {
  static const std::string end = [] {
    const Json members = {{"channels", channels()},
                          {"calls", calls()},
                          {"limits",
                           {{"message_bytes", kMaxMessageBytes},
                            {"depth", JsonDocument::kMaxDepth},
                            {"max_hz", kMaxHz}}}};
    return "," + text_of(members).substr(1);
  }();
  return end;
}

/// A message with more members behind `op`.
Message with_members(const Message& message, const std::string& members) {
  std::string text = *message;
  text.insert(text.find(','), members);
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Message hello(const Greeting& greeting) {
  Json message = {{"op", "hello"}, {"proto", kProtocol}, {"server", greeting.server}};
  if (greeting.access != Access::kNone) message.update(cell_members(greeting));
  message["access"] = name_of(greeting.access);
  std::string text = text_of(message);
  text.pop_back();  // the closing brace of the message
  return std::make_shared<const std::string>(text.append(end_of_hello()));
}

Message result(const RequestId& id, const Json& value) {
  return message_of({{"op", "result"}, {"id", id_json(id)}, {"ok", true}, {"value", value}});
}

Message result(const RequestError& error) {
  Json body = {{"code", error.code},
               {"message", error.message},
               {"hint", error.hint},
               {"details", details_json(error.details)}};
  body.update(error.more);
  return message_of({{"op", "result"}, {"id", id_json(error.id)}, {"ok", false}, {"error", body}});
}

Message pong(const RequestId& id) { return message_of({{"op", "pong"}, {"id", id_json(id)}}); }

Message channel_message(Channel channel, const ChannelHead& head, std::string_view members) {
  std::string text = R"({"op":")";
  text.append(name_of(channel)).append(R"(","cell":)").append(Json(head.cell).dump());
  text.append(R"(,"epoch":)").append(std::to_string(head.epoch));
  text.append(R"(,"seq":)").append(std::to_string(head.seq));
  text.append(R"(,"tick":)").append(std::to_string(head.tick));
  members.remove_prefix(1);  // the opening brace of the members
  if (members != "}") text.push_back(',');
  text.append(members);
  return std::make_shared<const std::string>(std::move(text));
}

Message with_id(const Message& message, const RequestId& id) {
  if (std::holds_alternative<std::monostate>(id)) return message;
  return with_members(message, R"(,"id":)" + text_of(id_json(id)));
}

Message as_past(const Message& message, const RequestId& id) {
  return with_id(with_members(message, R"(,"past":true)"), id);
}

Message with_fields(const Message& message, const Fields& fields) {
  if (!fields) return message;
  const Json whole = Json::parse(*message);
  Json picked = Json::object();
  for (const char* name : {"op", "cell", "epoch", "seq", "tick"}) picked[name] = whole.at(name);
  picked.update(chosen(whole, fields));
  return message_of(picked);
}

Message lag(std::string_view cell, Channel channel, const Missed& missed) {
  return message_of({{"op", "lag"},
                     {"cell", cell},
                     {"channel", name_of(channel)},
                     {"missed", missed.count},
                     {"from_seq", missed.from_seq},
                     {"to_seq", missed.to_seq}});
}

Message bye(CloseReason why) {
  const ByeText text = text_of_reason(why);
  return message_of({{"op", "bye"}, {"why", text.why}, {"message", text.message}});
}

}  // namespace xr3::monitor
