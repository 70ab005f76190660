#include "server/files/port_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "server/files/data_files.hpp"

namespace xr3 {

namespace {

nlohmann::ordered_json to_json(const PortFile& content) {
  nlohmann::ordered_json json{
      {"robot", content.robot}, {"monitor", content.monitor}, {"pid", ::getpid()}};
  if (!content.token.empty()) json["token"] = content.token;
  return json;
}

}  // namespace

void write_port_file(const std::string& path, const PortFile& content) {
  const std::string draft = path + "." + std::to_string(::getpid());
  std::ofstream file(draft);
  if (file && !content.token.empty()) ::chmod(draft.c_str(), S_IRUSR | S_IWUSR);
  file << to_json(content).dump() << "\n";
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(draft, path, error);
  if (file && !error) return;
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);
  throw FileError(path + ": the port file cannot be written");
}

std::uint16_t read_monitor_port(const std::string& path) {
  const auto json = nlohmann::json::parse(read_file(path).text, nullptr, false);
  const auto port = json.is_object() ? json.find("monitor") : json.end();
  const bool is_port = port != json.end() && port->is_number_unsigned() && *port > 0 &&
                       *port <= std::numeric_limits<std::uint16_t>::max();
  if (is_port) return port->get<std::uint16_t>();
  throw FileError(path + ": contains no monitor port; xr3 serve --port-file writes such a file");
}

}  // namespace xr3
