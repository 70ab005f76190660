#include "protocol/files/paper_form/reader.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/codec.hpp"

namespace xr3::paper {
namespace {

constexpr std::size_t kMaxLength = 250;  // maximum length of the text that a finding shows
constexpr const char* kRestUnread = " (the rest of the file was not read)";

Json::json_pointer at(const std::string& pointer) { return Json::json_pointer(pointer); }

bool looks_like_label(const std::string& item) {
  return item.size() == 1 && item[0] >= 'A' && item[0] <= 'Z';
}

std::string shown_items(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : " ") + item;
  return data::shown(Json(text));
}

std::string item_count(std::size_t items) {
  return items == 1 ? "one item" : std::to_string(items) + " items";
}

bool is_inside(const std::string& pointer, const std::string& around) {
  return pointer == around || pointer.starts_with(around + "/");
}

}  // namespace

PaperReader::PaperReader(std::string_view text, std::string file)
    : file_(std::move(file)), lines_(split(text, file_)), findings_(lines_.findings) {}

void PaperReader::open(const std::string& part, const Extras& extras) {
  if (has_more()) line_of_[part] = lines_.data[next_].line;
  parts_.push_back({part, extras});
}

void PaperReader::close() { parts_.pop_back(); }

/// The next line, after handling its additions. At the end of the file: reports it, returns
/// nullptr.
const DataLine* PaperReader::next_line(const std::string& title, const std::string& pointer) {
  if (is_lost_) return nullptr;
  if (next_ == lines_.data.size()) {
    is_lost_ = true;
    report(lines_.end, pointer, "the end of the file", title);
    return nullptr;
  }
  const DataLine& line = lines_.data[next_++];
  apply_additions(line.additions);
  line_of_[pointer] = line.line;
  return &line;
}

bool PaperReader::matches(const DataRow& row, const DataLine& line) const {
  if (line.items.size() != row.cells.size()) return false;
  return row.cells.size() > 1 || row.cells[0].is_label == looks_like_label(line.items[0]);
}

/// Reports an invalid line. A missing or additional line shifts all that follow: after two invalid
/// lines in a row, reading ends.
void PaperReader::report_mismatch(const DataRow& row, const std::string& pointer,
                                  const DataLine& line) {
  is_lost_ = is_after_mismatch_;
  is_after_mismatch_ = true;
  report(line.line, pointer, shown_items(line.items),
         item_count(row.cells.size()) + ": " + row.title + (is_lost_ ? kRestUnread : ""));
}

bool PaperReader::row(const DataRow& row, const std::string& part) {
  const std::string pointer = part + row.member;
  const DataLine* line = next_line(row.title, pointer);
  if (line == nullptr) return false;
  if (!matches(row, *line)) return report_mismatch(row, pointer, *line), false;
  is_after_mismatch_ = false;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    put(row.cells[i], part, line->items[i], line->line);
  }
  return true;
}

void PaperReader::put(const PaperCell& cell, const std::string& part, const std::string& item,
                      int line) {
  const std::string pointer = part + cell.member;
  const Json value = number_or_text(item);
  line_of_[pointer] = line;
  if (cell.words.empty()) return set(pointer, value);
  std::string allowed;
  for (const auto& [number, word] : cell.words) {
    if (value == number) return set(pointer, word);
    allowed += (allowed.empty() ? "" : " or ") + std::to_string(number) + " (" +
               word.get<std::string>() + ")";
  }
  set(pointer, nullptr);
  report(line, pointer, data::shown(value), allowed);
}

std::size_t PaperReader::count(const std::string& title, const std::string& list, std::size_t most,
                               std::size_t least) {
  const DataRow number{title, {PaperCell{list}}, list};
  if (row(number, "")) return count_at(list, list, most, least);
  if (!is_lost_) findings_.back().allowed += kRestUnread;
  is_lost_ = true;
  return 0;
}

std::size_t PaperReader::count_at(const std::string& at_pointer, const std::string& list,
                                  std::size_t most, std::size_t least) {
  const Json number = value(at_pointer);
  const std::size_t slash = at_pointer.rfind('/');
  root_[at(at_pointer.substr(0, slash))].erase(at_pointer.substr(slash + 1));
  const bool is_count = number.is_number_integer() && number >= least && number <= most;
  if (!is_count) {
    is_lost_ = true;
    report(line_of(at_pointer), list, data::shown(number),
           "a whole number " + std::to_string(least) + " to " + std::to_string(most) + kRestUnread);
    return 0;
  }
  set(list, Json::array());
  for (std::size_t i = 0; i < number; ++i) root_[at(list)].push_back(nullptr);
  return number.get<std::size_t>();
}

bool PaperReader::list(const std::string& title, const std::string& list) {
  const DataLine* line = next_line(title, list);
  if (line == nullptr) return false;
  for (std::size_t i = 0; i < line->items.size(); ++i) {
    put(PaperCell{"/" + std::to_string(i)}, list, line->items[i], line->line);
  }
  return true;
}

Json PaperReader::value(const std::string& pointer) const {
  return root_.contains(at(pointer)) ? root_.at(at(pointer)) : Json();
}

void PaperReader::set(const std::string& pointer, Json value) {
  root_[at(pointer)] = std::move(value);
}

void PaperReader::set_default(const std::string& pointer, Json value) {
  if (!root_.contains(at(pointer))) set(pointer, std::move(value));
}

void PaperReader::apply_additions(const std::vector<Addition>& additions) {
  for (const Addition& addition : additions) apply(addition);
}

/// Sets the member in the innermost part that has such a member.
void PaperReader::apply(const Addition& addition) {
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) {
    for (const Extra& extra : part->extras) {
      if (extra.key == addition.key) return put(addition, extra, part->pointer);
    }
  }
  refuse_addition(addition);
}

void PaperReader::put(const Addition& addition, const Extra& extra, const std::string& part) {
  const std::string pointer = part + extra.member;
  if (line_of_.contains(pointer)) {
    return report(addition.line, pointer, "\"" + extra.key + "\", a duplicate", "each member once");
  }
  line_of_[pointer] = addition.line;
  set(pointer, addition.value);
}

void PaperReader::refuse_addition(const Addition& addition) {
  std::vector<std::string> names;
  for (const Part& part : parts_) {
    for (const Extra& extra : part.extras) names.push_back(extra.key);
  }
  const std::string nearest = data::nearest_name(addition.key, names);
  report(addition.line, child_pointer(parts_.back().pointer, addition.key),
         "an unknown member \"" + addition.key + "\"",
         nearest.empty() ? "here " + data::quoted_names(names)
                         : "perhaps \"" + nearest + "\" was meant");
}

void PaperReader::finish() {
  if (is_lost_) return;
  apply_additions(lines_.last);
  if (next_ == lines_.data.size()) return;
  const DataLine& line = lines_.data[next_];
  const std::size_t left = lines_.data.size() - next_;
  report(line.line, "", shown_items(line.items) + (left > 1 ? " and more lines" : ""),
         "nothing more: the file is complete");
}

void PaperReader::report(int line, const std::string& pointer, const std::string& found,
                         std::string allowed) {
  add_bounded(findings_, {Severity::kError, file_, line, 0, cut(pointer, kMaxLength),
                          cut(found, kMaxLength), std::move(allowed)});
}

/// Whether the value, a value around it, or another item of its row has been refused.
bool PaperReader::is_refused(const std::string& pointer) const {
  return std::any_of(findings_.begin(), findings_.end(), [&](const Finding& finding) {
    if (finding.pointer.empty() || pointer.empty()) return false;
    const bool is_row = line_of(pointer) == finding.line && is_inside(finding.pointer, pointer);
    return is_row || is_inside(pointer, finding.pointer);
  });
}

int PaperReader::line_of(std::string pointer) const {
  while (true) {
    const auto known = line_of_.find(pointer);
    if (known != line_of_.end()) return known->second;
    const std::size_t slash = pointer.rfind('/');
    if (slash == std::string::npos) return 1;
    pointer.resize(slash);
  }
}

Findings PaperReader::merged(Findings of_loader) const {
  Findings all = findings_;
  for (Finding& finding : of_loader) {
    // A member that is missing only because reading ended is not reported.
    const bool is_unread = is_lost_ && !line_of_.contains(finding.pointer);
    if (is_unread || is_refused(finding.pointer)) continue;
    if (finding.more == 0) finding.line = line_of(finding.pointer);
    add_bounded(all, std::move(finding));
  }
  sort_by_line(all);
  return all;
}

}  // namespace xr3::paper
