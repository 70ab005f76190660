#include "protocol/explain/wire_record.hpp"

#include <algorithm>
#include <cassert>
#include <type_traits>
#include <utility>

namespace xr3 {
namespace {

using wire::Answered;
using wire::Executed;
using wire::Ignored;
using wire::Item;
using wire::NoMotion;
using wire::PictureSize;
using wire::WarningRaised;

// Records of the ring are overwritten hundreds of thousands of times per second.
static_assert(std::is_trivially_copyable_v<Item>);

void begin(WireRecord& record, Direction direction, const WirePlace& place, std::string_view bytes,
           std::size_t most_shown) {
  record.epoch = place.epoch;
  record.tick = place.tick;
  record.line = place.line;
  record.direction = direction;
  record.offset = place.offset;
  record.bytes = bytes.size();
  record.shown.assign(bytes.substr(0, most_shown));
  record.items.clear();
}

// Problems that skip a single byte. They are merged, as a client may send megabytes of garbage.
bool is_junk(const Problem& problem) {
  return problem.code == ProblemCode::kUnknownByte ||
         problem.code == ProblemCode::kNoJointSelected || problem.code == ProblemCode::kDisabled;
}

void add_problem(std::vector<Item>& items, const Parsed& parsed, const Problem& problem) {
  if (is_junk(problem) && !items.empty() && items.back().to == parsed.from) {
    auto* run = std::get_if<Ignored>(&items.back().what);
    if (run != nullptr && run->problem == problem) {
      for (const char byte : parsed.raw.view()) run->raw.push(static_cast<std::uint8_t>(byte));
      ++run->count;
      items.back().to = parsed.to;
      return;
    }
  }
  items.push_back({parsed.from, parsed.to, Ignored{problem, parsed.raw, 1}});
}

const MoveTaken* move_in(const Exchange& exchange) {
  for (const Event& event : exchange.events) {
    if (const auto* taken = std::get_if<MoveTaken>(&event.body)) return taken;
  }
  return nullptr;
}

// Commands never stall a robot, only ticks do: if it is stalled after the bytes, it was before
// them.
NoMotion held_back(const MoveTaken& move, const Simulation& machine) {
  const MotorState& motor = machine.state().motor(machine.model().index_of(move.label));
  return {move.label, machine.state().stall, motor.blocked};
}

void add_command(std::vector<Item>& items, const Exchange& exchange, const Command& command,
                 const Simulation& machine) {
  const auto [from, to] = std::pair(exchange.parsed.from, exchange.parsed.to);
  const MoveTaken* move = move_in(exchange);
  Executed executed{.command = command};
  if (move != nullptr) executed.counter = static_cast<std::int8_t>(move->error);
  items.push_back({from, to, executed});
  bool is_reported = false;
  for (const Event& event : exchange.events) {
    if (const auto* warning = std::get_if<Warning>(&event.body)) {
      items.push_back(
          {from, to, WarningRaised{warning->code, warning->label, warning->value, warning->limit}});
    } else if (const auto* blocked = std::get_if<MotorBlocked>(&event.body)) {
      items.push_back({from, to, *blocked});
      is_reported = true;
    }
  }
  if (move == nullptr || is_reported) return;
  const NoMotion why = held_back(*move, machine);
  if (why.stall != Stall::kNo || why.blocked != Blocked::kNo) items.push_back({from, to, why});
}

// Sets the members of each toggle, backwards from the state after the last byte.
void settle_toggles(std::vector<Item>& items, const State& after, bool has_device) {
  bool display = after.display.on;
  bool erase = after.display.erase;
  bool enabled = after.enabled;
  for (auto item = items.rbegin(); item != items.rend(); ++item) {
    auto* executed = std::get_if<Executed>(&item->what);
    if (executed == nullptr) continue;
    bool* toggled = nullptr;
    if (std::holds_alternative<ToggleDisplay>(executed->command)) toggled = &display;
    if (std::holds_alternative<ToggleErasing>(executed->command)) toggled = &erase;
    if (std::holds_alternative<ToggleSimulator>(executed->command)) toggled = &enabled;
    if (toggled == nullptr) continue;
    executed->is_on = *toggled;
    executed->has_device = has_device;
    *toggled = !*toggled;
  }
}

/// Assigns a reply without its image.
struct WithoutImage {
  ReplyWith<PictureSize>& target;

  void operator()(const CameraRows& rows) const {
    target = PictureSize{rows.image->width(), rows.image->height()};
  }
  template <class Small>
  void operator()(const Small& reply) const {
    target = reply;
  }
};

}  // namespace

void fill_in(WireRecord& record, const WirePlace& place, std::string_view bytes,
             const std::optional<TelnetFilter>& before, const std::vector<Exchange>& exchanges,
             const Simulation& machine, bool has_device) {
  begin(record, Direction::kIn, place, bytes, kMaxShownIn);
  record.telnet = before;
  for (const Exchange& exchange : exchanges) {
    if (const auto* problem = std::get_if<Problem>(&exchange.parsed.what)) {
      add_problem(record.items, exchange.parsed, *problem);
    } else if (exchange.is_for_device) {
      const Command& command = std::get<Command>(exchange.parsed.what);
      record.items.push_back({exchange.parsed.from, exchange.parsed.to, wire::ToDevice{command}});
    } else {
      add_command(record.items, exchange, std::get<Command>(exchange.parsed.what), machine);
    }
  }
  settle_toggles(record.items, machine.state(), has_device);
}

void fill_out(WireRecord& record, const WirePlace& place, std::string_view bytes,
              const std::vector<Item>& replies) {
  begin(record, Direction::kOut, place, bytes, kMaxShownOut);
  record.telnet.reset();
  record.items = replies;
}

wire::Answered answer_of(const Exchange& exchange) {
  assert(!std::holds_alternative<NoReply>(exchange.reply));
  Answered answered;
  answered.command = std::get<Command>(exchange.parsed.what);
  std::visit(WithoutImage{answered.reply}, exchange.reply);
  return answered;
}

}  // namespace xr3
