#include <optional>

#include "cli/commands/commands.hpp"
#include "cli/commands/convert_recording.hpp"
#include "cli/commands/fail.hpp"
#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/json/text.hpp"
#include "protocol/text/printable.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"
#include "server/files/load_model.hpp"
#include "server/print.hpp"

namespace xr3 {
namespace {

enum class Form : std::uint8_t { kJson, kPlain };

std::optional<Form> form_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension();
  if (ending == ".json") return Form::kJson;
  if (ending == ".txt" || ending == ".dat") return Form::kPlain;
  return std::nullopt;
}

std::string text_in(Form form, const CheckResult& data) {
  const bool is_json = form == Form::kJson;
  if (data.robot) {
    return is_json ? json_text(robot_to_json(*data.robot)) : robot_to_paper_form(*data.robot);
  }
  if (!data.workcell) return "";  // unreachable: a file without errors is a robot or a workcell
  return is_json ? json_text(workcell_to_json(*data.workcell))
                 : workcell_to_paper_form(*data.workcell);
}

std::string summary_of(const CheckResult& data) {
  if (data.robot) return "robot \"" + data.robot->name + "\"";
  return data.workcell ? "workcell \"" + data.workcell->name + "\"" : "";
}

/// Reads the draft back and compares. Throws FileError if the conversion has lost anything.
void check_draft(const DataFile& draft, const CheckResult& data) {
  const CheckResult again = check_either_form(draft.text, draft.path, Profile::kPaper);
  if (again.robot == data.robot && again.workcell == data.workcell) return;
  print_error(to_text(again.findings));
  throw FileError(draft.path + ": reads back differently from the input: a bug in xr3");
}

void print_summary(const ConvertOptions& options, Form form, const CheckResult& data) {
  print_text(printable_line(options.out + ": " + summary_of(data)) +
             (form == Form::kJson ? " as JSON, in mm\n" : " in the paper's plain form, in mm\n"));
}

}  // namespace

ExitCode run_command(const ConvertOptions& options) {
  if (options.out.ends_with(".mcap")) return convert_recording(options);
  if (options.every_ms)
    return fail(ExitCode::kBadInput, options.out + ": --every is for a name that ends in .mcap");
  const std::optional<Form> form = form_of(options.out);
  if (!form) {
    return fail(ExitCode::kBadInput,
                options.out +
                    ": the name must end in .json, in .txt or .dat for the paper's plain form, or "
                    "in .mcap for a recording");
  }
  const DataFile in = read_file(options.in);
  const std::optional<Robot> robot = robot_with_name_of(options.in);
  const CheckResult data =
      check_either_form(in.text, in.path, Profile::kPaper, robot ? &*robot : nullptr);
  print_error(to_text(data.findings));
  if (!data.is_good()) return ExitCode::kBadInput;
  if (data.faults)
    return fail(ExitCode::kBadInput,
                options.in + ": found a fault file; only robots and workcells have two forms");
  const Existing existing = options.force ? Existing::kReplace : Existing::kKeep;
  const bool is_written =
      write_file_atomically(options.out, text_in(*form, data), existing,
                            [&](const DataFile& draft) { check_draft(draft, data); });
  if (!is_written)
    return fail(ExitCode::kBadInput, options.out + ": already exists; --force replaces it");
  print_summary(options, *form, data);
  return ExitCode::kGood;
}

}  // namespace xr3
