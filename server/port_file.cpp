#include "server/port_file.hpp"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "server/data_files.hpp"

namespace xr3 {

void write_port_file(const std::string& path, std::uint16_t robot, std::uint16_t monitor) {
  const nlohmann::ordered_json ports{{"robot", robot}, {"monitor", monitor}, {"pid", ::getpid()}};
  const std::string draft = path + "." + std::to_string(::getpid());
  std::ofstream file(draft);
  file << ports.dump() << "\n";
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(draft, path, error);
  if (file && !error) return;
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);
  throw FileError(path + ": the port file cannot be written there");
}

}  // namespace xr3
