// Members of a request read one by one: each that is missing, of the wrong kind or out of range is
// noted with its pointer, and reading goes on, so that a client hears of all of them at once.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocol/monitor_request.hpp"

namespace xr3::monitor {

/// A message as it was parsed: a map, so that no message is slow to take in.
using Tree = nlohmann::json;

/// Wrong values found so far; of very many only the first are kept.
class Findings {
 public:
  static constexpr std::size_t kMostDetails = 32;

  /// `found` may be null: nothing stands there. A long one is told by its size.
  void add(std::string pointer, const Tree* found, std::string allowed);

  bool empty() const { return count_ == 0; }
  /// The error `bad_args` with everything that was found.
  RequestError error(RequestId id) const;

 private:
  std::size_t count_ = 0;
  std::vector<Detail> details_;
};

/// A whole number within +-kMostInteger, also where it is written as 5.0 or 5e0.
std::optional<std::int64_t> whole_number(const Tree& value);

class ArgsReader {
 public:
  /// `object` may be null: an empty one. `pointer` is where it stands in the message.
  ArgsReader(const Tree* object, std::string pointer, Findings& findings)
      : object_(object), pointer_(std::move(pointer)), findings_(findings) {}

  /// The member, or null; it counts as known from now on.
  const Tree* find(const std::string& name);

  /// A whole number that must be there; `low` where it is not, or is wrong.
  std::int64_t whole(const std::string& name, std::int64_t low, std::int64_t high);
  /// The same, but it may be left out.
  std::int64_t whole_or(const std::string& name, std::int64_t low, std::int64_t high,
                        std::int64_t otherwise);
  /// A number that must be there; `low` where it is not, or is wrong.
  double number(const std::string& name, double low, double high);
  /// A list of names of members of `state`, or nothing where it is left out.
  Fields fields(const std::string& name);
  /// An object inside this one, or null where it is left out or wrong.
  const Tree* object(const std::string& name);

  std::string pointer_to(const std::string& name) const;
  void refuse(const std::string& name, std::string allowed);
  /// Notes every member that was not asked for.
  void refuse_others();

 private:
  const Tree* object_;
  std::string pointer_;
  Findings& findings_;
  std::vector<std::string> known_;
};

}  // namespace xr3::monitor
