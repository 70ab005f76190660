// The monitor's call `transcript`.
#include <nlohmann/json.hpp>
#include <utility>

#include "server/monitor_port/service.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

Json marks_json(const TranscriptSummary& summary) {
  Json marks = Json::array();
  for (const TranscriptMark mark : summary.marks) marks.push_back(name_of(mark));
  return marks;
}

}  // namespace

monitor::Message MonitorService::transcript(HostedCell& at, const monitor::Request& request) {
  Cell& cell = at.cell();
  cell.catch_up(wall_now());
  if (cell.transcript() == nullptr)
    return refused(request.id, {"no_transcript", "only the byte clock has a transcript",
                                "start with --clock bytes"});
  const TranscriptSummary& summary = cell.transcript()->summary();
  Json value = value_now(cell);
  value["sha256"] = transcript_digest(summary, cell.model(), cell.state(), cell.clock_remainder());
  value["lines"] = summary.lines;
  value["bytes_in"] = summary.bytes_in;
  value["bytes_out"] = summary.bytes_out;
  value["marks"] = marks_json(summary);
  return monitor::result(request.id, value);
}

}  // namespace xr3
