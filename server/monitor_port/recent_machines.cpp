#include "server/monitor_port/recent_machines.hpp"

#include <algorithm>

namespace xr3 {

void RecentMachines::note(const asio::ip::address& machine, Time now) {
  auto place = std::ranges::find(noted_, machine, &Noted::machine);
  if (place == noted_.end()) place = std::ranges::min_element(noted_, {}, &Noted::at);
  *place = {machine, now};
}

bool RecentMachines::contains(const asio::ip::address& machine, Time now) const {
  const auto place = std::ranges::find(noted_, machine, &Noted::machine);
  return place != noted_.end() && now < place->at + kRemembered;
}

}  // namespace xr3
