// Converts fault files (docs/faults.md) from text to values and back, and single faults for calls
// and snapshots. The text comes from the caller; no file is read here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/faults/fault_state.hpp"
#include "core/model.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// Reads and checks a fault file. `labels`: those of the robot's motors; empty if the robot is not
/// known. Syntax errors are findings, too. Never throws.
FileReading<FaultPlan> read_faults(std::string_view text, const std::string& file,
                                   std::string_view labels = "");

/// Reads and checks a fault file. Throws DataError with all findings if one of them is an error.
FaultPlan load_faults(std::string_view text, const std::string& file, std::string_view labels);

/// Reads and checks one fault; errors go to the reading.
std::optional<Fault> read_fault(data::Reading& reading);

/// The JSON of a fault, as in a file; the JSON of a file; and the summary that `xr3 check` prints
/// of a good one.
Json fault_to_json(const Fault& fault);
Json faults_to_json(const FaultPlan& plan);
std::string faults_summary(const FaultPlan& plan);

}  // namespace xr3

namespace xr3::data {

/// The members of a fault, without the rules that concern several of them.
const Members<Fault>& fault_members();

/// The label of a motor of any robot.
Codec<char> motor_label();

/// Whole numbers that fit both JSON and the seed.
Codec<std::uint64_t> fault_seed();

}  // namespace xr3::data
