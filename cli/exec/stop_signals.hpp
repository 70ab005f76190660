// SIGINT and SIGTERM as a descriptor, for a process that ends others before itself.
#pragma once

#include <csignal>

#include "server/files/descriptor.hpp"

namespace xr3 {

class StopSignals {
 public:
  /// Blocks the signals. Throws std::system_error.
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals() { release(); }

  /// Becomes readable when a signal arrives. -1 after it was taken.
  int descriptor() const { return signals_.get(); }
  /// True once, if a signal has arrived; a further one then ends this process. Does not wait.
  bool take();
  /// Restores the default effect of the signals; in a forked child, too.
  void release() const;

 private:
  sigset_t before_{};
  Descriptor signals_;
};

}  // namespace xr3
