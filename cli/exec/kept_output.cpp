#include "cli/exec/kept_output.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "cli/exec/private_file.hpp"

namespace xr3 {
namespace {

constexpr std::string_view kMark =
    "\nxr3: the rest of the output is left out; only its first MiB is kept\n";

}  // namespace

KeptOutput::KeptOutput(const std::string& path, bool is_quiet) : is_quiet_(is_quiet) {
  if (!path.empty()) file_ = open_private(path);
}

void KeptOutput::add(int stream, std::string_view text) {
  if (!is_quiet_) show(stream, text);
  if (stream == STDERR_FILENO) errors_.append(text);
  if (errors_.size() > 2 * kMaxErrorBytes) errors_ = errors();
  if (file_.is_open()) keep(text);
}

void KeptOutput::keep(std::string_view text) {
  const std::size_t count = std::min(text.size(), kMaxOutputBytes - kept_);
  write_all(file_.get(), text.substr(0, count));
  kept_ += count;
  if (count < text.size() && !std::exchange(is_cut_, true)) write_all(file_.get(), kMark);
}

std::string KeptOutput::errors() const {
  return errors_.substr(errors_.size() - std::min(errors_.size(), kMaxErrorBytes));
}

void KeptOutput::show(int stream, std::string_view text) {
  if (::isatty(stream) == 0) {
    write_all(stream, text);
    return;
  }
  write_all(stream, terminals_[stream == STDOUT_FILENO ? 0 : 1].add(text));
}

}  // namespace xr3
