// Entries of a recording as JSON, one object on one line each.
#pragma once

#include <optional>
#include <string>

#include "protocol/json/codec.hpp"
#include "protocol/recording/entry.hpp"

namespace xr3::recording {

/// The members of an entry, without the closing brace. `epoch` is that of the entry before, which
/// is not repeated.
std::string members_of(const Entry& entry, Epoch epoch);

/// Reads what members_of() has made, with its closing brace and beside a member `c`. Errors go to
/// the reading.
std::optional<Entry> read_entry(data::Reading& reading, Epoch epoch);

}  // namespace xr3::recording
