// A signal between threads that a set of descriptors can wait for (eventfd).
#pragma once

#include "server/files/descriptor.hpp"

namespace xr3 {

class Signal {
 public:
  /// Throws FileError if no descriptor is left.
  Signal();

  /// Readable from give() to take().
  int descriptor() const { return event_.get(); }
  void give() const;
  void take() const;

 private:
  Descriptor event_;
};

}  // namespace xr3
