#include "tests/support/tap.hpp"

#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/explain.hpp"

namespace xr3::test {

Tap::Tap(ModelPtr model)
    : simulation_(std::move(model)),
      line_(simulation_.model().profile(), LineKind::kTcp, "test", 0) {}

std::string Tap::send(std::string_view bytes) {
  const std::size_t first = records_.size();
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kMaxShownIn))) {
    receive(bytes.substr(0, kMaxShownIn));
  }
  std::string text;
  for (std::size_t i = first; i < records_.size(); ++i) {
    text += transcript(records_[i], simulation_.model());
  }
  return text;
}

void Tap::receive(std::string_view bytes) {
  simulation_.take_events();
  exchanges_.clear();
  const std::optional<TelnetFilter> before = line_.telnet();
  const Tick tick = simulation_.tick();
  const WirePlace in{0, tick, 1, line_.bytes_in()};
  const WirePlace out{0, tick, 1, line_.output_end()};
  line_.receive(bytes, simulation_, exchanges_);
  fill_in(records_.emplace_back(), in, bytes, before, exchanges_, simulation_);
  const std::string sent(line_.outbox());
  line_.sent(sent.size(), 0);
  received_ += sent;
  if (!sent.empty()) fill_out(records_.emplace_back(), out, sent, exchanges_, line_.released());
}

std::string transcript(const WireRecord& record, const Model& model) {
  std::string text = record.direction == Direction::kIn ? "> " : "< ";
  text += readable(record.shown) + "\n";
  for (const Explanation& each : explain(record, model)) {
    text += "  " + std::to_string(each.from) + ".." + std::to_string(each.to) + " " +
            std::string(each.code) + ": " + each.message + "\n";
  }
  return text;
}

}  // namespace xr3::test
