#include "server/pty/pseudo_terminal.hpp"

#include <gtest/gtest.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <string>

#include "server/files/data_files.hpp"
#include "tests/server/pty/slave.hpp"

namespace xr3 {
namespace {

using test::Slave;

TEST(PseudoTerminal, IsOpenWhileAProgramHasTheSlaveOpen) {
  const PseudoTerminal terminal(0600);
  EXPECT_FALSE(terminal.poll().is_open) << "not even before the first";
  {
    const Slave slave(terminal);
    EXPECT_TRUE(terminal.poll().is_open);
  }
  EXPECT_FALSE(terminal.poll().is_open);
}

TEST(PseudoTerminal, KeepsTheBytesOfAProgramThatHasLeft) {
  const PseudoTerminal terminal(0600);
  Slave(terminal).write("E?");
  EXPECT_TRUE(terminal.poll().has_bytes);
  std::array<char, 8> bytes{};
  EXPECT_EQ(::read(terminal.master(), bytes.data(), bytes.size()), 2);
  EXPECT_FALSE(terminal.poll().has_bytes);
}

TEST(PseudoTerminal, PrepareDropsRepliesAndKeepsBytes) {
  const PseudoTerminal terminal(0600);
  Slave(terminal).write("E?");
  EXPECT_EQ(::write(terminal.master(), "reply", 5), 5);
  terminal.prepare();
  EXPECT_EQ(Slave(terminal).read(), "");
  EXPECT_TRUE(terminal.poll().has_bytes) << "E? is not read yet";
}

TEST(PseudoTerminal, PrepareUndoesTheModesOfAClient) {
  const PseudoTerminal terminal(0600);
  EXPECT_EQ(terminal.modes(), (PtyModes{9600, false}));
  {
    const Slave slave(terminal);
    slave.set(B1200, ECHO | ICANON);
    EXPECT_EQ(terminal.modes(), (PtyModes{1200, true}));
    slave.set(B115200, 0);
    EXPECT_EQ(terminal.modes(), (PtyModes{115200, false}));
  }
  terminal.prepare();
  EXPECT_EQ(terminal.modes(), (PtyModes{9600, false}));
}

TEST(PseudoTerminal, PrepareStartsTheOutputThatAClientHasStopped) {
  const PseudoTerminal terminal(0600);
  ASSERT_EQ(::tcflow(Slave(terminal).file(), TCOOFF), 0);
  terminal.prepare();
  Slave(terminal).write("E?");
  EXPECT_TRUE(terminal.poll().has_bytes);
}

TEST(PseudoTerminal, PrepareSharesTheTerminalOfAnExclusiveClient) {
  const PseudoTerminal terminal(0600);
  ASSERT_EQ(::ioctl(Slave(terminal).file(), TIOCEXCL), 0);
  terminal.prepare();
  const Slave next(terminal);
  int is_exclusive = 1;
  ASSERT_EQ(::ioctl(next.file(), TIOCGEXCL, &is_exclusive), 0);
  EXPECT_EQ(is_exclusive, 0);
}

TEST(PseudoTerminal, PrepareRefusesAnotherLineDiscipline) {
  const PseudoTerminal terminal(0600);
  const int null_discipline = N_NULL;
  ASSERT_EQ(::ioctl(Slave(terminal).file(), TIOCSETD, &null_discipline), 0);
  EXPECT_THROW(terminal.prepare(), FileError);
}

}  // namespace
}  // namespace xr3
