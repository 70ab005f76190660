// A network namespace that contains nothing but one listening socket: a program in it reaches the
// robot, and nothing else.
#pragma once

#include <unistd.h>

#include <optional>
#include <string>

#include "cli/exec/program_user.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// The user and group of this process, or of `of`, mapped to themselves in a new user namespace.
struct IdMaps {
  explicit IdMaps(const std::optional<ProgramUser>& of = {})
      : user(one(of ? of->user : ::geteuid())), group(one(of ? of->group : ::getegid())) {}

  std::string user;
  std::string group;

  /// Writes the maps, in the first process of the namespace. Only async-signal-safe calls. Returns
  /// whether it succeeded.
  bool write() const;

 private:
  static std::string one(unsigned id) {
    return std::to_string(id) + " " + std::to_string(id) + " 1";
  }
};

class PrivateNetwork {
 public:
  /// Makes the namespace in a user namespace of its own, which belongs to `user` (nullopt for the
  /// user of this process), and in which bubblewrap can make its own and nothing any further one.
  /// Throws std::system_error if the system does not allow it.
  explicit PrivateNetwork(const std::optional<ProgramUser>& user);

  /// A socket that listens on 127.0.0.1 and a free port of the namespace. The caller owns it. Call
  /// once.
  int release_listener() { return listener_.release(); }

  /// Enters the namespace, in a child process before exec. Only async-signal-safe calls. Returns
  /// whether it succeeded.
  bool enter() const;

 private:
  Descriptor listener_;
  Descriptor network_;
  Descriptor user_;
};

}  // namespace xr3
