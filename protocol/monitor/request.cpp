#include "protocol/monitor/request.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/syntax.hpp"
#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/fields.hpp"
#include "protocol/monitor/message.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {
namespace {

// --- The text of a message.

RequestError too_deep() {
  return {{},
          "too_deep",
          "lists and objects lie more than 32 deep",
          "no request needs more than 8",
          {}};
}

/// Over WebSocket a message may have several lines.
RequestError bad_json(TextPlace place, const std::string& what) {
  return {{},
          "bad_json",
          "line " + std::to_string(place.line) + ", column " + std::to_string(place.column) + ": " +
              what,
          "one JSON object a line",
          {}};
}

RequestError syntax_error(const JsonDocument& document) {
  const Finding finding = fault_finding(document, "");
  const std::string found =
      finding.found == "the end of the file" ? "the end of the message" : finding.found;
  return bad_json({finding.line, finding.column}, found + "; allowed: " + finding.allowed);
}

/// Errors found by parsing, without an id.
std::optional<RequestError> refuse_document(const JsonDocument& document) {
  if (document.fault() == JsonDocument::SyntaxFault::kTooDeep) return too_deep();
  if (document.fault() != JsonDocument::SyntaxFault::kNone) return syntax_error(document);
  if (!document.root().is_object())
    return bad_json(place_of(document.text(), document.root().offset()), "no object; allowed: {");
  return std::nullopt;
}

// --- Its members.

/// The value, or its size if it is long.
std::string quoted(JsonValue value) {
  if (value.json_size(kMaxIdBytes) <= kMaxIdBytes) return shown(value).dump();
  const std::size_t size = value.is_text() ? value.text_size() : value.json_size();
  return "of " + std::to_string(size) + " bytes";
}

RequestError unknown(const RequestId& id, const std::string& kind, JsonValue found,
                     const std::vector<std::string>& names) {
  const std::string message =
      found ? "there is no " + kind + " " + quoted(found) : "the request names no " + kind;
  return {id, "unknown_" + kind, message, "there is " + data::quoted_names(names), {}};
}

RequestId read_id(ArgsReader& members, InvalidValues& findings) {
  const JsonValue value = members.ask("id");
  if (const auto id = id_of(value)) return *id;
  findings.add("/id", value, "a text of at most 64 bytes or a whole number below 2^53");
  return {};
}

/// A pointer within a document, as in the findings about a file.
std::string in_document(const std::string& pointer) {
  for (const std::string_view document : {"/args/workcell/", "/args/snapshot/"}) {
    if (pointer.starts_with(document)) return pointer.substr(document.size() - 1);
  }
  return pointer;
}

/// `found` of a duplicate member: its name, or its size if it is long.
Json duplicate_json(JsonValue member) {
  constexpr std::size_t kMaxLength = 200;  // as JSON
  const std::string_view suffix = ", a duplicate";
  const std::size_t size = member.name().text_size() + 2 + suffix.size();
  if (size < kMaxLength) {
    Json found = "\"" + member.name().text() + "\"" + std::string(suffix);
    if (found.dump().size() <= kMaxLength) return found;
  }
  return "string of " + std::to_string(size) + " bytes";
}

/// Duplicates are errors, since it is unclear which of the members is meant.
void refuse_duplicates(const JsonDocument& document, InvalidValues& findings) {
  document.for_each_duplicate([&](JsonValue member) {
    if (!findings.counts()) return;
    findings.keep(in_document(member.pointer_from(document.root())), duplicate_json(member),
                  "each member once");
  });
}

/// An error never quotes the token.
Auth read_auth(ArgsReader& members) {
  const JsonValue token = members.ask("token");
  if (token.is_text()) return {token.text()};
  members.findings().add(members.pointer_to("token"), {}, "a text");
  return {};
}

Selection read_selection(Channel channel, ArgsReader& members) {
  if (channel == Channel::kOverview) return {channel, {}, Encoding::kRows};
  Selection selection{channel, members.fields("fields", channel), Encoding::kRows};
  if (channel != Channel::kImage) return selection;
  const auto encoding =
      data::choice<Encoding>({{"rows", Encoding::kRows}, {"rle", Encoding::kRle}});
  selection.encoding =
      members.coded("encoding", encoding, Presence::kOptional).value_or(Encoding::kRows);
  return selection;
}

std::optional<std::int64_t> read_since(Channel channel, ArgsReader& members) {
  if (is_latest_wins(channel) || channel == Channel::kOverview) return std::nullopt;
  return members.integer("since", 0, kMaxInteger, Presence::kOptional);
}

Subscribe read_subscribe(Channel channel, ArgsReader& members) {
  Subscribe wanted;
  wanted.selection = read_selection(channel, members);
  const auto max_hz =
      members.number("max_hz", kMinMilliHz / 1000.0, kMaxMilliHz / 1000.0, Presence::kOptional);
  if (max_hz) wanted.max_millihz = static_cast<MilliHz>(std::lround(*max_hz * 1000));
  wanted.on_change =
      members.coded("on_change", data::boolean(), Presence::kOptional).value_or(true);
  wanted.since = read_since(channel, members);
  return wanted;
}

/// Reads the id, then the members that belong to the op.
class RequestReader {
 public:
  explicit RequestReader(const JsonDocument& document) : members_(document.root(), "", findings_) {
    refuse_duplicates(document, findings_);
  }

  RequestReading read() {
    request_.id = read_id(members_, findings_);
    std::optional<RequestError> error = read_names();
    if (error) return *std::move(error);
    if (!findings_.empty()) return findings_.error(request_.id);
    return std::move(request_);
  }

 private:
  std::optional<RequestError> read_names() {
    const JsonValue op = members_.ask("op");
    if (!op.is_one_of(ops())) return unknown(request_.id, "op", op, ops());
    const JsonValue cell = members_.ask("cell");
    if (cell && !cell.is_text())
      return RequestError{request_.id,
                          "unknown_cell",
                          "there is no cell " + quoted(cell),
                          "a cell is named by a text; hello lists the names",
                          {}};
    if (cell) request_.cell = cell.text();
    return read_op(op.text());
  }

  std::optional<RequestError> read_op(const std::string& op) {
    if (op == "call") return read_call_request();
    if (op == "ping") return std::nullopt;
    if (op == "auth") {
      request_.what = read_auth(members_);
      return std::nullopt;
    }
    return read_of_channel(op);
  }

  std::optional<RequestError> read_of_channel(const std::string& op) {
    const JsonValue name = members_.ask("channel");
    const auto channel = name.is_one_of(channels()) ? channel_named(name.text()) : std::nullopt;
    if (!channel) return unknown(request_.id, "channel", name, channels());
    if (op == "sub") request_.what = read_subscribe(*channel, members_);
    if (op == "unsub") request_.what = Unsubscribe{*channel};
    if (op == "get")
      request_.what = Get{read_selection(*channel, members_), read_since(*channel, members_)};
    return std::nullopt;
  }

  std::optional<RequestError> read_call_request() {
    const JsonValue fn = members_.ask("fn");
    if (!fn.is_one_of(calls())) return unknown(request_.id, "fn", fn, calls());
    request_.what = read_call(*find_call(fn.text()), members_);
    return std::nullopt;
  }

  InvalidValues findings_;
  ArgsReader members_;
  Request request_;
};

}  // namespace

const std::vector<std::string>& ops() {
  static const std::vector<std::string> names = {"auth", "sub", "unsub", "get", "call", "ping"};
  return names;
}

std::optional<RequestId> id_of(JsonValue value) {
  if (!value || value.is_null()) return RequestId();
  if (value.is_text() && value.text_size() <= kMaxIdBytes) return value.text();
  if (const auto number = whole_number(value)) return *number;
  return std::nullopt;
}

RequestReading read_request(std::string_view message) {
  if (message.size() > kMaxMessageBytes)
    return RequestError{
        {}, "too_long", "a message has at most 262144 bytes", "send less at once", {}};
  const JsonDocument document(message);
  if (auto error = refuse_document(document)) return *std::move(error);
  return RequestReader(document).read();
}

std::optional<RequestError> limit_ticks(Request& request, Tick now) {
  auto* wanted = std::get_if<CallRequest>(&request.what);
  if (wanted == nullptr) return std::nullopt;
  auto* of_cell = std::get_if<call::Call>(&wanted->call);
  if (of_cell == nullptr) return std::nullopt;
  const Tick room = kMaxInteger - now;
  if (auto* run = std::get_if<call::RunUntil>(of_cell))
    run->max_ticks = std::min(run->max_ticks, room);
  const auto* step = std::get_if<call::Step>(of_cell);
  if (step == nullptr || step->ticks <= room) return std::nullopt;
  InvalidValues findings;
  if (findings.counts())
    findings.keep("/args/ticks", step->ticks,
                  "a whole number 0..." + std::to_string(room) + ": no tick lies beyond 2^53-1");
  return findings.error(request.id);
}

RequestError unknown_cell(const Request& request, const std::vector<std::string>& known) {
  constexpr std::size_t kMaxListed = 8;
  constexpr std::size_t kMaxSearched = 256;  // a comparison takes some 1 us
  if (known.empty()) return {request.id, "unknown_cell", "there is no cell", "open one first", {}};
  std::vector<std::string> listed = known;
  if (listed.size() > kMaxListed) listed.resize(kMaxListed);
  std::string hint = "there is " + data::quoted_names(listed);
  if (known.size() > kMaxListed)
    hint = "the call cells lists them; for example " + data::quoted_names(listed);
  if (!request.cell)
    return {request.id, "unknown_cell", "the request names no cell, and hello had none", hint, {}};
  const std::string& name = *request.cell;
  const bool is_searched = known.size() > 1 && known.size() <= kMaxSearched;
  const std::string nearest =
      is_searched && name.size() <= kMaxIdBytes ? data::nearest_name(name, known) : "";
  if (!nearest.empty()) hint += "; perhaps \"" + nearest + "\" was meant";
  const std::string shown = name.size() <= kMaxIdBytes
                                ? text_of(Json(name))
                                : "of " + std::to_string(name.size()) + " bytes";
  return {request.id, "unknown_cell", "there is no cell " + shown, hint, {}};
}

}  // namespace xr3::monitor
