#include "server/device/uucp_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "server/device/serial_device.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

// /dev/null stands for a port: the lock does not open it.
class UucpLockTest : public testing::Test {
 protected:
  UucpLockTest() { fs::create_directories(folder_); }
  ~UucpLockTest() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(file_) << text; }
  std::string content() const {
    std::ifstream file(file_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("uucp." + std::to_string(::getpid()));
  fs::path file_ = folder_ / "LCK..null";
};

TEST_F(UucpLockTest, HasTheProcessAsTenDigits) {
  {
    const UucpLock lock("/dev/null", folder_);
    EXPECT_EQ(content().size(), 11U);
    EXPECT_EQ(std::stol(content()), ::getpid());
  }
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(UucpLockTest, ALivingOwnerIsRespected) {
  write("         1\n");
  try {
    const UucpLock lock("/dev/null", folder_);
    FAIL() << "process 1 has the lock";
  } catch (const SerialDeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("in use by process 1"), std::string::npos);
  }
  EXPECT_EQ(content(), "         1\n");
}

TEST_F(UucpLockTest, TheLockOfAnEndedProcessIsTakenOver) {
  for (const char* text : {"  99999999\n", "nonsense", ""}) {
    write(text);
    const UucpLock lock("/dev/null", folder_);
    EXPECT_EQ(std::stol(content()), ::getpid()) << text;
  }
}

TEST_F(UucpLockTest, LocksNothingWhereItMayNotWrite) {
  const UucpLock lock("/dev/null", folder_ / "missing");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(UucpLockTest, LocksNoPseudoTerminal) {
  const UucpLock lock("/dev/pts/ptmx", folder_);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace xr3
