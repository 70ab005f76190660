// A network namespace that contains nothing but one listening socket: a program in it reaches the
// robot, and nothing else.
#pragma once

#include <unistd.h>

#include <string>

#include "server/files/descriptor.hpp"

namespace xr3 {

/// The user and group that this process has, for a new user namespace in which it keeps them.
struct IdMaps {
  std::string user = one(::geteuid());
  std::string group = one(::getegid());

  /// Writes them, in the first process of the namespace. Only async-signal-safe calls. Returns
  /// whether it succeeded.
  bool write() const;

 private:
  static std::string one(unsigned id) {
    return std::to_string(id) + " " + std::to_string(id) + " 1";
  }
};

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
