// The memory that the growing parts of all cells, such as their rings, may have together. When the
// budget is used up, the largest part gives up to half of its bytes, the oldest, to a smaller one
// that grows. So busy cells share the memory, and a cell at rest needs none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

namespace xr3::monitor {

class ByteBudget {
 public:
  explicit ByteBudget(std::size_t max_bytes) : max_bytes_(max_bytes) {}
  ByteBudget(const ByteBudget&) = delete;
  ByteBudget& operator=(const ByteBudget&) = delete;

  /// A part that grows and takes its bytes from the budget.
  class Account {
   public:
    /// The bytes that the part has.
    virtual std::size_t bytes() const = 0;
    /// Releases half of its bytes, or fewer.
    virtual void shrink() = 0;

   protected:
    ~Account() = default;  // never owned through this interface
  };

  /// kRequired: granted although the budget is used up.
  enum class Necessity : std::uint8_t { kUseful, kRequired };

  /// Lets a member have `wanted` bytes in place of its current ones. Other members that have more
  /// than that shrink if necessary. Returns false, and changes nothing for this member, if it is
  /// not possible.
  bool grant(Account& member, std::size_t wanted, Necessity necessity = Necessity::kUseful);
  /// Returns all bytes of a member to the budget.
  void release(Account& member);

  std::size_t used_bytes() const { return used_bytes_; }

 private:
  bool make_room(const Account& member, std::size_t more, std::size_t wanted);
  void set_bytes(Account& member, std::size_t before, std::size_t now);

  std::size_t max_bytes_;
  std::size_t used_bytes_ = 0;
  std::set<std::pair<std::size_t, Account*>> by_size_;
};

}  // namespace xr3::monitor
