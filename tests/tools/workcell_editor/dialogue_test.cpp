// Dialogues with the workcell editor, in memory: input, output, and the file written.
#include "tools/workcell_editor/dialogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "protocol/files/workcell.hpp"
#include "tests/support/models.hpp"

namespace xr3 {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A dialogue and the file it writes.
class Talk {
 public:
  explicit Talk(const std::string& robot = "rhino-xr3", const std::string& workcell = "",
                const std::string& from = "lab.json")
      : dialogue_(start(robot, workcell, from)) {
    show(dialogue_.begin());
  }

  /// Types lines one after another. Returns the text shown after the last one.
  template <class... Lines>
  std::string type(const Lines&... lines) {
    (type_line(lines), ...);
    return shown_;
  }

  std::string enter(int times) {
    for (int i = 0; i < times; ++i) type_line("");
    return shown_;
  }

  std::string leave() {
    shown_.clear();
    show(dialogue_.leave("End of input"));
    return shown_;
  }

  const std::string& shown() const { return shown_; }
  bool is_over() const { return turn_.is_over; }
  bool has_unsaved() const { return dialogue_.has_unsaved(); }
  const std::optional<std::string>& file() const { return file_; }
  Workcell saved() const { return load_workcell(file_.value_or(""), "lab.json"); }

  bool is_there = false;  ///< the file exists and was not written by this dialogue
  std::string failure;    ///< why writing fails
  int writes = 0;

 private:
  static DialogueStart start(const std::string& robot, const std::string& workcell,
                             const std::string& from) {
    DialogueStart result{"lab.json", std::nullopt, "", test::robot_named(robot)};
    if (workcell.empty()) return result;
    result.workcell = test::workcell_named(workcell);
    result.from = from;
    return result;
  }

  void type_line(const std::string& line) {
    EXPECT_FALSE(turn_.is_over) << "no question before \"" << line << "\"";
    shown_.clear();
    show(dialogue_.handle(line));
  }

  void show(const DialogueTurn& turn) {
    turn_ = turn;
    shown_ += turn.text;
    if (turn.file_text) show(write(turn));
  }

  DialogueTurn write(const DialogueTurn& turn) {
    if (!failure.empty()) return dialogue_.written(WriteOutcome::kFailed, failure);
    if ((is_there || file_) && !turn.may_replace) return dialogue_.written(WriteOutcome::kIsThere);
    file_ = turn.file_text;
    ++writes;
    EXPECT_NO_THROW(saved());
    return dialogue_.written(WriteOutcome::kWritten);
  }

  WorkcellDialogue dialogue_;
  DialogueTurn turn_;
  std::string shown_;
  std::optional<std::string> file_;
};

constexpr int kRoomItems = 7;    // name, notes, X, Y, Z, surface, stall
constexpr int kCameraItems = 9;  // yes or no, x, y, z, field, pixels, projection

TEST(WorkcellDialogue, CreatesAWorkcellItemByItem) {
  Talk talk;
  EXPECT_EQ(talk.shown(),
            "Workcell for lab.json, checked against Rhino XR-3. Lengths are in mm.\n"
            "Enter accepts the default in brackets, ? explains, . leaves the rest as it is.\n"
            "Name [my workcell]: ");
  EXPECT_EQ(talk.type("Lab 7"), "Notes: ");
  EXPECT_EQ(talk.type("by the window"), "Workspace X, to the front (0.001 to 100000 mm) [600]: ");
  EXPECT_EQ(talk.type("650"), "Workspace Y, to either side (0.001 to 100000 mm) [500]: ");
  EXPECT_EQ(talk.type(""), "Workspace Z, upwards (0.001 to 100000 mm) [700]: ");
  EXPECT_EQ(talk.type(" 800 "), "Work surface, z (0 to 800 mm) [0]: ");
  EXPECT_EQ(talk.type("12.5"), "Stall under the surface? (yes or no) [no]: ");
  EXPECT_EQ(talk.type("y"), "A block? (yes or no) [yes]: ");
  EXPECT_EQ(talk.type(""), "Block's name [block 1]: ");
  EXPECT_EQ(talk.type("red"), "Length (0.001 to 650 mm) [60]: ");
  EXPECT_EQ(talk.type("64"), "Width (0.001 to 63.5 mm) [30]: ");
  EXPECT_EQ(talk.type("32"), "Height (0.001 to 787.5 mm) [30]: ");
  EXPECT_EQ(talk.type("40"), "x of its middle (0 to 650 mm) [320]: ");
  EXPECT_EQ(talk.type("262"), "y of its middle (-500 to 500 mm) [0]: ");
  EXPECT_EQ(talk.type("0"), "Orientation (-360 to 360 degrees) [0]: ");
  EXPECT_EQ(talk.type("270"), "z of its middle (12.5 to 800 mm) [32.5]: ");
  EXPECT_EQ(talk.type(""), "Colour (0 to 15) [9]: ");
  EXPECT_EQ(talk.type("12"),
            "Added: r \"red\" at (262, 0, 32.5).\nAnother block? (yes or no) [yes]: ");
  EXPECT_EQ(talk.type("no"), "A camera? (yes or no) [yes]: ");
  EXPECT_EQ(talk.type("yes"), "Camera x (0 to 650 mm) [325]: ");
  EXPECT_EQ(talk.enter(6), "Pixels along y (1 to 1000) [192]: ");
  EXPECT_EQ(talk.type("96"), "Projection (orthographic or perspective) [orthographic]: ");
  EXPECT_THAT(talk.type("per"), HasSubstr("R robot   . within reach   : camera's field"));
  EXPECT_THAT(talk.shown(), EndsWith("r red\nworkcell (not saved)> "));
  EXPECT_EQ(talk.type("save"), "Wrote lab.json.\nworkcell> ");
  EXPECT_EQ(talk.type("quit"), "Left; all changes to lab.json are saved.\n");
  EXPECT_TRUE(talk.is_over());

  const Workcell cell = talk.saved();
  EXPECT_EQ(cell.name, "Lab 7");
  EXPECT_EQ(cell.notes, "by the window");
  EXPECT_EQ(cell.workspace, (Workspace{650'000, 500'000, 800'000}));
  EXPECT_EQ(cell.work_surface_um, 12'500);
  EXPECT_TRUE(cell.surface_stalls);
  ASSERT_EQ(cell.blocks.size(), 1U);
  EXPECT_EQ(cell.blocks[0],
            (Block{"red", {64'000, 32'000, 40'000}, {262'000, 0, 32'500}, -90'000'000, 12}));
  ASSERT_TRUE(cell.camera);
  EXPECT_EQ(cell.camera->pixels_y, 96);
  EXPECT_EQ(cell.camera->projection, Projection::kPerspective);
}

TEST(WorkcellDialogue, EnterAloneGivesEveryRobotAValidWorkcell) {
  for (const std::string robot : {"rhino-xr3", "adept-one", "intelledex-660"}) {
    SCOPED_TRACE(robot);
    Talk talk(robot);
    talk.enter(kRoomItems);
    for (int block = 0; block < 4; ++block) {
      EXPECT_THAT(talk.enter(10), Not(HasSubstr("!")));
    }
    talk.type("no");
    talk.enter(kCameraItems);
    EXPECT_THAT(talk.type("check"), HasSubstr("No problems"));
    EXPECT_THAT(talk.type("save"), HasSubstr("Wrote"));
    EXPECT_EQ(talk.saved().blocks.size(), 4U);
  }
}

TEST(WorkcellDialogue, RepeatsAQuestionAfterAnInvalidAnswer) {
  Talk talk;
  EXPECT_EQ(talk.type(std::string(81, 'n')),
            "  That is too long: at most 80 bytes.\n"
            "Name [my workcell]: ");
  EXPECT_EQ(talk.type("\x1B[2J"), "  That contains unprintable characters.\nName [my workcell]: ");
  EXPECT_EQ(talk.type("\xFF"), "  That contains unprintable characters.\nName [my workcell]: ");
  talk.type("say \"\\\" \xC3\xA9", "");
  const std::string ask_x = "Workspace X, to the front (0.001 to 100000 mm) [600]: ";
  EXPECT_EQ(talk.type("wide"), "  Not a number: 0.001 to 100000 mm.\n" + ask_x);
  EXPECT_EQ(talk.type("nan"), "  Not a number: 0.001 to 100000 mm.\n" + ask_x);
  EXPECT_EQ(talk.type("0"), "  That is out of range: 0.001 to 100000 mm.\n" + ask_x);
  EXPECT_EQ(talk.type("1e9"), "  That is out of range: 0.001 to 100000 mm.\n" + ask_x);
  EXPECT_EQ(talk.type("?"), "It reaches from the base, x = 0, to x = X.\n" + ask_x);
  talk.enter(3);
  EXPECT_THAT(talk.type("700"), HasSubstr("out of range: -100000 to 699.999 mm"));
  talk.enter(1);
  EXPECT_THAT(talk.type("maybe"), HasSubstr("Please answer yes or no."));
  talk.enter(1);
  talk.type("", "b", "60", "30", "30", "300", "0", "0", "");
  EXPECT_THAT(talk.type("16"), HasSubstr("out of range: 0 to 15"));
  EXPECT_THAT(talk.type("1.5"), HasSubstr("Not a whole number"));
  EXPECT_THAT(talk.type("?"), HasSubstr("14 is yellow"));
}

TEST(WorkcellDialogue, OddBlocksGetWarningsAndStay) {
  Talk talk("rhino-xr3", "rhino-xr3");
  EXPECT_THAT(talk.shown(), HasSubstr("No problems"));
  EXPECT_THAT(talk.type("add", "wide", "70"), HasSubstr("Width"));
  EXPECT_THAT(talk.type("65"),
              HasSubstr("! too wide to be grasped: the jaws of Rhino XR-3 open 63.5 mm"));
  talk.type("40", "262", "0", "0");
  EXPECT_EQ(talk.shown(), "z of its middle (0 to 700 mm) [60]: ")
      << "it would stand on the red block";
  EXPECT_THAT(talk.type("20", ""), HasSubstr("! \"wide\": a block that overlaps \"red\""));
  EXPECT_THAT(talk.shown(), HasSubstr("65 mm wide"));
  EXPECT_THAT(talk.shown(), EndsWith("Keep it anyway? (yes or no) [no]: "));
  EXPECT_EQ(talk.type(""), "Block's name [wide]: ") << "once more";
  talk.type("", "60", "30", "", "580", "0", "0", "");
  EXPECT_THAT(talk.type(""), HasSubstr("! \"wide\": a block that is partly outside the workspace"));
  EXPECT_THAT(talk.shown(), HasSubstr("! \"wide\": a block out of reach"));
  talk.type("", "", "", "", "", "400", "", "");
  EXPECT_THAT(talk.type("100", ""), HasSubstr("floats 80 mm"));
  EXPECT_EQ(talk.type("yes"), "Added: w \"wide\" at (400, 0, 100).\nworkcell (not saved)> ");
  EXPECT_THAT(talk.type("check"), HasSubstr("! \"wide\": a block that floats 80 mm"));
  EXPECT_THAT(talk.type("save", "yes", "q"), HasSubstr("are saved")) << "odd, but it loads";
}

TEST(WorkcellDialogue, EditsAndRemovesBlocks) {
  Talk talk("rhino-xr3", "rhino-xr3");
  EXPECT_EQ(talk.type("move red"), "x of its middle (0 to 600 mm) [262]: ");
  EXPECT_THAT(talk.type("400", "0", ""), HasSubstr("Changed: r \"red\" at (400, 0, 20)."));
  EXPECT_EQ(talk.type("tu g"), "Orientation (-360 to 360 degrees) [25]: ");
  talk.type("-180");
  EXPECT_THAT(talk.type("change b"), HasSubstr("Block's name [blue]: "));
  EXPECT_THAT(talk.type("red"), HasSubstr("Another block has this name."));
  talk.type("azure");
  talk.enter(8);
  EXPECT_EQ(talk.type("remove yellow"), "Remove \"yellow\"? (yes or no) [yes]: ");
  talk.type("no");
  talk.type("remove m", "");
  talk.type("save", "yes");
  const Workcell cell = talk.saved();
  ASSERT_EQ(cell.blocks.size(), 4U);
  EXPECT_EQ(cell.blocks[0].centroid_um, (PointUm{400'000, 0, 20'000}));
  EXPECT_EQ(cell.blocks[1].yaw_udeg, 180'000'000);
  EXPECT_EQ(cell.blocks[2].name, "azure");
  EXPECT_EQ(cell.blocks[3].name, "yellow");
}

TEST(WorkcellDialogue, EditsTheOtherItems) {
  Talk talk("adept-one", "adept-one");
  talk.type("name", "Second table", "-");
  talk.type("workspace", "1000", "", "");
  EXPECT_THAT(talk.type("surface", "510", "yes"),
              HasSubstr("reaches 10 mm under the work surface"));
  talk.type("surface", "500", "no");
  talk.type("camera", "no");
  talk.type("save", "yes");
  const Workcell cell = talk.saved();
  EXPECT_EQ(cell.name, "Second table");
  EXPECT_EQ(cell.notes, "");
  EXPECT_EQ(cell.workspace.x_um, 1'000'000);
  EXPECT_EQ(cell.work_surface_um, 500'000);
  EXPECT_FALSE(cell.camera);
  EXPECT_EQ(cell.blocks, test::workcell_named("adept-one").blocks);
}

TEST(WorkcellDialogue, RepeatsQuestionsWithInconsistentAnswers) {
  Talk talk("adept-one", "adept-one");
  talk.type("camera", "yes", "", "", "540", "", "", "", "");
  EXPECT_THAT(talk.type("perspective"),
              HasSubstr("! \"red\": a block whose top, 540 mm, reaches the camera"));
  EXPECT_THAT(talk.shown(),
              EndsWith("Not valid. Please enter the items again:\nCamera x (0 to 900 mm) [540]: "));
  EXPECT_THAT(talk.type("."), HasSubstr("Back to the menu"));
  EXPECT_FALSE(talk.has_unsaved()) << "nothing has changed";
  EXPECT_THAT(talk.type("workspace", "", "", "400"), HasSubstr("less than the workspace's z"));
  EXPECT_THAT(talk.type("", "", "1100"), HasSubstr("workcell (not saved)> "));
}

TEST(WorkcellDialogue, AsksBeforeReplacingAFile) {
  Talk talk("rhino-xr3", "rhino-xr3", "old.json");
  talk.is_there = true;
  EXPECT_EQ(talk.type("save"), "lab.json already exists. Replace it? (yes or no) [no]: ");
  EXPECT_THAT(talk.type(""), HasSubstr("Not written."));
  EXPECT_FALSE(talk.file());
  talk.type("save");
  EXPECT_THAT(talk.type("."), HasSubstr("Back to the menu"));
  EXPECT_FALSE(talk.file());
  EXPECT_EQ(talk.type("save", "yes"), "Wrote lab.json.\nworkcell> ");
  EXPECT_EQ(talk.saved(), test::workcell_named("rhino-xr3"));
  talk.type("name", "again", "");
  EXPECT_EQ(talk.type("save"), "Wrote lab.json.\nworkcell> ") << "this dialogue wrote the file";
  EXPECT_EQ(talk.writes, 2);
}

TEST(WorkcellDialogue, AFailureToWriteLosesNoChanges) {
  Talk talk("rhino-xr3", "rhino-xr3", "old.json");
  talk.failure = "the disk is full";
  EXPECT_THAT(talk.type("quit", "yes"),
              HasSubstr("Not written: the disk is full\nworkcell (not saved)> "));
  EXPECT_FALSE(talk.is_over());
  talk.failure.clear();
  EXPECT_EQ(talk.type("quit", "yes"), "Wrote lab.json.\n");
  EXPECT_TRUE(talk.is_over());
}

TEST(WorkcellDialogue, AsksToSaveBeforeLeaving) {
  Talk unchanged("rhino-xr3", "rhino-xr3");
  EXPECT_EQ(unchanged.type("q"), "Left; all changes to lab.json are saved.\n");
  Talk changed("rhino-xr3", "rhino-xr3");
  changed.type("remove r", "");
  EXPECT_EQ(changed.type("quit"), "Save before leaving? (yes or no) [yes]: ");
  EXPECT_THAT(changed.type("."), HasSubstr("Back to the menu"));
  EXPECT_EQ(changed.type("quit", "no"), "Left without writing lab.json.\n");
  EXPECT_FALSE(changed.file());
  Talk broken_off;
  broken_off.type("Lab 7");
  EXPECT_EQ(broken_off.leave(), "End of input: left without writing lab.json.\n");
  EXPECT_TRUE(broken_off.is_over());
  EXPECT_TRUE(broken_off.has_unsaved());
}

TEST(WorkcellDialogue, CommandsHaveShortFormsAndHelp) {
  Talk talk("rhino-xr3", "rhino-xr3");
  EXPECT_EQ(talk.type(""), "workcell> ");
  EXPECT_THAT(talk.type("?"), HasSubstr("remove NAME"));
  EXPECT_THAT(talk.type("help"), HasSubstr("remove NAME"));
  EXPECT_THAT(talk.type("l"), HasSubstr("magenta"));
  EXPECT_THAT(talk.type("v"), HasSubstr("r red, g green"));
  EXPECT_THAT(talk.type("ch"), HasSubstr("Which one: check or change?"));
  EXPECT_THAT(talk.type("fly"), HasSubstr("Unknown command"));
  EXPECT_THAT(talk.type("move purple"), HasSubstr("move which block?"));
  EXPECT_THAT(talk.type(std::string(5000, 'x')), HasSubstr("too long"));
}

TEST(WorkcellDialogue, EscapesNamesFromAFile) {
  DialogueStart start{"lab.json", test::workcell_named("rhino-xr3"), "lab.json",
                      test::robot_named("rhino-xr3")};
  start.workcell->name = "a\x1B[2Jb";
  WorkcellDialogue dialogue(start);
  EXPECT_EQ(dialogue.begin().text.find('\x1B'), std::string::npos);
}

/// Words that are valid answers to some question, and some that are not.
std::string any_line(std::mt19937& random) {
  static const std::vector<std::string> kLines = {
      "",       "",          "",        "",         "?",        ".",    "yes",        "no",
      "add",    "move b",    "turn r",  "remove b", "change r", "list", "view",       "check",
      "camera", "workspace", "surface", "name",     "save",     "0",    "1",          "12",
      "300",    "-80",       "1e5",     "red",      "x",        "-",    "perspective"};
  return kLines[random() % kLines.size()];
}

// For any input: only text that loads is written (Talk checks this), and nothing is thrown.
TEST(WorkcellDialogue, AfterRandomInputTheFileLoads) {
  int writes = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    std::mt19937 random(seed);
    Talk talk(seed % 2 == 0 ? "rhino-xr3" : "adept-one", seed % 3 == 0 ? "adept-one" : "");
    talk.is_there = seed % 4 == 0;
    for (int i = 0; i < 100; ++i) talk.type(any_line(random));
    writes += talk.writes;
  }
  EXPECT_GT(writes, 10);
}

}  // namespace
}  // namespace xr3
