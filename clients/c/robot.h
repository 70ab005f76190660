/* Shared by examples 2 to 6: the connection to the robot and its basic commands. On failure, a
   function prints a message and ends the program with exit code 1. */

#ifndef ROBOT_H
#define ROBOT_H

/* The joints from the base to the jaws, as indices into arrays of counts. */
enum { F, E, D, C, B, A, JOINTS };
extern const char LETTERS[]; /* "FEDCBA" */

/* A joint counts as stopped if its counter is the same after this many questions, over 2 seconds.
   The slowest speed is one count per second, and the simulator's clock may run slowly, hence the
   long wait. */
enum { STANDS_AFTER = 40 };

/* Motor positions in counts from the soft home, as tracked by robot_go. */
extern int at[JOINTS];

/* Connects to HOST and PORT from the arguments, else XR3_HOST and XR3_PORT, else localhost 9600. */
void robot_connect(int argc, char *argv[]);

/* Sends commands; the text is a printf format. A move must end with \r. */
void robot_send(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Reads exactly `count` bytes of an answer. */
void robot_read(unsigned char *bytes, int count);

/* Sends an inquiry and returns the one-byte answer. */
int robot_ask(const char *inquiry);

/* The counts that the joint still has to go. A Mark III answers with seven bits: for more than 95
   counts the answer is wrong there, so no move of these programs is longer. */
int robot_to_go(int joint);

/* Pauses between two questions: 50 ms, or XR3_POLL_MS. */
void robot_pause(void);

/* Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels its
   move. Returns the counts that were left. */
int robot_wait(int joint);

/* Reports a joint that has stopped `left` counts short of its target, with possible reasons, and
   ends the program. */
void robot_stands(int joint, int left);

/* Prints a message and ends the program; the text is a printf format. */
void robot_give_up(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Moves all motors to these counts together, in parts small enough for the error counter. */
void robot_go(const int wanted[JOINTS]);

void robot_close(void);

#endif
