// The engine and the menu. Questions about blocks are in blocks.cpp, all others in
// room.cpp.
#include "tools/workcell_editor/dialogue.hpp"

#include <algorithm>
#include <utility>

#include "protocol/files/summary.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/json/text.hpp"
#include "protocol/text/printable.hpp"

namespace xr3 {
namespace {

constexpr std::size_t kMaxLineLength = 4096;
constexpr double kHandHeightMm = 20;  ///< above the work surface, for the reach shown in the view

constexpr const char* kMenuHelp =
    "  list          show all items            view         the workspace from above\n"
    "  add           add a block               change NAME  edit all items of a block\n"
    "  move NAME     edit its position         turn NAME    edit its orientation\n"
    "  remove NAME   remove it                 check        report problems\n"
    "  name  workspace  surface  camera        edit the other items\n"
    "  save          write the file            quit         leave\n"
    "Commands may be abbreviated. NAME is a block's name, or its letter in the view.\n"
    "While items are asked: Enter accepts the default in brackets, ? explains, . returns here.\n";

}  // namespace

WorkcellDialogue::WorkcellDialogue(DialogueStart start)
    : file_(std::move(start.file)),
      from_(std::move(start.from)),
      is_new_(!start.workcell),
      arm_(std::move(start.robot)) {
  if (is_new_) {
    workcell_ = dialogue::proposed_workcell(arm_);
    return;
  }
  workcell_ = *std::move(start.workcell);
  if (from_ == file_) saved_ = workcell_;
}

DialogueTurn WorkcellDialogue::begin() {
  say("Workcell for " + file_ + ", checked against " + arm_.robot.name + ". Lengths are in mm.\n");
  if (is_new_) {
    say("Enter accepts the default in brackets, ? explains, . leaves the rest as it is.\n");
    ask_all();
  } else {
    say("From " + from_ + ": \"" + printable_line(workcell_.name) + "\", " +
        std::to_string(workcell_.blocks.size()) + " blocks. ? shows the commands.\n");
    check();
  }
  next();
  return turn();
}

DialogueTurn WorkcellDialogue::handle(std::string_view line) {
  text_.clear();
  answer(dialogue::trimmed(line));
  return turn();
}

void WorkcellDialogue::answer(std::string_view line) {
  if (line.size() > kMaxLineLength) return say("That line is too long.\n");
  if (line == "?") return say(question_.help.empty() ? "" : question_.help + "\n");
  if (line == "." && !question_.prompt.ends_with('>')) {
    steps_.clear();
    then_ = nullptr;
    is_making_ = false;
    is_leaving_ = false;
    say("Back to the menu; unfinished changes are discarded. ? shows the commands.\n");
    return next();
  }
  const Question asked = question_;  // a copy: the answer may replace question_
  const std::string problem = asked.handle(line.empty() ? asked.fallback : std::string(line));
  if (!problem.empty()) return say("  " + problem + "\n");
  next();
}

/// Proceeds to the next question, or to the menu if there is none.
void WorkcellDialogue::next() {
  while (steps_.empty() && then_) std::exchange(then_, nullptr)();
  if (is_over_ || file_text_) return;
  if (steps_.empty()) {
    question_ = menu();
    return;
  }
  const Step step = std::move(steps_.front());
  steps_.pop_front();
  question_ = step();
}

DialogueTurn WorkcellDialogue::turn() {
  DialogueTurn result{text_, file_text_, may_replace_, is_over_};
  if (!is_over_ && !file_text_) result.text += dialogue::shown(question_);
  text_.clear();
  return result;
}

void WorkcellDialogue::ask(Steps steps, std::function<void()> then) {
  steps_ = std::move(steps);
  then_ = std::move(then);
}

void WorkcellDialogue::ask_yes_no(const std::string& prompt, bool fallback, const std::string& help,
                                  std::function<void(bool)> then) {
  is_yes_ = fallback;
  ask({[=, this] { return dialogue::yes_no_question(prompt, is_yes_, help); }},
      [this, then = std::move(then)] { then(is_yes_); });
}

WorkcellDialogue::Steps WorkcellDialogue::joined(const std::vector<Steps>& parts) {
  Steps all;
  for (const Steps& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The menu.

const std::vector<WorkcellDialogue::DialogueCommand>& WorkcellDialogue::commands() {
  using Self = WorkcellDialogue;
  static const std::vector<DialogueCommand> table = {
      {"help", [](Self& self) { self.say(kMenuHelp); }},
      {"list", [](Self& self) { self.say(workcell_summary(self.workcell_)); }},
      {"view", &Self::view},
      {"check", &Self::check},
      {"add", &Self::add},
      {"change", &Self::change, true},
      {"move",
       [](Self& self) {
         self.edit_block(joined({self.place_steps(), {self.height_step()}}));
       },
       true},
      {"turn", [](Self& self) { self.edit_block({self.yaw_step()}); }, true},
      {"remove", &Self::remove, true},
      {"name", [](Self& self) { self.edit_room(self.name_steps()); }},
      {"workspace", [](Self& self) { self.edit_room(self.workspace_steps()); }},
      {"surface", [](Self& self) { self.edit_room(self.surface_steps()); }},
      {"camera", &Self::camera},
      {"save", &Self::save},
      {"quit", &Self::quit}};
  return table;
}

WorkcellDialogue::Question WorkcellDialogue::menu() {
  Question question;
  question.prompt = has_unsaved() ? "workcell (not saved)>" : "workcell>";
  question.help = std::string(kMenuHelp).substr(0, std::string(kMenuHelp).size() - 1);
  question.handle = [this](const std::string& line) { return run_command(line); };
  return question;
}

std::string WorkcellDialogue::run_command(const std::string& line) {
  if (line.empty()) return "";
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string argument(dialogue::trimmed(std::string_view(line).substr(end)));
  std::vector<std::string> names;
  for (const DialogueCommand& command : commands()) names.push_back(command.name);
  const std::vector<std::string> like = dialogue::words_like(line.substr(0, end), names);
  if (like.empty()) return "Unknown command; ? shows the commands.";
  if (like.size() > 1) return "Which one: " + like[0] + " or " + like[1] + "?";
  const auto command = std::ranges::find(commands(), like[0], &DialogueCommand::name);
  if (command->needs_block) {
    const auto index = block_named(argument);
    if (!index) return like[0] + " which block? Give its name or its letter; view shows them.";
    block_index_ = *index;
    block_ = workcell_.blocks[*index];
  }
  command->action(*this);
  return "";
}

/// Finds a block by its name or else by its letter in the view.
std::optional<std::size_t> WorkcellDialogue::block_named(const std::string& name) const {
  const std::vector<Block>& blocks = workcell_.blocks;
  const auto named = std::ranges::find(blocks, name, &Block::name);
  if (named != blocks.end()) return static_cast<std::size_t>(named - blocks.begin());
  const std::size_t at = name == "#" ? std::string::npos : block_letters(blocks).find(name);
  return name.size() == 1 && at < blocks.size() ? std::optional(at) : std::nullopt;
}

void WorkcellDialogue::say(const std::string& text) { text_ += text; }

/// Reach of the hand just above the work surface.
ReachAbove WorkcellDialogue::reach_above() {
  if (!arm_.reach.is_quick()) return {};
  const double z = mm(workcell_.work_surface_um) + kHandHeightMm;
  return [this, z](double x, double y) { return arm_.reach.is_within(x, y, z); };
}

void WorkcellDialogue::view() { say(top_view(workcell_, reach_above())); }

void WorkcellDialogue::check() {
  const std::string notes = dialogue::notes(workcell_, dialogue::check(workcell_, arm_));
  say(notes.empty() ? "No problems: every block can be grasped where it is.\n" : notes);
}

// Writing and leaving.

void WorkcellDialogue::save() {
  const std::string text = json_text(workcell_to_json(workcell_));
  const FileReading<Workcell> reading = read_workcell(text, file_);
  if (reading.value == workcell_) return write(has_written_);
  is_leaving_ = false;
  say("Not written because it would not load:\n" + to_text(reading.findings));
}

void WorkcellDialogue::write(bool may_replace) {
  file_text_ = json_text(workcell_to_json(workcell_));
  may_replace_ = may_replace;
}

DialogueTurn WorkcellDialogue::written(WriteOutcome outcome, const std::string& why) {
  text_.clear();
  file_text_.reset();
  if (outcome == WriteOutcome::kIsThere) {
    ask_yes_no(file_ + " already exists. Replace it?", false,
               "yes: its contents are lost. no: it stays unchanged.", [this](bool replaces) {
                 if (replaces) return write(true);
                 is_leaving_ = false;
                 say("Not written. To use another file name, quit and start again with --from.\n");
               });
  } else if (outcome == WriteOutcome::kWritten) {
    saved_ = workcell_;
    has_written_ = true;
    is_over_ = is_leaving_;
    say("Wrote " + file_ + ".\n");
  } else {
    is_leaving_ = false;
    say("Not written: " + why + "\n");
  }
  next();
  return turn();
}

void WorkcellDialogue::quit() {
  if (!has_unsaved()) {
    is_over_ = true;
    return say("Left; all changes to " + file_ + " are saved.\n");
  }
  ask_yes_no("Save before leaving?", true,
             "yes: write " + file_ + ". no: leave and lose the changes. .: stay here.",
             [this](bool saves) {
               is_leaving_ = saves;
               if (saves) return save();
               is_over_ = true;
               say("Left without writing " + file_ + ".\n");
             });
}

DialogueTurn WorkcellDialogue::leave(std::string_view why) {
  text_.clear();
  is_over_ = true;
  file_text_.reset();
  say(std::string(why) + ": left without writing " + file_ +
      (has_written_ ? " again; it has what was saved last.\n" : ".\n"));
  return turn();
}

}  // namespace xr3
