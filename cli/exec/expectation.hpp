// The verdict that a program of an exercise must get.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "tools/report/run_report.hpp"

namespace xr3 {

class Expectation {
 public:
  static Expectation all_goals() { return Expectation(ExpectationKind::kAllGoals, "", ""); }
  static Expectation no_points() { return Expectation(ExpectationKind::kNoPoints, "", ""); }
  /// An expectation in words: `failed` or `time_up`; or the kind of a goal that is missed, with a
  /// part of its `found`.
  static Expectation stated(std::string what, std::string part) {
    return Expectation(ExpectationKind::kStated, std::move(what), std::move(part));
  }

  bool is_stated() const { return kind_ == ExpectationKind::kStated; }
  /// The difference of a report from the expectation; empty if there is none.
  std::string trouble_of(const RunReport& report) const;

 private:
  enum class ExpectationKind : std::uint8_t { kAllGoals, kNoPoints, kStated };
  Expectation(ExpectationKind kind, std::string what, std::string part)
      : kind_(kind), what_(std::move(what)), part_(std::move(part)) {}
  bool is_as_stated(const RunReport& report) const;

  ExpectationKind kind_;
  std::string what_;
  std::string part_;
};

/// The expectation in the first line of a wrong program, a comment: `expects: WHAT: PART` or
/// `expects: WHAT`. Throws FileError if there is none.
Expectation stated_expectation(const std::filesystem::path& program);

}  // namespace xr3
