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

static void give_up(const char *why) {
  fprintf(stderr, "%s\n", why);
  exit(1);
}

void robot_connect(int argc, char *argv[]) {
  const char *host = argc > 1 ? argv[1] : getenv("XR3_HOST");
  const char *port = argc > 2 ? argv[2] : getenv("XR3_PORT");
  if (host == NULL) host = "localhost";
  if (port == NULL) port = "9600";
  struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
  struct addrinfo *addresses;
  if (getaddrinfo(host, port, &wanted, &addresses) != 0) give_up("no such host");
  for (struct addrinfo *a = addresses; a != NULL && line < 0; a = a->ai_next) {
    line = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
    if (connect(line, a->ai_addr, a->ai_addrlen) != 0) {
      close(line);
      line = -1;
    }
  }
  freeaddrinfo(addresses);
  if (line < 0) give_up("no robot answers there");
  int yes = 1; /* few bytes at a time shall go out at once, not be gathered first */
  setsockopt(line, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

void robot_send(const char *format, ...) {
  char text[100];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length >= (int)sizeof text) give_up("too long a text to send");
  if (write(line, text, length) != length) give_up("the robot has closed the line");
}

void robot_read(unsigned char *bytes, int count) {
  while (count > 0) { /* a long answer comes in pieces */
    int got = (int)read(line, bytes, count);
    if (got <= 0) give_up("the robot has closed the line");
    bytes += got;
    count -= got;
  }
}

int robot_ask(const char *inquiry) {
  unsigned char reply;
  robot_send("%s", inquiry);
  robot_read(&reply, 1);
  return reply;
}

int robot_to_go(int joint) {
  char inquiry[] = {LETTERS[joint], '?', '\0'};
  return robot_ask(inquiry) - 32;
}

void wait_ms(int milliseconds) {
  struct timespec pause = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
  nanosleep(&pause, NULL);
}

int robot_wait(int joint) {
  int left = robot_to_go(joint);
  while (left > 0) {
    wait_ms(50); /* time enough for a count at 20 counts a second and more */
    int before = left;
    left = robot_to_go(joint);
    if (left == before) {
      robot_send("%cX", LETTERS[joint]);
      break;
    }
  }
  return left;
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
      if (robot_wait(j) > 0) give_up("a joint stands and is not where it was sent");
    }
  }
}

void robot_close(void) { close(line); }
