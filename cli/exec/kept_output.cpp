#include "cli/exec/kept_output.hpp"

#include <unistd.h>

#include <algorithm>

#include "server/files/data_files.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

KeptOutput::KeptOutput(const std::string& path, bool is_quiet) : is_quiet_(is_quiet) {
  if (path.empty()) return;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw FileError(path + ": cannot be written");
}

void KeptOutput::add(int stream, std::string_view text) {
  if (!is_quiet_) show(stream, text);
  const std::size_t count = std::min(text.size(), kMaxOutputBytes - kept_);
  file_.write(text.data(), static_cast<std::streamsize>(count));
  file_.flush();
  kept_ += count;
}

void KeptOutput::show(int stream, std::string_view text) {
  if (::isatty(stream) == 0) {
    write_all(stream, text);
    return;
  }
  write_all(stream, terminals_[stream == STDOUT_FILENO ? 0 : 1].add(text));
}

}  // namespace xr3
