// The output of a program under test: shown, and its beginning kept in a file.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "cli/exec/terminal_text.hpp"
#include "server/files/descriptor.hpp"

namespace xr3 {

/// Maximum size of the file of a program's output. The rest is dropped, and a last line says so.
inline constexpr std::size_t kMaxOutputBytes = std::size_t{1} << 20U;

/// Maximum size of the end of standard error that is kept for reports.
inline constexpr std::size_t kMaxErrorBytes = std::size_t{64} << 10U;

class KeptOutput {
 public:
  /// `path`: of the file; empty for none. `is_quiet`: the output is not shown. Throws FileError if
  /// the file cannot be written.
  KeptOutput(const std::string& path, bool is_quiet);

  /// Adds text that the program has written to `stream`, STDOUT_FILENO or STDERR_FILENO, and shows
  /// it there: on a terminal without control characters.
  void add(int stream, std::string_view text);

  /// The end of the program's standard error.
  std::string errors() const;

 private:
  void keep(std::string_view text);
  void show(int stream, std::string_view text);

  bool is_quiet_;
  Descriptor file_;
  std::size_t kept_ = 0;
  bool is_cut_ = false;
  std::string errors_;
  std::array<TerminalText, 2> terminals_;  ///< for standard output and error
};

}  // namespace xr3
