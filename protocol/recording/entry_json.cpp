#include "protocol/recording/entry_json.hpp"

#include <nlohmann/json.hpp>

#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/recording/byte_text.hpp"

namespace xr3::recording {
namespace {

void append(std::string& json, std::string_view name, std::uint64_t number) {
  json += ",\"";
  json += name;
  json += "\":" + std::to_string(number);
}

void append_bytes(std::string& json, std::string_view name, std::string_view bytes) {
  json += ",\"";
  json += name;
  json += "\":";
  append_byte_text(bytes, json);
}

void append_flag(std::string& json, std::string_view name, bool value) {
  json += ",\"";
  json += name;
  json += value ? "\":true" : "\":false";
}

std::string_view name_of(Guard guard) {
  switch (guard) {
    case Guard::kOff: return "off";
    case Guard::kNormal: return "normal";
    case Guard::kStrict: return "strict";
  }
  return "";
}

struct EntryWriter {
  std::string& json;

  void operator()(const LineBegin& begin) const {
    append(json, "line", begin.line);
    append_bytes(json, "open", xr3::name_of(begin.kind));
    append_bytes(json, "peer", begin.peer);
    append_bytes(json, "guard", name_of(begin.guard));
  }
  void operator()(const LineSettings& setup) const {
    append(json, "line", setup.line);
    append_bytes(json, "settings", text_of(setup.settings));
    append_flag(json, "cooked", setup.is_cooked);
  }
  void operator()(const LineInput& input) const {
    append(json, "line", input.line);
    append_bytes(json, "in", input.bytes);
    if (input.taken < input.bytes.size()) append(json, "taken", input.taken);
    if (input.unsent > 0) append(json, "unsent", input.unsent);
    if (!input.replies.empty()) append_bytes(json, "out", input.replies);
  }
  void operator()(const LineUnsent& left) const {
    append(json, "line", left.line);
    append(json, "unsent", left.unsent);
  }
  void operator()(const InputEnded& end) const {
    append(json, "line", end.line);
    append_flag(json, "input_ended", true);
  }
  void operator()(const LineSilent& silence) const {
    append(json, "line", silence.line);
    append_flag(json, "silent", true);
  }
  void operator()(const LineClosed& end) const {
    append(json, "line", end.line);
    append_bytes(json, "close", code_of(end.reason));
  }
  void operator()(const CallMade& made) const {
    const monitor::WrittenCall call = monitor::written(made.call);
    append_bytes(json, "call", call.fn);
    json += ",\"args\":" + call.args.dump(-1, ' ', true);
  }
  void operator()(const Rewound& rewound) const {
    json += ",\"seek\":" + saved_cell_to_json(*rewound.saved).dump(-1, ' ', true);
  }
  void operator()(const DeviceOpened&) const { append_bytes(json, "device", "opened"); }
  void operator()(const DeviceLost& gone) const {
    append_bytes(json, "device", "lost");
    append_bytes(json, "why", gone.why);
  }
  void operator()(const DeviceInput& input) const { append_bytes(json, "device_in", input.bytes); }
  void operator()(const DeviceOut& sent) const { append(json, "device_out", sent.count); }
  void operator()(const DeviceSilent&) const { append_bytes(json, "device", "silent"); }
  void operator()(const Replies& replies) const {
    append(json, "line", replies.line);
    append_bytes(json, "out", replies.bytes);
  }
  void operator()(const StateHash& state) const { append_bytes(json, "hash", state.hash); }
  void operator()(const End& end) const {
    append_bytes(json, "end", end.why);
    if (!end.hash.empty()) append_bytes(json, "hash", end.hash);
  }
};

}  // namespace

std::string members_of(const Entry& entry, Epoch epoch) {
  std::string json = "{\"tick\":" + std::to_string(entry.tick);
  if (entry.epoch != epoch) append(json, "epoch", static_cast<std::uint64_t>(entry.epoch));
  if (entry.us != 0) append(json, "us", static_cast<std::uint64_t>(entry.us));
  std::visit(EntryWriter{json}, entry.body);
  return json;
}

}  // namespace xr3::recording
