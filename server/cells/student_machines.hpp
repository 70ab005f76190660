// The machines on which students have opened the pages of their robots: with a roster and
// `--cell-per-connection`, a connection of the one robot port from there is for that robot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "server/net/asio.hpp"

namespace xr3 {

class StudentMachines {
 public:
  static constexpr std::size_t kMost = 4096;  ///< the latest note replaces the oldest

  /// A page of this cell was opened on the machine: see machine_of().
  void note(const asio::ip::address& machine, std::string cell);

  /// The cell whose page was opened last on the machine; nullopt if none was.
  std::optional<std::string> cell_on(const asio::ip::address& machine) const;

 private:
  struct Opened {
    std::string cell;
    std::uint64_t number = 0;  ///< in the order of the notes
  };

  std::map<asio::ip::address, Opened> opened_;
  std::uint64_t last_ = 0;
};

}  // namespace xr3
