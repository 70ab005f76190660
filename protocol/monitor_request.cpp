#include "protocol/monitor_request.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/monitor_args.hpp"
#include "protocol/monitor_calls.hpp"
#include "protocol/monitor_fields.hpp"
#include "protocol/monitor_tree.hpp"

namespace xr3::monitor {
namespace {

/// What stands there, unless it is long.
std::string quoted(const Tree& value) {
  std::string json = value.dump(-1, ' ', false, Tree::error_handler_t::replace);
  if (json.size() <= kLongestId) return json;
  if (!value.is_string()) return "of " + std::to_string(json.size()) + " bytes";
  return "of " + std::to_string(value.get_ref<const std::string&>().size()) + " bytes";
}

RequestError unknown(const RequestId& id, const std::string& kind, const Tree* found,
                     const std::vector<std::string>& names) {
  const std::string message = found == nullptr ? "the request names no " + kind
                                               : "there is no " + kind + " " + quoted(*found);
  return {id, "unknown_" + kind, message, "there is " + one_of(names), {}};
}

bool names_one(const Tree* value, const std::vector<std::string>& names) {
  if (value == nullptr || !value->is_string()) return false;
  return std::find(names.begin(), names.end(), value->get_ref<const std::string&>()) != names.end();
}

RequestId read_id(ArgsReader& members, Findings& findings) {
  const Tree* value = members.ask("id");
  if (value == nullptr || value->is_null()) return {};
  if (value->is_string() && value->get_ref<const std::string&>().size() <= kLongestId) {
    return value->get<std::string>();
  }
  if (const auto number = whole_number(*value)) return *number;
  findings.add("/id", value, "a text of at most 64 bytes or a whole number below 2^53");
  return {};
}

/// What is wrong inside a document is told as of a file.
std::string in_document(const std::string& pointer) {
  for (const std::string_view document : {"/args/workcell/", "/args/snapshot/"}) {
    if (pointer.starts_with(document)) return pointer.substr(document.size() - 1);
  }
  return pointer;
}

/// Nobody can say which of two members was meant.
void refuse_duplicates(std::string_view message, const Tree& tree, Findings& findings) {
  for_each_duplicate(message, tree, [&](const std::string& pointer, const std::string& name) {
    const Tree found = "\"" + name + "\" for the second time";
    findings.add(in_document(pointer), &found, "each member once");
  });
}

const std::vector<std::string>& ops() {
  static const std::vector<std::string> names = {"auth", "sub", "unsub", "get", "call", "ping"};
  return names;
}

/// The token is not shown again, whatever it is.
Auth read_auth(ArgsReader& members) {
  const Tree* token = members.ask("token");
  if (token != nullptr && token->is_string()) return {token->get<std::string>()};
  members.findings().add(members.pointer_to("token"), nullptr, "a text");
  return {};
}

Selection read_selection(Channel channel, ArgsReader& members) {
  Selection selection{channel, members.fields("fields", channel), Encoding::kRows};
  if (channel != Channel::kImage) return selection;
  const auto encoding =
      data::choice<Encoding>({{"rows", Encoding::kRows}, {"rle", Encoding::kRle}});
  selection.encoding =
      members.coded("encoding", encoding, Presence::kOptional).value_or(Encoding::kRows);
  return selection;
}

std::optional<std::int64_t> read_since(Channel channel, ArgsReader& members) {
  if (is_latest_wins(channel)) return std::nullopt;
  return members.whole("since", 0, kMostInteger, Presence::kOptional);
}

Subscribe read_subscribe(Channel channel, ArgsReader& members) {
  Subscribe wanted;
  wanted.selection = read_selection(channel, members);
  const auto max_hz =
      members.number("max_hz", kLeastMilliHz / 1000.0, kMostMilliHz / 1000.0, Presence::kOptional);
  if (max_hz) wanted.max_millihz = static_cast<MilliHz>(std::lround(*max_hz * 1000));
  wanted.on_change =
      members.coded("on_change", data::boolean(), Presence::kOptional).value_or(true);
  wanted.since = read_since(channel, members);
  return wanted;
}

/// Carries on from the id: reads the members that belong to the op.
class RequestReader {
 public:
  RequestReader(std::string_view message, const Tree& tree, const std::vector<std::string>& cells)
      : cells_(cells), members_(&tree, "", findings_) {
    refuse_duplicates(message, tree, findings_);
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
    const Tree* op = members_.ask("op");
    if (!names_one(op, ops())) return unknown(request_.id, "op", op, ops());
    const Tree* cell = members_.ask("cell");
    if (cell != nullptr && !names_one(cell, cells_))
      return unknown(request_.id, "cell", cell, cells_);
    request_.cell = cell == nullptr ? cells_.front() : cell->get<std::string>();
    return read_op(op->get_ref<const std::string&>());
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
    const Tree* name = members_.ask("channel");
    const auto channel = names_one(name, channels())
                             ? channel_named(name->get_ref<const std::string&>())
                             : std::nullopt;
    if (!channel) return unknown(request_.id, "channel", name, channels());
    if (op == "sub") request_.what = read_subscribe(*channel, members_);
    if (op == "unsub") request_.what = Unsubscribe{*channel};
    if (op == "get")
      request_.what = Get{read_selection(*channel, members_), read_since(*channel, members_)};
    return std::nullopt;
  }

  std::optional<RequestError> read_call_request() {
    const Tree* fn = members_.ask("fn");
    if (!names_one(fn, calls())) return unknown(request_.id, "fn", fn, calls());
    request_.what = read_call(*find_call(fn->get_ref<const std::string&>()), members_);
    return std::nullopt;
  }

  const std::vector<std::string>& cells_;
  Findings findings_;
  ArgsReader members_;
  Request request_;
};

}  // namespace

RequestReading read_request(std::string_view message, const std::vector<std::string>& cells) {
  TreeReading reading = read_tree(message);
  if (RequestError* error = std::get_if<RequestError>(&reading)) return std::move(*error);
  return RequestReader(message, std::get<Tree>(reading), cells).read();
}

std::optional<RequestError> fit(Request& request, Tick now) {
  auto* wanted = std::get_if<CallRequest>(&request.what);
  if (wanted == nullptr) return std::nullopt;
  auto* of_cell = std::get_if<call::Call>(&wanted->call);
  if (of_cell == nullptr) return std::nullopt;
  const Tick room = kMostInteger - now;
  if (auto* run = std::get_if<call::RunUntil>(of_cell))
    run->max_ticks = std::min(run->max_ticks, room);
  const auto* step = std::get_if<call::Step>(of_cell);
  if (step == nullptr || step->ticks <= room) return std::nullopt;
  Findings findings;
  const Tree ticks = step->ticks;
  findings.add("/args/ticks", &ticks,
               "a whole number 0..." + std::to_string(room) + ": no tick lies beyond 2^53-1");
  return findings.error(request.id);
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "\"" + names[i] + "\"";
  }
  return text;
}

}  // namespace xr3::monitor
