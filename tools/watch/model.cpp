#include "tools/watch/model.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/watch/read.hpp"

namespace xr3::watch {
namespace {

constexpr const char* kAuthId = "auth";
constexpr const char* kKeyId = "key";
constexpr const char* kLinesId = "lines";
constexpr const char* kTimeId = "time";
constexpr const char* kLastId = "last";
constexpr int kMaxStatesPerS = 20;
constexpr int kMaxImagesPerS = 10;
constexpr int kStepTicks = 10;

/// The members of `display` without the drawing.
const std::vector<std::string> kDisplayFields{"on",           "view",          "erase",
                                              "period_ticks", "function_keys", "status"};

/// Kinds of events that the joint table shows anyway; they would crowd out all others.
const std::vector<std::string> kSeenElsewhere{"move", "reached", "switch", "io"};

}  // namespace

std::string WatchModel::request(Json members) const {
  if (!wish_.cell.empty()) members["cell"] = wish_.cell;
  return members.dump() + "\n";
}

// One byte is enough to select JSON. If the peer is a serial line instead, it moves nothing.
std::string WatchModel::opening() {
  is_opened_ = has_sent_token_ = is_asking_lines_ = false;
  return "{";
}

std::vector<std::string> WatchModel::handle(std::string_view line) {
  const Json message = Json::parse(line, nullptr, false);
  const auto op = value_of<std::string>(message, "op");
  if (op == "hello") return handle_hello(message);
  if (op == "result") handle_result(message);
  if (op == "pong" && member(message, "id") == kLastId) is_complete_ = true;
  if (op == "bye") {
    has_left_ = true;
    read(message, "message", known_.last_message);
  }
  if (!is_of_our_cell(message)) return {};
  if (op == "state") handle_state(message);
  if (op == "model") handle_model(message);
  if (op == "display") known_.display = read_display(message);
  if (op == "event") handle_event(message);
  if (op == "image") known_.image = read_image(message);
  return {};
}

bool WatchModel::is_of_our_cell(const Json& message) const {
  return value_of<std::string>(message, "cell", known_.cell) == known_.cell;
}

// Discards data from an earlier connection: the server may be a different one.
std::vector<std::string> WatchModel::handle_hello(const Json& message) {
  known_ = {};
  read(message, "server", known_.server);
  read(message, "cell", known_.cell);
  if (!wish_.cell.empty()) known_.cell = wish_.cell;
  read(member(message, "robot"), "name", known_.robot);
  read(message, "epoch", known_.epoch);
  read(message, "tick", known_.tick);
  read(message, "tick_hz", known_.tick_hz);
  known_.tick_hz = std::max<std::int64_t>(known_.tick_hz, 1);
  read_clock(member(message, "clock"), known_);
  known_.has_control = value_of<std::string>(message, "access") == "control";
  known_.is_locked = value_of<std::string>(message, "access") == "none";
  if (known_.is_locked && wish_.token.empty())
    known_.last_message = "this server shows nothing without its token: " + how_to_unlock();
  return first_requests(member(message, "channels"));
}

std::vector<std::string> WatchModel::first_requests(const Json& channels) {
  const bool is_once = wish_.interest == Interest::kOnce;
  std::vector<std::string> requests;
  if (!std::exchange(is_opened_, true)) requests.emplace_back("\"op\":\"ping\"}\n");
  const auto add = [&](const char* op, const char* channel, const Json& options) {
    if (std::find(channels.begin(), channels.end(), channel) == channels.end()) return;
    Json members{{"op", op}, {"channel", channel}};
    members.update(options);
    requests.push_back(request(members));
  };
  const char* op = is_once ? "get" : "sub";
  const auto limited = [is_once](Json options, int max_hz) {
    if (!is_once) options["max_hz"] = max_hz;
    return options;
  };
  if (!wish_.token.empty() && !std::exchange(has_sent_token_, true)) requests.push_back(auth());
  const std::string last = Json{{"op", "ping"}, {"id", kLastId}}.dump() + "\n";
  if (known_.is_locked) {  // with the token, another `hello` follows
    if (wish_.token.empty()) requests.push_back(last);
    return requests;
  }
  add(op, "model", Json{{"fields", {"robot"}}});
  add(op, "state", limited(Json::object(), kMaxStatesPerS));
  add(op, "display", limited({{"fields", kDisplayFields}}, kMaxStatesPerS));
  add(op, "image", limited({{"encoding", "rle"}}, kMaxImagesPerS));
  // Subscribe first, then get earlier events: an event that arrives both ways has the same seq.
  if (!is_once) add("sub", "event", Json::object());
  add("get", "event", Json::object());
  if (is_once && wish_.wants_lines) requests.push_back(call(kLinesId, "lines", Json::object()));
  requests.push_back(last);  // without the cell: it is answered even if there is no such cell
  return requests;
}

void WatchModel::handle_time(const Json& message) {
  read(message, "epoch", known_.epoch);
  read(message, "tick", known_.tick);
  read_clock(member(message, "clock"), known_);
}

void WatchModel::handle_state(const Json& message) {
  handle_time(message);
  if (member(message, "id") != kTimeId) known_.state = read_state(message);
}

void WatchModel::handle_model(const Json& message) {
  const Json& robot = member(message, "robot");
  read(robot, "name", known_.robot);
  known_.limits.clear();
  const Json& joints = member(robot, "joints");
  if (joints.is_array()) {
    for (const Json& joint : joints) read_limits(joint, known_.limits);
  }
  read_limits(member(robot, "tool"), known_.limits);
  read_limits(member(robot, "carousel"), known_.limits);
}

void WatchModel::handle_event(const Json& message) {
  Note note;
  read(message, "epoch", note.epoch);
  read(message, "tick", note.tick);
  read(message, "event", note.kind);
  read(message, "message", note.message);
  if (member(message, "line").is_number_integer())
    note.line = value_of<std::int64_t>(message, "line");
  // In other events `count` is a position.
  if (note.kind == "warning") note.times = value_of<std::int64_t>(message, "count", 1);
  if (std::ranges::find(kSeenElsewhere, note.kind) != kSeenElsewhere.end()) return;
  known_.notes[value_of<std::int64_t>(message, "seq")] = note;
  if (known_.notes.size() > kMaxNotes) known_.notes.erase(known_.notes.begin());
}

void WatchModel::handle_result(const Json& message) {
  const bool is_of_lines = member(message, "id") == kLinesId;
  if (is_of_lines) is_asking_lines_ = false;
  if (!value_of<bool>(message, "ok")) return handle_refusal(message);
  const Json& value = member(message, "value");
  // A step that changes only the time does not publish a state.
  read(value, "epoch", known_.epoch);
  read(value, "tick", known_.tick);
  if (is_of_lines) known_.lines = read_lines(value);
  const auto access = value_of<std::string>(value, "access");
  if (access.empty()) return;
  known_.has_control = access == "control";
  known_.last_message.clear();
}

void WatchModel::handle_refusal(const Json& message) {
  const Json& error = member(message, "error");
  const auto code = value_of<std::string>(error, "code");
  if (code == "no_camera") return;
  known_.last_message = value_of<std::string>(error, "message", "the server refused a request");
  if (code == "token_required") known_.last_message += ": " + how_to_unlock();
  if (member(message, "id") != kAuthId) return;
  wish_.token.clear();  // not sent again: repeated wrong tokens end the connection
  known_.last_message = "the server refuses this token: " + how_to_unlock();
  if (known_.is_locked) is_complete_ = true;
}

/// The advice to unlock. Names no key where there is none.
std::string WatchModel::how_to_unlock() const {
  return wish_.interest == Interest::kOnce ? "see --token-file and XR3_TOKEN"
                                           : "press t, or use --token-file FILE or XR3_TOKEN";
}

bool WatchModel::may_call() {
  known_.last_message = known_.has_control ? "" : "this key needs the token: " + how_to_unlock();
  return known_.has_control;
}

std::string WatchModel::call(const char* id, const char* fn, Json args) const {
  return request({{"op", "call"}, {"id", id}, {"fn", fn}, {"args", std::move(args)}});
}

std::optional<std::string> WatchModel::ask_time() const {
  if (!known_.state) return {};
  return request({{"op", "get"}, {"id", kTimeId}, {"channel", "state"}, {"fields", {"clock"}}});
}

std::optional<std::string> WatchModel::ask_lines() {
  if (!known_.has_control || std::exchange(is_asking_lines_, true)) return {};
  return call(kLinesId, "lines", Json::object());
}

std::string WatchModel::unlock(std::string token) {
  wish_.token = std::move(token);
  has_sent_token_ = true;
  return auth();
}

std::string WatchModel::auth() const {
  return request({{"op", "auth"}, {"id", kAuthId}, {"token", wish_.token}});
}

std::optional<std::string> WatchModel::ask(const FunctionCall& function) {
  if (!may_call()) return {};
  Json args{{"function", function.function}};
  if (function.value.size() == 1) args["value"] = function.value[0];
  if (function.value.size() > 1) args["value"] = function.value;
  return call(kKeyId, "key", std::move(args));
}

std::optional<std::string> WatchModel::ask(Action action) {
  if (!may_call()) return {};
  // No fields: the state arrives by its channel.
  const auto step = [&](std::int64_t ticks) {
    return call(kKeyId, "step", {{"ticks", ticks}, {"fields", Json::array()}});
  };
  switch (action) {
    case Action::kPauseOrResume:
      return call(kKeyId, known_.mode == WatchedClockMode::kManual ? "resume" : "pause",
                  Json::object());
    case Action::kStep: return step(kStepTicks);
    case Action::kStepSecond: return step(known_.tick_hz);
  }
  return {};
}

}  // namespace xr3::watch
