// The command line of `xr3 term`.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/address.hpp"
#include "cli/options/cli_fwd.hpp"
#include "core/model.hpp"
#include "protocol/line/serial_settings.hpp"

namespace xr3 {

/// The form in which bytes are shown.
enum class TermView : std::uint8_t {
  kText,  ///< replies decoded
  kHex,   ///< bytes of both directions
  kRaw,   ///< replies unchanged
};

struct TermOptions {
  std::string peer = "localhost:9600";  ///< a path as given, or the text of the address
  bool is_path = false;                 ///< a device or pseudo-terminal, not an address
  PortAddress address;                  ///< the address, unless is_path
  bool is_rfc2217 = false;              ///< negotiate COM-PORT with the address
  SerialSettings settings{kDefaultBaud, SerialFrame{}};  ///< settings of the device, or of RFC 2217
  TermView view = TermView::kText;
  bool edits_lines = false;
  std::string robot;     ///< name or path; empty if unknown
  std::string workcell;  ///< name or path; empty for the one with the robot's name
  Profile profile = Profile::kPaper;
  double timeout_s = 3;  ///< for a reply
};

/// Adds the subcommand `term` with its options.
void add_term(CLI::App& app, TermOptions& options);

}  // namespace xr3
