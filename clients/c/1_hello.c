/* 1. Hello: connect to the robot, ask it two questions, print the answers.

       build/1_hello [HOST [PORT]]

   A robot on a serial line knows no lines of text and no "OK". It answers a question with one
   byte, and everything else with silence. */

#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

int main(int argc, char *argv[]) {
  /* Where the robot is: from the arguments, else from the environment, else this machine. */
  const char *host = argc > 1 ? argv[1] : getenv("XR3_HOST");
  const char *port = argc > 2 ? argv[2] : getenv("XR3_PORT");
  if (host == NULL) host = "localhost";
  if (port == NULL) port = "9600";

  /* A name may have several addresses; the first one that answers is taken. */
  struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
  struct addrinfo *addresses;
  if (getaddrinfo(host, port, &wanted, &addresses) != 0) {
    fprintf(stderr, "no such host: %s\n", host);
    return 1;
  }
  int robot = -1;
  for (struct addrinfo *a = addresses; a != NULL && robot < 0; a = a->ai_next) {
    robot = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
    if (connect(robot, a->ai_addr, a->ai_addrlen) != 0) {
      close(robot);
      robot = -1;
    }
  }
  freeaddrinfo(addresses);
  if (robot < 0) {
    fprintf(stderr, "no robot at %s port %s\n", host, port);
    return 1;
  }

  /* How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
     blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on. */
  unsigned char reply;
  if (write(robot, "E?", 2) != 2 || read(robot, &reply, 1) != 1) return 1;
  printf("E? is answered by %d: %d counts to go\n", reply, reply - 32);

  /* Which microswitches are closed? Again 32 is added; each switch has a bit of its own. */
  if (write(robot, "I", 1) != 1 || read(robot, &reply, 1) != 1) return 1;
  printf("I is answered by %d: switches %d\n", reply, reply - 32);

  close(robot);
  return 0;
}
