// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

mod robot;
use robot::{pause, Robot};
use std::io::Result;

/// Asks how far there is still to go until nothing is left. Between two questions it does nothing
/// for a while.
fn wait_for(robot: &mut Robot, joint: char) -> Result<()> {
    let mut left = robot.to_go(joint)?;
    while left > 0 {
        println!("  {left} counts to go");
        pause();
        left = robot.to_go(joint)?;
    }
    println!("{joint} is there");
    Ok(())
}

fn main() -> Result<()> {
    let mut robot = Robot::connect()?;

    // The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that
    // the number ends here. It starts to move, and answers nothing: so we ask.
    println!("E+50");
    robot.send("E+50\r")?;
    wait_for(&mut robot, 'E')?;

    // And back again.
    println!("E-50");
    robot.send("E-50\r")?;
    wait_for(&mut robot, 'E')
}
