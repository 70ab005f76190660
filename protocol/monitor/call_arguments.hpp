// How the args of each call are read into its value. A reader asks for every argument that there is,
// whatever it finds, so that reading nothing tells what the call takes; the value of a reading with
// findings means nothing.
#pragma once

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/calls.hpp"

namespace xr3::monitor {

/// Most bytes of a `send`.
inline constexpr std::size_t kMaxSent = 4096;
/// Longest name of a snapshot, bytes.
inline constexpr std::size_t kMaxSnapshotNameLength = 64;

template <class Call>
CallValue read_nothing(ArgsReader&) {
  return Call{};
}

CallValue read_rate(ArgsReader& args);
CallValue read_step(ArgsReader& args);
CallValue read_run_until(ArgsReader& args);
CallValue read_send(ArgsReader& args);
CallValue read_input(ArgsReader& args);
CallValue read_key(ArgsReader& args);
CallValue read_block_add(ArgsReader& args);
CallValue read_block_move(ArgsReader& args);
CallValue read_block_remove(ArgsReader& args);
CallValue read_workcell_call(ArgsReader& args);
CallValue read_snapshot_save(ArgsReader& args);
CallValue read_snapshot_load(ArgsReader& args);
CallValue read_line_disconnect(ArgsReader& args);
/// The description is of nothing yet: it is the name of the call to be described, or null.
CallValue read_describe(ArgsReader& args);

/// The barrier in `after`, which may be left out.
std::optional<After> read_after(ArgsReader& args);

}  // namespace xr3::monitor
