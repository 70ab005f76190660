// A program in Python with the package xr3, clients/python of the sources.
import { filled, kNoMarkIII, programOf, slug, speedRows } from "./program.js";

const kArms = { "Rhino XR-3/FEDCB": "RHINO_XR3", "Adept One/EDCB": "ADEPT_ONE", "Intelledex 660/GFEDCB": "INTELLEDEX_660" };

const kText = `"""Moves the robot @robot@ through the points that were taught on the page of xr3.

    python3 @file@ [HOST [PORT]]

It needs the package xr3, the folder clients/python/xr3 of the sources of xr3: copy that next to this program. The
arm must stand at its soft home, as after the start of the server. It moves to each point with the jaws as
they are, and then moves the jaws.
@warning
"""

@imports

import xr3

ARM = @arm@
CLOSING = @closing@  # the sign of counts that close the jaws
SHUT = @shut@  # the count at which the jaws are closed
SQUEEZE = @squeeze@  # counts by which the jaws close further than a point that grips a block
@speeds

# Name, counts of the joints, count of the jaws, whether they grip a block, @percent@pause in seconds.
POINTS = [
@points
]


def grip(robot, count):
    """Closes the jaws at a block. The rest of the move shows that something is between them."""
    target = max(count + CLOSING * SQUEEZE, SHUT, key=lambda each: -each * CLOSING)
    while robot.at["A"] != target:
        step = max(-@stride@, min(@stride@, target - robot.at["A"]))
        robot.move("A", step)
        left = robot.wait("A")  # and drops the rest
        robot.at["A"] += step - left if step > 0 else step + left
        if left:
            return
    raise xr3.RobotError("the jaws closed on nothing")


def main():
    robot = xr3.connect(ARM)
    holds = False
    for number, (name, joints, jaws, grips, @percent@pause) in enumerate(POINTS, 1):
        try:
@set_speeds
            robot.go(joints)
            if not grips:
                robot.go({"A": jaws})
            elif not holds:
                grip(robot, jaws)
            holds = grips
        except (xr3.RobotError, xr3.Unreachable, OSError) as error:
            sys.exit(f"stopped on the way to point {number}, {name}: {error}")
        print(f"{number} {name}", flush=True)
        time.sleep(pause)
@reset_speeds


if __name__ == "__main__":
    main()
`;

const dict = (labels, values) => `{${labels.map((label, i) => `"${label}": ${values[i]}`).join(", ")}}`;
const bool = (value) => (value ? "True" : "False");

/** { name, text, notes, companion }: the program, how to run it, and a file that it needs, or null. */
export function pythonPackage(robot, points) {
  const program = programOf(robot, points);
  const { name, labels, jaws, stride, squeeze, usesSpeeds } = program;
  const arm = kArms[`${robot.name}/${labels.join("")}`];
  const robotFile = `${slug(robot.name)}.json`;
  const text = filled(kText, {
    robot: robot.name.replaceAll(/[\\"]/g, ""), file: `${name}.py`, warning: usesSpeeds ? `\n${kNoMarkIII}` : null,
    imports: ["import sys", "import time", ...(arm ? [] : ["from pathlib import Path"])].join("\n"),
    arm: arm ? `xr3.${arm}` : `xr3.Arm.load(Path(__file__).with_name("${robotFile}"))`,
    ...jaws, stride, squeeze, percent: usesSpeeds ? "percent, " : "",
    speeds: usesSpeeds ? `SPEEDS = {  # counts a second for each percentage\n${speedTable(program)}\n}` : null,
    set_speeds: usesSpeeds ? "            for label, speed in SPEEDS[percent].items():\n                robot.set_speed(label, speed)" : null,
    reset_speeds: usesSpeeds ? "    for label, speed in SPEEDS[100].items():\n        robot.set_speed(label, speed)\n    robot.close()" : "    robot.close()",
    points: program.points.map((point) => `    (${JSON.stringify(point.name)}, ${dict(labels, point.counts)}, ${point.jaws}, ${bool(point.grip)}, ${usesSpeeds ? `${point.percent}, ` : ""}${point.pause}),`).join("\n"),
  });
  const notes = `Copy the folder clients/python/xr3 of the sources next to it, then: python3 ${name}.py HOST PORT. The arm must stand at its soft home.${arm ? "" : ` It reads the robot's file, ${robotFile}, beside it.`}`;
  return { name: `${name}.py`, text, notes, companion: arm ? null : { name: robotFile, text: `${JSON.stringify(robot, null, 2)}\n`, what: "the robot’s file" } };
}

const speedTable = (program) => speedRows(program).map(([percent, speeds]) => `    ${percent}: ${dict(Object.keys(speeds), Object.values(speeds))},`).join("\n");
