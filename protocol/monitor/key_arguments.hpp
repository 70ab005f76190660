// The call `key`: the functions of the controller's command mode (paper, Table IV) by name.
#pragma once

#include "protocol/monitor/arguments.hpp"
#include "protocol/monitor/call_table.hpp"

namespace xr3::monitor {

/// Reads the args of `key` as the other readers of call_table.cpp do.
CallValue read_key(ArgsReader& args);

}  // namespace xr3::monitor
