#include "protocol/monitor/call_table.hpp"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>
#include <utility>

namespace xr3::monitor {
namespace {

/// All calls, in the order in which `hello` lists them.
const std::vector<CallForm>& forms() {
  static const std::vector<CallForm> all = [] {
    std::vector<CallForm> joined;
    for (const CallForms group :
         {time_calls(), machine_calls(), inverse_calls(), workcell_calls(), snapshot_calls(),
          fault_calls(), line_calls(), past_calls(), server_calls()})
      joined.insert(joined.end(), group.begin(), group.end());
    return joined;
  }();
  return all;
}

/// The barrier in `after`, which may be omitted.
std::optional<After> read_after(ArgsReader& args) {
  const JsonValue object = args.object("after", Presence::kOptional,
                                       "an object of line, bytes_in and, where it is not 1000, "
                                       "within_ms");
  if (!object) return std::nullopt;
  ArgsReader members(object, args.pointer_to("after"), args.findings());
  After after;
  after.line = static_cast<std::uint32_t>(members.integer("line", 1, UINT32_MAX).value_or(1));
  after.bytes_in =
      static_cast<std::uint64_t>(members.integer("bytes_in", 0, kMaxInteger).value_or(0));
  after.within_ms = static_cast<int>(
      members.integer("within_ms", 0, kMaxWithinMs, Presence::kOptional).value_or(after.within_ms));
  members.refuse_others();
  return after;
}

/// Reads args, and the members beside them.
CallRequest read_args(const CallForm& form, ArgsReader& args) {
  CallRequest request{std::string(form.fn), form.read(args), {}, {}};
  const auto* of_cell = std::get_if<call::Call>(&request.call);
  if (of_cell != nullptr && call::traits_of(*of_cell).moves_time) {
    request.after = read_after(args);
    request.fields = args.fields("fields", Channel::kState);
  }
  return request;
}

/// The arguments that the call's reader requests from an empty object.
Json form_json(const CallForm& form) {
  InvalidValues ignored;
  ArgsReader nothing({}, "", ignored);
  read_args(form, nothing);
  Json args = Json::array();
  for (const Asked& each : nothing.asked()) {
    args.push_back(
        {{"name", each.name}, {"required", each.is_required}, {"allowed", each.allowed}});
  }
  return {{"fn", form.fn}, {"purpose", form.purpose}, {"args", std::move(args)}};
}

}  // namespace

const CallForm* find_call(std::string_view fn) {
  const auto form = std::find_if(forms().begin(), forms().end(),
                                 [&fn](const CallForm& each) { return each.fn == fn; });
  return form == forms().end() ? nullptr : &*form;
}

CallRequest read_call(const CallForm& form, ArgsReader& members) {
  const JsonValue object = members.object("args", Presence::kOptional);
  ArgsReader args(object, members.pointer_to("args"), members.findings());
  CallRequest request = read_args(form, args);
  args.refuse_others();
  return request;
}

WrittenCall written(const call::Call& call) {
  for (const CallForm& form : forms()) {
    if (form.write == nullptr) continue;
    if (auto args = form.write(call)) return {form.fn, *std::move(args)};
  }
  assert(false);  // every call of the cell has a form that writes it
  return {};
}

Json description(const std::optional<std::string>& fn) {
  Json calls = Json::array();
  for (const CallForm& form : forms()) {
    if (!fn || form.fn == *fn) calls.push_back(form_json(form));
  }
  return {{"calls", std::move(calls)}};
}

const std::vector<std::string>& calls() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const CallForm& form : forms()) all.emplace_back(form.fn);
    return all;
  }();
  return names;
}

}  // namespace xr3::monitor
