// The calls on the server: `cells` and `describe`.
#include <utility>

#include "protocol/monitor/call_table.hpp"

namespace xr3::monitor {
namespace {

CallValue read_describe(ArgsReader& args) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& fn : calls()) names.emplace_back(fn, fn);
  return Describe{args.coded("fn", data::choice(std::move(names)), Presence::kOptional)};
}

constexpr CallForm kServerCalls[] = {
    {"cells", "Lists the cells of the server.", read_nothing<ListCells>},
    {"describe", "Lists the calls and their arguments.", read_describe},
};

}  // namespace

CallForms server_calls() { return kServerCalls; }

}  // namespace xr3::monitor
