// The port file, from which scripts read the ports. It is written atomically, by a rename.
#pragma once

#include <cstdint>
#include <string>

namespace xr3 {

struct PortFile {
  std::uint16_t robot = 0;
  std::uint16_t monitor = 0;
  std::string token;  ///< generated for this run; empty: none
};

/// Writes {"robot":9600,"monitor":9601,"pid":...}, with the token if there is one; then only the
/// owner can read the file. Throws FileError if it cannot be written.
void write_port_file(const std::string& path, const PortFile& content);

/// The monitor port in such a file. Throws FileError.
std::uint16_t read_monitor_port(const std::string& path);

}  // namespace xr3
