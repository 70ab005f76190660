// The interface of a log of a cell. The cell reports its inputs, and how time has passed between
// them where its state depends on that. A log must not change the cell. It hears what it overrides.
#pragma once

#include <string_view>

#include "cell/input.hpp"

namespace xr3 {

class Cell;

class InputLog {
 public:
  InputLog() = default;
  InputLog(const InputLog&) = delete;
  InputLog& operator=(const InputLog&) = delete;
  virtual ~InputLog() = default;

  /// Time has advanced to the tick of an input, which acts next.
  virtual void begin(const Cell& /*cell*/, const Input& /*input*/) {}
  /// The input has acted.
  virtual void end(const Cell& /*cell*/, const Input& /*input*/, const Applied& /*applied*/) {}
  /// A transport has sent bytes, which the line's outbox still has.
  virtual void sent(const Cell& /*cell*/, const BytesOut& /*out*/) {}
  /// A line has added these bytes to its outbox.
  virtual void output(const Cell& /*cell*/, LineId /*line*/, std::string_view /*bytes*/) {}
  /// Time has advanced.
  virtual void after_advance(const Cell& /*cell*/) {}
  /// The physical controller has not answered in time.
  virtual void expired(const Cell& /*cell*/) {}
};

}  // namespace xr3
