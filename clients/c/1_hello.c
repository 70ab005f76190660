/* 1. Hello: connect to the robot, ask it two questions, print the answers.

       build/1_hello [HOST [PORT]]

   A robot on a serial line knows no lines of text and no "OK". It answers a question with one
   byte, and everything else with silence. */

#define _POSIX_C_SOURCE 200809L /* the network is no part of C11: it comes from POSIX */

#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* A variable of the environment; one that is empty counts as not set. */
static const char *setting(const char *name, const char *otherwise) {
  const char *value = getenv(name);
  return value != NULL && value[0] != '\0' ? value : otherwise;
}

/* Sends a question and returns the byte that answers it. */
static int ask(int robot, const char *question) {
  unsigned char reply[100];
  /* MSG_NOSIGNAL: if the line is closed, tell us, and do not just end the program. */
  ssize_t sent = send(robot, question, strlen(question), MSG_NOSIGNAL);
  ssize_t got = sent < 0 ? 0 : recv(robot, reply, sizeof reply, 0);
  if (got <= 0) {
    fprintf(stderr, "the robot has closed the line\n");
    exit(1);
  }
  if (got > 1) {
    fprintf(stderr, "no robot answers like this; is it the monitor port? "
                    "The robot port is 9600\n");
    exit(1);
  }
  return reply[0];
}

int main(int argc, char *argv[]) {
  /* Where the robot is: from the arguments, else from the environment, else this machine. */
  const char *host = argc > 1 ? argv[1] : setting("XR3_HOST", "localhost");
  const char *port = argc > 2 ? argv[2] : setting("XR3_PORT", "9600");
  char *end;
  long number = strtol(port, &end, 10);
  if (*end != '\0' || number < 1 || number > 65535) {
    fprintf(stderr, "the port has to be a number from 1 to 65535, not '%s'\n", port);
    return 1;
  }

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
    fprintf(stderr, "no robot answers at %s port %s: is the server running? ./run\n", host, port);
    return 1;
  }

  /* How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
     blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on. */
  int reply = ask(robot, "E?");
  printf("E? is answered by %d: %d counts to go\n", reply, reply - 32);

  /* Which microswitches are closed? Again 32 is added; each switch has a bit of its own. */
  reply = ask(robot, "I");
  printf("I is answered by %d: switches %d\n", reply, reply - 32);

  close(robot);
  return 0;
}
