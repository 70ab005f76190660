// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     build/1_hello [HOST [PORT]]
//
// A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
// and everything else with silence.

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>

/// A variable of the environment; one that is empty counts as not set.
std::string setting(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value && *value ? value : otherwise;
}

/// Sends a question and returns the byte that answers it.
int ask(int robot, const std::string& question) {
  unsigned char reply[100];
  // MSG_NOSIGNAL: if the line is closed, tell us, and do not just end the program.
  const ssize_t sent = send(robot, question.data(), question.size(), MSG_NOSIGNAL);
  const ssize_t got = sent < 0 ? 0 : recv(robot, reply, sizeof reply, 0);
  if (got <= 0) {
    std::cerr << "the robot has closed the line\n";
    std::exit(1);
  }
  if (got > 1) {
    std::cerr << "no robot answers like this; is it the monitor port? The robot port is 9600\n";
    std::exit(1);
  }
  return reply[0];
}

int main(int argc, char* argv[]) {
  // Where the robot is: from the arguments, else from the environment, else this machine.
  const std::string host = argc > 1 ? argv[1] : setting("XR3_HOST", "localhost");
  const std::string port = argc > 2 ? argv[2] : setting("XR3_PORT", "9600");
  char* end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);
  if (*end != '\0' || number < 1 || number > 65535) {
    std::cerr << "the port has to be a number from 1 to 65535, not '" << port << "'\n";
    return 1;
  }

  // A name may have several addresses; the first one that answers is taken.
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* addresses = nullptr;
  if (getaddrinfo(host.c_str(), port.c_str(), &wanted, &addresses) != 0) {
    std::cerr << "no such host: " << host << "\n";
    return 1;
  }
  int robot = -1;
  for (const addrinfo* a = addresses; a && robot < 0; a = a->ai_next) {
    robot = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
    if (connect(robot, a->ai_addr, a->ai_addrlen) != 0) {
      close(robot);
      robot = -1;
    }
  }
  freeaddrinfo(addresses);
  if (robot < 0) {
    std::cerr << "no robot answers at " << host << " port " << port
              << ": is the server running? ./run\n";
    return 1;
  }

  // How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
  // blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on.
  int reply = ask(robot, "E?");
  std::cout << "E? is answered by " << reply << ": " << reply - 32 << " counts to go\n";

  // Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
  reply = ask(robot, "I");
  std::cout << "I is answered by " << reply << ": switches " << reply - 32 << "\n";

  close(robot);
}
