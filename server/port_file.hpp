// The file that tells scripts where to connect. It appears whole, by a rename.
#pragma once

#include <cstdint>
#include <string>

namespace xr3 {

struct PortFile {
  std::uint16_t robot = 0;
  std::uint16_t monitor = 0;
  std::string token;  ///< one made for this run; empty: none
};

/// {"robot":9600,"monitor":9601,"pid":...}, and the token where there is one; the file is then for its
/// owner only. Throws FileError if it cannot be written.
void write_port_file(const std::string& path, const PortFile& content);

/// The port of the monitor in such a file. Throws FileError.
std::uint16_t read_monitor_port(const std::string& path);

}  // namespace xr3
