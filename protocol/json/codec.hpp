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

#include "protocol/json/finding.hpp"
#include "protocol/json/source.hpp"

namespace xr3::data {

inline constexpr double kMmPerInch = 25.4;
/// Longest length that a file may name, so that squares of micrometres stay whole numbers.
inline constexpr double kMaxLengthMm = 1e5;

/// Which length unit counts.
enum class Unit : std::uint8_t { kMm, kOfDocument };

/// What goes on while one document is read: its root, its length unit, and what was found so far. Of very
/// many findings the first are kept, with pointers that are cut where they are long; the others are counted.
class Reading {
 public:
  static constexpr std::size_t kMaxOfValue = 32;
  static constexpr std::size_t kMaxPointerLength = 200;
  static constexpr std::size_t kMaxNameLength = 200;

  /// Starts with the source's duplicates and takes the length unit from the root's `length_unit`.
  explicit Reading(const JsonSource& source);
  /// For a value that stands in no file: every line is 1, pointers begin at the value, and there are no
  /// warnings. Its duplicates are not looked for.
  Reading(JsonValue root, Unit unit);

  JsonValue root() const { return root_; }
  double mm_per_unit() const { return mm_per_unit_; }
  bool wants_warnings() const { return source_ != nullptr; }

  void report(Severity severity, const std::string& pointer, std::string found,
              std::string allowed);
  /// Counts an error. Whether it is to be kept: nothing needs to be put into words otherwise.
  bool keeps_error() { return keeps(Severity::kError); }
  /// An error that counts already: at a value, or at a member that an object has not got.
  void keep(JsonValue value, std::string found, std::string allowed);
  void keep_missing(JsonValue object, const std::string& member, std::string allowed);
  /// What was found in a part of this document that was read by itself.
  void adopt(const Reading& part);

  /// Nothing more is kept: what is read from now on is of no use.
  bool is_full() const { return findings_.size() >= most_; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t errors() const { return errors_; }
  /// No error so far at this pointer, inside it, or at an object around it that could not be read. Of very
  /// many errors nobody knows.
  bool is_sound(const std::string& pointer) const;
  Findings take_findings();

  /// A finding with the value that it is about, or nothing where there is none.
  struct Kept {
    Finding finding;
    JsonValue value;
  };
  const std::vector<Kept>& kept() const { return findings_; }

 private:
  void take_unit();
  bool keeps(Severity severity);
  void keep(Severity severity, std::string pointer, JsonValue value, JsonValue line,
            std::string found, std::string allowed);

  const JsonSource* source_ = nullptr;
  JsonValue root_;
  std::size_t most_;
  double mm_per_unit_ = 1;
  std::vector<Kept> findings_;
  std::size_t errors_ = 0;         ///< those that are not kept included
  std::size_t warnings_ = 0;       ///< the same
  std::set<std::string> wrong_{};  ///< pointers of the errors that are kept
};

/// A value of the document that is being read.
struct Place {
  Reading& reading;
  JsonValue value;

  Place element(std::size_t index) const { return {reading, value.element(index)}; }
  /// Reports this very value as not allowed; always false.
  bool refuse(const std::string& allowed) const;
};

/// A value as a finding shows it: a number, "text", `a list of 3`...
std::string shown(const Json& value);
std::string shown(JsonValue value);

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

#include "protocol/json/codec_impl.hpp"
