#include "server/recording/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

class RecordingFiles : public testing::Test {
 protected:
  RecordingFiles() {
    std::string name = (fs::temp_directory_path() / "xr3-recording-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~RecordingFiles() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(RecordingFiles, AreNewAndOfTheirOwnerAlone) {
  {
    RecordingFile file(path("a"));
    file.add("one\n");
    EXPECT_EQ(file.size(), 4U);
  }
  EXPECT_EQ(read_file(path("a")).text, "one\n");
  struct ::stat status {};
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  EXPECT_THROW(RecordingFile(path("a")), FileError);
  EXPECT_EQ(read_file(path("a")).text, "one\n");
}

TEST_F(RecordingFiles, NoLinkIsFollowed) {
  fs::create_symlink(path("elsewhere"), path("link"));
  EXPECT_THROW(RecordingFile(path("link")), FileError);
  EXPECT_FALSE(fs::exists(path("elsewhere")));
  EXPECT_THROW(RecordingFile(path("none/a")), FileError);
}

TEST_F(RecordingFiles, ANameThatIsTakenGetsTheTimeOfTheStart) {
  const auto start = std::chrono::system_clock::from_time_t(1'000'000'000);
  EXPECT_EQ(unused_path(path("a.b.xr3rec"), start), path("a.b.xr3rec"));
  for (const char* name : {"a.b.xr3rec", "a.b-20010909T014640Z.xr3rec",
                           "a.b-20010909T014640Z-2.xr3rec", "plain", ".hidden"})
    RecordingFile file(path(name));
  EXPECT_EQ(unused_path(path("a.b.xr3rec"), start), path("a.b-20010909T014640Z-3.xr3rec"));
  EXPECT_EQ(unused_path(path("plain"), start), path("plain-20010909T014640Z"));
  EXPECT_EQ(unused_path(path(".hidden"), start), path(".hidden-20010909T014640Z"));
  fs::create_symlink(path("elsewhere"), path("link.c"));
  EXPECT_EQ(unused_path(path("link.c"), start), path("link-20010909T014640Z.c"));
  EXPECT_THROW(unused_path(folder_.string(), start), FileError);
}

// A limit of the process stands for a full disk.
TEST_F(RecordingFiles, OnAFullDiskTheFileEndsWithAWholeLine) {
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  {
    RecordingFile file(path("a"));
    const ::rlimit small{10, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    file.add("first\n");
    file.add("second\n");
    file.flush();
    EXPECT_NE(file.failure(), "");
    file.add("third\n");
    EXPECT_EQ(file.size(), 6U);
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(read_file(path("a")).text, "first\n");
}

}  // namespace
}  // namespace xr3
