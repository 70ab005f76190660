#include "protocol/files/paper_form/writer.hpp"

#include <nlohmann/json.hpp>

namespace xr3::paper {
namespace {

std::string item_of(const PaperCell& cell, const Json& value) {
  for (const auto& [number, word] : cell.words) {
    if (word == value) return std::to_string(number);
  }
  return cell.is_label ? value.get<std::string>() : value.dump();
}

}  // namespace

void PaperWriter::comment(std::string_view text) { text_ += "* " + std::string(text) + "\n"; }

void PaperWriter::extras(const Extras& extras, const Json& part) {
  std::string members;
  for (const Extra& extra : extras) {
    const Json::json_pointer member(extra.member);
    if (!part.contains(member)) continue;
    if (!members.empty()) members += ", ";
    members += Json(extra.key).dump() + ": " + part.at(member).dump();
  }
  if (!members.empty()) text_ += "*+ " + members + "\n";
}

void PaperWriter::row(const DataRow& row, const Json& part) {
  comment(row.title);
  line(row, part);
}

void PaperWriter::line(const DataRow& row, const Json& part) {
  std::string items;
  for (const PaperCell& cell : row.cells) {
    if (!items.empty()) items += " ";
    items += item_of(cell, part.at(Json::json_pointer(cell.member)));
  }
  text_ += items + "\n";
}

void PaperWriter::number(std::string_view title, std::size_t number) {
  comment(title);
  text_ += std::to_string(number) + "\n";
}

std::string stem_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  const std::string name = slash == std::string::npos ? file : file.substr(slash + 1);
  const std::string stem = name.substr(0, name.rfind('.'));
  return stem.empty() ? "unnamed" : stem.substr(0, 80);
}

}  // namespace xr3::paper
