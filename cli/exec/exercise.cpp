#include "cli/exec/exercise.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "cli/exec/private_file.hpp"
#include "cli/exec/run_folder.hpp"
#include "cli/exec/sandbox.hpp"
#include "server/files/atomic_write.hpp"
#include "server/files/data_files.hpp"
#include "server/files/load_model.hpp"
#include "tools/drawing/picture.hpp"
#include "tools/drawing/svg.hpp"

namespace xr3 {
namespace {

void require_readable(const std::vector<std::string>& paths) {
  for (const std::string& each : paths)
    if (::access(each.c_str(), R_OK) != 0)
      throw FileError("--read " + each + ": " + std::system_category().message(errno));
}

void make_folder(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::create_directories(path, error) && error)
    throw FileError(path + ": cannot be made: " + error.message());
  if (!std::filesystem::is_empty(path, error))
    throw FileError(path + ": there is something in this folder; name a new one");
}

std::string picture_of(const RunResult& result) {
  return to_svg(drawing(*result.model, result.end, ViewVector{}, kUsualPictureWidthPx));
}

}  // namespace

Exercise::Sources::Sources(ExecOptions exec_options, ServeOptions server_options)
    : exec(std::move(exec_options)), server(std::move(server_options)) {
  remove_abandoned_folders();
  if (exec.exercise.empty()) return;
  folder.emplace(exec.exercise);
  folder->set(exec);
  folder->set(server);
}

Exercise::Exercise(const Sources& sources)
    : title_(sources.folder ? sources.folder->file().title : ""),
      options_(sources.exec),
      server_(sources.server),
      seed_(load_seed(server_, server_.robot, server_.workcell)),
      goals_(options_.goals.empty() ? GoalList{} : load_goal_list(options_.goals, *seed_.model)) {
  require_readable(options_.readable);
  const auto user = program_user(options_.run_as, options_.is_sandboxed, 0);
  if (options_.is_sandboxed) require_sandbox(user, options_.without_sandbox);
}

std::optional<Variation> Exercise::variation_of(std::size_t run) const {
  std::optional<Variation> variation = options_.vary;
  if (variation && run > 0) variation->seed += run - 1;
  return variation;
}

CellSeed Exercise::seed_of(std::size_t run) const {
  const std::optional<Variation> variation = variation_of(run);
  if (!variation) return seed_;
  const auto workcell = varied(seed_.model->workcell(), seed_.model->robot(), *variation);
  if (!workcell)
    throw FileError("--vary " + std::to_string(variation->seed) +
                    ": found no place for a block within reach and in view, apart from the others; "
                    "allow more mm");
  CellSeed seed = seed_;
  seed.model =
      std::make_shared<const Model>(seed_.model->robot(), *workcell, seed_.model->profile());
  return seed;
}

RunReport Exercise::run(const RunPlace& place) const {
  RunSettings settings{server_,  seed_of(place.run),
                       options_, program_user(options_.run_as, options_.is_sandboxed, place.job),
                       "",       place.refused};
  settings.exec.command = place.command;
  settings.exec.readable.push_back(place.readable);
  settings.server.record = place.record;
  if (!place.folder.empty()) {
    make_folder(place.folder);
    settings.server.record = place.folder + "/recording.xr3rec";
    settings.output_file = place.folder + "/output.txt";
  }
  RunResult result = run_program(settings, goals_);
  result.report.program = place.title;
  result.report.run = place.run;
  if (const auto variation = variation_of(place.run)) result.report.seed = variation->seed;
  if (place.transcripts != nullptr)
    place.transcripts->keep(result.report.transcript, result.transcript);
  if (!place.folder.empty()) {
    write_file(place.folder + "/end.svg", picture_of(result));
    write_private(place.folder + "/transcript.txt", result.transcript);
    write_file(place.folder + "/result.txt", to_text(result.report));
    write_private(place.folder + "/" + kResultFile, to_json(result.report));
  }
  return std::move(result.report);
}

WallNs Exercise::run_limit() const {
  constexpr double kForTheEnd = 60;  // ending the program, the rest of the motion, the files
  constexpr double kNs = 1e9;
  const double wall_s = options_.limits.wall_s;
  return wall_s > 0 ? static_cast<WallNs>((wall_s + kForTheEnd) * kNs) : 0;
}

RunReport report_of(const std::optional<std::string>& text, const std::string& title,
                    std::size_t run) {
  if (text) try {
      return parse_report(*text);
    } catch (const std::exception&) {
    }
  RunReport report;
  report.program = title;
  report.run = run;
  report.outcome = RunOutcome::kFailed;
  report.why = "the run could not be made; standard error says why";
  return report;
}

std::size_t usual_jobs() {
  constexpr unsigned kJobsOfProcessor = 8;  // programs mostly wait
  return kJobsOfProcessor * std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace xr3
