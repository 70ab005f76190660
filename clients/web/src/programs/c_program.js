// A program in C for POSIX systems, in one file.
import { filled, kNoMarkIII, programOf, speedRows } from "./program.js";

const kText = `/* Moves the robot through the points that were taught on the page of xr3.

       cc -o points @file@
       ./points [HOST [PORT]]

   The arm must stand at its soft home, as after the start of the server. It moves to each point with the
   jaws as they are, and then moves the jaws.
@warning
*/

#define _POSIX_C_SOURCE 200809L

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum {
  JOINTS = @count@,
  A = JOINTS,         /* the index of the jaws */
  CLOSING = @closing@,       /* the sign of counts that close the jaws */
  SHUT = @shut@,         /* the count at which the jaws are closed */
  SQUEEZE = @squeeze@,       /* counts by which the jaws close further than a point that grips a block */
  STRIDE = @stride@,        /* the longest move: the error counter has 8 bits */
  POLL_MS = 50,       /* between two questions, unless XR3_POLL_MS is set */
  STANDS_AFTER = 40   /* a joint has stopped if so many questions in a row have the same answer */
};

static const char LABELS[] = "@labels@";

struct point {
  const char *name;
  int counts[JOINTS + 1]; /* of the joints, then of the jaws */
  int grips;              /* whether the jaws grip a block */
  const char *speeds;     /* the commands that set the speeds, or "" */
  int pause_ms;
};

static const struct point POINTS[] = {
@points
};

static int line;           /* the socket */
static int at[JOINTS + 1]; /* counts from the soft home */
static int number;         /* of the point on the way, from 1 */

static void stop(const char *why) {
  fprintf(stderr, "stopped on the way to point %d, %s: %s\\n", number, POINTS[number - 1].name, why);
  exit(1);
}

static void wait_ms(int ms) {
  struct timespec pause = {ms / 1000, ms % 1000 * 1000000L};
  nanosleep(&pause, NULL);
}

static void robot_send(const char *text) {
  size_t length = strlen(text);
  if (send(line, text, length, MSG_NOSIGNAL) != (ssize_t)length) stop("the robot has closed the line");
}

/* The counts that a motor still has to go. */
static int to_go(int motor) {
  char inquiry[] = {LABELS[motor], '?', '\\0'};
  unsigned char reply;
  robot_send(inquiry);
  if (recv(line, &reply, 1, 0) != 1) stop("the robot has closed the line");
  return reply - 32;
}

/* Pauses between two questions. */
static void poll_pause(void) {
  const char *ms = getenv("XR3_POLL_MS");
  wait_ms(ms ? atoi(ms) : POLL_MS);
}

/* Waits until a motor has arrived. If it stands, drops the rest of its move. Returns that rest. */
static int wait_for(int motor) {
  int left = to_go(motor);
  int same = 0;
  while (left > 0 && same < STANDS_AFTER) {
    int before = left;
    poll_pause();
    left = to_go(motor);
    same = left == before ? same + 1 : 0;
  }
  if (left > 0) {
    char cancel[] = {LABELS[motor], 'X', '\\0'};
    robot_send(cancel);
  }
  return left;
}

static void start(int motor, int counts) {
  char text[16];
  snprintf(text, sizeof text, "%c%+d\\r", LABELS[motor], counts);
  if (counts != 0) robot_send(text);
}

/* Waits for a move and updates the counts. Returns what was left. */
static int arrive(int motor, int counts) {
  int left = wait_for(motor);
  at[motor] += counts > 0 ? counts - left : counts + left;
  return left;
}

/* The part of a way that has been gone after so many of all parts. */
static int gone(int way, int part, int parts) {
  long product = (long)way * part;
  return (int)(product >= 0 ? product / parts : -((-product + parts - 1) / parts));
}

/* Moves the motors from \`first\` to \`last\` to these counts, all together, and waits. */
static void go(int first, int last, const int *counts) {
  int way[JOINTS + 1], longest = 0;
  for (int m = first; m <= last; m++) {
    way[m] = counts[m] - at[m];
    if (abs(way[m]) > longest) longest = abs(way[m]);
  }
  int parts = (longest + STRIDE - 1) / STRIDE;
  for (int part = 1; part <= parts; part++) {
    int stuck = -1;
    for (int m = first; m <= last; m++) start(m, gone(way[m], part, parts) - gone(way[m], part - 1, parts));
    for (int m = first; m <= last; m++) {
      if (arrive(m, gone(way[m], part, parts) - gone(way[m], part - 1, parts)) > 0) stuck = m;
    }
    if (stuck >= 0) {
      char why[200];
      snprintf(why, sizeof why, "%c stands at %d, not at %d. Is the arm stalled, or a joint at its limit, or a "
               "block in the jaws?", LABELS[stuck], at[stuck], counts[stuck]);
      stop(why);
    }
  }
}

/* Closes the jaws at a block. The rest of the move shows that something is between them. */
static void grip(int count) {
  int target = count + CLOSING * SQUEEZE;
  if ((target - SHUT) * CLOSING > 0) target = SHUT;
  while (at[A] != target) {
    int step = target - at[A];
    if (step > STRIDE) step = STRIDE;
    if (step < -STRIDE) step = -STRIDE;
    start(A, step);
    if (arrive(A, step) > 0) return;
  }
  stop("the jaws closed on nothing");
}

static const char *setting(int argc, char *argv[], int i, const char *variable, const char *usual) {
  const char *value = argc > i ? argv[i] : getenv(variable);
  return value != NULL && value[0] != '\\0' ? value : usual;
}

static void robot_connect(const char *host, const char *port) {
  struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM}, *found = NULL;
  line = -1;
  if (getaddrinfo(host, port, &wanted, &found) == 0) {
    for (struct addrinfo *a = found; a != NULL && line < 0; a = a->ai_next) {
      line = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
      if (line >= 0 && connect(line, a->ai_addr, a->ai_addrlen) != 0) {
        close(line);
        line = -1;
      }
    }
    freeaddrinfo(found);
  }
  if (line < 0) {
    fprintf(stderr, "no robot answers at %s port %s\\n", host, port);
    exit(1);
  }
  int yes = 1;
  setsockopt(line, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

int main(int argc, char *argv[]) {
  int holds = 0;
  robot_connect(setting(argc, argv, 1, "XR3_HOST", "localhost"), setting(argc, argv, 2, "XR3_PORT", "9600"));
  for (size_t i = 0; i < sizeof POINTS / sizeof POINTS[0]; i++) {
    const struct point *point = &POINTS[i];
    number = (int)i + 1;
    robot_send(point->speeds);
    go(0, JOINTS - 1, point->counts);
    if (!point->grips) {
      go(A, A, point->counts);
    } else if (!holds) {
      grip(point->counts[A]);
    }
    holds = point->grips;
    printf("%d %s\\n", number, point->name);
    fflush(stdout);
    wait_ms(point->pause_ms);
  }
@reset_speeds
  close(line);
  return 0;
}
`;

/** A string literal: octal escapes end after three digits, and no trigraph can arise. */
const literal = (text) => `"${text.replaceAll(/["\\?]/g, (sign) => `\\${sign}`)}"`;
const commands = (speeds) => Object.entries(speeds).map(([label, speed]) => `${label}${speed}S`).join("");

/** { name, text, notes, companion }: the program, how to run it, and null, since it needs no other file. */
export function cProgram(robot, points) {
  const program = programOf(robot, points);
  const { name, labels, jaws, stride, squeeze, usesSpeeds } = program;
  const rows = new Map(speedRows(program));
  const speeds = (percent) => (usesSpeeds ? literal(commands(rows.get(percent))) : '""');
  const text = filled(kText, {
    file: `${name}.c`, warning: usesSpeeds ? `\n   ${kNoMarkIII}` : null, count: labels.length, labels: `${labels.join("")}A`,
    ...jaws, stride, squeeze, reset_speeds: usesSpeeds ? `  robot_send(${speeds(100)});` : null,
    points: program.points.map((point) => `    {${literal(point.name)}, {${[...point.counts, point.jaws].join(", ")}}, ${Number(point.grip)}, ${speeds(point.percent)}, ${Math.round(point.pause * 1000)}},`).join("\n"),
  });
  return { name: `${name}.c`, text, notes: `Run it: cc -o points ${name}.c && ./points HOST PORT. The arm must stand at its soft home.`, companion: null };
}
