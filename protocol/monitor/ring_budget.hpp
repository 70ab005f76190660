// The memory that the rings of all cells may have together. A ring grows as it is filled; when the
// budget is used up, the largest ring gives half of its places, with its oldest messages, to a
// smaller one that wants to grow. So busy cells share the memory, and a cell at rest needs none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

namespace xr3::monitor {

class RingBudget {
 public:
  explicit RingBudget(std::size_t max_bytes) : max_bytes_(max_bytes) {}
  RingBudget(const RingBudget&) = delete;
  RingBudget& operator=(const RingBudget&) = delete;

  /// A ring, as far as the budget knows it.
  class Member {
   public:
    /// The bytes that it has.
    virtual std::size_t bytes() const = 0;
    /// Gives up half of its bytes, or fewer.
    virtual void shrink() = 0;

   protected:
    ~Member() = default;  // never owned through this interface
  };

  /// kVital: granted although the budget is used up.
  enum class Necessity : std::uint8_t { kUseful, kVital };

  /// Lets a member have `wanted` bytes instead of those that it has. Other members that have more
  /// than that shrink if necessary. Returns false, and changes nothing for this member, if it is
  /// not possible.
  bool grant(Member& member, std::size_t wanted, Necessity necessity = Necessity::kUseful);
  /// The member gives all its bytes back.
  void release(Member& member);

  std::size_t used_bytes() const { return used_bytes_; }

 private:
  bool make_room(const Member& member, std::size_t more, std::size_t wanted);
  void set_bytes(Member& member, std::size_t before, std::size_t now);

  std::size_t max_bytes_;
  std::size_t used_bytes_ = 0;
  std::set<std::pair<std::size_t, Member*>> by_size_;
};

}  // namespace xr3::monitor
