#include "server/cells/comebacks.hpp"

#include <algorithm>
#include <utility>

#include "cell/recording/continued.hpp"
#include "cell/recording/recorder.hpp"
#include "server/net/spawn.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// The time of work on one recording after which another has its turn.
constexpr WallNs kWorkSlice = 50'000'000;

/// Lets the cell go on from the end of a recording. Returns why it cannot; empty if it does.
std::string go_on(Cell& cell, const RecordedEnd& end) {
  if (!end.why().empty()) return end.why();
  const recording::Header header = end.header();
  const Model& model = *header.model;
  if (!(model.robot() == cell.model().robot()) || model.profile() != cell.model().profile())
    return end.path() + ": it is of another robot (" + model.robot().name +
           "), or of another --compat";
  if (origin_of(header) != origin_of(recording_header(cell, "")))
    return end.path() +
           ": it began with another workcell or other faults, as of another --exercise";
  begin_at_start(cell, header, wall_now());
  return {};
}

}  // namespace

void Comebacks::add(const CellPtr& cell, std::string recording) {
  const auto each = std::make_shared<Comeback>(cell, std::move(recording));
  cell->leave([weak = std::weak_ptr(each)] {
    if (const ComebackPtr wanted = weak.lock()) wanted->is_wanted = true;
  });
  waiting_.push_back(each);
  if (!worker_) begin_work();
}

bool Comebacks::needs(const std::string& recording) const {
  return std::ranges::any_of(waiting_,
                             [&](const auto& each) { return each->end.path() == recording; });
}

void Comebacks::stop() {
  is_stopped_ = true;
  if (worker_) worker_->stop();
}

void Comebacks::begin_work() {
  worker_ = std::make_unique<Worker>();
  spawn_loop(io_.get_executor(), "the recordings to go on from", work());
}

asio::awaitable<void> Comebacks::work() {
  while (const ComebackPtr each = next()) {
    const auto slice = [each] { return each->end.work(kWorkSlice); };
    const bool is_done = co_await worker_->run(slice);
    if (is_stopped_) co_return;
    is_done ? finish(each) : step_back(each);
  }
  worker_.reset();
}

/// The first one that a client waits for, or else the first one; nullptr if there is none.
Comebacks::ComebackPtr Comebacks::next() const {
  if (waiting_.empty() || is_stopped_) return nullptr;
  const auto wanted =
      std::ranges::find_if(waiting_, [](const ComebackPtr& each) { return each->is_wanted; });
  return wanted == waiting_.end() ? waiting_.front() : *wanted;
}

/// Others that a client waits for have their turns before the next one of this.
void Comebacks::step_back(const ComebackPtr& each) {
  if (!each->is_wanted) return;
  std::erase(waiting_, each);
  waiting_.push_back(each);
}

void Comebacks::finish(const ComebackPtr& each) {
  HostedCell& cell = *each->cell;
  const std::string why = go_on(cell.cell(), each->end);
  begin_(cell);
  cell.cell().report_continued(each->end.path(), why);
  std::erase(waiting_, each);
  cell.come_back();
}

}  // namespace xr3
