#include "cli/exec/script.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "server/files/descriptor.hpp"

namespace xr3 {
namespace {

/// The first line without its line feed, as far as Linux reads it. Does not wait for a FIFO.
std::string first_line(const std::string& path) {
  std::array<char, 256> bytes{};
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  const ::ssize_t count = ::read(file.get(), bytes.data(), bytes.size());
  const std::string_view read(bytes.data(),
                              static_cast<std::size_t>(std::max<::ssize_t>(0, count)));
  return std::string(read.substr(0, read.find('\n')));
}

/// `/usr/bin/env` of `#! /usr/bin/env python3`.
std::string interpreter_in(const std::string& line) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = line.find_first_not_of(kBlanks, 2);
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_first_of(kBlanks, begin) - begin);
}

}  // namespace

std::string interpreter_trouble(const std::string& path) {
  const std::string line = first_line(path);
  if (!line.starts_with("#!")) return {};
  if (line.ends_with('\r'))
    return "its first line ends with CR LF, as on Windows, and the CR counts as a part of the "
           "interpreter's name; remove it: sed -i 's/\\r$//' FILE";
  const std::string interpreter = interpreter_in(line);
  std::error_code ignored;
  if (std::filesystem::exists(interpreter, ignored)) return {};
  return "its first line names the interpreter \"" + interpreter + "\", which is not there";
}

}  // namespace xr3
