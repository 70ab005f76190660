// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     build/3_home [HOST [PORT]]

mod robot;
use robot::{check_arrived, error, Robot};
use std::io::Result;

/// A switch closes at `place`, in counts from the soft home: upper arm upright, forearm level, tool
/// down. Seen from there it is open before this count, and closed from it on: for a few dozen
/// counts on a real arm, for longer in the simulator. One byte reports several switches: I those of
/// joints C to F, J those of A and B. Each has one `bit`.
struct Switch {
    joint: char,
    place: i32,
    inquiry: &'static str,
    bit: i32,
}

const JAWS: Switch = Switch { joint: 'A', place: -16, inquiry: "J", bit: 16 };
const SHOULDER: Switch = Switch { joint: 'E', place: -40, inquiry: "I", bit: 4 };

// The jaws come first: they show how a closed switch reads. The elbow, joint D, follows, since it
// lifts the hand off the table.
const SWITCHES: [Switch; 6] = [
    JAWS,
    Switch { joint: 'D', place: 40, inquiry: "I", bit: 2 },
    SHOULDER,
    Switch { joint: 'C', place: 40, inquiry: "I", bit: 1 },
    Switch { joint: 'B', place: -25, inquiry: "J", bit: 32 },
    Switch { joint: 'F', place: 30, inquiry: "I", bit: 8 },
];

const STEP: i32 = 10; // counts of one move of the search; a switch stays closed for longer
const FAR: i32 = 1600; // more counts than any joint has from a limit to its switch
const LEAN: i32 = 400; // counts forward that bring the shoulder out of its backmost position

/// The bit of the joint's switch. Some controllers report a closed switch as 1, others as 0.
fn read_switch(robot: &mut Robot, of: &Switch) -> Result<i32> {
    Ok(i32::from((robot.ask(of.inquiry)? - 32) & of.bit != 0))
}

/// Moves the joint and returns the counts that were left, 0 if it has arrived.
fn step(robot: &mut Robot, joint: char, counts: i32) -> Result<i32> {
    robot.send(&format!("{joint}{counts:+}\r"))?;
    robot.wait(joint) // as in example 2; cancels the move of a blocked joint
}

/// Moves in steps of `counts` until the switch changes. Returns false if it does not within
/// `farthest` counts, or before the joint is blocked.
fn changes(robot: &mut Robot, of: &Switch, counts: i32, farthest: i32) -> Result<bool> {
    let before = read_switch(robot, of)?;
    for _ in 0..farthest / counts.abs() {
        let left = step(robot, of.joint, counts)?;
        if read_switch(robot, of)? != before {
            return Ok(true);
        }
        if left > 0 {
            return Ok(false);
        }
    }
    Ok(false)
}

/// Moves until the switch closes, usually away from the soft home first. Returns false if it does
/// not close.
fn search(robot: &mut Robot, of: &Switch, away: i32) -> Result<bool> {
    if of.joint == 'E' {
        // Forwards first: a shoulder that leans back folds the arm into its base.
        return Ok(changes(robot, of, STEP, LEAN)? || changes(robot, of, -STEP, 2 * FAR)?);
    }
    if changes(robot, of, STEP * away, FAR)? {
        return Ok(true);
    }
    if of.joint == 'D' {
        // The shoulder may lean far back: it must not when the forearm comes down.
        changes(robot, &SHOULDER, STEP, LEAN)?;
    }
    changes(robot, of, -STEP * away, 2 * FAR)
}

/// Moves to the count at which the switch closes. `closed` is what a closed switch reads. Returns
/// false if the switch does not change.
fn find_near_edge(robot: &mut Robot, of: &Switch, closed: i32) -> Result<bool> {
    let away = of.place.signum();
    if read_switch(robot, of)? != closed && !search(robot, of, away)? {
        return Ok(false);
    }
    // Back until the switch opens, and then count by count until it closes.
    Ok(changes(robot, of, -STEP * away, FAR)? && changes(robot, of, away, FAR)?)
}

fn home() -> Result<()> {
    let mut robot = Robot::connect()?;

    // The open jaws are at the end of their travel, and on their switch. It opens when they close.
    changes(&mut robot, &JAWS, -STEP, FAR)?;
    let closed = read_switch(&mut robot, &JAWS)?; // the reading of a closed switch, 0 or 1

    // A shoulder on its switch may lean far back: it comes forward before the forearm moves.
    if read_switch(&mut robot, &SHOULDER)? == closed {
        find_near_edge(&mut robot, &SHOULDER, closed)?;
    }

    for of in &SWITCHES {
        if !find_near_edge(&mut robot, of, closed)? {
            return Err(error(&format!(
                "the switch of {} does not change. Is the joint blocked at a limit, or the arm \
                 stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with \
                 its own workcell)",
                of.joint
            )));
        }
        println!("{} is on its switch, at {:+}", of.joint, of.place);
    }

    // All switches at once. J also reports four input lines, in its bits 1 to 8.
    let i = robot.ask("I")? - 32;
    let j = (robot.ask("J")? - 32) & 48;
    println!("a closed switch reads {closed}; the switches of I are {i}, those of J {j}");

    // The soft home is at count 0: move each joint back by the count of its switch.
    for of in &SWITCHES {
        check_arrived(of.joint, step(&mut robot, of.joint, -of.place)?)?;
    }
    println!("at the soft home");
    Ok(())
}

fn main() {
    if let Err(why) = home() {
        eprintln!("{why}");
        std::process::exit(1);
    }
}
