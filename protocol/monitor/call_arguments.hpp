// Reads the args of each call into its value. A reader requests every argument regardless of what
// it finds, so that reading an empty object yields the description of the call. If there are
// findings, the returned value is meaningless.
#pragma once

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/calls.hpp"

namespace xr3::monitor {

/// Maximum size of a `send` in bytes.
inline constexpr std::size_t kMaxSent = 4096;
/// Maximum length of a snapshot's name in bytes.
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
/// The description is not built yet: it holds the name of the call to describe, or null for all.
CallValue read_describe(ArgsReader& args);

/// The barrier in `after`, which may be omitted.
std::optional<After> read_after(ArgsReader& args);

}  // namespace xr3::monitor
