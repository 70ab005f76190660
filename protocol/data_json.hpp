// Data files as tables: each kind of object is a list of members, each member a name and a codec that
// reads it strictly, writes it again, and says in words what it takes. Every wrong value becomes a
// finding; reading goes on. It knows no robot and no workcell.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/finding.hpp"
#include "protocol/json_source.hpp"

namespace xr3::data {

inline constexpr double kMmPerInch = 25.4;
/// Longest length that a file may name, so that squares of micrometres stay whole numbers.
inline constexpr double kMaxLengthMm = 1e5;

/// What goes on while one file is read: its text, its length unit, and what was found so far.
class Reading {
 public:
  /// Starts with the source's duplicates and takes the length unit from the root's `length_unit`.
  explicit Reading(const JsonSource& source);
  /// For values that stand in no file: lengths are in mm, every line is 1.
  Reading();

  const JsonSource& source() const { return source_; }
  double mm_per_unit() const { return mm_per_unit_; }
  void report(Severity severity, const std::string& pointer, std::string found,
              std::string allowed);
  /// No error so far at this pointer, inside it, or at an object around it that could not be read.
  bool is_sound(const std::string& pointer) const;
  Findings take_findings();
  const Findings& findings() const { return findings_; }

 private:
  const JsonSource& source_;
  double mm_per_unit_ = 1;
  Findings findings_;
  std::set<std::string> wrong_;  ///< pointers of the errors among them
};

/// A value of the file together with where it stands.
struct Place {
  Reading& reading;
  const Json& value;
  std::string pointer;

  Place element(std::size_t index) const;
  void report(std::string found, std::string allowed) const;
  /// Reports this very value as not allowed; always false.
  bool refuse(const std::string& allowed) const;
};

/// A value as a finding shows it: a number, "text", `a list of 3`...
std::string shown(const Json& value);

/// The nearest of the allowed names, if one is near enough to be a slip of the pen; otherwise empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed);

/// A number as JSON: whole ones without a decimal point.
Json number_json(double number);

/// How one value is read, written and described. `read` reports what is wrong and returns false.
template <class V>
struct Codec {
  std::string allowed;
  std::function<bool(const Place&, V&)> read;
  std::function<Json(const V&)> write;
};

/// Numbers from min to max; min itself only if it is not open.
struct Range {
  double min;
  double max;
  bool open_min = false;
  std::string_view unit = "";
};

/// Where anything may lie, mm.
inline constexpr Range kCoordinate{-kMaxLengthMm, kMaxLengthMm};

/// Lengths in bytes of UTF-8.
Codec<std::string> text(std::size_t min_length, std::size_t max_length);
Codec<bool> boolean();
Codec<int> whole(int min, int max);
/// The same for any type of integer; both within +-2^53.
template <class I>
Codec<I> integer(std::int64_t min, std::int64_t max);
Codec<double> number(Range range);
/// A length in the file's unit, read into mm and written in mm; the range is in mm.
Codec<double> length(Range range);

/// One of a few names, each standing for a value.
template <class E>
Codec<E> choice(std::vector<std::pair<std::string, E>> names);

/// A list of min_count to max_count values.
template <class V>
Codec<std::vector<V>> list(Codec<V> item, std::size_t min_count, std::size_t max_count);

/// A member of an object T; `read` puts it into the T, `write` gives nothing where it is left out.
template <class T>
struct Member {
  std::string name;
  bool is_required = true;
  std::string allowed;
  std::function<bool(const Place&, T&)> read;
  std::function<std::optional<Json>(const T&)> write;
};

template <class T>
using Members = std::vector<Member<T>>;

/// A member that must be there.
template <class T, class V>
Member<T> required(std::string name, V T::*field, Codec<V> codec);

/// A member that may be left out, and is when written, where it has the value of a default T.
template <class T, class V>
Member<T> optional(std::string name, V T::*field, Codec<V> codec);

/// A member that may be left out, leaving the field empty.
template <class T, class V>
Member<T> optional(std::string name, std::optional<V> T::*field, Codec<V> codec);

/// The members of a part of T that has no object of its own in the file.
template <class T, class V>
Members<T> spread(V T::*part, const Members<V>& members);

/// `length_unit`, which every file carries: checked by Reading, written as "mm".
template <class T>
Member<T> length_unit_member();

/// Reads an object: every member by its table, unknown ones reported with the nearest name.
template <class T>
bool read_object(const Place& place, const Members<T>& members, T& object);

template <class T>
Json write_object(const T& object, const Members<T>& members);

template <class T>
Codec<T> object(Members<T> members);

}  // namespace xr3::data

#include "protocol/data_json_impl.hpp"
