#include "cli/exec/descendants.hpp"

#include <gtest/gtest.h>

#include <ios>
#include <sstream>
#include <streambuf>
#include <string>

namespace xr3 {
namespace {

::pid_t parent(const std::string& stat) {
  std::istringstream file(stat);
  return parent_in(file);
}

// Reading fails as libstdc++ does it if a process ends after its file was opened.
class Ended : public std::streambuf {
 protected:
  int_type underflow() override { throw std::ios_base::failure("No such process"); }
};

TEST(ProcessStat, NamesTheParent) { EXPECT_EQ(parent("42 (python3) S 17 42 42 0 -1\n"), 17); }

TEST(ProcessStat, TheNameOfTheProgramMayHoldAnything) {
  EXPECT_EQ(parent("42 (a) R 9\n(b) S 17 42\n"), 17);
}

TEST(ProcessStat, AProcessThatHasEndedHasNoParent) {
  EXPECT_EQ(parent("42 (python3) Z 17 42\n"), 0);
  EXPECT_EQ(parent(""), 0);
}

TEST(ProcessStat, AProcessMayEndWhileItIsRead) {
  Ended buffer;
  std::istream file(&buffer);
  EXPECT_EQ(parent_in(file), 0);
}

}  // namespace
}  // namespace xr3
