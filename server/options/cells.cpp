#include "server/options/cells.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "protocol/text/whole_number.hpp"
#include "server/options/options.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxPort = 65535;

[[noreturn]] void refuse_cell(const std::string& text) {
  throw std::invalid_argument(
      text +
      ": a cell is NAME=ROBOT,WORKCELL or NAME=ROBOT,WORKCELL,PORT; a name has 1 to 32 "
      "letters, digits, _ and -");
}

/// The part before the next comma, which is removed from `text`.
std::string next_part(std::string_view& text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  std::string part(text.substr(0, comma));
  text.remove_prefix(std::min(comma + 1, text.size()));
  return part;
}

std::vector<CellPlan> named_plans(const ServeOptions& options) {
  std::vector<CellPlan> plans;
  for (std::size_t k = 1; k <= options.cells; ++k)
    plans.push_back({std::to_string(k), options.robot, options.workcell, 0});
  for (const CellChoice& each : options.cell_choices) {
    const auto known = std::ranges::find(plans, each.name, &CellPlan::name);
    CellPlan& plan = known == plans.end() ? plans.emplace_back() : *known;
    const bool is_usual = each.robot.empty();
    plan = {each.name, is_usual ? options.robot : each.robot,
            is_usual && each.workcell.empty() ? options.workcell : each.workcell, 0,
            each.token_file};
  }
  return plans;
}

/// Gives each cell the port of its place, or the one that was chosen for it.
void assign_ports(const ServeOptions& options, std::vector<CellPlan>& plans) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto chosen = std::ranges::find(options.cell_choices, plans[i].name, &CellChoice::name);
    const bool has_own = chosen != options.cell_choices.end() && chosen->port;
    const std::size_t port = has_own                   ? *chosen->port
                             : options.robot_port == 0 ? 0
                                                       : options.robot_port + i;
    if (port > kMaxPort) {
      throw CellPlanError("cell " + plans[i].name + " would have the port " + std::to_string(port) +
                          ", but 65535 is the highest: choose a lower --robot-port, or 0");
    }
    plans[i].port = static_cast<std::uint16_t>(port);
  }
}

void refuse_clashes(const ServeOptions& options, const std::vector<CellPlan>& plans) {
  std::map<std::uint16_t, std::string> owners;
  if (options.monitor_port != 0) owners.emplace(options.monitor_port, "the monitor");
  for (const CellPlan& plan : plans) {
    if (plan.port == 0) continue;
    const auto [owner, is_free] = owners.emplace(plan.port, "cell " + plan.name);
    if (is_free) continue;
    throw CellPlanError("cell " + plan.name + " and " + owner->second +
                        " would both have the port " + std::to_string(plan.port) +
                        ": choose another --robot-port or --monitor-port, or 0 for free ones");
  }
}

void refuse_repeated(const std::vector<CellChoice>& choices) {
  std::map<std::string_view, const CellChoice*> known;
  for (const CellChoice& each : choices) {
    const auto [first, is_new] = known.emplace(each.name, &each);
    if (is_new) continue;
    const bool is_of_roster = !each.source.empty();
    throw CellPlanError(
        is_of_roster ? each.source + ": found the name \"" + each.name +
                           "\", which --cell gives already: each cell has its own name"
                     : "--cell " + each.name + " is given twice: each cell has its own name");
  }
}

bool is_name_of_connection(std::string_view name) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  return name.size() > 1 && name.front() == 'c' && std::ranges::all_of(name.substr(1), is_digit);
}

void refuse_for_connections(const CellChoice& choice) {
  if (choice.port)
    throw CellPlanError(choice.source + ": found a port for \"" + choice.name +
                        "\"; with --cell-per-connection all have the one of --robot-port");
  if (is_name_of_connection(choice.name))
    throw CellPlanError(choice.source + ": found the name \"" + choice.name +
                        "\"; with --cell-per-connection c and a number name other robots");
}

}  // namespace

bool is_cell_name(std::string_view name) {
  const auto is_allowed = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
           c == '-';
  };
  return !name.empty() && name.size() <= kMaxCellName && std::ranges::all_of(name, is_allowed);
}

CellChoice parse_cell(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !is_cell_name(text.substr(0, equals))) refuse_cell(text);
  std::string_view rest = std::string_view(text).substr(equals + 1);
  const bool has_port = std::ranges::count(rest, ',') == 2;
  CellChoice choice{text.substr(0, equals), next_part(rest), next_part(rest), {}};
  if (choice.robot.empty() || (!has_port && !rest.empty())) refuse_cell(text);
  if (!has_port) return choice;
  choice.port = whole_number<std::uint16_t>(rest, 0, kMaxPort);
  if (!choice.port) refuse_cell(text);
  return choice;
}

std::vector<CellPlan> plan_cells(const ServeOptions& options) {
  refuse_repeated(options.cell_choices);
  std::vector<CellPlan> plans = named_plans(options);
  if (plans.empty() && options.is_cell_per_connection) return {};
  if (plans.empty()) return {{"main", options.robot, options.workcell, options.robot_port}};
  if (plans.size() > options.max_cells) {
    throw CellPlanError("these are " + std::to_string(plans.size()) +
                        " cells, but --max-cells is " + std::to_string(options.max_cells));
  }
  if (options.is_cell_per_connection) {
    std::ranges::for_each(options.cell_choices, refuse_for_connections);
    return plans;
  }
  assign_ports(options, plans);
  refuse_clashes(options, plans);
  return plans;
}

}  // namespace xr3
