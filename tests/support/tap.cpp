#include "tests/support/tap.hpp"

#include <utility>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/explain/explain.hpp"

namespace xr3::test {

std::string Tap::send(std::string_view bytes) {
  const std::size_t first = records_.size();
  for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kMaxShownIn))) {
    receive(bytes.substr(0, kMaxShownIn));
  }
  std::string text;
  for (std::size_t i = first; i < records_.size(); ++i) {
    text += transcript(records_[i], simulation().model());
  }
  return text;
}

void Tap::receive(std::string_view bytes) {
  one_.receive(bytes);
  for (const WireRecord& record : one_.out.records()) records_.push_back(record);
  received_ += one_.fetch();
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
