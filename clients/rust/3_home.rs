// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     build/3_home [HOST [PORT]]

mod robot;
use robot::{check_arrived, error, Robot};
use std::io::Result;

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
const SWITCHES: [(char, i32); 6] =
    [('D', 40), ('E', -40), ('C', 40), ('B', -25), ('F', 30), ('A', 16)];

/// More counts than the full travel of any joint.
const FARTHEST: i32 = 2500;

fn is_closed(robot: &mut Robot, joint: char) -> Result<bool> {
    Ok(robot.ask(&format!("{joint}V"))? == 1) // 0 or 1, without the 32
}

/// Moves the joint and returns the counts that were left, 0 if it has arrived.
fn step(robot: &mut Robot, joint: char, counts: i32) -> Result<i32> {
    robot.send(&format!("{joint}{counts:+}\r"))?;
    robot.wait(joint) // as in example 2; cancels the move of a blocked joint
}

/// Moves in steps of `counts` until the switch is closed (true) or open (false).
fn search(robot: &mut Robot, joint: char, counts: i32, closed: bool) -> Result<()> {
    let mut gone = 0;
    while is_closed(robot, joint)? != closed {
        if step(robot, joint, counts)? == counts.abs() {
            return Err(error(&format!(
                "{joint} does not move, and its switch is not found. Is it at a limit, or \
                 stalled? Is the clock paused? This example is for the Rhino XR-3, in the profile \
                 paper"
            )));
        }
        gone += counts.abs();
        if gone > FARTHEST {
            return Err(error(&format!(
                "{joint} went {gone} counts, and its switch is not found. This example is for the \
                 Rhino XR-3, in the profile paper"
            )));
        }
    }
    Ok(())
}

fn home() -> Result<()> {
    let mut robot = Robot::connect()?;

    // Some controllers report their switches inverted. The answer to I shows it: the highest of its
    // six bits belongs to no switch and should be 0.
    if robot.ask("I")? - 32 >= 32 {
        return Err(error(
            "the switches of D and of all other joints read 1 when they are open, as in the \
             profile mark3. This example is for the profile paper",
        ));
    }

    for (joint, place) in SWITCHES {
        let way = place.signum();
        search(&mut robot, joint, 5 * way, true)?; // quickly, until the switch closes
        search(&mut robot, joint, -5 * way, false)?; // back, until it opens again
        search(&mut robot, joint, way, true)?; // slowly, to find the exact count at which it closes
        println!("{joint} is on its switch, at {place:+}");
    }

    // All switches at once: I reports joints C to F, J reports A and B.
    let i = robot.ask("I")? - 32;
    let j = robot.ask("J")? - 32;
    println!("switches closed: {i} of I, {j} of J");

    // The soft home is at count 0: move each joint back by the count of its switch.
    for (joint, place) in SWITCHES {
        check_arrived(joint, step(&mut robot, joint, -place)?)?;
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
