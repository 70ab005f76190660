// Data files as tables: an object is a list of members, each with a name and a codec that reads the
// value strictly, writes it, and describes the allowed values. Each invalid value becomes a
// finding; reading continues after it. Independent of robots and workcells.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/shared_vector.hpp"
#include "protocol/json/finding.hpp"
#include "protocol/json/source.hpp"

namespace xr3::data {

inline constexpr double kMmPerInch = 25.4;
/// Maximum length in a file, so that squares of micrometres remain exact integers.
inline constexpr double kMaxLengthMm = 1e5;

/// The length unit of a value: mm, or the `length_unit` of its root, which must have one.
enum class Unit : std::uint8_t { kMm, kOfDocument };

/// The context for reading one document: its root, its length unit, and the findings so far. Stores
/// a limited number of findings, with long pointers shortened; further findings are only counted.
class Reading {
 public:
  static constexpr std::size_t kMaxOfValue = 32;
  static constexpr std::size_t kMaxPointerLength = 200;
  static constexpr std::size_t kMaxNameLength = 200;

  /// Reports the source's duplicate members.
  explicit Reading(const JsonSource& source, Unit unit = Unit::kOfDocument);
  /// For a value that is not from a file: every line is 1, pointers begin at the value, warnings
  /// are dropped, and duplicates are not reported.
  Reading(JsonValue root, Unit unit);

  JsonValue root() const { return root_; }
  double mm_per_unit() const { return mm_per_unit_; }
  bool wants_warnings() const { return source_ != nullptr; }

  void report(Severity severity, const std::string& pointer, std::string found,
              std::string allowed);
  void refuse(const std::string& pointer, std::string found, std::string allowed) {
    report(Severity::kError, pointer, std::move(found), std::move(allowed));
  }
  /// Reports the errors of a part that was read as a document of its own, at this pointer.
  void refuse_part(const std::string& pointer, const Findings& findings);
  /// Counts an error. Returns whether the caller should store it with keep(); if not, its texts
  /// need not be built.
  bool keeps_error() { return keeps(Severity::kError); }
  /// Store an error that keeps_error() has counted: at a value, or for a missing member of an
  /// object.
  void keep(JsonValue value, std::string found, std::string allowed);
  void keep_missing(JsonValue object, const std::string& member, std::string allowed);
  /// Adds the findings of a part of this document that was read with its own Reading.
  void adopt(const Reading& part);

  /// Whether no further finding is stored. Values that are read after that are not used.
  bool is_full() const { return findings_.size() >= most_; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t errors() const { return errors_; }
  /// Whether there is no error at this pointer, inside it, or at a value around it. False if
  /// is_full() and there are errors, since some were not stored.
  bool is_sound(const std::string& pointer) const;
  Findings take_findings();

  /// A finding and its value; the handle is empty if the value is missing.
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
  std::size_t errors_ = 0;         ///< including those not stored
  std::size_t warnings_ = 0;       ///< including those not stored
  std::set<std::string> wrong_{};  ///< pointers of the stored errors
};

/// A value of the document being read.
struct Place {
  Reading& reading;
  JsonValue value;

  Place element(std::size_t index) const { return {reading, value.element(index)}; }
  /// Reports the value as not allowed. Always returns false.
  bool refuse(const std::string& allowed) const;
};

/// A value as text for a finding: a number, "text", `a list of 3`...
std::string shown(const Json& value);
std::string shown(JsonValue value);

/// The most similar allowed name if `name` may be a misspelling of it; otherwise empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed);

/// `"one", "two" or "three"`.
std::string quoted_names(const std::vector<std::string>& names);

/// A number as JSON; integers have no decimal point.
Json number_json(double number);

/// Reads, writes and describes a value. `read` reports an invalid value and returns false.
template <class V>
struct Codec {
  std::string allowed;
  std::function<bool(const Place&, V&)> read;
  std::function<Json(const V&)> write;
};

/// A value that `parse` makes of the JSON value; nullopt if it is not allowed.
template <class V>
Codec<V> parsed(
    std::string allowed, std::function<std::optional<V>(JsonValue)> parse,
    std::function<Json(const V&)> write = [](const V& value) { return Json(value); });

/// A V that is read and written as a W. `from` may be null if it is never written.
template <class V, class W>
Codec<V> converted(Codec<W> codec, std::function<V(const W&)> to, std::function<W(const V&)> from);

/// A list of the values of these fields of V, in order.
template <class V, class F>
Codec<V> row(std::string allowed, Codec<F> item, std::vector<F V::*> fields);

/// Numbers from min to max; min itself is excluded if open_min is set.
struct Range {
  double min;
  double max;
  bool open_min = false;
  std::string_view unit = "";
};

/// The range of coordinates, in mm.
inline constexpr Range kCoordinate{-kMaxLengthMm, kMaxLengthMm};

/// Lengths in bytes of UTF-8.
Codec<std::string> text(std::size_t min_length, std::size_t max_length);
Codec<bool> boolean();
Codec<int> whole_number(int min, int max);
/// A whole number of any integer type; min and max must be within +-2^53.
template <class I>
Codec<I> integer(std::int64_t min, std::int64_t max);
Codec<double> number(Range range);
/// A length, converted from the file's unit to mm when read and written in mm; the range is in mm.
Codec<double> length(Range range);

/// One of several names, each with its value.
template <class E>
Codec<E> choice(std::vector<std::pair<std::string, E>> names);

/// A list of min_count to max_count values.
template <class V>
Codec<std::vector<V>> list(Codec<V> item, std::size_t min_count, std::size_t max_count);
/// A list as a vector that copies share.
template <class V>
Codec<SharedVector<V>> shared(Codec<std::vector<V>> values);

/// A member of an object T. `read` stores it in the T; `write` returns nullopt if it is omitted.
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

/// A member that must be present.
template <class T, class V>
Member<T> required(std::string name, V T::*field, Codec<V> codec);

/// A required member whose value is spread over several fields of T, such as a row().
template <class T>
Member<T> required(std::string name, Codec<T> codec);

/// A member that may be omitted, which leaves the field as it is. It is always written, so that
/// readers need not know the default.
template <class T, class V>
Member<T> defaulted(std::string name, V T::*field, Codec<V> codec);

/// A member that may be omitted. It is not written if its value is that of a default T.
template <class T, class V>
Member<T> optional(std::string name, V T::*field, Codec<V> codec);

/// A member that may be omitted, which leaves the field empty.
template <class T, class V>
Member<T> optional(std::string name, std::optional<V> T::*field, Codec<V> codec);

/// Tables of members, one after the other.
template <class T, class... More>
Members<T> joined(Members<T> first, const More&... more);

/// The members of a part of T that are members of T's own object in the file.
template <class T, class V>
Members<T> spread(V T::*part, const Members<V>& members);

/// `length_unit`, present in every file: checked by Reading, written as "mm".
template <class T>
Member<T> length_unit_member();

/// Reads the object's members. Reports missing members, and unknown ones with the most similar
/// name.
template <class T>
bool read_object(const Place& place, const Members<T>& members, T& object);

/// Reads the root of the document, and lets `check(value, reading)` report what concerns several
/// members. nullopt if there are errors.
template <class T, class Check>
std::optional<T> read_root(Reading& reading, const Members<T>& members, const Check& check);

template <class T>
Json write_object(const T& object, const Members<T>& members);

template <class T>
Codec<T> object(Members<T> members);

/// Requires that the elements of the list at `pointer` have different names; `what` is the noun for
/// one of them.
template <class T>
void check_names(const std::vector<T>& elements, const std::string& pointer,
                 const std::string& what, Reading& reading);

}  // namespace xr3::data

#include "protocol/json/codec_impl.hpp"
