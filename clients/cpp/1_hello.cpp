// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     build/1_hello [HOST [PORT]]
//
// The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
// with one byte and does not answer other commands.

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>

/// An environment variable; an empty one counts as not set.
std::string setting(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value && *value ? value : otherwise;
}

/// Sends a question and returns the one-byte answer.
int ask(int robot, const std::string& question) {
  unsigned char reply[100];
  // MSG_NOSIGNAL: on a closed connection, return an error instead of ending the program.
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
  // Host and port: from the arguments, else from the environment, else the defaults.
  const std::string host = argc > 1 ? argv[1] : setting("XR3_HOST", "localhost");
  const std::string port = argc > 2 ? argv[2] : setting("XR3_PORT", "9600");
  char* end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);
  if (*end != '\0' || number < 1 || number > 65535) {
    std::cerr << "the port has to be a number from 1 to 65535, not '" << port << "'\n";
    return 1;
  }

  // A name may have several addresses: use the first one that accepts a connection.
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

  // Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is added
  // to the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so on.
  int reply = ask(robot, "E?");
  std::cout << "E? is answered by " << reply << ": " << reply - 32 << " counts to go\n";

  // Which microswitches are closed? Again 32 is added; each switch has one bit.
  reply = ask(robot, "I");
  std::cout << "I is answered by " << reply << ": switches " << reply - 32 << "\n";

  close(robot);
}
