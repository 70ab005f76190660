// The names, sizes and number of the files of a log.
#include "server/log_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

class LogFileTest : public testing::Test {
 protected:
  LogFileTest() {
    std::string name = (fs::temp_directory_path() / "xr3-log-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~LogFileTest() override { fs::remove_all(folder_); }
  std::string path(const std::string& ending = "") const {
    return (folder_ / ("a.log" + ending)).string();
  }
  std::string text(const std::string& ending = "") const { return read_file(path(ending)).text; }

  fs::path folder_;
};

TEST_F(LogFileTest, KeepsTheNewestMessagesInNumberedFiles) {
  LogFile log(path(), 12, 3);
  for (const char* message : {"one\n", "two\n", "three\n", "four\n", "five\n", "six\n", "seven\n"})
    log.write(message);
  EXPECT_EQ(text(), "seven\n");
  EXPECT_EQ(text(".1"), "five\nsix\n");
  EXPECT_EQ(text(".2"), "three\nfour\n");
  EXPECT_FALSE(fs::exists(path(".3")));
}

TEST_F(LogFileTest, GoesOnWithAFileThatExists) {
  std::ofstream(path()) << "before\n";
  LogFile log(path(), 12, 2);
  log.write("one\n");
  EXPECT_EQ(text(), "before\none\n");
  log.write("two\n");
  EXPECT_EQ(text(), "two\n");
  EXPECT_EQ(text(".1"), "before\none\n");
}

TEST_F(LogFileTest, AMessageLongerThanAFileIsKept) {
  LogFile log(path(), 4, 2);
  log.write("long message\n");
  EXPECT_EQ(text(), "long message\n");
  EXPECT_FALSE(fs::exists(path(".1")));
}

TEST_F(LogFileTest, AFileThatWasRemovedIsMadeAnew) {
  LogFile log(path(), 4, 2);
  log.write("one\n");
  fs::remove(path());
  log.write("two\n");
  EXPECT_EQ(text(), "two\n");
}

TEST_F(LogFileTest, AFileThatCannotBeRenamedBeginsAnew) {
  LogFile log(path(), 8, 2);
  fs::create_directory(path(".1"));
  for (const char* message : {"one\n", "two\n", "three\n"}) log.write(message);
  EXPECT_EQ(text(), "three\n");
}

TEST_F(LogFileTest, NoLinkIsFollowed) {
  fs::create_symlink(path(".link"), path());
  EXPECT_THROW(LogFile(path(), 8, 2), FileError);
  fs::remove(path());
  LogFile log(path(), 4, 2);
  log.write("one\n");
  fs::remove(path());
  fs::create_symlink(path(".link"), path());
  for (const char* message : {"two\n", "three\n"}) log.write(message);
  EXPECT_FALSE(fs::exists(path(".link")));
  EXPECT_EQ(text(), "three\n") << "the link was renamed like a file";
}

TEST_F(LogFileTest, AFileThatCannotBeOpenedIsRefused) {
  EXPECT_THROW(LogFile((folder_ / "none" / "a.log").string(), 8, 2), FileError);
}

}  // namespace
}  // namespace xr3
