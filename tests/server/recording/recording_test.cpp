#include "server/recording/recording.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "server/files/data_files.hpp"
#include "server/net/wall_clock.hpp"
#include "tests/support/models.hpp"
#include "tests/support/on_event.hpp"
#include "tests/support/recorded.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMiB = 1U << 20U;

DiskSpace unknown_space(const std::string&) { return {}; }

class CellRecording : public testing::Test {
 protected:
  CellRecording() : cell_("main", test::rhino(), SimClock::manual()) {
    std::string name = (fs::temp_directory_path() / "xr3-recording-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~CellRecording() override { fs::remove_all(folder_); }

  std::string path() const { return (folder_ / "a").string(); }
  std::string text() const { return read_file(path()).text; }
  void ask(std::string_view bytes) {
    cell_.apply(BytesIn{1, bytes}, 0);
    cell_.sent({1, cell_.find_line(1)->outbox().size()});
  }

  fs::path folder_;
  asio::io_context io_;
  std::vector<std::string> failures_;
  Cell cell_;
  test::OnEvent on_event_{cell_, [this](const CellEvent& event) {
                            if (const auto* note = std::get_if<RecordingNote>(&event.note))
                              failures_.push_back(note->why);
                          }};
  int acted_ = 0;
};

TEST_F(CellRecording, IsWrittenSoonAndIsWholeAtTheEnd) {
  {
    Recording recording(io_, cell_, path(), {kMiB}, [this] { ++acted_; });
    const std::string header = text();
    EXPECT_EQ(io_.poll(), 0U) << "no timer without input";
    io_.restart();
    cell_.apply(LineOpened{"test"}, 0);
    ask("E?");
    EXPECT_EQ(text(), header);
    EXPECT_EQ(io_.run(), 1U) << "one timer for both";
    EXPECT_NE(text().find(R"("in":"E?")"), std::string::npos);
    recording.finish();
  }
  cell_.apply(LineOpened{"later"}, 0);
  const auto replayed = test::replay(text());
  EXPECT_FALSE(replayed.difference);
  EXPECT_EQ(replayed.inputs, 2U);
  EXPECT_NE(text().find(R"("end":"stopped")"), std::string::npos);
}

TEST_F(CellRecording, GoesOnInAnotherFileThatReplaysAlone) {
  const auto session = [this](const LineId line, std::string_view bytes) {
    cell_.apply(LineOpened{"test"}, 0);
    cell_.apply(BytesIn{line, bytes}, 0);
    cell_.apply(call::Call{call::Step{Tick{30}}}, 0);
    cell_.apply(LineClosed{line, LineCloseReason::kClientClosed}, 0);
  };
  const auto next = [this] { return path() + "2"; };
  {
    Recording recording(io_, cell_, path(), {kMiB}, [] {});
    session(1, "F+90\rE+40\rE?");
    recording.go_on_in(next);
    session(2, "E?F?");
    recording.finish();
  }
  for (const std::string& each : {path(), next()}) {
    const auto replayed = test::replay(read_file(each).text);
    EXPECT_FALSE(replayed.difference) << each;
    EXPECT_EQ(replayed.inputs, 4U) << each;
  }
  EXPECT_EQ(test::replay(read_file(next()).text).state, cell_.state());
}

TEST_F(CellRecording, EndsWithAnEventIfItCannotGoOn) {
  Recording recording(io_, cell_, path(), {kMiB}, [this] { ++acted_; });
  recording.go_on_in([]() -> std::string { throw FileError("no folder"); });
  cell_.apply(LineOpened{"test"}, 0);
  io_.run();
  EXPECT_EQ(acted_, 1);
  ASSERT_EQ(failures_.size(), 1U);
  EXPECT_NE(failures_[0].find("no folder"), std::string::npos);
  EXPECT_NE(text().find(R"("end":"stopped")"), std::string::npos);
}

TEST_F(CellRecording, EndsAtItsMaximumSizeWithAnEvent) {
  Recording recording(io_, cell_, path(), {30'000}, [this] { ++acted_; });
  cell_.apply(LineOpened{"test", LineKind::kPty}, 0);
  for (int i = 0; i < 2000; ++i) ask("E?");
  io_.run();
  EXPECT_EQ(failures_.size(), 1U);
  EXPECT_EQ(acted_, 1);
  EXPECT_LE(text().size(), 30'000U);
  EXPECT_GT(text().size(), 29'000U);
  EXPECT_FALSE(test::replay(text()).difference);
  recording.finish();
  EXPECT_NE(text().find(R"("end":"limit")"), std::string::npos);
}

TEST_F(CellRecording, SharesItsRoomWithOthers) {
  Cell other("other", test::rhino(), SimClock::manual(), {});
  RecordingRoom room(40'000, unknown_space);
  Recording first(io_, other, path() + "1", {kMiB, &room}, [] {});
  Recording second(io_, cell_, path(), {kMiB, &room}, [this] { ++acted_; });
  cell_.apply(LineOpened{"test", LineKind::kPty}, 0);
  for (int i = 0; i < 2000; ++i) ask("E?");
  other.apply(LineOpened{"test", LineKind::kPty}, 0);
  io_.run();
  EXPECT_EQ(failures_.size(), 1U);
  EXPECT_EQ(acted_, 1);
  first.finish();
  const std::string of_first = read_file(path() + "1").text;
  EXPECT_LE(text().size() + of_first.size(), 40'000U);
  EXPECT_GT(text().size() + of_first.size(), 39'000U);
  EXPECT_NE(text().find(R"("end":"limit")"), std::string::npos);
  EXPECT_FALSE(test::replay(text()).difference);
  EXPECT_NE(of_first.find(R"("end":"limit")"), std::string::npos);
}

TEST_F(CellRecording, WithoutRoomForItsHeaderThereIsNoFile) {
  RecordingRoom room(1000, unknown_space);
  Recording recording(io_, cell_, path(), {kMiB, &room}, [this] { ++acted_; });
  cell_.apply(LineOpened{"test"}, 0);
  io_.run();
  recording.finish();
  EXPECT_EQ(failures_.size(), 1U);
  EXPECT_EQ(acted_, 1);
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(CellRecording, EndsWhenItsDiskIsNearlyFull) {
  DiskSpace space{1000 * kMiB, 50 * kMiB};
  RecordingRoom room(
      kMiB, [&](const std::string&) { return space; }, 0);
  Recording recording(io_, cell_, path(), {kMiB, &room}, [this] { ++acted_; });
  cell_.apply(LineOpened{"test", LineKind::kPty}, 0);
  ask("E?");
  io_.run();
  EXPECT_EQ(failures_.size(), 0U);
  space.free = 50 * kMiB - 1;
  ask("E?");
  io_.restart();
  io_.run();
  ASSERT_EQ(failures_.size(), 1U);
  EXPECT_EQ(failures_[0], path() + ": its disk has only 49 MiB free, and recordings leave 50 MiB");
  EXPECT_EQ(cell_.counters().recordings_failed, 1U);
  ask("E?");
  recording.finish();
  EXPECT_NE(text().find(R"("end":"limit")"), std::string::npos);
  const auto replayed = test::replay(text());
  EXPECT_FALSE(replayed.difference);
  EXPECT_EQ(replayed.inputs, 3U);
}

TEST_F(CellRecording, WithoutSpaceForItsHeaderThereIsNoFile) {
  RecordingRoom room(kMiB, [](const std::string&) { return DiskSpace{1000 * kMiB, 0}; });
  Recording recording(io_, cell_, path(), {kMiB, &room}, [this] { ++acted_; });
  io_.run();
  EXPECT_EQ(failures_.size(), 1U);
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(CellRecording, AHeaderThatDoesNotFitIsRefused) {
  EXPECT_THROW(Recording(io_, cell_, path(), {1000}, [] {}), FileError);
  EXPECT_THROW(Recording(io_, cell_, (folder_ / "none" / "a").string(), {kMiB}, [] {}), FileError);
}

}  // namespace
}  // namespace xr3
