// The link to a pseudo-terminal and its lock: only what an xr3 has made is replaced or removed.
#include "server/pty/link.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

class PtyLinkTest : public testing::Test {
 protected:
  PtyLinkTest() { fs::create_directories(folder_); }
  ~PtyLinkTest() override { fs::remove_all(folder_); }

  std::string target() const { return fs::read_symlink(path_); }
  /// The message of the refusal to make a link.
  std::string refusal() const {
    try {
      const PtyLink link(path_, "/dev/pts/1");
      return "";
    } catch (const FileError& error) {
      return error.what();
    }
  }
  /// Leaves what a killed server leaves.
  void leave(const std::string& recorded, const std::string& target) const {
    std::ofstream(lock_) << recorded;
    fs::create_symlink(target, path_);
  }

  fs::path folder_ = fs::path(testing::TempDir()) /
                     ("link." + std::to_string(::getpid()) + "." +
                      testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string path_ = folder_ / "rhino";
  std::string lock_ = path_ + ".lock";
};

TEST_F(PtyLinkTest, LinkAndLockExistAsLongAsTheObject) {
  {
    const PtyLink link(path_, "/dev/pts/1");
    EXPECT_EQ(target(), "/dev/pts/1");
    EXPECT_TRUE(fs::exists(lock_));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(PtyLinkTest, PointsToAnotherSlave) {
  PtyLink link(path_, "/dev/pts/1");
  link.point_to("/dev/pts/2");
  EXPECT_EQ(target(), "/dev/pts/2");
}

TEST_F(PtyLinkTest, ASecondOwnerIsRefused) {
  const PtyLink link(path_, "/dev/pts/2");
  EXPECT_NE(refusal().find("is in use by another xr3"), std::string::npos);
  EXPECT_EQ(target(), "/dev/pts/2");
}

TEST_F(PtyLinkTest, ALinkOfAKilledServerIsReplaced) {
  leave("/dev/pts/7\n", "/dev/pts/7");
  EXPECT_EQ(refusal(), "");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(PtyLinkTest, AServerKilledWhileItRenewedTheLinkIsReplaced) {
  for (const char* target : {"/dev/pts/7", "/dev/pts/8"}) {
    leave("/dev/pts/7\n/dev/pts/8\n", target);
    EXPECT_EQ(refusal(), "") << target;
  }
}

TEST_F(PtyLinkTest, ALinkThatWasNotRecordedIsKept) {
  for (const char* recorded :
       {"", "/dev/pts/77\n", "/dev/pts/7", "\n", "/dev/pts/8\n/dev/pts/77\n"}) {
    leave(recorded, "/dev/pts/7");
    EXPECT_NE(refusal().find("no link of xr3"), std::string::npos) << recorded;
    EXPECT_EQ(target(), "/dev/pts/7");
    fs::remove(path_);
    fs::remove(lock_);
  }
}

TEST_F(PtyLinkTest, AnotherFileIsKeptWithoutATrace) {
  std::ofstream(path_) << "precious";
  EXPECT_NE(refusal().find("no link of xr3; it is kept"), std::string::npos);
  EXPECT_EQ(fs::file_size(path_), 8U);
  EXPECT_FALSE(fs::exists(lock_));
}

TEST_F(PtyLinkTest, ALockThatIsALinkIsNotFollowed) {
  fs::create_symlink("elsewhere", lock_);
  EXPECT_NE(refusal().find("cannot be locked"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere"));
}

TEST_F(PtyLinkTest, ALinkThatWasReplacedMeanwhileIsKept) {
  {
    const PtyLink link(path_, "/dev/pts/1");
    fs::remove(path_);
    fs::create_symlink("/dev/null", path_);
  }
  EXPECT_EQ(target(), "/dev/null");
}

}  // namespace
}  // namespace xr3
