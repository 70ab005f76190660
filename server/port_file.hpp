// The file that tells scripts where to connect. It appears whole, by a rename.
#pragma once

#include <cstdint>
#include <string>

namespace xr3 {

/// {"robot":9600,"monitor":9601,"pid":...}. Throws FileError if it cannot be written.
void write_port_file(const std::string& path, std::uint16_t robot, std::uint16_t monitor);

}  // namespace xr3
