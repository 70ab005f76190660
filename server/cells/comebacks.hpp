// The cells that go on from the end of their last recordings (`--continue`), after a stop or a
// crash. Each is absent until its recording has been repeated, in a thread of their own: first
// those that a client waits for, in turns, so that a long recording holds up no other; then the
// others, one after the other.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "server/cells/hosted_cell.hpp"
#include "server/net/asio.hpp"
#include "server/net/worker.hpp"
#include "server/recording/recorded_end.hpp"

namespace xr3 {

class Comebacks {
 public:
  /// `begin` is called when a cell has its state, and before anything reaches it.
  Comebacks(asio::io_context& io, std::function<void(HostedCell&)> begin)
      : io_(io), begin_(std::move(begin)) {}
  Comebacks(const Comebacks&) = delete;
  Comebacks& operator=(const Comebacks&) = delete;
  ~Comebacks() { stop(); }

  /// The cell, which is fresh, is absent until the recording has been repeated. If it cannot be, an
  /// event says why, and the cell stays fresh.
  void add(const CellPtr& cell, std::string recording);
  /// Whether this recording has still to be repeated.
  bool needs(const std::string& recording) const;
  /// Waits for the work that is being done, and does no more.
  void stop();

 private:
  struct Comeback {
    Comeback(CellPtr its_cell, std::string recording)
        : cell(std::move(its_cell)), end(std::move(recording)) {}

    CellPtr cell;
    RecordedEnd end;
    bool is_wanted = false;
  };
  using ComebackPtr = std::shared_ptr<Comeback>;

  void begin_work();
  asio::awaitable<void> work();
  ComebackPtr next() const;
  void step_back(const ComebackPtr& each);
  void finish(const ComebackPtr& each);

  asio::io_context& io_;
  std::function<void(HostedCell&)> begin_;
  std::unique_ptr<Worker> worker_;   ///< nullptr before the first
  std::deque<ComebackPtr> waiting_;  ///< in the order of their turns
  bool is_stopped_ = false;
};

}  // namespace xr3
