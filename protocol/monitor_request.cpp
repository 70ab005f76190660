#include "protocol/monitor_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "protocol/json_syntax.hpp"
#include "protocol/monitor_args.hpp"

namespace xr3::monitor {
namespace {

// --- From text to a tree.

/// Listens to the parser for nothing but its complaint.
class ComplaintListener : public nlohmann::json_sax<Tree> {
 public:
  explicit ComplaintListener(std::string_view text) : text_(text) {}
  const Finding& finding() const { return finding_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_object() override { return true; }
  bool end_array() override { return true; }
  bool key(string_t&) override { return true; }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& error) override {
    finding_ = syntax_finding(text_, "", {position, last_token, error.what()});
    return false;
  }

 private:
  std::string_view text_;
  Finding finding_;
};

/// How deep lists and objects lie inside one another; brackets inside texts do not count.
int depth_of(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if (c == '}' || c == ']') --depth;
  }
  return deepest;
}

RequestError bad_json(std::size_t column, const std::string& what) {
  return {{},
          "bad_json",
          "line 1, column " + std::to_string(column) + ": " + what,
          "one JSON object a line",
          {}};
}

RequestError syntax_error(std::string_view message) {
  ComplaintListener listener(message);
  Tree::sax_parse(message, &listener);
  const Finding& finding = listener.finding();
  const std::string found =
      finding.found == "the end of the file" ? "the end of the message" : finding.found;
  return bad_json(static_cast<std::size_t>(finding.column),
                  found + "; allowed: " + finding.allowed);
}

using TreeReading = std::variant<Tree, RequestError>;

TreeReading read_tree(std::string_view message) {
  if (message.size() > kMostMessageBytes) {
    return RequestError{
        {}, "too_long", "a message has at most 262144 bytes", "send less at once", {}};
  }
  if (depth_of(message) > kDeepest) {
    return RequestError{{},
                        "too_deep",
                        "lists and objects lie more than 32 deep",
                        "no request needs more than 4",
                        {}};
  }
  const std::size_t nul = message.find('\0');  // the parser would take it for the end
  if (nul != std::string_view::npos) return bad_json(nul + 1, "a NUL byte; allowed: JSON in UTF-8");
  Tree tree = Tree::parse(message, nullptr, false);
  if (tree.is_discarded()) return syntax_error(message);
  if (!tree.is_object()) return bad_json(1, "no object; allowed: {");
  return tree;
}

// --- The calls.

template <class Call>
call::Call without_args(ArgsReader&) {
  return Call{};
}

call::Call read_rate(ArgsReader& args) {
  const double factor = args.number("factor", 0.001, 100'000);
  return call::SetRate{{std::llround(factor * 1e6)}};
}

call::Call read_step(ArgsReader& args) { return call::Step{args.whole("ticks", 0, kMostInteger)}; }

call::Call read_run_until(ArgsReader& args) {
  call::RunUntil run;
  const Tree* idle = args.find("idle");
  const bool has_tick = args.find("tick") != nullptr;
  if (has_tick) run.tick = args.whole("tick", 0, kMostInteger);
  if (idle != nullptr && (has_tick || *idle != true)) args.refuse("idle", "true, and then no tick");
  if (idle == nullptr && !has_tick) args.refuse("idle", "true, or else a tick");
  run.max_ticks = args.whole("max_ticks", 0, kMostInteger);
  return run;
}

struct CallForm {
  std::string_view fn;
  call::Call (*read)(ArgsReader&);
  bool moves_time = false;  ///< takes `after` and `fields`
};

constexpr std::array kForms = {
    CallForm{"pause", without_args<call::Pause>},
    CallForm{"resume", without_args<call::Resume>},
    CallForm{"rate", read_rate},
    CallForm{"step", read_step, true},
    CallForm{"run_until", read_run_until, true},
    CallForm{"reset", without_args<call::Reset>},
    CallForm{"home", without_args<call::Home>},
};

std::optional<After> read_after(const Tree* object, const std::string& pointer,
                                Findings& findings) {
  if (object == nullptr) return std::nullopt;
  ArgsReader args(object, pointer, findings);
  After after;
  after.line = static_cast<std::uint32_t>(args.whole("line", 1, UINT32_MAX));
  after.bytes_in = static_cast<std::uint64_t>(args.whole("bytes_in", 0, kMostInteger));
  after.within_ms = static_cast<int>(args.whole_or("within_ms", 0, kMostWithinMs, after.within_ms));
  args.refuse_others();
  return after;
}

CallRequest read_call(const CallForm& form, ArgsReader& members, Findings& findings) {
  ArgsReader args(members.object("args"), "/args", findings);
  CallRequest request{std::string(form.fn), form.read(args), {}, {}};
  if (form.moves_time) {
    request.after = read_after(args.object("after"), "/args/after", findings);
    request.fields = args.fields("fields");
  }
  args.refuse_others();
  return request;
}

// --- The whole request.

/// What stands there, unless it is long.
std::string quoted(const Tree& value) {
  const std::string text = value.dump(-1, ' ', false, Tree::error_handler_t::replace);
  return text.size() <= kLongestId ? text : "a value of " + std::to_string(text.size()) + " bytes";
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
  const Tree* value = members.find("id");
  if (value == nullptr || value->is_null()) return {};
  if (value->is_string() && value->get_ref<const std::string&>().size() <= kLongestId) {
    return value->get<std::string>();
  }
  if (const auto number = whole_number(*value)) return *number;
  findings.add("/id", value, "a text of at most 64 bytes or a whole number below 2^53");
  return {};
}

const std::vector<std::string>& ops() {
  static const std::vector<std::string> names = {"get", "call", "ping"};
  return names;
}

/// Carries on from the id: reads the members that belong to the op.
class RequestReader {
 public:
  RequestReader(const Tree& tree, const std::vector<std::string>& cells)
      : cells_(cells), members_(&tree, "", findings_) {}

  RequestReading read() {
    request_.id = read_id(members_, findings_);
    std::optional<RequestError> error = read_names();
    if (error) return *std::move(error);
    if (!findings_.empty()) return findings_.error(request_.id);
    return std::move(request_);
  }

 private:
  std::optional<RequestError> read_names() {
    const Tree* op = members_.find("op");
    if (!names_one(op, ops())) return unknown(request_.id, "op", op, ops());
    const Tree* cell = members_.find("cell");
    if (cell != nullptr && !names_one(cell, cells_))
      return unknown(request_.id, "cell", cell, cells_);
    request_.cell = cell == nullptr ? cells_.front() : cell->get<std::string>();
    if (*op == "get") return read_get();
    if (*op == "call") return read_call_request();
    return std::nullopt;
  }

  std::optional<RequestError> read_get() {
    const Tree* channel = members_.find("channel");
    if (!names_one(channel, channels()))
      return unknown(request_.id, "channel", channel, channels());
    request_.what = Get{Selection{Channel::kState, members_.fields("fields"), Encoding::kRows}, {}};
    return std::nullopt;
  }

  std::optional<RequestError> read_call_request() {
    const Tree* fn = members_.find("fn");
    if (!names_one(fn, calls())) return unknown(request_.id, "fn", fn, calls());
    const auto& name = fn->get_ref<const std::string&>();
    const auto* form = std::find_if(kForms.begin(), kForms.end(),
                                    [&name](const CallForm& each) { return each.fn == name; });
    request_.what = read_call(*form, members_, findings_);
    return std::nullopt;
  }

  const std::vector<std::string>& cells_;
  Findings findings_;
  ArgsReader members_;
  Request request_;
};

}  // namespace

const std::vector<std::string>& channels() {
  static const std::vector<std::string> names = {"state"};
  return names;
}

const std::vector<std::string>& calls() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const CallForm& form : kForms) all.emplace_back(form.fn);
    return all;
  }();
  return names;
}

RequestReading read_request(std::string_view message, const std::vector<std::string>& cells) {
  TreeReading reading = read_tree(message);
  if (RequestError* error = std::get_if<RequestError>(&reading)) return std::move(*error);
  return RequestReader(std::get<Tree>(reading), cells).read();
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
