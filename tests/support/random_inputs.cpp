#include "tests/support/random_inputs.hpp"

#include <utility>
#include <vector>

namespace xr3::test {

void RandomInputs::play(int inputs) {
  for (int i = 0; i < inputs; ++i) {
    pass();
    act();
  }
}

std::uint32_t RandomInputs::below(std::uint32_t end) {
  return static_cast<std::uint32_t>(random_() % end);
}

void RandomInputs::pass() {
  constexpr WallNs kTimes[] = {0,          1'000,       999'999,      1'000'000,
                               20'000'000, 300'000'000, 4'000'000'000};
  now_ += kTimes[below(7)] + (below(2) == 0 ? below(1'000'000) : 0);
  if (below(3) == 0) cell_.catch_up(now_);
}

void RandomInputs::act() {
  switch (below(8)) {
    case 0: return open();
    case 1: return close();
    case 2: return call();
    case 3: return take();
    default: return send();
  }
}

void RandomInputs::open() {
  constexpr LineKind kKinds[] = {LineKind::kTcp, LineKind::kTcp, LineKind::kPty,
                                 LineKind::kMonitor};
  if (cell_.lines().size() < 4) cell_.apply(LineOpened{"test", kKinds[below(4)]}, now_);
}

LineId RandomInputs::some_line() {
  if (cell_.lines().empty()) cell_.apply(LineOpened{"test"}, now_);
  auto line = cell_.lines().begin();
  std::advance(line, below(static_cast<std::uint32_t>(cell_.lines().size())));
  return line->first;
}

void RandomInputs::close() {
  const LineId line = some_line();
  if (below(2) == 0) cell_.apply(InputEnded{line}, now_);
  if (below(2) == 0) cell_.apply(LineClosed{line, LineCloseReason::kDisconnected}, now_);
}

void RandomInputs::take() {
  const LineId line = some_line();
  const auto waiting = static_cast<std::uint32_t>(cell_.find_line(line)->outbox().size());
  cell_.sent({line, below(waiting + 1)});
  if (below(4) == 0)
    cell_.apply(LineSettings{line, *parse_serial_settings(below(2) == 0 ? "9600-7e2" : "300-8n1")},
                now_);
}

std::string RandomInputs::bytes() {
  const std::vector<std::string> pieces = {
      "E?",
      "E+50\r",
      "C-90\r",
      "D?",
      "I",
      "V?",
      "A?",
      "E-1\r",
      "A$",
      "A@",
      "P5",
      "R3\r",
      "x\xff",
      "GET / HTTP/1.1\r\n",
      "CONNECT a",
      "A&1,1,1,3;",
      "A!",
      "\xff\xfd\x03",
      "\xff\xfb\x2c",
      std::string("\xff\xfa\x2c\x01\x00\x00\x25\x80\xff\xf0", 10),
      "\xff\xfa\x2c\x08\xff\xf0",
      "\xff\xfa\x2c\x09\xff\xf0",
      "J",
      "K",
      "T",
      "12",
      "\r",
      std::string(3000, '?')};
  std::string all;
  for (std::uint32_t i = below(6); i < 6; ++i)
    all += pieces[below(static_cast<std::uint32_t>(pieces.size()))];
  return all;
}

void RandomInputs::send() {
  const LineId line = some_line();
  const std::string sent = bytes();
  int pieces = 0;
  const int pieces_wanted = static_cast<int>(below(100));
  cell_.apply(BytesIn{line, sent}, now_, [&] { return ++pieces > pieces_wanted; });
  const SerialLine& its = *cell_.find_line(line);
  if (its.is_not_a_robot_program())
    return void(cell_.apply(LineClosed{line, LineCloseReason::kNotARobotProgram}, now_));
  if (below(3) != 0) cell_.sent({line, its.outbox().size()});
}

void RandomInputs::call() {
  Fault fault;
  fault.name = "f" + std::to_string(below(3));
  constexpr FaultKind kKinds[] = {FaultKind::kByteDropped,      FaultKind::kReplyDelayed,
                                  FaultKind::kReplyBatched,     FaultKind::kXoffStall,
                                  FaultKind::kLineDisconnected, FaultKind::kPowerCycle,
                                  FaultKind::kMotorSlow,        FaultKind::kByteDoubled};
  fault.kind = kKinds[below(8)];
  fault.from_tick = cell_.state().tick + below(2000);
  fault.ticks = 1 + below(5000);
  if (fault.kind == FaultKind::kReplyDelayed) fault.delay_ms = 1 + below(900);
  if (fault.kind == FaultKind::kMotorSlow) fault.percent = 50, fault.joint = 'E';
  const bool is_once =
      fault.kind == FaultKind::kLineDisconnected || fault.kind == FaultKind::kPowerCycle;
  if (is_once) {
    fault.at_tick = std::exchange(fault.from_tick, std::nullopt);
    fault.ticks.reset();
  }
  const std::vector<call::Call> calls = {
      call::Pause{},
      call::Resume{},
      call::Resume{},
      call::SetRate{{1'000'000 + below(9'000'000)}},
      call::Step{below(3000)},
      call::RunUntil{std::nullopt, below(30'000)},
      call::RunUntil{cell_.state().tick + below(500), 1000},
      call::Reset{},
      call::Home{},
      call::Key{ToggleSimulator{}},
      call::Key{SetViewVector{1, -2, 3}},
      call::SetInput{static_cast<int>(1 + below(8)), below(2) == 0},
      call::MoveBlock{"red", PointUm{200'000, 100'000, 20'000}, std::nullopt},
      call::SaveSnapshot{"s"},
      call::LoadSnapshot{"s", nullptr},
      call::SetFault{fault, below(2) == 0 ? std::optional<std::uint64_t>(below(9)) : std::nullopt},
      call::SetFault{fault, std::nullopt},
      call::ClearFault{""}};
  cell_.apply(Input{calls[below(static_cast<std::uint32_t>(calls.size()))]}, now_);
}

}  // namespace xr3::test
