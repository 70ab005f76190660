#include "protocol/recording/call_json.hpp"

#include <utility>

#include "protocol/monitor/call_table.hpp"
#include "protocol/monitor/request_error.hpp"

namespace xr3::recording {
namespace {

constexpr std::size_t kMaxFnLength = 40;

const monitor::CallForm* call_form(const data::Place& fn) {
  const bool is_name = fn.value.is_text() && fn.value.text_size() <= kMaxFnLength;
  return is_name ? monitor::find_call(fn.value.text()) : nullptr;
}

}  // namespace

std::optional<call::Call> read_call_json(const data::Place& fn, JsonValue args) {
  const auto refuse = [&fn] {
    fn.refuse("the name of a call that changes the cell");
    return std::nullopt;
  };
  const monitor::CallForm* form = call_form(fn);
  if (form == nullptr) return refuse();
  monitor::Findings findings;
  monitor::ArgsReader reader(args, args ? args.pointer_from(fn.reading.root()) : "", findings);
  monitor::CallValue value = form->read(reader);
  reader.refuse_others();
  for (const monitor::Detail& detail : findings.error({}).details) {
    fn.reading.refuse(detail.pointer, detail.found.is_null() ? "" : data::shown(detail.found),
                      detail.allowed);
  }
  if (!findings.empty()) return std::nullopt;
  auto* call = std::get_if<call::Call>(&value);
  if (call == nullptr) return refuse();
  return std::move(*call);
}

}  // namespace xr3::recording
