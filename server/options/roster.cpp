#include "server/options/roster.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "protocol/json/codec.hpp"
#include "protocol/text/whole_number.hpp"
#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr const char* kAllowedName = "1 to 32 letters, digits, _ and -, such as student-01";
constexpr const char* kAllowedPort = "a port, 0 to 65535";
constexpr std::size_t kMaxText = 4096;
constexpr std::uint16_t kHighestPort = 65535;

/// A row as text, with the line of the file.
struct RosterRow {
  int line = 0;
  std::string name;
  std::string robot;
  std::string workcell;
  std::string port;
  std::string token_file;
};

struct RosterColumn {
  std::string_view name;
  std::string RosterRow::*field;
};
constexpr std::array<RosterColumn, 5> kColumns{{{"name", &RosterRow::name},
                                                {"robot", &RosterRow::robot},
                                                {"workcell", &RosterRow::workcell},
                                                {"port", &RosterRow::port},
                                                {"token_file", &RosterRow::token_file}}};

std::string in_quotes(std::string_view text) {
  return "\"" + cut(text, data::Reading::kMaxNameLength) + "\"";
}

class RosterReader {
 public:
  explicit RosterReader(std::string file) : file_(std::move(file)) {}

  FileReading<std::vector<CellChoice>> read(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool is_json =
        first != std::string_view::npos && (text[first] == '[' || text[first] == '{');
    std::vector<RosterRow> rows = is_json ? rows_of_json(text) : rows_of_table(text);
    std::vector<CellChoice> cells;
    for (RosterRow& row : rows) cells.push_back(cell_of(std::move(row)));
    if (rows.empty() && findings_.empty()) refuse(1, "no row", "a row for each robot");
    if (has_errors(findings_)) return {std::nullopt, std::move(findings_)};
    return {std::move(cells), {}};
  }

 private:
  void refuse(int line, std::string found, std::string allowed) {
    add_bounded(findings_,
                {Severity::kError, file_, line, 0, "", std::move(found), std::move(allowed)});
  }

  // --- Tables.

  std::vector<RosterRow> rows_of_table(std::string_view text) {
    std::vector<RosterRow> rows;
    std::vector<const RosterColumn*> columns;
    for (int line = 1; !text.empty(); ++line) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view whole = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (line == 1) separator_ = separator_of(whole);
      const auto fields = fields_of(whole, line);
      const bool is_empty = std::ranges::all_of(fields, &std::string::empty);
      if (columns.empty() && !is_empty) {
        columns = columns_of(fields, line);
        if (columns.empty()) break;
      } else if (!is_empty) {
        rows.push_back(row_of(fields, columns, line));
      }
    }
    if (columns.empty() && findings_.empty())
      refuse(1, "nothing", "a header with the column name, then a row for each robot");
    return rows;
  }

  /// The first separator of the header.
  static char separator_of(std::string_view header) {
    const std::size_t first = header.find_first_of(",;\t");
    return first == std::string_view::npos ? ',' : header[first];
  }

  std::vector<std::string> fields_of(std::string_view text, int line) {
    std::vector<std::string> fields;
    for (bool has_more = true; has_more;) {
      text.remove_prefix(std::min(text.find_first_not_of(blanks()), text.size()));
      fields.push_back(text.starts_with('"') ? quoted_field(text, line) : plain_field(text));
      has_more = !text.empty();
      if (has_more && text.front() != separator_) {
        refuse(line, in_quotes(text) + " after a quote",
               std::string("the separator ") + separator_ + ", or the end of the line");
        break;
      }
      if (has_more) text.remove_prefix(1);
    }
    return fields;
  }
  std::string_view blanks() const { return separator_ == '\t' ? " \r" : kBlanks; }

  /// Removes the field from the text, but not the separator after it.
  std::string plain_field(std::string_view& text) const {
    const std::size_t end = std::min(text.find(separator_), text.size());
    std::string_view field = text.substr(0, end);
    field = field.substr(0, field.find_last_not_of(kBlanks) + 1);
    text.remove_prefix(end);
    return std::string(field);
  }

  /// Removes a field in quotes, and the blanks after it. A doubled quote stands for one.
  std::string quoted_field(std::string_view& text, int line) {
    std::string field;
    text.remove_prefix(1);
    while (true) {
      const std::size_t quote = text.find('"');
      if (quote == std::string_view::npos) {
        refuse(line, "a quote that is not closed", "both quotes of a field on one line");
        text = {};
        return field;
      }
      field += text.substr(0, quote);
      text.remove_prefix(quote + 1);
      if (!text.starts_with('"')) break;
      field += '"';
      text.remove_prefix(1);
    }
    text.remove_prefix(std::min(text.find_first_not_of(blanks()), text.size()));
    return field;
  }

  /// The columns of the header; empty if it is not allowed.
  std::vector<const RosterColumn*> columns_of(const std::vector<std::string>& names, int line) {
    constexpr const char* kAllowed =
        "a header with each of these at most once: name, robot, workcell, port, token_file";
    std::vector<const RosterColumn*> columns;
    for (const std::string& name : names) {
      const auto* const column = std::ranges::find(kColumns, name, &RosterColumn::name);
      const bool is_known = column != kColumns.end();
      if (!is_known || std::ranges::find(columns, column) != columns.end()) {
        refuse(line, (is_known ? "twice the column " : "the column ") + in_quotes(name), kAllowed);
        return {};
      }
      columns.push_back(column);
    }
    if (std::ranges::find(columns, kColumns.begin()) != columns.end()) return columns;
    refuse(line, "no column \"name\"", kAllowed);
    return {};
  }

  /// Fields that are missing at the end are empty, as some spreadsheets write them.
  RosterRow row_of(const std::vector<std::string>& fields,
                   const std::vector<const RosterColumn*>& columns, int line) {
    RosterRow row{line, {}, {}, {}, {}, {}};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (i < columns.size()) {
        row.*columns[i]->field = fields[i];
      } else if (!fields[i].empty()) {
        refuse(line, "the field " + in_quotes(fields[i]) + " after the last column",
               "as many fields as the header has, which are " + std::to_string(columns.size()) +
                   "; a field with a separator needs quotes");
      }
    }
    return row;
  }

  // --- JSON.

  static const data::Members<RosterRow>& members() {
    using namespace data;  // NOLINT: keeps the table readable
    const auto port_text = converted<std::string, std::uint16_t>(
        integer<std::uint16_t>(0, kHighestPort),
        [](const std::uint16_t& port) { return std::to_string(port); }, nullptr);
    static const Members<RosterRow> members = {
        required("name", &RosterRow::name, text(0, kMaxText)),
        optional("robot", &RosterRow::robot, text(0, kMaxText)),
        optional("workcell", &RosterRow::workcell, text(0, kMaxText)),
        optional("port", &RosterRow::port, port_text),
        optional("token_file", &RosterRow::token_file, text(0, kMaxText))};
    return members;
  }

  std::vector<RosterRow> rows_of_json(std::string_view text) try {
    constexpr std::size_t kMaxRows = 100'000;
    const JsonSource source(text, file_);
    data::Reading reading(source, data::Unit::kMm);
    std::vector<RosterRow> rows;
    data::list(data::object(members()), 0, kMaxRows).read({reading, source.root()}, rows);
    for (Finding& each : reading.take_findings()) add_bounded(findings_, std::move(each));
    if (!findings_.empty()) return {};
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].line = source.line_of(source.root().element(i));
    return rows;
  } catch (const DataError& error) {
    findings_ = error.findings();
    return {};
  }

  // --- Cells.

  CellChoice cell_of(RosterRow row) {
    if (!is_cell_name(row.name)) {
      refuse(row.line, row.name.empty() ? "no name" : "the name " + in_quotes(row.name),
             kAllowedName);
    } else if (const auto [first, is_new] = lines_.emplace(row.name, row.line); !is_new) {
      refuse(row.line,
             "the name " + in_quotes(row.name) + " of line " + std::to_string(first->second),
             "a name of its own for each robot");
    }
    CellChoice cell{std::move(row.name), std::move(row.robot), std::move(row.workcell), {}};
    if (!row.port.empty()) cell.port = whole_number<std::uint16_t>(row.port, 0, kHighestPort);
    if (!row.port.empty() && !cell.port)
      refuse(row.line, "the port " + in_quotes(row.port), kAllowedPort);
    cell.token_file = std::move(row.token_file);
    cell.source = file_ + ":" + std::to_string(row.line);
    return cell;
  }

  std::string file_;
  char separator_ = ',';
  std::map<std::string, int> lines_;  ///< by name
  Findings findings_;
};

}  // namespace

FileReading<std::vector<CellChoice>> read_roster(std::string_view text, const std::string& file) {
  return RosterReader(file).read(text);
}

std::vector<CellChoice> load_roster(const std::string& path) {
  const DataFile file = read_file(path);
  return value_of(read_roster(file.text, file.path));
}

}  // namespace xr3
