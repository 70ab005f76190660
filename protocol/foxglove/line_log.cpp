#include "protocol/foxglove/line_log.hpp"

#include <nlohmann/json.hpp>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/explain.hpp"
#include "protocol/foxglove/geometry.hpp"
#include "protocol/monitor/message.hpp"

namespace xr3::foxglove {
namespace {

std::string sentence_of(const WireRecord& record, const Model& model) {
  std::string text = record.direction == Direction::kIn ? "> " : "< ";
  text += readable(record.shown);
  if (record.bytes > record.shown.size()) text += "...";
  std::string_view separator = "  ";
  for (const Explanation& each : explain(record, model)) {
    text.append(separator).append(each.message);
    separator = "; ";
  }
  return text;
}

}  // namespace

std::string log_text(const WireRecord& record, const Model& model, Nanoseconds time) {
  constexpr int kDebug = 1;  // foxglove.LogLevel
  return monitor::text_of(Json::object({{"timestamp", time_json(time)},
                                        {"level", kDebug},
                                        {"message", sentence_of(record, model)},
                                        {"name", "line " + std::to_string(record.line)},
                                        {"file", ""},
                                        {"line", 0}}));
}

}  // namespace xr3::foxglove
