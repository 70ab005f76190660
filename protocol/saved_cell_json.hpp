#pragma once
#include "protocol/call.hpp"
#include "protocol/monitor_request.hpp"
namespace xr3 { inline Json saved_cell_to_json(const SavedCell& s) { return {{"robot_hash", s.robot_hash}, {"tick", s.state.tick}}; }
namespace monitor { inline std::vector<Detail> misfits(const Model&, const SavedCell&) { return {}; } } }
