// Shared by examples 2 to 6: the connection to the robot and its basic commands. It handles joints
// and counts, but not millimetres or the camera.
#pragma once

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

/// Motor counts by the letters of their joints: base F, shoulder E, elbow D, pitch C, roll B,
/// jaws A.
using Counts = std::map<char, int>;

/// A move command such as "E+5": the joint and a number with explicit sign.
inline std::string move_of(char joint, int counts) {
  return joint + std::string(counts < 0 ? "" : "+") + std::to_string(counts);
}

class Robot {
 public:
  /// Connects to HOST and PORT from main's arguments, else XR3_HOST and XR3_PORT, else localhost
  /// 9600. Like all members, throws std::runtime_error with a readable message on failure.
  Robot(int argc, char* argv[]) {
    connect_to(argc > 1 ? argv[1] : setting("XR3_HOST", "localhost"),
               argc > 2 ? argv[2] : setting("XR3_PORT", "9600"));
  }
  ~Robot() { close(line_); }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Sends commands. A move must end with \r.
  void send(const std::string& text) {
    // MSG_NOSIGNAL: on a closed connection, return an error instead of ending the program.
    const ssize_t sent = ::send(line_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent != static_cast<ssize_t>(text.size())) {
      throw std::runtime_error("the robot has closed the line");
    }
  }

  /// Reads exactly `count` bytes of an answer.
  std::vector<unsigned char> read(std::size_t count) {
    std::vector<unsigned char> bytes(count);
    for (std::size_t have = 0; have < count;) {  // a long answer arrives in pieces
      const ssize_t got = recv(line_, bytes.data() + have, count - have, 0);
      if (got <= 0) throw std::runtime_error("the robot has closed the line");
      have += static_cast<std::size_t>(got);
    }
    return bytes;
  }

  /// Sends an inquiry and returns the one-byte answer.
  int ask(const std::string& inquiry) {
    send(inquiry);
    unsigned char reply[100];
    const ssize_t got = recv(line_, reply, sizeof reply, 0);
    if (got <= 0) throw std::runtime_error("the robot has closed the line");
    if (got > 1) {
      throw std::runtime_error(
          "no robot answers like this; is it the monitor port? The robot port is 9600");
    }
    return reply[0];
  }

  /// The counts that the joint still has to go. A Mark III answers with seven bits: for more than
  /// 95 counts the answer is wrong there, so no move of these programs is longer.
  int to_go(char joint) { return ask(std::string{joint, '?'}) - 32; }

  /// A joint counts as stopped if its counter is the same after this many questions, over 2
  /// seconds. The slowest speed is one count per second, and the simulator's clock may run slowly,
  /// hence the long wait.
  static constexpr int kStandsAfter = 40;

  /// Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels
  /// its move. Returns the counts that were left.
  int wait(char joint) {
    int left = to_go(joint);
    int same = 0;  // number of equal answers in a row
    while (left > 0 && same < kStandsAfter) {
      pause();
      const int before = left;
      left = to_go(joint);
      same = left == before ? same + 1 : 0;
    }
    if (left > 0) send(std::string{joint, 'X'});
    return left;
  }

  /// Pauses between two questions: 50 ms, or XR3_POLL_MS.
  static void pause() {
    const int milliseconds = std::atoi(setting("XR3_POLL_MS", "50").c_str());
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }

  /// Throws if counts are left; the message has the joint and possible reasons.
  static void check_arrived(char joint, int left) {
    if (left <= 0) return;
    throw std::runtime_error(
        std::string{joint} + " stopped " + std::to_string(left) +
        " counts short of its target. Is it blocked at a limit, or stalled? Is a block in the "
        "jaws? Is the clock paused or slow? Look at the page or at `xr3 watch`");
  }

  /// Moves these motors to these counts together, in parts small enough for the error counter.
  void go(const Counts& wanted) {
    const Counts start = at;
    int longest = 0;
    for (const auto& [joint, count] : wanted) {
      longest = std::max(longest, std::abs(count - start.at(joint)));
    }
    const int parts = (longest + 59) / 60;  // no move is longer than 60 counts
    for (int part = 1; part <= parts; ++part) {
      for (const auto& [joint, count] : wanted) {
        const int next = start.at(joint) + (count - start.at(joint)) * part / parts;
        if (next != at[joint]) send(move_of(joint, next - at[joint]) + "\r");
        at[joint] = next;
      }
      for (const auto& [joint, count] : wanted) {
        check_arrived(joint, wait(joint));
      }
    }
  }

  /// Motor positions in counts from the soft home, as tracked by go().
  Counts at{{'F', 0}, {'E', 0}, {'D', 0}, {'C', 0}, {'B', 0}, {'A', 0}};

 private:
  /// An environment variable; an empty one counts as not set.
  static std::string setting(const char* name, const std::string& otherwise) {
    const char* value = std::getenv(name);
    return value && *value ? value : otherwise;
  }

  void connect_to(const std::string& host, const std::string& port) {
    char* end = nullptr;
    const long number = std::strtol(port.c_str(), &end, 10);
    if (*end != '\0' || number < 1 || number > 65535) {
      throw std::runtime_error("the port has to be a number from 1 to 65535, not '" + port + "'");
    }
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* addresses = nullptr;
    if (getaddrinfo(host.c_str(), port.c_str(), &wanted, &addresses) != 0) {
      throw std::runtime_error("no such host: " + host);
    }
    for (const addrinfo* a = addresses; a && line_ < 0; a = a->ai_next) {
      line_ = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
      if (connect(line_, a->ai_addr, a->ai_addrlen) != 0) {
        close(line_);
        line_ = -1;
      }
    }
    freeaddrinfo(addresses);
    if (line_ < 0) {
      throw std::runtime_error("no robot answers at " + host + " port " + port +
                               ": is the server running? ./run");
    }
    const int yes = 1;  // send small messages at once
    setsockopt(line_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  }

  int line_ = -1;  // the socket
};
