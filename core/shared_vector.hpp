// A vector that its copies share until one of them changes: a copy of the blocks of a workcell
// costs a pointer, so a snapshot, a checkpoint and a client's view need no copy of them.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace xr3 {

/// A regular value, like std::vector. Copies may be used by different threads.
template <class Value>
class SharedVector {
 public:
  SharedVector() = default;
  SharedVector(std::vector<Value> values)  // NOLINT(google-explicit-constructor): the same value
      : values_(values.empty() ? nullptr
                               : std::make_shared<std::vector<Value>>(std::move(values))) {}
  SharedVector(std::initializer_list<Value> values) : SharedVector(std::vector<Value>(values)) {}

  /// The values, for reading.
  const std::vector<Value>& all() const { return values_ ? *values_ : none(); }
  // NOLINTNEXTLINE(google-explicit-constructor): the same value
  operator const std::vector<Value>&() const { return all(); }

  std::size_t size() const { return all().size(); }
  bool empty() const { return all().empty(); }
  const Value& operator[](std::size_t index) const { return all()[index]; }
  const Value& front() const { return all().front(); }
  const Value& back() const { return all().back(); }
  auto begin() const { return all().begin(); }
  auto end() const { return all().end(); }

  /// The values, for changes before the next copy is made. Copies them if they are shared.
  std::vector<Value>& edit() {
    if (!values_ || values_.use_count() > 1)
      values_ = std::make_shared<std::vector<Value>>(all());
    else
      synchronise();
    return *values_;
  }

  /// Whether both share one copy, or are both empty; if not, they may still be equal.
  bool is_shared_with(const SharedVector& other) const { return values_ == other.values_; }
  bool operator==(const SharedVector& other) const {
    return is_shared_with(other) || all() == other.all();
  }

 private:
  /// Orders changes after the last reads of other threads: the end of a copy acquires what they
  /// released, which use_count() does not.
  void synchronise() const { const auto copy = values_; }

  static const std::vector<Value>& none() {
    static const std::vector<Value> empty;
    return empty;
  }

  std::shared_ptr<std::vector<Value>> values_;  ///< nullptr if empty
};

}  // namespace xr3
