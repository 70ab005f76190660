#include "server/recording/source.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/files/data_files.hpp"

namespace xr3 {

RecordingSource::RecordingSource(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)), reader_(path) {
  if (!file_.is_open()) fail();
}

recording::Header RecordingSource::header() {
  auto header = next_of<recording::Header>([this] { return reader_.header(); });
  if (!header) throw FileError(path_ + ": contains no whole line of a recording");
  return *std::move(header);
}

std::optional<recording::Entry> RecordingSource::next() {
  return next_of<recording::Entry>([this] { return reader_.next(); });
}

template <class Item, class Take>
std::optional<Item> RecordingSource::next_of(const Take& take) {
  std::optional<Item> item = take();
  while (!item && has_more()) item = take();
  return item;
}

bool RecordingSource::has_more() {
  if (is_at_end_) return false;
  const ::ssize_t count = ::read(file_.get(), piece_.data(), piece_.size());
  if (count < 0 && errno != EINTR) fail();
  if (count > 0) reader_.add({piece_.data(), static_cast<std::size_t>(count)});
  is_at_end_ = count == 0;
  if (is_at_end_) reader_.end();
  return true;
}

void RecordingSource::fail() const {
  throw FileError(path_ + ": cannot be read: " + std::strerror(errno));
}

}  // namespace xr3
