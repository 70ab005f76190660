// Calls a function for each event of a cell.
#pragma once

#include <functional>
#include <utility>

#include "cell/cell.hpp"

namespace xr3::test {

class OnEvent final : public CellObserver {
 public:
  using Use = std::function<void(const CellEvent&)>;

  /// The cell must outlive it.
  OnEvent(Cell& cell, Use use) : cell_(cell), use_(std::move(use)) { cell.observe(*this); }
  ~OnEvent() override { cell_.end_observation(*this); }

  void happened(const Cell& /*cell*/, const CellOutput& output) override {
    for (const CellEvent& event : output.events) use_(event);
  }

 private:
  Cell& cell_;
  Use use_;
};

}  // namespace xr3::test
