// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

mod robot;
use robot::{check_arrived, pause, Robot, PAUSE_MS, STANDS_MS};
use std::io::Result;

/// Asks how far there is still to go until nothing is left. Between two questions it does nothing
/// for a while. A joint that is blocked would let us ask forever: we give up after STANDS_MS
/// without a count.
fn wait_for(robot: &mut Robot, joint: char) -> Result<()> {
    let mut left = robot.to_go(joint)?;
    let mut still_ms = 0; // for how long the counter has not changed
    while left > 0 {
        println!("  {left} counts to go");
        pause();
        let before = left;
        left = robot.to_go(joint)?;
        still_ms = if left == before { still_ms + PAUSE_MS } else { 0 };
        if still_ms >= STANDS_MS {
            robot.send(&format!("{joint}X"))?; // forget the rest, or the next move would add to it
            check_arrived(joint, left)?;
        }
    }
    println!("{joint} is there");
    Ok(())
}

fn move_and_wait() -> Result<()> {
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

fn main() {
    if let Err(why) = move_and_wait() {
        eprintln!("{why}"); // robot.rs says in words what went wrong
        std::process::exit(1);
    }
}
