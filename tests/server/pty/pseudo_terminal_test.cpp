#include "server/pty/pseudo_terminal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>

namespace xr3 {
namespace {

class Slave {
 public:
  explicit Slave(const PseudoTerminal& terminal)
      : file_(::open(terminal.slave().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {}
  Slave(const Slave&) = delete;
  Slave& operator=(const Slave&) = delete;
  ~Slave() { ::close(file_); }

  void write(const std::string& text) const {
    EXPECT_EQ(::write(file_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  bool has_bytes() const {
    char byte = 0;
    return ::read(file_, &byte, 1) == 1;
  }
  void set(speed_t speed, tcflag_t local) const {
    struct ::termios modes {};
    ASSERT_EQ(::tcgetattr(file_, &modes), 0);
    ::cfsetspeed(&modes, speed);
    modes.c_lflag = local;
    ASSERT_EQ(::tcsetattr(file_, TCSANOW, &modes), 0);
  }

 private:
  int file_;
};

TEST(PseudoTerminal, HasAClientWhileTheSlaveIsOpen) {
  const PseudoTerminal terminal(0600);
  EXPECT_FALSE(terminal.has_client()) << "not even before the first";
  {
    const Slave slave(terminal);
    EXPECT_TRUE(terminal.has_client());
  }
  EXPECT_FALSE(terminal.has_client());
}

TEST(PseudoTerminal, BytesThatAClientHasLeftCount) {
  const PseudoTerminal terminal(0600);
  Slave(terminal).write("E?");
  EXPECT_TRUE(terminal.has_client());
  std::array<char, 8> bytes{};
  EXPECT_EQ(::read(terminal.master(), bytes.data(), bytes.size()), 2);
  EXPECT_FALSE(terminal.has_client());
}

TEST(PseudoTerminal, PrepareDropsRepliesAndKeepsBytes) {
  const PseudoTerminal terminal(0600);
  Slave(terminal).write("E?");
  EXPECT_EQ(::write(terminal.master(), "reply", 5), 5);
  terminal.prepare();
  EXPECT_FALSE(Slave(terminal).has_bytes());
  EXPECT_TRUE(terminal.has_client()) << "E? is not read yet";
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

}  // namespace
}  // namespace xr3
