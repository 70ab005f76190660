// 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
//
//     build/5_pick_and_place [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.

mod robot;
use robot::{Robot, JAWS};
use std::io::Result;

// Motor counts from the soft home for each position of the tool.
// `xr3 kin --pose 262,0,20 --down 90` computes those at the block, whose centre is at x 262, y 0
// and z 20 mm, with a yaw of 90 degrees. "Above" is 100 mm higher. On a real arm one would move
// there manually and note the counts. The order is F, E, D, C, B.
const ABOVE_BLOCK: [i32; 5] = [0, 242, -440, 0, 0];
const AT_BLOCK: [i32; 5] = [0, 449, -625, 0, 0];
const ABOVE_PLACE: [i32; 5] = [0, 483, -238, 0, 288]; // x 400, y 0, not turned
const AT_PLACE: [i32; 5] = [0, 623, -354, 0, 288];
const SHUT: i32 = 64; // count of A at which the jaws are closed

fn pick_and_place() -> Result<()> {
    let mut robot = Robot::connect()?;

    // go_arm() moves all joints to these counts together. A single move is limited to 127 counts,
    // so it sends several and waits after each.
    robot.go_jaws(-16)?;
    println!("the jaws are open");
    robot.go_arm(ABOVE_BLOCK)?;
    println!("above the block");
    robot.go_arm(AT_BLOCK)?;

    // Command the jaws to close much further than the block permits. They stop at the block, and
    // the remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
    // wait() also cancels the remaining counts (AX); otherwise the jaws would keep pressing.
    robot.send("A+90\r")?;
    robot.at[JAWS] += 90 - robot.wait('A')?;
    if robot.at[JAWS] >= SHUT {
        eprintln!(
            "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to have \
             it there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell)"
        );
        robot.go_arm(ABOVE_BLOCK)?; // back to the start position
        robot.go([0; 6])?;
        std::process::exit(1);
    }
    println!("the jaws closed on {:.1} mm", 50.8 - 0.79375 * f64::from(robot.at[JAWS]));

    robot.go_arm(ABOVE_BLOCK)?;
    println!("lifted");
    robot.go_arm(ABOVE_PLACE)?;
    robot.go_arm(AT_PLACE)?;
    println!("at its new place");
    robot.go_jaws(-16)?;
    println!("let go");
    robot.go_arm(ABOVE_PLACE)?;
    robot.go([0; 6])?; // home: all at 0, including the jaws
    println!("back at the start");
    Ok(())
}

fn main() {
    if let Err(why) = pick_and_place() {
        eprintln!("{why}");
        std::process::exit(1);
    }
}
