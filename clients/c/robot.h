/* What the examples 2 to 6 share: the line to the robot, and the few things that one says on it.
   A function that cannot do its work says so and ends the program with exit code 1. */

#ifndef ROBOT_H
#define ROBOT_H

/* The joints from the base to the jaws; an array of counts has a place for each. */
enum { F, E, D, C, B, A, JOINTS };
extern const char LETTERS[]; /* "FEDCBA" */

/* How long to do nothing between two questions. */
enum { PAUSE_MS = 50 };

/* A joint stands if its counter has not changed for so long. The slowest speed is one count a
   second, and the simulator's clock may run slowly, so be patient. */
enum { STANDS_MS = 2000 };

/* Where the motors are, in counts from the soft home, as far as robot_go moved them. */
extern int at[JOINTS];

/* Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost
   9600. */
void robot_connect(int argc, char *argv[]);

/* Sends commands; the text is printf's. A move has to end with \r. */
void robot_send(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Reads exactly so many bytes of an answer. */
void robot_read(unsigned char *bytes, int count);

/* Asks, and returns the byte that answers. */
int robot_ask(const char *inquiry);

/* How many counts the joint has still to go. */
int robot_to_go(int joint);

/* Does nothing for so long. */
void wait_ms(int milliseconds);

/* Waits until the joint is there. One that makes no count for STANDS_MS stands, at a limit or with
   the jaws at a block, and is stopped. Returns the counts that were left. */
int robot_wait(int joint);

/* Says that the joint stands so many counts too early and what the reason may be, and ends the
   program. */
void robot_stands(int joint, int left);

/* Says what is wrong and ends the program; the text is printf's. */
void robot_give_up(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Brings all motors to these counts together, in parts small enough for the error counter. */
void robot_go(const int wanted[JOINTS]);

void robot_close(void);

#endif
