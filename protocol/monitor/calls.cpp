#include "protocol/monitor/calls.hpp"

#include <algorithm>
#include <array>

#include "protocol/monitor/call_arguments.hpp"

namespace xr3::monitor {
namespace {

using Time = CallForm::Time;

constexpr std::array kForms = {
    CallForm{"pause", "Stops simulated time; the clock is then manual.", read_nothing<call::Pause>},
    CallForm{"resume", "Makes simulated time follow the wall clock again.",
             read_nothing<call::Resume>},
    CallForm{"rate", "Sets the number of simulated seconds per second.", read_rate},
    CallForm{"step", "Advances simulated time by a number of ticks; needs the manual clock.",
             read_step, Time::kMoves},
    CallForm{"run_until",
             "Advances simulated time until nothing moves or to a tick; needs the manual clock.",
             read_run_until, Time::kMoves},
    CallForm{"reset", "Begins a new epoch with the initial state of the files.",
             read_nothing<call::Reset>},
    CallForm{"home", "Moves the robot to its soft home, as A$ does.", read_nothing<call::Home>},
    CallForm{"send", "Sends bytes on a serial line that belongs to this client.", read_send},
    CallForm{"input", "Sets an input line high or low.", read_input},
    CallForm{"block_add", "Adds a block to the workcell.", read_block_add},
    CallForm{"block_move", "Moves a block.", read_block_move},
    CallForm{"block_remove", "Removes a block.", read_block_remove},
    CallForm{"workcell", "Replaces the workcell.", read_workcell_call},
    CallForm{"snapshot_save", "Saves state and workcell under a name, or returns them.",
             read_snapshot_save},
    CallForm{"snapshot_load", "Begins a new epoch with a saved state and workcell.",
             read_snapshot_load},
    CallForm{"lines", "Lists the open serial lines.", read_nothing<ListLines>},
    CallForm{"line_disconnect", "Closes a serial line.", read_line_disconnect},
    CallForm{"key", "Runs a function of the controller's command mode.", read_key},
    CallForm{"describe", "Lists the calls and their arguments.", read_describe},
};

/// Reads all members of args.
CallRequest read_args(const CallForm& form, ArgsReader& args) {
  CallRequest request{std::string(form.fn), form.read(args), {}, {}};
  if (form.time == Time::kMoves) {
    request.after = read_after(args);
    request.fields = args.fields("fields", Channel::kState);
  }
  return request;
}

/// The arguments that the call's reader requests from an empty object.
Json form_json(const CallForm& form) {
  Findings ignored;
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
  const auto* form = std::find_if(kForms.begin(), kForms.end(),
                                  [&fn](const CallForm& each) { return each.fn == fn; });
  return form == kForms.end() ? nullptr : form;
}

CallRequest read_call(const CallForm& form, ArgsReader& members) {
  const JsonValue object = members.object("args", Presence::kOptional);
  ArgsReader args(object, members.pointer_to("args"), members.findings());
  CallRequest request = read_args(form, args);
  args.refuse_others();
  // read_describe() cannot build the description, since that runs every reader, including itself.
  if (auto* described = std::get_if<Describe>(&request.call)) {
    const Json& fn = described->description;
    described->description =
        description(fn.is_string() ? std::optional(fn.get<std::string>()) : std::nullopt);
  }
  return request;
}

Json description(const std::optional<std::string>& fn) {
  Json calls = Json::array();
  for (const CallForm& form : kForms) {
    if (!fn || form.fn == *fn) calls.push_back(form_json(form));
  }
  return {{"calls", std::move(calls)}};
}

const std::vector<std::string>& calls() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const CallForm& form : kForms) all.emplace_back(form.fn);
    return all;
  }();
  return names;
}

}  // namespace xr3::monitor
