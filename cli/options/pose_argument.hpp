// A pose given on the command line: joint variables in degrees and mm, converted to counts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "protocol/text/numbers.hpp"
#include "server/base/exit_code.hpp"

namespace xr3 {

/// An invalid argument; the message names it and the allowed values.
class ArgumentError : public ExitError {
 public:
  explicit ArgumentError(const std::string& what) : ExitError(ExitCode::kBadInput, what) {}
};

/// The counts nearest to the joint variables, from the base on (degrees or mm; if empty, the soft
/// home), and to the tool variable. Throws ArgumentError for a wrong number of values or one out of
/// its limits.
Positions pose_argument(const Model& model, const std::vector<double>& joints,
                        std::optional<double> tool);

}  // namespace xr3
