// The path of a pseudo-terminal: a symbolic link to its slave. A lock file beside it, `PATH.lock`,
// keeps other servers away and records which links are ours: a slave of an earlier run may be
// another program's terminal by now.
#pragma once

#include <string>

#include "server/files/descriptor.hpp"

namespace xr3 {

class PtyLink {
 public:
  /// Makes the link. Throws FileError, and changes nothing, if another server has the path or if
  /// something is there that no xr3 has made.
  PtyLink(std::string path, const std::string& slave);
  PtyLink(const PtyLink&) = delete;
  PtyLink& operator=(const PtyLink&) = delete;
  /// Removes link and lock, if they are ours still.
  ~PtyLink();

  const std::string& path() const { return path_; }

  /// Makes the link point to another slave. Throws FileError.
  void point_to(const std::string& slave);

 private:
  void lock();
  bool is_ours() const;
  void record(const std::string& slave);
  [[noreturn]] void fail(const std::string& why) const;

  std::string path_;
  std::string lock_path_;
  std::string slave_;  ///< empty before the first link
  Descriptor lock_;
};

}  // namespace xr3
