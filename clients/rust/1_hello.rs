// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     build/1_hello [HOST [PORT]]
//
// A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
// and everything else with silence.

use std::env;
use std::io::{Read, Result, Write};
use std::net::TcpStream;

fn main() -> Result<()> {
    // Where the robot is: from the arguments, else from the environment, else this machine.
    let host = env::args().nth(1).or(env::var("XR3_HOST").ok());
    let port = env::args().nth(2).or(env::var("XR3_PORT").ok());
    let host = host.unwrap_or("localhost".to_string());
    let port = port.unwrap_or("9600".to_string());
    let mut robot = TcpStream::connect(format!("{host}:{port}"))?;

    // How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
    // blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on.
    let mut reply = [0u8];
    robot.write_all(b"E?")?;
    robot.read_exact(&mut reply)?;
    println!("E? is answered by {}: {} counts to go", reply[0], reply[0] - 32);

    // Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
    robot.write_all(b"I")?;
    robot.read_exact(&mut reply)?;
    println!("I is answered by {}: switches {}", reply[0], reply[0] - 32);

    Ok(())
}
