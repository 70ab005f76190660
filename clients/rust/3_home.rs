// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     build/3_home [HOST [PORT]]

mod robot;
use robot::Robot;
use std::io::Result;

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const SWITCHES: [(char, i32); 6] =
    [('D', 40), ('E', -40), ('C', 40), ('B', -25), ('F', 30), ('A', 16)];

fn is_closed(robot: &mut Robot, joint: char) -> Result<bool> {
    Ok(robot.ask(&format!("{joint}V"))? == 1) // a plain 0 or 1, nothing is added
}

fn step(robot: &mut Robot, joint: char, counts: i32) -> Result<()> {
    robot.send(&format!("{joint}{counts:+}\r"))?;
    robot.wait(joint)?; // asks as in example 2, and stops the joint if it cannot go on
    Ok(())
}

fn main() -> Result<()> {
    let mut robot = Robot::connect()?;

    for (joint, place) in SWITCHES {
        let way = place.signum();
        while !is_closed(&mut robot, joint)? {
            step(&mut robot, joint, 5 * way)?; // quickly, until the switch closes
        }
        while is_closed(&mut robot, joint)? {
            step(&mut robot, joint, -way)?; // back, until it opens again
        }
        while !is_closed(&mut robot, joint)? {
            step(&mut robot, joint, way)?; // slowly: now we know to the count where it closes
        }
        println!("{joint} stands on its switch, at {place:+}");
    }

    // All switches at once: I tells of joints C to F, J of A and B.
    let i = robot.ask("I")? - 32;
    let j = robot.ask("J")? - 32;
    println!("switches closed: {i} of I, {j} of J");

    // From here the soft home is as far away as the switches are from it.
    for (joint, place) in SWITCHES {
        step(&mut robot, joint, -place)?;
    }
    println!("at the soft home");
    Ok(())
}
