// A program in Python that needs nothing but a socket.
import { filled, kNoMarkIII, programOf, speedRows } from "./program.js";

const kText = `"""Moves the robot @robot@ through the points that were taught on the page of xr3.

    python3 @file@ [HOST [PORT]]

It needs only Python 3. The arm must stand at its soft home, as after the start of the server. It moves to each
point with the jaws as they are, and then moves the jaws.
@warning
"""

import os
import socket
import sys
import time

JOINTS = "@joints@"
CLOSING = @closing@  # the sign of counts that close the jaws
SHUT = @shut@  # the count at which the jaws are closed
SQUEEZE = @squeeze@  # counts by which the jaws close further than a point that grips a block
STRIDE = @stride@  # the longest move: the error counter has 8 bits
POLL_S = int(os.environ.get("XR3_POLL_MS", 50)) / 1000  # between two questions
STANDS_AFTER = 40  # a joint has stopped if so many questions in a row have the same answer
@speeds

# Name, counts of the joints, count of the jaws, whether they grip a block, @percent@pause in seconds.
POINTS = [
@points
]

at = dict.fromkeys(JOINTS + "A", 0)  # counts from the soft home


class Stopped(Exception):
    """A joint did not arrive."""


def to_go(line, label):
    """The counts that the joint still has to go."""
    line.sendall(f"{label}?".encode())
    reply = line.recv(1)
    if not reply:
        raise Stopped("the robot has closed the line")
    return reply[0] - 32


def wait(line, label):
    """Waits until the joint has arrived. If it stands, drops the rest of its move. Returns that rest."""
    left, same = to_go(line, label), 0
    while left and same < STANDS_AFTER:
        time.sleep(POLL_S)
        before, left = left, to_go(line, label)
        same = same + 1 if left == before else 0
    if left:
        line.sendall(f"{label}X".encode())
    return left


def stride(line, way):
    """Moves joints by these counts together. Returns those that did not arrive."""
    for label, counts in way.items():
        if counts:
            line.sendall(f"{label}{counts:+d}\\r".encode())
    lefts = {label: wait(line, label) for label in way}
    for label, counts in way.items():
        at[label] += counts - lefts[label] if counts > 0 else counts + lefts[label]
    return [label for label, left in lefts.items() if left]


def go(line, counts):
    """Moves joints to these counts, all together, and waits."""
    way = {label: wanted - at[label] for label, wanted in counts.items()}
    parts = -(-max(map(abs, way.values())) // STRIDE)
    for part in range(1, parts + 1):
        stuck = stride(line, {label: whole * part // parts - whole * (part - 1) // parts for label, whole in way.items()})
        if stuck:
            places = ", ".join(f"{label} stands at {at[label]}, not at {counts[label]}" for label in stuck)
            raise Stopped(f"{places}. Is the arm stalled, or a joint at its limit, or a block in the jaws?")


def grip(line, count):
    """Closes the jaws at a block. The rest of the move shows that something is between them."""
    target = max(count + CLOSING * SQUEEZE, SHUT, key=lambda each: -each * CLOSING)
    while at["A"] != target:
        if stride(line, {"A": max(-STRIDE, min(STRIDE, target - at["A"]))}):
            return
    raise Stopped("the jaws closed on nothing")


def connect():
    host = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("XR3_HOST") or "localhost"
    port = sys.argv[2] if len(sys.argv) > 2 else os.environ.get("XR3_PORT") or "9600"
    line = socket.create_connection((host, int(port)), 10)
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return line


def main():
    try:
        line = connect()
    except (OSError, ValueError) as error:
        sys.exit(f"no robot answers: {error}")
    holds = False
    for number, (name, joints, jaws, grips, @percent@pause) in enumerate(POINTS, 1):
        try:
@set_speeds
            go(line, dict(zip(JOINTS, joints)))
            if not grips:
                go(line, {"A": jaws})
            elif not holds:
                grip(line, jaws)
            holds = grips
        except (Stopped, OSError) as error:
            sys.exit(f"stopped on the way to point {number}, {name}: {error}")
        print(f"{number} {name}", flush=True)
        time.sleep(pause)
@reset_speeds
    line.close()


if __name__ == "__main__":
    main()
`;

const bool = (value) => (value ? "True" : "False");
const tuple = (values) => `(${values.join(", ")}${values.length === 1 ? "," : ""})`;

/** { name, text, notes, companion }: the program, how to run it, and null, since it needs no other file. */
export function pythonSockets(robot, points) {
  const program = programOf(robot, points);
  const { name, labels, jaws, stride, squeeze, usesSpeeds } = program;
  const rows = speedRows(program).map(([percent, speeds]) => `    ${percent}: "${Object.entries(speeds).map(([label, speed]) => `${label}${speed}S`).join("")}",`);
  const text = filled(kText, {
    robot: robot.name.replaceAll(/[\\"]/g, ""), file: `${name}.py`, warning: usesSpeeds ? `\n${kNoMarkIII}` : null,
    joints: labels.join(""), ...jaws, stride, squeeze, percent: usesSpeeds ? "percent, " : "",
    speeds: usesSpeeds ? `SPEEDS = {  # the commands for each percentage\n${rows.join("\n")}\n}` : null,
    set_speeds: usesSpeeds ? "            line.sendall(SPEEDS[percent].encode())" : null,
    reset_speeds: usesSpeeds ? "    line.sendall(SPEEDS[100].encode())" : null,
    points: program.points.map((point) => `    (${JSON.stringify(point.name)}, ${tuple(point.counts)}, ${point.jaws}, ${bool(point.grip)}, ${usesSpeeds ? `${point.percent}, ` : ""}${point.pause}),`).join("\n"),
  });
  return { name: `${name}.py`, text, notes: `Run it: python3 ${name}.py HOST PORT. The arm must stand at its soft home.`, companion: null };
}
