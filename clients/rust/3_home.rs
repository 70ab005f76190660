// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     build/3_home [HOST [PORT]]

mod robot;
use robot::{check_arrived, error, Robot};
use std::io::Result;

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const SWITCHES: [(char, i32); 6] =
    [('D', 40), ('E', -40), ('C', 40), ('B', -25), ('F', 30), ('A', 16)];

/// No joint has so many counts to go from one end of its way to the other.
const FARTHEST: i32 = 2500;

fn is_closed(robot: &mut Robot, joint: char) -> Result<bool> {
    Ok(robot.ask(&format!("{joint}V"))? == 1) // a plain 0 or 1, nothing is added
}

/// Moves the joint and returns how many counts were left, if it could not go on.
fn step(robot: &mut Robot, joint: char, counts: i32) -> Result<i32> {
    robot.send(&format!("{joint}{counts:+}\r"))?;
    robot.wait(joint) // asks as in example 2, and stops a joint that stands
}

/// Steps of so many counts until the switch is closed, or until it is open.
fn search(robot: &mut Robot, joint: char, counts: i32, closed: bool) -> Result<()> {
    let mut gone = 0;
    while is_closed(robot, joint)? != closed {
        if step(robot, joint, counts)? == counts.abs() {
            return Err(error(&format!(
                "{joint} does not move, and its switch is not found. Is it at a limit, or \
                 stalled? Does time stand? This example is for the Rhino XR-3, in the profile paper"
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

    // A robot may tell of its switches the other way round. I shows it: the highest of its six bits
    // belongs to no switch, and should be 0.
    if robot.ask("I")? - 32 >= 32 {
        return Err(error(
            "the switches of D and of all other joints tell 1 when they are open, as in the \
             profile mark3. This example is for the profile paper",
        ));
    }

    for (joint, place) in SWITCHES {
        let way = place.signum();
        search(&mut robot, joint, 5 * way, true)?; // quickly, until the switch closes
        search(&mut robot, joint, -5 * way, false)?; // back, until it opens again
        search(&mut robot, joint, way, true)?; // slowly: now we know to the count where it closes
        println!("{joint} stands on its switch, at {place:+}");
    }

    // All switches at once: I tells of joints C to F, J of A and B.
    let i = robot.ask("I")? - 32;
    let j = robot.ask("J")? - 32;
    println!("switches closed: {i} of I, {j} of J");

    // From here the soft home is as far away as the switches are from it.
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
