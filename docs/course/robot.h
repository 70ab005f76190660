/* The robot's serial line for the C programs of the course: C11, POSIX sockets, no other library.
   Include it before any other header. If something fails, a function prints why and ends the program
   with exit code 1. Labels are the robot's letters: 'A' is the jaws, 'B' to 'H' are the joints. */

#ifndef ROBOT_H
#define ROBOT_H

#define _POSIX_C_SOURCE 200809L

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum {
  ROBOT_SPACE = 32,        /* added to one-byte replies, so that they can be printed */
  ROBOT_STRIDE = 60,       /* longest move of robot_go, in counts: the counters have 8 bits */
  ROBOT_PAUSE_MS = 50,     /* between two inquiries, unless XR3_POLL_MS says otherwise */
  ROBOT_STANDS_AFTER = 40, /* a joint stands if so many replies are the same */
  ROBOT_TIMEOUT_S = 10     /* for a reply */
};

static int robot_line = -1;

/* Where the motors are, in counts from the soft home: robot_at[label - 'A'], kept by robot_go. */
static int robot_at[8];

/* Prints a message (a printf format) and ends the program. */
static inline void robot_give_up(const char *format, ...) {
  va_list values;
  va_start(values, format);
  vfprintf(stderr, format, values);
  va_end(values);
  fputc('\n', stderr);
  exit(1);
}

/* Connects to XR3_HOST and XR3_PORT of the environment, else to localhost, port 9600. */
static inline void robot_connect(void) {
  const char *host = getenv("XR3_HOST") ? getenv("XR3_HOST") : "localhost";
  const char *port = getenv("XR3_PORT") ? getenv("XR3_PORT") : "9600";
  const struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
  struct addrinfo *found = NULL;
  if (getaddrinfo(host, port, &wanted, &found) != 0) robot_give_up("there is no host %s", host);
  for (const struct addrinfo *each = found; each && robot_line < 0; each = each->ai_next) {
    robot_line = socket(each->ai_family, each->ai_socktype, each->ai_protocol);
    if (robot_line >= 0 && connect(robot_line, each->ai_addr, each->ai_addrlen) != 0) {
      close(robot_line);
      robot_line = -1;
    }
  }
  freeaddrinfo(found);
  if (robot_line < 0) robot_give_up("no robot answers at %s port %s", host, port);
  const int yes = 1;
  const struct timeval timeout = {.tv_sec = ROBOT_TIMEOUT_S};
  setsockopt(robot_line, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  setsockopt(robot_line, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
}

/* Sends commands (a printf format). A move starts at the first byte after its number: end it with \r. */
static inline void robot_send(const char *format, ...) {
  char text[256];
  va_list values;
  va_start(values, format);
  const int length = vsnprintf(text, sizeof text, format, values);
  va_end(values);
  if (length < 0 || (size_t)length >= sizeof text) robot_give_up("the commands are too long");
  if (send(robot_line, text, (size_t)length, MSG_NOSIGNAL) != length)
    robot_give_up("the robot has closed the line");
}

/* Reads exactly `count` bytes of replies. */
static inline void robot_read(unsigned char *bytes, size_t count) {
  for (size_t done = 0; done < count;) {
    const ssize_t part = recv(robot_line, bytes + done, count - done, 0);
    if (part < 0) robot_give_up("the robot does not answer");
    if (part == 0) robot_give_up("the robot has closed the line");
    done += (size_t)part;
  }
}

/* Sends an inquiry and returns its one-byte reply, 0 to 255. */
static inline int robot_ask(const char *inquiry) {
  unsigned char reply = 0;
  robot_send("%s", inquiry);
  robot_read(&reply, 1);
  return reply;
}

/* The counts that a joint has still to go, without their sign. The real controller answers with seven
   bits, so that a reply below 32 has lost its bit of 128. */
static inline int robot_to_go(char label) {
  const char inquiry[] = {label, '?', '\0'};
  const int reply = robot_ask(inquiry);
  return reply >= ROBOT_SPACE ? reply - ROBOT_SPACE : reply + 128 - ROBOT_SPACE;
}

/* xr3 exec sets XR3_POLL_MS to 0 where simulated time follows the inquiries. */
static inline void robot_pause(void) {
  const int ms = getenv("XR3_POLL_MS") ? atoi(getenv("XR3_POLL_MS")) : ROBOT_PAUSE_MS;
  const struct timespec pause = {.tv_sec = ms / 1000, .tv_nsec = ms % 1000 * 1000000L};
  nanosleep(&pause, NULL);
}

/* Waits until a joint has arrived. If it stands (at a limit, jaws at a block), cancels the rest of its
   move. Returns the counts that were left, 0 if it has arrived. */
static inline int robot_wait(char label) {
  int left = robot_to_go(label);
  for (int same = 0; left > 0 && same < ROBOT_STANDS_AFTER;) {
    const int before = left;
    robot_pause();
    left = robot_to_go(label);
    same = left == before ? same + 1 : 0;
  }
  if (left > 0) robot_send("%cX", label);
  return left;
}

/* Moves these joints to these counts from the soft home, all together and in equal parts, and waits.
   robot_go("FE", (int[]){20, -30}) moves F to 20 and E to -30. */
static inline void robot_go(const char *labels, const int *counts) {
  const size_t joints = strlen(labels);
  int way[8] = {0};
  int longest = 0;
  for (size_t k = 0; k < joints; ++k) {
    way[k] = counts[k] - robot_at[labels[k] - 'A'];
    if (abs(way[k]) > longest) longest = abs(way[k]);
  }
  const int parts = (longest + ROBOT_STRIDE - 1) / ROBOT_STRIDE;
  for (int part = 1; part <= parts; ++part) {
    for (size_t k = 0; k < joints; ++k) {
      const int step = way[k] * part / parts - way[k] * (part - 1) / parts;
      if (step != 0) robot_send("%c%+d\r", labels[k], step);
      robot_at[labels[k] - 'A'] += step;
    }
    for (size_t k = 0; k < joints; ++k) {
      const int left = robot_wait(labels[k]);
      if (left > 0) robot_give_up("%c stopped %d counts short of its target", labels[k], left);
    }
  }
}

static inline void robot_close(void) { close(robot_line); }

#endif
