// 4. Two joints at once, with speeds: base and shoulder start together and arrive together.
//
//     build/4_two_joints [HOST [PORT]]

mod robot;
use robot::{pause, Robot};
use std::io::Result;

fn main() -> Result<()> {
    let mut robot = Robot::connect()?;

    // A number with an S behind it is a speed, in counts a second. E has twice as far to go as F,
    // so it gets twice the speed.
    robot.send("F40S E80S\r")?;
    println!("F runs at 40 counts a second, E at 80");

    // Each joint has a motor of its own, and the robot does not wait: both run from here on.
    robot.send("F+40 E+80\r")?;
    println!("F+40 E+80");

    let mut f = robot.to_go('F')?;
    let mut e = robot.to_go('E')?;
    while f > 0 || e > 0 {
        println!("  F {f}, E {e} counts to go");
        pause();
        f = robot.to_go('F')?;
        e = robot.to_go('E')?;
    }
    println!("both are there");

    // And back again. wait() is example 2 once more, for one joint after the other.
    robot.send("F-40 E-80\r")?;
    robot.wait('F')?;
    robot.wait('E')?;
    println!("both are back");
    Ok(())
}
