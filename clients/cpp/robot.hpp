// What the examples 2 to 6 share: the line to the robot, and the few things that one says on it. It
// knows joints and their counts, but neither millimetres nor the camera.
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

/// "E+5": a joint, and a number that always shows its sign.
inline std::string move_of(char joint, int counts) {
  return joint + std::string(counts < 0 ? "" : "+") + std::to_string(counts);
}

class Robot {
 public:
  /// Connects to HOST and PORT of main's arguments, else of XR3_HOST and XR3_PORT, else to
  /// localhost 9600. Like everything here, it throws std::runtime_error, with a text for people,
  /// if it cannot do its work.
  Robot(int argc, char* argv[]) {
    connect_to(argc > 1 ? argv[1] : setting("XR3_HOST", "localhost"),
               argc > 2 ? argv[2] : setting("XR3_PORT", "9600"));
  }
  ~Robot() { close(line_); }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Sends commands. A move has to end with \r.
  void send(const std::string& text) {
    // MSG_NOSIGNAL: if the line is closed, tell us, and do not just end the program.
    const ssize_t sent = ::send(line_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent != static_cast<ssize_t>(text.size())) {
      throw std::runtime_error("the robot has closed the line");
    }
  }

  /// Reads exactly so many bytes of an answer.
  std::vector<unsigned char> read(std::size_t count) {
    std::vector<unsigned char> bytes(count);
    for (std::size_t have = 0; have < count;) {  // a long answer comes in pieces
      const ssize_t got = recv(line_, bytes.data() + have, count - have, 0);
      if (got <= 0) throw std::runtime_error("the robot has closed the line");
      have += static_cast<std::size_t>(got);
    }
    return bytes;
  }

  /// Asks, and returns the byte that answers.
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

  /// How many counts the joint has still to go.
  int to_go(char joint) { return ask(std::string{joint, '?'}) - 32; }

  /// A joint stands if its counter has not changed for so long. The slowest speed is one count a
  /// second, and the simulator's clock may run slowly, so be patient.
  static constexpr int kStandsMs = 2000;

  /// Waits until the joint is there. One that makes no count for kStandsMs stands, at a limit or
  /// with the jaws at a block, and is stopped. Returns the counts that were left.
  int wait(char joint) {
    int left = to_go(joint);
    int still_ms = 0;  // for how long the counter has not changed
    while (left > 0 && still_ms < kStandsMs) {
      pause();
      const int before = left;
      left = to_go(joint);
      still_ms = left == before ? still_ms + kPauseMs : 0;
    }
    if (left > 0) send(std::string{joint, 'X'});
    return left;
  }

  /// How long pause() does nothing, between two questions.
  static constexpr int kPauseMs = 50;
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(kPauseMs)); }

  /// Throws if there are counts left: says which joint stands, and what the reason may be.
  static void check_arrived(char joint, int left) {
    if (left <= 0) return;
    throw std::runtime_error(
        std::string{joint} + " stands, " + std::to_string(left) +
        " counts short of where it was sent. Is it blocked at a limit, or stalled? Is a block in "
        "the jaws? Does time stand, or run slowly? Look at the page or at `xr3 watch`");
  }

  /// Brings these motors to these counts together, in parts small enough for the error counter.
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

  /// Where the motors are, in counts from the soft home, as far as go() moved them.
  Counts at{{'F', 0}, {'E', 0}, {'D', 0}, {'C', 0}, {'B', 0}, {'A', 0}};

 private:
  /// A variable of the environment; one that is empty counts as not set.
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
    const int yes = 1;  // few bytes at a time shall go out at once, not be gathered first
    setsockopt(line_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  }

  int line_ = -1;  // the socket
};
