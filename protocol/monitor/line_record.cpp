#include "protocol/monitor/line_record.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/explain.hpp"

namespace xr3 {

Json wire_json(const WireRecord& record, const Model& model) {
  Json parsed = Json::array();
  for (Explanation& each : explain(record, model)) {
    parsed.push_back({{"from", each.from},
                      {"to", each.to},
                      {"code", each.code},
                      {"message", std::move(each.message)}});
  }
  return {{"line", record.line},
          {"dir", record.direction == Direction::kIn ? "in" : "out"},
          {"offset", record.offset},
          {"hex", hexadecimal(record.shown)},
          {"text", readable(record.shown)},
          {"bytes", record.bytes},
          {"parsed", std::move(parsed)}};
}

}  // namespace xr3
