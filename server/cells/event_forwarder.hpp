// Passes the events of a cell on, such as to the log.
#pragma once

#include <functional>
#include <utility>

#include "cell/cell.hpp"

namespace xr3 {

using EventSink = std::function<void(const CellEvent&, const Model&)>;

class EventForwarder final : public CellObserver {
 public:
  /// `sink` may be empty.
  explicit EventForwarder(EventSink sink) : sink_(std::move(sink)) {}

  void happened(const Cell& cell, const CellOutput& output) override {
    if (!sink_) return;
    for (const CellEvent& event : output.events) sink_(event, cell.model());
  }

 private:
  EventSink sink_;
};

}  // namespace xr3
