// Members of a request read one by one: each that is missing, of the wrong kind or out of range is
// noted with its pointer, and reading goes on, so that a client hears of all of them at once. What
// was asked for is kept, so that a reader describes itself by reading nothing.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/json/codec.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::monitor {

/// Wrong values found so far; of very many only the first are kept.
class Findings {
 public:
  static constexpr std::size_t kMaxDetails = 32;

  /// Counts one more. Whether it is to be kept: nothing needs to be put into words otherwise.
  bool counts() { return count_++ < kMaxDetails; }
  /// One that counts already.
  void keep(const std::string& pointer, Json found, std::string allowed);
  /// `found` may be nothing. A long one is told by its size.
  void add(const std::string& pointer, JsonValue found, std::string allowed);
  /// The errors that a reader of files found in a value that stands at the pointer `at`.
  void add_errors(const data::Reading& reading, const std::string& at);

  bool empty() const { return count_ == 0; }
  /// The error `bad_args` with everything that was found.
  RequestError error(RequestId id) const;

 private:
  std::size_t count_ = 0;
  std::vector<Detail> details_;
};

/// A whole number within +-kMaxInteger, also where it is written as 5.0 or 5e0.
std::optional<std::int64_t> whole_number(JsonValue value);

/// The value as it stands, or, for one that is long, what it is: a text by its own bytes, a list or an
/// object by those of its JSON.
Json shown(JsonValue value);

/// A member that was asked for, and what it may be.
struct Asked {
  std::string name;
  bool is_required;
  std::string allowed;
};

enum class Presence : std::uint8_t { kRequired, kOptional };

/// Its readers give nothing where the member is left out, or is wrong and noted.
class ArgsReader {
 public:
  /// `object` may be nothing: an empty one. `pointer` is where it stands in the message.
  ArgsReader(JsonValue object, std::string pointer, Findings& findings)
      : object_(object), pointer_(std::move(pointer)), findings_(findings) {}

  /// The member as it stands, or nothing; it counts as known from now on.
  JsonValue ask(const std::string& name, Presence presence = Presence::kOptional,
                std::string allowed = {});
  /// The same, but an object; nothing also where it is wrong or missing, and noted.
  JsonValue object(const std::string& name, Presence presence,
                   const std::string& allowed = "an object");

  std::optional<std::int64_t> whole(const std::string& name, std::int64_t low, std::int64_t high,
                                    Presence presence = Presence::kRequired);
  std::optional<double> number(const std::string& name, double low, double high,
                               Presence presence = Presence::kRequired);
  /// A value as the data files have it, lengths in mm.
  template <class V>
  std::optional<V> coded(const std::string& name, const data::Codec<V>& codec,
                         Presence presence = Presence::kRequired);
  /// A list of names of members of the channel, or nothing where it is left out.
  Fields fields(const std::string& name, Channel channel);

  /// Exactly one of the two is there; noted at the first otherwise.
  bool has_one_of(const std::string& first, const std::string& second);

  std::string pointer_to(const std::string& name) const;
  void refuse(const std::string& name, std::string allowed);
  /// Notes every member that was not asked for.
  void refuse_others();

  Findings& findings() const { return findings_; }
  const std::vector<Asked>& asked() const { return asked_; }

 private:
  JsonValue object_;
  std::string pointer_;
  Findings& findings_;
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
