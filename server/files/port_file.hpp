// The port file, from which scripts read the ports. It is written atomically, by a rename, and
// removed when the server stops.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace xr3 {

/// A cell that is served from the start.
struct ServedCell {
  std::string name;
  std::uint16_t robot = 0;
  std::string token;  ///< token of this cell; empty if there is none
};

struct ServedPorts {
  std::uint16_t robot = 0;
  std::uint16_t monitor = 0;
  std::string token;  ///< generated for this run; empty if there is none
  std::vector<ServedCell> cells;
};

/// A port file that exists during the lifetime of this object.
class PortFile {
 public:
  /// Writes {"robot":9600,"monitor":9601,"pid":...,"cells":[{"name":"main","robot":9600}]}, with
  /// the tokens if there are any; then only the owner can read the file at any time. Replaces a
  /// symbolic link instead of following it. Throws FileError if it cannot be written.
  PortFile(std::string path, const ServedPorts& ports);
  PortFile(const PortFile&) = delete;
  PortFile& operator=(const PortFile&) = delete;
  /// Removes the file, unless another one has replaced it.
  ~PortFile();

 private:
  [[noreturn]] void fail(const char* why) const;
  void write(const std::string& draft, const std::string& text, ::mode_t rights);

  std::string path_;
  ::dev_t device_ = 0;
  ::ino_t inode_ = 0;
};

/// The monitor port in a port file. Throws FileError.
std::uint16_t read_monitor_port(const std::string& path);

}  // namespace xr3
