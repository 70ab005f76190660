// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     build/1_hello [HOST [PORT]]
//
// The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
// with one byte and does not answer other commands.

use std::env;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;

/// An error with a readable message.
fn error(why: &str) -> Error {
    Error::new(ErrorKind::Other, why)
}

/// An environment variable; an empty one counts as not set.
fn setting(name: &str) -> Option<String> {
    env::var(name).ok().filter(|value| !value.is_empty())
}

/// Connects to the robot; errors have a readable message.
fn connect(host: &str, port: &str) -> Result<TcpStream> {
    let number: u16 = port.parse().map_err(|_| {
        error(&format!("the port has to be a number from 1 to 65535, not '{port}'"))
    })?;
    TcpStream::connect((host, number)).map_err(|_| {
        error(&format!("no robot answers at {host} port {port}: is the server running? ./run"))
    })
}

/// Sends a question and returns the one-byte answer.
fn ask(robot: &mut TcpStream, question: &str) -> Result<i32> {
    robot.write_all(question.as_bytes())?;
    let mut reply = [0; 100];
    match robot.read(&mut reply)? {
        0 => Err(error("the robot has closed the line")),
        1 => Ok(reply[0].into()),
        _ => {
            Err(error("no robot answers like this; is it the monitor port? The robot port is 9600"))
        }
    }
}

fn hello() -> Result<()> {
    // Host and port: from the arguments, else from the environment, else the defaults.
    let host = env::args().nth(1).or(setting("XR3_HOST"));
    let port = env::args().nth(2).or(setting("XR3_PORT"));
    let host = host.unwrap_or("localhost".to_string());
    let port = port.unwrap_or("9600".to_string());
    let mut robot = connect(&host, &port)?;

    // Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is
    // added to the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so
    // on.
    let reply = ask(&mut robot, "E?")?;
    println!("E? is answered by {}: {} counts to go", reply, reply - 32);

    // Which microswitches are closed? Again 32 is added; each switch has one bit.
    let reply = ask(&mut robot, "I")?;
    println!("I is answered by {}: switches {}", reply, reply - 32);

    Ok(())
}

fn main() {
    if let Err(why) = hello() {
        eprintln!("{why}"); // no robot, or connection lost
        std::process::exit(1);
    }
}
