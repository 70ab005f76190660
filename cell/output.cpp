#include "cell/output.hpp"

#include <algorithm>

namespace xr3 {

void CellOutput::hand_over() {
  if (is_empty()) return;
  struct Clearing {
    CellOutput& output;
    ~Clearing() { output.clear(); }
  };
  const Clearing at_the_end{*this};
  taker_(*this);
}

void CellOutput::clear() {
  const bool is_large = slots_.size() > kKept || events.size() > kKept;
  events.clear();
  woken.clear();
  silences.clear();
  records_ = 0;
  runs_.clear();
  bytes_.clear();
  if (is_large) {
    events.shrink_to_fit();
    runs_.shrink_to_fit();
    slots_.resize(std::min(slots_.size(), kKept));
  }
  if (bytes_.capacity() > 2 * kLargeBytes) bytes_.shrink_to_fit();  // after an image
}

WireRecord& CellOutput::add_record() {
  if (records_ == slots_.size()) slots_.emplace_back();
  return slots_[records_++];
}

void CellOutput::add_bytes(Tick tick, LineId line, std::string_view bytes) {
  if (bytes.empty()) return;
  runs_.push_back({tick, line, bytes_.size(), bytes.size()});
  bytes_ += bytes;
}

}  // namespace xr3
