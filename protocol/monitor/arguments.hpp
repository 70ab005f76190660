// Reads the members of a request. A missing member, or one of the wrong kind or out of range, is
// recorded with its pointer, and reading continues, so that a client receives all errors at once.
// The requested members are recorded, too: run on an empty object, a reader describes its
// arguments.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/files/workcell.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/monitor/request.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::monitor {

/// The invalid values of a request. Stores the first kMaxDetails of them and counts the others.
class InvalidValues {
 public:
  static constexpr std::size_t kMaxDetails = 32;

  /// Counts an invalid value. Returns whether the caller should store it with keep(); if not, its
  /// texts need not be built.
  bool counts() { return count_++ < kMaxDetails; }
  /// Stores an invalid value that counts() has counted.
  void keep(const std::string& pointer, Json found, std::string allowed);
  /// Counts and stores an invalid value. `found` may be empty; a long one is described by its size.
  void add(const std::string& pointer, JsonValue found, std::string allowed);
  /// Adds the errors of a reading of the value at the pointer `at`.
  void add_errors(const data::Reading& reading, const std::string& at);

  bool empty() const { return count_ == 0; }
  /// The error `bad_args` with all stored details.
  RequestError error(RequestId id) const;

 private:
  std::size_t count_ = 0;
  std::vector<Detail> details_;
};

/// An integer within +-kMaxInteger, also if it is written as 5.0 or 5e0.
std::optional<std::int64_t> whole_number(JsonValue value);

/// The value, or a description if it is long: its kind and its size, which for a list or object is
/// the size of its JSON.
Json shown(JsonValue value);

/// A member that a reader has requested, and its allowed values.
struct Asked {
  std::string name;
  bool is_required;
  std::string allowed;
};

enum class Presence : std::uint8_t { kRequired, kOptional };

/// Reads members of an object. The read functions return an empty value if the member is omitted or
/// invalid; an invalid member is recorded.
class ArgsReader {
 public:
  /// An empty `object` has no members. `pointer` is its position in the message.
  ArgsReader(JsonValue object, std::string pointer, InvalidValues& findings,
             WorkcellBounds bounds = WorkcellBounds::kFile)
      : object_(object), pointer_(std::move(pointer)), findings_(findings), bounds_(bounds) {}

  /// The member, unchecked, or empty. Marks it as known for refuse_others().
  JsonValue ask(const std::string& name, Presence presence = Presence::kOptional,
                std::string allowed = {});
  /// The member, which must be an object. If it is invalid, or required and missing, records that
  /// and returns empty.
  JsonValue object(const std::string& name, Presence presence,
                   const std::string& allowed = "an object");

  std::optional<std::int64_t> integer(const std::string& name, std::int64_t low, std::int64_t high,
                                      Presence presence = Presence::kRequired);
  std::optional<double> number(const std::string& name, double low, double high,
                               Presence presence = Presence::kRequired);
  /// A value in the form of the data files, with lengths in mm.
  template <class V>
  std::optional<V> coded(const std::string& name, const data::Codec<V>& codec,
                         Presence presence = Presence::kRequired);
  /// A list of names of the channel's members; nullopt if it is omitted.
  Fields fields(const std::string& name, Channel channel);

  /// Whether exactly one of the two is present. If not, records an error at `first`.
  bool has_one_of(const std::string& first, const std::string& second);

  std::string pointer_to(const std::string& name) const;
  void refuse(const std::string& name, std::string allowed);
  /// Records an error for every member that was not requested.
  void refuse_others();

  InvalidValues& findings() const { return findings_; }
  /// The bounds of a workcell among the members.
  WorkcellBounds bounds() const { return bounds_; }
  const std::vector<Asked>& asked() const { return asked_; }

 private:
  JsonValue object_;
  std::string pointer_;
  InvalidValues& findings_;
  WorkcellBounds bounds_;
  std::vector<Asked> asked_;
};

template <class V>
std::optional<V> ArgsReader::coded(const std::string& name, const data::Codec<V>& codec,
                                   Presence presence) {
  const JsonValue value = ask(name, presence, codec.allowed);
  if (!value) {
    if (presence == Presence::kRequired) refuse(name, codec.allowed);
    return std::nullopt;
  }
  data::Reading reading(value, data::Unit::kMm);
  V result{};
  const bool is_good = codec.read({reading, value}, result);
  if (reading.has_errors()) findings_.add_errors(reading, pointer_to(name));
  return is_good ? std::optional<V>(std::move(result)) : std::nullopt;
}

}  // namespace xr3::monitor
