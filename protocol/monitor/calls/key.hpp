// The call `key`: the functions of the controller's command mode (paper, Table IV) by name.
#pragma once

#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {

/// Reads and writes the args of `key`; see CallForm.
CallValue read_key(ArgsReader& args);
Json write_key(const call::Key& key);

}  // namespace xr3::monitor
