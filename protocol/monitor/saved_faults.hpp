// The faults of a machine as a part of its snapshot, and as the list that calls return.
#pragma once

#include "core/state.hpp"
#include "protocol/json/codec.hpp"

namespace xr3 {

/// The faults with their history. Derived members are not written: refresh_faults() restores them.
data::Codec<Faults> saved_faults();

/// Reports faults that the rules of fault files do not allow; `pointer` is that of the faults.
void check_saved_faults(const Faults& faults, const std::string& pointer, data::Reading& reading);

/// Adds `seed` and `faults`: each fault as in a file, with `effects` so far and `active`.
void add_fault_list(const State& state, Json& value);

}  // namespace xr3
