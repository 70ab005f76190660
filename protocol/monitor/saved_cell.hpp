// A saved cell as JSON and back, exact to the last bit: the state is integers and is written so, the
// workcell has the form of its file. What comes back is read strictly, so that nothing that a client
// made up can bring the machine into a state from which it could not run on.
#pragma once

#include <optional>
#include <vector>

#include "core/model.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/json/finding.hpp"
#include "protocol/monitor/call.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {

/// `{"robot_hash","workcell","state"}`; lengths of the state in micrometres, angles in microdegrees.
Json saved_cell_to_json(const SavedCell& saved);

/// A saved cell, unless a finding is an error, and everything found in it.
struct SavedCellReading {
  std::optional<SavedCell> saved;
  Findings findings;
};

/// Reads what saved_cell_to_json() made, with what is wrong in the reading.
std::optional<SavedCell> read_saved_cell(data::Reading& reading);
/// The same, of JSON that is at hand; pointers begin at `json`. Never throws.
SavedCellReading read_saved_cell(const Json& json);

}  // namespace xr3

namespace xr3::monitor {

/// A request can carry it back: beside its JSON, written without blanks, there is room for the call.
bool fits_a_request(const SavedCell& saved);

/// What a machine with this model's robot and profile could never have come to in the saved workcell:
/// joints outside their limits, switches that do not follow their counts, a tip inside the protected
/// region, jaws open about what they hold... Pointers begin at the saved cell. Nothing: it can be loaded.
std::vector<Detail> misfits(const Model& model, const SavedCell& saved);

}  // namespace xr3::monitor
