// The lines that wait for a turn, light ones first: a line that causes little work does not wait
// for those that cause much.
#pragma once

#include <array>
#include <boost/container/flat_set.hpp>
#include <cstdint>
#include <deque>
#include <vector>

namespace xr3 {

/// Numbers the sessions of all cells while they are open; a line's own number counts per cell.
using SessionNumber = std::uint32_t;

class TurnQueue {
 public:
  /// Adds a line behind those of about the same load (LineLoad::at(), in nanoseconds). No effect if
  /// it waits already.
  void add(SessionNumber line, std::uint64_t load);
  bool contains(SessionNumber line) const { return members_.contains(line); }
  bool empty() const { return members_.empty(); }
  /// Whether a line of this load would have its turn at once.
  bool is_next(std::uint64_t load) const;

  /// Removes the line that waits longest of those with the least load. Precondition: not empty.
  SessionNumber take_lightest();
  /// Removes the line that waits longest of each class of load, heavy ones first, so that no class
  /// is forgotten.
  std::vector<SessionNumber> take_first_of_each();

 private:
  static constexpr std::size_t kClasses = 4;
  using Class = std::deque<SessionNumber>;

  static std::size_t class_of(std::uint64_t load);
  SessionNumber take(Class& lines);

  std::array<Class, kClasses> classes_;
  boost::container::flat_set<SessionNumber> members_;  ///< no allocation for a turn
};

}  // namespace xr3
