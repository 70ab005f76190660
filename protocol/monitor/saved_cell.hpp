// Converts a saved cell to JSON and back, bit-identically: the state consists of integers, the
// workcell has the form of its file. Reading is strict, so that invented data of a client cannot
// put the machine into a state from which it cannot continue.
#pragma once

#include <optional>
#include <vector>

#include "core/model.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/json/finding.hpp"
#include "protocol/monitor/call.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3 {

/// `{"robot_hash","workcell","state"}` of a saved cell; lengths of the state in micrometres, angles
/// in microdegrees.
Json saved_cell_to_json(const SavedCell& saved);

/// The JSON of the member `state` alone.
Json saved_state_to_json(const State& state);

/// Reads the JSON of saved_cell_to_json(); errors go to the reading.
std::optional<SavedCell> read_saved_cell(data::Reading& reading);
/// Reads a saved cell from a JSON value; pointers begin at `json`. Never throws.
FileReading<SavedCell> read_saved_cell(const Json& json);

}  // namespace xr3

namespace xr3::monitor {

/// Whether a request can hold the saved cell: its JSON without blanks plus the rest of the call.
bool fits_a_request(const SavedCell& saved);

/// Validates a saved cell. Returns everything that a machine with this model's robot and profile
/// cannot reach in the saved workcell: joints outside their limits, switches that do not match
/// their counts, a tip inside the protected region, jaws that do not touch the block they hold...
/// Pointers begin at the saved cell. If the result is empty, the saved cell can be loaded.
std::vector<Detail> validate(const Model& model, const SavedCell& saved);

}  // namespace xr3::monitor
