// Reads entries of a recording: a table of all members, and one of the kinds of entries.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "protocol/explain/event_report.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/saved_cell.hpp"
#include "protocol/recording/byte_text.hpp"
#include "protocol/recording/entry_json.hpp"

namespace xr3::recording {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr std::size_t kMaxBytes = std::size_t{8} << 20U;
constexpr std::size_t kMaxText = 8192;
constexpr int kMaxMicros = 999;
constexpr std::size_t kMaxFnLength = 40;

enum class DeviceChange : std::uint8_t { kOpened, kLost, kSilent };

/// All members that an entry can have.
struct Raw {
  std::optional<Epoch> epoch;
  Tick tick = 0;
  std::optional<int> us;
  std::optional<LineId> line;
  std::optional<LineKind> open;
  std::optional<std::string> peer;
  std::optional<Guard> guard;
  std::optional<SerialSettings> settings;
  std::optional<bool> cooked;
  std::optional<std::string> in;
  std::optional<std::size_t> taken;
  std::optional<std::size_t> unsent;
  std::optional<std::string> out;
  std::optional<bool> input_ended;
  std::optional<bool> silent;
  std::optional<LineCloseReason> close;
  std::optional<DeviceChange> device;
  std::optional<std::string> why;
  std::optional<std::string> device_in;
  std::optional<std::size_t> device_out;
  std::optional<std::string> hash;
  std::optional<std::string> end;
  JsonValue call;
  JsonValue args;
  JsonValue seek;
  std::string check;
};

Codec<SerialSettings> line_settings() {
  return parsed<SerialSettings>(
      "settings such as \"9600-7e2\" or \"9600\"",
      [](JsonValue value) {
        return value.is_text() ? parse_serial_settings(value.text(kMaxText)) : std::nullopt;
      },
      nullptr);
}

Codec<LineKind> line_kind() {
  std::vector<std::pair<std::string, LineKind>> names;
  for (const LineKind kind :
       {LineKind::kTcp, LineKind::kPty, LineKind::kDevice, LineKind::kMonitor})
    names.emplace_back(xr3::name_of(kind), kind);
  return choice(std::move(names));
}

Codec<LineCloseReason> close_reason() {
  std::vector<std::pair<std::string, LineCloseReason>> names;
  for (std::size_t i = 0; i < kLineCloseReasons; ++i) {
    const auto reason = static_cast<LineCloseReason>(i);
    names.emplace_back(code_of(reason), reason);
  }
  return choice(std::move(names));
}

/// A value that is read later.
Member<Raw> raw_member(const char* name, JsonValue Raw::*field) {
  return {name, false, "",
          [field](const Place& place, Raw& raw) { return raw.*field = place.value, true; },
          [](const Raw&) -> std::optional<Json> { return std::nullopt; }};
}

const Members<Raw>& raw_members() {
  constexpr std::int64_t kMax = monitor::kMaxInteger;
  static const Members<Raw> members = {
      required("tick", &Raw::tick, integer<Tick>(0, kMax)),
      optional("line", &Raw::line, integer<LineId>(1, UINT32_MAX)),
      optional("in", &Raw::in, byte_text(kMaxBytes)),
      optional("out", &Raw::out, byte_text(kMaxBytes)),
      optional("epoch", &Raw::epoch, integer<Epoch>(0, kMax)),
      optional("us", &Raw::us, whole_number(1, kMaxMicros)),
      optional("open", &Raw::open, line_kind()),
      optional("peer", &Raw::peer, byte_text(kMaxText)),
      optional("guard", &Raw::guard,
               choice<Guard>(
                   {{"off", Guard::kOff}, {"normal", Guard::kNormal}, {"strict", Guard::kStrict}})),
      optional("settings", &Raw::settings, line_settings()),
      optional("cooked", &Raw::cooked, boolean()),
      optional("taken", &Raw::taken, integer<std::size_t>(0, kMaxBytes)),
      optional("unsent", &Raw::unsent, integer<std::size_t>(0, kMax)),
      optional("input_ended", &Raw::input_ended, boolean()),
      optional("silent", &Raw::silent, boolean()),
      optional("close", &Raw::close, close_reason()),
      optional("device", &Raw::device,
               choice<DeviceChange>({{"opened", DeviceChange::kOpened},
                                     {"lost", DeviceChange::kLost},
                                     {"silent", DeviceChange::kSilent}})),
      optional("why", &Raw::why, byte_text(kMaxText)),
      optional("device_in", &Raw::device_in, byte_text(kMaxBytes)),
      optional("device_out", &Raw::device_out, integer<std::size_t>(1, kMax)),
      optional("hash", &Raw::hash, text(1, kMaxText)),
      optional("end", &Raw::end, text(1, kMaxText)),
      raw_member("call", &Raw::call),
      raw_member("args", &Raw::args),
      raw_member("seek", &Raw::seek),
      optional("c", &Raw::check, text(0, kMaxText))};
  return members;
}

/// A kind of entry: the member that shows it, those that it needs, and those that it may have,
/// beside tick, epoch and us.
struct EntryForm {
  std::string_view shown_by;
  std::vector<std::string_view> needs;
  std::vector<std::string_view> allows;
  std::optional<EntryBody> (*make)(Raw&, Reading&);
};

std::optional<EntryBody> make_input(Raw& raw, Reading& reading) {
  LineInput input{*raw.line, *std::move(raw.in), 0, raw.unsent.value_or(0),
                  std::move(raw.out).value_or("")};
  input.taken = raw.taken.value_or(input.bytes.size());
  if (input.taken <= input.bytes.size()) return input;
  reading.refuse("/taken", std::to_string(input.taken),
                 "at most the " + std::to_string(input.bytes.size()) + " bytes of in");
  return std::nullopt;
}

const monitor::CallForm* call_form(const Place& fn) {
  const bool is_name = fn.value.is_text() && fn.value.text_size() <= kMaxFnLength;
  return is_name ? monitor::find_call(fn.value.text()) : nullptr;
}

/// Reads the JSON of monitor::written(). `args` may be empty, for no arguments. Reports errors at
/// `fn` and in `args`.
std::optional<call::Call> read_call(const Place& fn, JsonValue args) {
  const auto refuse = [&fn] {
    fn.refuse("the name of a call that changes the cell");
    return std::nullopt;
  };
  const monitor::CallForm* form = call_form(fn);
  if (form == nullptr) return refuse();
  monitor::InvalidValues findings;
  monitor::ArgsReader reader(args, args ? args.pointer_from(fn.reading.root()) : "", findings,
                             WorkcellBounds::kSaved);
  monitor::CallValue value = form->read(reader);
  reader.refuse_others();
  for (const monitor::Detail& detail : findings.error({}).details) {
    fn.reading.refuse(detail.pointer, detail.found.is_null() ? "" : shown(detail.found),
                      detail.allowed);
  }
  if (!findings.empty()) return std::nullopt;
  auto* call = std::get_if<call::Call>(&value);
  if (call == nullptr) return refuse();
  return std::move(*call);
}

std::optional<EntryBody> make_call(Raw& raw, Reading& reading) {
  auto call = read_call({reading, raw.call}, raw.args);
  if (!call) return std::nullopt;
  return CallMade{*std::move(call)};
}

std::optional<EntryBody> make_seek(Raw& raw, Reading& reading) {
  Reading inner(raw.seek, Unit::kMm);
  auto saved = read_saved_cell(inner);
  reading.refuse_part("/seek", inner.take_findings());
  if (!saved) return std::nullopt;
  return Rewound{std::make_shared<const SavedCell>(*std::move(saved))};
}

std::optional<EntryBody> make_device(Raw& raw, Reading&) {
  if (*raw.device == DeviceChange::kOpened) return DeviceOpened{};
  if (*raw.device == DeviceChange::kSilent) return DeviceSilent{};
  return DeviceLost{std::move(raw.why).value_or("")};
}

using MaybeBody = std::optional<EntryBody>;

MaybeBody make_begin(Raw& raw, Reading&) {
  return LineBegin{*raw.line, *std::move(raw.peer), *raw.open, *raw.guard};
}
MaybeBody make_setup(Raw& raw, Reading&) {
  return LineSettings{*raw.line, *raw.settings, *raw.cooked};
}
MaybeBody make_input_end(Raw& raw, Reading&) { return InputEnded{*raw.line}; }
MaybeBody make_silence(Raw& raw, Reading&) { return LineSilent{*raw.line}; }
MaybeBody make_line_end(Raw& raw, Reading&) { return LineClosed{*raw.line, *raw.close}; }
MaybeBody make_device_input(Raw& raw, Reading&) { return DeviceInput{*std::move(raw.device_in)}; }
MaybeBody make_device_sent(Raw& raw, Reading&) { return DeviceOut{*raw.device_out}; }
MaybeBody make_end(Raw& raw, Reading&) {
  return End{std::move(raw.hash).value_or(""), *std::move(raw.end)};
}
MaybeBody make_hash(Raw& raw, Reading&) { return StateHash{*std::move(raw.hash)}; }
MaybeBody make_replies(Raw& raw, Reading&) { return Replies{*raw.line, *std::move(raw.out)}; }
MaybeBody make_unsent(Raw& raw, Reading&) { return LineUnsent{*raw.line, *raw.unsent}; }

/// The first form whose member is there counts.
const std::vector<EntryForm>& entry_forms() {
  static const std::vector<EntryForm> forms = {
      {"in", {"line", "in"}, {"taken", "unsent", "out"}, make_input},
      {"out", {"line", "out"}, {}, make_replies},
      {"open", {"line", "open", "peer", "guard"}, {}, make_begin},
      {"settings", {"line", "settings", "cooked"}, {}, make_setup},
      {"input_ended", {"line", "input_ended"}, {}, make_input_end},
      {"silent", {"line", "silent"}, {}, make_silence},
      {"close", {"line", "close"}, {}, make_line_end},
      {"unsent", {"line", "unsent"}, {}, make_unsent},
      {"call", {"call", "args"}, {}, make_call},
      {"seek", {"seek"}, {}, make_seek},
      {"device", {"device"}, {"why"}, make_device},
      {"device_in", {"device_in"}, {}, make_device_input},
      {"device_out", {"device_out"}, {}, make_device_sent},
      {"end", {"end"}, {"hash"}, make_end},
      {"hash", {"hash"}, {}, make_hash}};
  return forms;
}

const EntryForm* form_of(JsonValue root) {
  for (const EntryForm& form : entry_forms()) {
    if (root.find(form.shown_by)) return &form;
  }
  return nullptr;
}

/// Reports members that this kind of entry does not have, and needed ones that are missing.
bool has_form(const EntryForm& form, Reading& reading) {
  static const std::vector<std::string_view> common = {"tick", "epoch", "us", "c"};
  const JsonValue root = reading.root();
  for (const std::string_view name : form.needs) {
    if (!root.find(name))
      reading.refuse("/" + std::string(name), "", "a value beside " + std::string(form.shown_by));
  }
  for (const JsonValue member : root) {
    const JsonValue name = member.name();
    if (name.is_one_of(common) || name.is_one_of(form.needs) || name.is_one_of(form.allows))
      continue;
    reading.refuse(member.pointer_from(root), shown(member),
                   "no such member beside " + std::string(form.shown_by));
  }
  return !reading.has_errors();
}

std::string form_names() {
  std::vector<std::string> names;
  for (const EntryForm& form : entry_forms()) names.emplace_back(form.shown_by);
  return "one of the members " + quoted_names(names);
}

/// Reports an entry that only version 0.1 wrote: it executed bytes of lines after they were due.
bool has_late_bytes(Reading& reading) {
  const JsonValue acted = reading.root().find("acted");
  if (!acted) return false;
  reading.refuse(
      "/acted", shown(acted),
      "no entry \"acted\": bytes of lines are never executed late; replay this recording "
      "with the version of xr3 in its first line, \"program\"");
  return true;
}

}  // namespace

std::optional<Entry> read_entry(Reading& reading, Epoch epoch) {
  Raw raw;
  if (has_late_bytes(reading)) return std::nullopt;
  if (!read_object(Place{reading, reading.root()}, raw_members(), raw)) return std::nullopt;
  const EntryForm* form = form_of(reading.root());
  if (form == nullptr) {
    reading.refuse("", "an entry without them", form_names());
    return std::nullopt;
  }
  if (!has_form(*form, reading)) return std::nullopt;
  auto body = form->make(raw, reading);
  if (!body || reading.has_errors()) return std::nullopt;
  return Entry{raw.epoch.value_or(epoch), raw.tick, raw.us.value_or(0), *std::move(body)};
}

}  // namespace xr3::recording
