// The lines that wait for a turn, light ones first: a line that causes little work does not wait
// for those that cause much. Peers take turns, however many lines each of them has.
#pragma once

#include <array>
#include <boost/container/flat_set.hpp>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

namespace xr3 {

/// Numbers the sessions of all cells while they are open; a line's own number counts per cell.
using SessionNumber = std::uint32_t;

class TurnQueue {
 public:
  static constexpr std::size_t kClasses = 4;  ///< of load

  /// A peer's lines share its turns: it has at most one in each round of its class.
  class Peer {
    friend class TurnQueue;
    std::array<std::uint64_t, kClasses> next_round_{};
  };

  /// Adds a line behind those of its peer of about the same load (LineLoad::at(), in nanoseconds).
  /// No effect if it waits already.
  void add(SessionNumber line, std::uint64_t load, Peer& peer);
  bool contains(SessionNumber line) const { return members_.contains(line); }
  bool empty() const { return members_.empty(); }
  /// Whether a line of this load would have its turn at once.
  bool is_next(std::uint64_t load) const;

  /// Removes the first line of those with the least load. Precondition: not empty.
  SessionNumber take_lightest();
  /// Removes the first line of each class of load, heavy ones first, so that no class is forgotten.
  std::vector<SessionNumber> take_first_of_each();

 private:
  struct Entry {
    std::uint64_t round;
    std::uint64_t order;  ///< of arrival, within a round
    SessionNumber line;
    auto operator<=>(const Entry&) const = default;
  };

  /// No allocation for a turn, once the memory suffices for the lines that wait at once.
  struct Class {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> lines;
    std::uint64_t round = 0;  ///< of the line that was taken last
  };

  static std::size_t class_of(std::uint64_t load);
  static bool has_lines(const Class& each) { return !each.lines.empty(); }
  SessionNumber take(Class& from);

  std::array<Class, kClasses> classes_;
  std::uint64_t added_ = 0;
  boost::container::flat_set<SessionNumber> members_;  ///< no allocation for a turn
};

}  // namespace xr3
