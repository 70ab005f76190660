/* 1. Hello: connect to the robot, ask it two questions, print the answers.

       build/1_hello [HOST [PORT]]

   The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
   with one byte and does not answer other commands. */

#define _POSIX_C_SOURCE 200809L /* sockets are part of POSIX, not of C11 */

#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* An environment variable; an empty one counts as not set. */
static const char *setting(const char *name, const char *otherwise) {
  const char *value = getenv(name);
  return value != NULL && value[0] != '\0' ? value : otherwise;
}

/* Sends a question and returns the one-byte answer. */
static int ask(int robot, const char *question) {
  unsigned char reply[100];
  /* MSG_NOSIGNAL: on a closed connection, return an error instead of ending the program. */
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
  /* Host and port: from the arguments, else from the environment, else the defaults. */
  const char *host = argc > 1 ? argv[1] : setting("XR3_HOST", "localhost");
  const char *port = argc > 2 ? argv[2] : setting("XR3_PORT", "9600");
  char *end;
  long number = strtol(port, &end, 10);
  if (*end != '\0' || number < 1 || number > 65535) {
    fprintf(stderr, "the port has to be a number from 1 to 65535, not '%s'\n", port);
    return 1;
  }

  /* A name may have several addresses: use the first one that accepts a connection. */
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

  /* Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is added
     to the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so on. */
  int reply = ask(robot, "E?");
  printf("E? is answered by %d: %d counts to go\n", reply, reply - 32);

  /* Which microswitches are closed? Again 32 is added; each switch has one bit. */
  reply = ask(robot, "I");
  printf("I is answered by %d: switches %d\n", reply, reply - 32);

  close(robot);
  return 0;
}
