// A network namespace that contains nothing but one listening socket: a program in it reaches the
// robot, and nothing else.
#pragma once

#include "server/files/descriptor.hpp"

namespace xr3 {

class PrivateNetwork {
 public:
  /// Makes the namespace, in a user namespace of its own unless this process is privileged. Throws
  /// std::system_error if the system does not allow it.
  PrivateNetwork();

  /// A socket that listens on 127.0.0.1 and a free port in it. The caller owns it; to be called
  /// once.
  int release_listener() { return listener_.release(); }

  /// Enters it, in a child process before exec. Only async-signal-safe calls. Returns whether it
  /// succeeded.
  bool enter() const;

 private:
  Descriptor listener_;
  Descriptor network_;
  Descriptor user_;  ///< none: that of this process
};

}  // namespace xr3
