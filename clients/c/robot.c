#define _POSIX_C_SOURCE 200809L /* sockets are part of POSIX, not of C11 */

#include "robot.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

const char LETTERS[] = "FEDCBA";
int at[JOINTS];

static int line = -1; /* the socket */

void robot_give_up(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fprintf(stderr, "\n");
  exit(1);
}

/* An environment variable; an empty one counts as not set. */
static const char *setting(const char *name, const char *otherwise) {
  const char *value = getenv(name);
  return value != NULL && value[0] != '\0' ? value : otherwise;
}

void robot_connect(int argc, char *argv[]) {
  const char *host = argc > 1 ? argv[1] : setting("XR3_HOST", "localhost");
  const char *port = argc > 2 ? argv[2] : setting("XR3_PORT", "9600");
  char *end;
  long number = strtol(port, &end, 10);
  if (*end != '\0' || number < 1 || number > 65535) {
    robot_give_up("the port has to be a number from 1 to 65535, not '%s'", port);
  }
  struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
  struct addrinfo *addresses;
  if (getaddrinfo(host, port, &wanted, &addresses) != 0) {
    robot_give_up("no such host: %s", host);
  }
  for (struct addrinfo *a = addresses; a != NULL && line < 0; a = a->ai_next) {
    line = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
    if (connect(line, a->ai_addr, a->ai_addrlen) != 0) {
      close(line);
      line = -1;
    }
  }
  freeaddrinfo(addresses);
  if (line < 0) {
    robot_give_up("no robot answers at %s port %s: is the server running? ./run", host, port);
  }
  int yes = 1; /* send small messages at once */
  setsockopt(line, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

void robot_send(const char *format, ...) {
  char text[100];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length >= (int)sizeof text) robot_give_up("too long a text to send");
  /* MSG_NOSIGNAL: on a closed connection, return an error instead of ending the program. */
  if (send(line, text, length, MSG_NOSIGNAL) != length) {
    robot_give_up("the robot has closed the line");
  }
}

void robot_read(unsigned char *bytes, int count) {
  while (count > 0) { /* a long answer arrives in pieces */
    int got = (int)recv(line, bytes, count, 0);
    if (got <= 0) robot_give_up("the robot has closed the line");
    bytes += got;
    count -= got;
  }
}

int robot_ask(const char *inquiry) {
  unsigned char reply[100];
  robot_send("%s", inquiry);
  int got = (int)recv(line, reply, sizeof reply, 0);
  if (got <= 0) robot_give_up("the robot has closed the line");
  if (got > 1) {
    robot_give_up("no robot answers like this; is it the monitor port? The robot port is 9600");
  }
  return reply[0];
}

int robot_to_go(int joint) {
  char inquiry[] = {LETTERS[joint], '?', '\0'};
  return robot_ask(inquiry) - 32;
}

void robot_pause(void) {
  int milliseconds = atoi(setting("XR3_POLL_MS", "50"));
  struct timespec pause = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
  nanosleep(&pause, NULL);
}

int robot_wait(int joint) {
  int left = robot_to_go(joint);
  int same = 0; /* number of equal answers in a row */
  while (left > 0 && same < STANDS_AFTER) {
    robot_pause();
    int before = left;
    left = robot_to_go(joint);
    same = left == before ? same + 1 : 0;
  }
  if (left > 0) robot_send("%cX", LETTERS[joint]);
  return left;
}

void robot_stands(int joint, int left) {
  robot_give_up("%c stopped %d counts short of its target. Is it blocked at a limit, or stalled? "
                "Is a block in the jaws? Is the clock paused or slow? Look at the page or at "
                "`xr3 watch`", LETTERS[joint], left);
}

void robot_go(const int wanted[JOINTS]) {
  int start[JOINTS], longest = 0;
  memcpy(start, at, sizeof start);
  for (int j = 0; j < JOINTS; j++) {
    if (abs(wanted[j] - start[j]) > longest) longest = abs(wanted[j] - start[j]);
  }
  int parts = (longest + 59) / 60; /* no move is longer than 60 counts */
  for (int part = 1; part <= parts; part++) {
    for (int j = 0; j < JOINTS; j++) {
      int next = start[j] + (wanted[j] - start[j]) * part / parts;
      if (next != at[j]) robot_send("%c%+d\r", LETTERS[j], next - at[j]);
      at[j] = next;
    }
    for (int j = 0; j < JOINTS; j++) {
      int left = robot_wait(j);
      if (left > 0) robot_stands(j, left);
    }
  }
}

void robot_close(void) { close(line); }
