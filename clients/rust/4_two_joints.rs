// 4. Two joints at once: base and shoulder start together, and the program waits for both.
//
//     build/4_two_joints [HOST [PORT]]

mod robot;
use robot::{check_arrived, pause, Robot, STANDS_AFTER};
use std::io::Result;

fn two_joints() -> Result<()> {
    let mut robot = Robot::connect()?;

    // Each joint has its own motor, and the robot does not wait: both start now.
    // The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
    robot.send("F+40 E+80\r")?;
    println!("F+40 E+80");

    let mut f = robot.to_go('F')?;
    let mut e = robot.to_go('E')?;
    let mut same = 0; // number of equal answers in a row, as in example 2
    while f > 0 || e > 0 {
        println!("  F {f}, E {e} counts to go");
        pause();
        let before = f + e;
        f = robot.to_go('F')?;
        e = robot.to_go('E')?;
        same = if f + e == before { same + 1 } else { 0 };
        if same == STANDS_AFTER {
            robot.send("FX EX")?; // cancel the rest: the next move would add to it
            check_arrived('F', f)?;
            check_arrived('E', e)?;
        }
    }
    println!("both are there");

    // Move back. wait() is the loop of example 2, for one joint after the other.
    robot.send("F-40 E-80\r")?;
    check_arrived('F', robot.wait('F')?)?;
    check_arrived('E', robot.wait('E')?)?;
    println!("both are back");
    Ok(())
}

fn main() {
    if let Err(why) = two_joints() {
        eprintln!("{why}");
        std::process::exit(1);
    }
}
