#include "server/recording/folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "server/files/data_files.hpp"
#include "server/recording/file.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;
using testing::Optional;

const auto kBegin = std::chrono::system_clock::from_time_t(1'000'000'000);
constexpr std::chrono::hours kDay{24};

class RecordingFolders : public testing::Test {
 protected:
  RecordingFolders() {
    std::string name = (fs::temp_directory_path() / "xr3-folder-XXXXXX").string();
    home_ = ::mkdtemp(name.data());
  }
  ~RecordingFolders() override { fs::remove_all(home_); }

  std::string folder() const { return (home_ / "class").string(); }
  /// A file of ada that was written last so long ago.
  std::string write(const std::string& name, std::chrono::hours age) const {
    const fs::path path = fs::path(folder()) / "ada" / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "x";
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path.string();
  }
  std::size_t delete_old(const std::string& kept = "") const {
    return delete_old_recordings(folder() + "/ada", std::chrono::system_clock::now() - 30 * kDay,
                                 [&](const std::string& path) { return path == kept; });
  }

  fs::path home_;
};

TEST_F(RecordingFolders, EachStartHasAFileInTheFolderOfItsCell) {
  make_recording_folder(folder());
  make_recording_folder(folder());
  for (const char* end : {"Z", "Z-2", "Z-3"}) {
    const std::string path = new_recording_path(folder(), "ada", kBegin);
    EXPECT_EQ(path, folder() + "/ada/2001-09-09T01-46-40" + end + ".xr3rec");
    RecordingFile file(path);
    EXPECT_TRUE(is_recording_name(fs::path(path).filename().string()));
  }
  for (const auto& each : {folder(), folder() + "/ada"})
    EXPECT_EQ(fs::status(each).permissions(), fs::perms::owner_all) << each;
}

TEST_F(RecordingFolders, AFolderThatCannotBeMadeIsRefused) {
  { RecordingFile file(folder()); }
  EXPECT_THROW(make_recording_folder(folder()), FileError);
  EXPECT_THROW(make_recording_folder(folder() + "/none/class"), FileError);
  EXPECT_THROW(new_recording_path(folder(), "ada", kBegin), FileError);
}

TEST_F(RecordingFolders, NamesHaveOneForm) {
  for (const char* name : {"2001-09-09T01-46-40Z.xr3rec", "2001-09-09T01-46-40Z-10.xr3rec"})
    EXPECT_TRUE(is_recording_name(name)) << name;
  for (const char* name :
       {"", ".xr3rec", "a.xr3rec", "2001-09-09T01-46-40Z", "2001-09-09T01-46-40Z-.xr3rec",
        "2001-09-09T01-46-40Z-1.xr3rec", "2001-09-09T01-46-40Z-02.xr3rec",
        "2001-09-09T01-46-40Z-2a.xr3rec", "2001-09-09T01-46-40Z.xr3rec.bak",
        "x2001-09-09T01-46-40Z.xr3rec", "2001-09-09T01-46-4aZ.xr3rec"})
    EXPECT_FALSE(is_recording_name(name)) << name;
}

TEST_F(RecordingFolders, TheNewestBeganLast) {
  EXPECT_EQ(newest_recording(folder(), "ada"), std::nullopt);
  const std::string first = write("2001-09-09T01-46-40Z.xr3rec", 1 * kDay);
  EXPECT_THAT(newest_recording(folder(), "ada"), Optional(first));
  write("2001-09-09T01-46-40Z-9.xr3rec", 3 * kDay);
  const std::string last = write("2001-09-09T01-46-40Z-10.xr3rec", 2 * kDay);
  write("zzz.xr3rec", 0 * kDay);
  EXPECT_THAT(newest_recording(folder(), "ada"), Optional(last));
  EXPECT_EQ(newest_recording(folder(), "bob"), std::nullopt);
}

TEST_F(RecordingFolders, OldRecordingsGoAndNothingElse) {
  write("2001-09-09T01-46-40Z.xr3rec", 31 * kDay);
  write("2001-09-09T01-46-41Z.xr3rec", 31 * kDay);
  const std::string kept = write("2001-09-09T01-46-42Z.xr3rec", 31 * kDay);
  const std::string young = write("2001-09-09T01-46-43Z.xr3rec", 29 * kDay);
  const std::string notes = write("notes.txt", 99 * kDay);
  const std::string other = write("copy.xr3rec", 99 * kDay);
  fs::create_symlink(notes, folder() + "/ada/2001-09-09T01-46-44Z.xr3rec");
  EXPECT_EQ(delete_old(kept), 2U);
  for (const std::string& path : {kept, young, notes, other}) EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::is_symlink(folder() + "/ada/2001-09-09T01-46-44Z.xr3rec"));
  EXPECT_EQ(delete_old(kept), 0U);
}

TEST_F(RecordingFolders, ARecordingThatIsBeingWrittenStays) {
  make_recording_folder(folder());
  const std::string path = new_recording_path(folder(), "ada", kBegin);
  {
    RecordingFile file(path);
    fs::last_write_time(path, fs::file_time_type::clock::now() - 31 * kDay);
    EXPECT_EQ(delete_old(), 0U);
  }
  fs::last_write_time(path, fs::file_time_type::clock::now() - 31 * kDay);
  EXPECT_EQ(delete_old(), 1U);
  EXPECT_FALSE(fs::exists(folder() + "/ada"));
}

}  // namespace
}  // namespace xr3
