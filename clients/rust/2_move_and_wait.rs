// 2. Move and wait: move a joint and ask until it has arrived.
//
//     build/2_move_and_wait [HOST [PORT]]

mod robot;
use robot::{check_arrived, pause, Robot, STANDS_AFTER};
use std::io::Result;

/// Asks for the remaining counts until none are left, with a pause between two questions. A blocked
/// joint would never finish, so the program gives up after STANDS_AFTER equal answers.
fn wait_for(robot: &mut Robot, joint: char) -> Result<()> {
    let mut left = robot.to_go(joint)?;
    let mut same = 0; // number of equal answers in a row
    while left > 0 {
        println!("  {left} counts to go");
        pause();
        let before = left;
        left = robot.to_go(joint)?;
        same = if left == before { same + 1 } else { 0 };
        if same == STANDS_AFTER {
            robot.send(&format!("{joint}X"))?; // cancel the rest: the next move would add to it
            check_arrived(joint, left)?;
        }
    }
    println!("{joint} is there");
    Ok(())
}

fn move_and_wait() -> Result<()> {
    let mut robot = Robot::connect()?;

    // Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
    // starts to move and does not answer, so the program has to ask.
    println!("E+50");
    robot.send("E+50\r")?;
    wait_for(&mut robot, 'E')?;

    // Move back.
    println!("E-50");
    robot.send("E-50\r")?;
    wait_for(&mut robot, 'E')
}

fn main() {
    if let Err(why) = move_and_wait() {
        eprintln!("{why}"); // robot.rs reports failures with a readable message
        std::process::exit(1);
    }
}
