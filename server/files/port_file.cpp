#include "server/files/port_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

std::string to_text(const ServedPorts& ports) {
  nlohmann::ordered_json json{
      {"robot", ports.robot}, {"monitor", ports.monitor}, {"pid", ::getpid()}};
  if (!ports.token.empty()) json["token"] = ports.token;
  json["cells"] = nlohmann::ordered_json::array();
  for (const ServedCell& cell : ports.cells) {
    nlohmann::ordered_json entry{{"name", cell.name}, {"robot", cell.robot}};
    if (!cell.token.empty()) entry["token"] = cell.token;
    json["cells"].push_back(std::move(entry));
  }
  return json.dump() + "\n";
}

bool has_tokens(const ServedPorts& ports) {
  return !ports.token.empty() ||
         std::ranges::any_of(ports.cells, [](const auto& cell) { return !cell.token.empty(); });
}

int create(const std::string& path, ::mode_t rights) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, rights);
}

}  // namespace

PortFile::PortFile(std::string path, const ServedPorts& ports) : path_(std::move(path)) {
  constexpr ::mode_t kOwner = S_IRUSR | S_IWUSR;
  const ::mode_t rights = has_tokens(ports) ? kOwner : kOwner | S_IRGRP | S_IROTH;
  const std::string draft = path_ + "." + std::to_string(::getpid());
  write(draft, to_text(ports), rights);
  if (::rename(draft.c_str(), path_.c_str()) == 0) return;
  const int why = errno;
  ::unlink(draft.c_str());
  fail(std::strerror(why));
}

void PortFile::fail(const char* why) const {
  throw FileError(path_ + ": the port file cannot be written: " + why);
}

void PortFile::write(const std::string& draft, const std::string& text, ::mode_t rights) {
  int file = create(draft, rights);
  if (file < 0 && errno == EEXIST && ::unlink(draft.c_str()) == 0) file = create(draft, rights);
  if (file < 0) fail(std::strerror(errno));
  struct ::stat status {};
  const auto size = static_cast<::ssize_t>(text.size());
  const bool is_written =
      ::write(file, text.data(), text.size()) == size && ::fstat(file, &status) == 0;
  const int why = errno;
  if (::close(file) != 0 || !is_written) {
    ::unlink(draft.c_str());
    fail(std::strerror(why));
  }
  device_ = status.st_dev;
  inode_ = status.st_ino;
}

PortFile::~PortFile() {
  struct ::stat status {};
  const bool is_there = ::lstat(path_.c_str(), &status) == 0;
  if (is_there && status.st_dev == device_ && status.st_ino == inode_) ::unlink(path_.c_str());
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
