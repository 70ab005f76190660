// The workcell editor, `xr3 workcell`, as a dialogue without I/O: it takes a line and returns the
// text to show next. It is the successor of the paper's WORKCELL program (Section III-B). It asks
// for each item with a default and a range, and reports problems on the way.
//
// The flow through the folder: the caller (cli/commands/workcell.cpp) loads the robot and perhaps a
// workcell, prints the text of begin() and passes each line of input to handle(). A line is either
// a command of the menu (dialogue.cpp) or the answer to the current question. Questions are values
// of items.hpp, with prompt, default, help and a function that stores the answer; blocks.cpp and
// room.cpp queue them for a block, the workspace, the work surface or the camera. Answers go to a
// draft. When the last one is given, checks.hpp runs the rules of workcell files on the draft, and
// the robot's reach and jaws; it also proposes defaults. A draft without errors replaces the
// workcell. To save, a turn contains `file_text`, only if that text loads; the caller writes the
// file and returns the outcome to written().
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "tools/watch/top_view.hpp"
#include "tools/workcell_editor/checks.hpp"
#include "tools/workcell_editor/items.hpp"

namespace xr3 {

struct DialogueStart {
  std::string file;                  ///< the file to write; used in messages only
  std::optional<Workcell> workcell;  ///< workcell to edit; nullopt to make a new one, item by item
  std::string from;                  ///< file of `workcell`
  Robot robot;                       ///< the robot to check against
};

/// The caller's output and actions after a line.
struct DialogueTurn {
  std::string text;                      ///< ends with a prompt, unless file_text or is_over is set
  std::optional<std::string> file_text;  ///< write this now, then call written()
  bool may_replace = false;              ///< whether an existing file may be replaced
  bool is_over = false;
};

enum class WriteOutcome : std::uint8_t { kWritten, kIsThere, kFailed };

class WorkcellDialogue {
 public:
  explicit WorkcellDialogue(DialogueStart start);
  WorkcellDialogue(const WorkcellDialogue&) = delete;
  WorkcellDialogue& operator=(const WorkcellDialogue&) = delete;

  /// Returns the greeting and the first prompt.
  DialogueTurn begin();
  /// Handles a line without its line end.
  DialogueTurn handle(std::string_view line);
  /// Reports the result of writing. Call after a turn with `file_text`. `why` is used for kFailed
  /// only.
  DialogueTurn written(WriteOutcome outcome, const std::string& why = "");
  /// Ends the dialogue. Call if the input has ended or was interrupted. Returns the closing text;
  /// nothing is written.
  DialogueTurn leave(std::string_view why);

  /// Whether there are unsaved changes.
  bool has_unsaved() const { return saved_ != workcell_; }

 private:
  using Question = dialogue::Question;
  using Step = std::function<Question()>;
  using Steps = std::deque<Step>;

  struct DialogueCommand {
    std::string name;
    std::function<void(WorkcellDialogue&)> action;
    bool needs_block = false;
  };
  static const std::vector<DialogueCommand>& commands();

  void say(const std::string& text);
  void answer(std::string_view line);
  void next();
  DialogueTurn turn();

  /// Asks the steps one after another, then does `then`.
  void ask(Steps steps, std::function<void()> then);
  /// Asks a question, then does `then` with the answer.
  void ask_yes_no(const std::string& prompt, bool fallback, const std::string& help,
                  std::function<void(bool)> then);
  static Steps joined(const std::vector<Steps>& parts);
  Question menu();
  std::string run_command(const std::string& line);
  std::optional<std::size_t> block_named(const std::string& name) const;

  // Commands of the menu.
  void view();
  void check();
  void add();
  void change();
  void remove();
  void camera();
  void save();
  void quit();

  // A new workcell, item by item.
  void ask_all();
  void offer_block();

  // Edits everything except blocks; the answers go to draft_ first.
  void edit_room(Steps steps, std::function<void()> then = {});
  void ask_room();
  void keep_room();
  static Step length_step(const std::string& prompt, dialogue::Lengths sensible,
                          dialogue::Lengths possible, Micrometres& value, const std::string& help);
  Steps name_steps();
  Steps workspace_steps();
  Steps surface_steps();
  void edit_camera(bool is_wanted);

  // Blocks: the answers go to block_ first.
  Step name_of_block_step();
  Steps size_steps();
  Steps place_steps();
  Step yaw_step();
  Step height_step();
  Step color_step();
  void edit_block(Steps steps);
  void ask_block();
  void judge_block();
  void keep_block();

  void write(bool may_replace);
  ReachAbove reach_above();

  std::string file_;
  std::string from_;
  bool is_new_;
  dialogue::Arm arm_;
  Workcell workcell_;
  std::optional<Workcell> saved_;  ///< the file's contents, if known

  Question question_;
  Steps steps_;
  std::function<void()> then_;
  std::string text_;

  Workcell draft_;
  Steps room_steps_;
  std::function<void()> room_then_;  ///< runs after the answers are accepted

  Block block_;
  std::size_t block_index_ = 0;  ///< for a block to be added: the number of blocks
  Steps block_steps_;
  bool is_yes_ = false;
  bool is_making_ = false;  ///< the items of a new workcell are being asked for

  std::optional<std::string> file_text_;
  bool may_replace_ = false;
  bool has_written_ = false;
  bool is_leaving_ = false;
  bool is_over_ = false;
};

}  // namespace xr3
