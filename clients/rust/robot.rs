// Shared by examples 2 to 6: the connection to the robot and its basic commands. It handles joints
// and counts, but not millimetres or the camera.

#![allow(dead_code)] // no example uses all of it

use std::env;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::thread::sleep;
use std::time::Duration;

/// The joints' letters from the base to the jaws.
pub const LETTERS: [char; 6] = ['F', 'E', 'D', 'C', 'B', 'A'];

/// The index of the jaws, joint A, in Counts.
pub const JAWS: usize = 5;

/// A count for each motor, in the order of LETTERS.
pub type Counts = [i32; 6];

/// A joint counts as stopped if its counter is the same after this many questions, over 2 seconds.
/// The slowest speed is one count per second, and the simulator's clock may run slowly, hence the
/// long wait.
pub const STANDS_AFTER: i32 = 40;

const CLOSED: &str = "the robot has closed the line";

pub struct Robot {
    /// Motor positions in counts from the soft home, as tracked by go().
    pub at: Counts,
    line: TcpStream,
}

impl Robot {
    /// Connects to HOST and PORT from the arguments, else XR3_HOST and XR3_PORT, else localhost
    /// 9600. Like all functions here, returns an error with a readable message on failure.
    pub fn connect() -> Result<Robot> {
        let host = env::args().nth(1).or(setting("XR3_HOST"));
        let port = env::args().nth(2).or(setting("XR3_PORT"));
        let host = host.unwrap_or("localhost".to_string());
        let port = port.unwrap_or("9600".to_string());
        let number: u16 = port.parse().map_err(|_| {
            error(&format!("the port has to be a number from 1 to 65535, not '{port}'"))
        })?;
        let line = TcpStream::connect((host.as_str(), number)).map_err(|_| {
            error(&format!("no robot answers at {host} port {port}: is the server running? ./run"))
        })?;
        line.set_nodelay(true)?; // send small messages at once
        Ok(Robot { at: [0; 6], line })
    }

    /// Sends commands. A move must end with \r.
    pub fn send(&mut self, text: &str) -> Result<()> {
        self.line.write_all(text.as_bytes()).map_err(|_| error(CLOSED))
    }

    /// Reads exactly `count` bytes of an answer.
    pub fn read(&mut self, count: usize) -> Result<Vec<u8>> {
        let mut bytes = vec![0; count];
        self.line.read_exact(&mut bytes).map_err(|_| error(CLOSED))?;
        Ok(bytes)
    }

    /// Sends an inquiry and returns the one-byte answer.
    pub fn ask(&mut self, inquiry: &str) -> Result<i32> {
        self.send(inquiry)?;
        let mut reply = [0; 100];
        match self.line.read(&mut reply) {
            Ok(1) => Ok(reply[0].into()),
            Ok(0) | Err(_) => Err(error(CLOSED)),
            Ok(_) => Err(error(
                "no robot answers like this; is it the monitor port? The robot port is 9600",
            )),
        }
    }

    /// The counts that the joint still has to go. A Mark III answers with seven bits: for more than
    /// 95 counts the answer is wrong there, so no move of these programs is longer.
    pub fn to_go(&mut self, joint: char) -> Result<i32> {
        Ok(self.ask(&format!("{joint}?"))? - 32)
    }

    /// Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels
    /// its move. Returns the counts that were left.
    pub fn wait(&mut self, joint: char) -> Result<i32> {
        let mut left = self.to_go(joint)?;
        let mut same = 0; // number of equal answers in a row
        while left > 0 && same < STANDS_AFTER {
            pause();
            let before = left;
            left = self.to_go(joint)?;
            same = if left == before { same + 1 } else { 0 };
        }
        if left > 0 {
            self.send(&format!("{joint}X"))?;
        }
        Ok(left)
    }

    /// Moves all motors to these counts together, in parts small enough for the error counter.
    pub fn go(&mut self, wanted: Counts) -> Result<()> {
        let start = self.at;
        let mut longest = 0;
        for j in 0..6 {
            longest = longest.max((wanted[j] - start[j]).abs());
        }
        let parts = (longest + 59) / 60; // no move is longer than 60 counts
        for part in 1..=parts {
            for j in 0..6 {
                let next = start[j] + (wanted[j] - start[j]) * part / parts;
                if next != self.at[j] {
                    self.send(&format!("{}{:+}\r", LETTERS[j], next - self.at[j]))?;
                }
                self.at[j] = next;
            }
            for joint in LETTERS {
                check_arrived(joint, self.wait(joint)?)?;
            }
        }
        Ok(())
    }

    /// Moves the arm to these counts of F, E, D, C and B, and leaves the jaws as they are.
    pub fn go_arm(&mut self, arm: [i32; 5]) -> Result<()> {
        self.go([arm[0], arm[1], arm[2], arm[3], arm[4], self.at[JAWS]])
    }

    /// Moves the jaws to this count, and leaves the arm where it is.
    pub fn go_jaws(&mut self, count: i32) -> Result<()> {
        let mut wanted = self.at;
        wanted[JAWS] = count;
        self.go(wanted)
    }
}

/// Pauses between two questions: 50 ms, or XR3_POLL_MS.
pub fn pause() {
    let milliseconds = setting("XR3_POLL_MS").and_then(|value| value.parse().ok());
    sleep(Duration::from_millis(milliseconds.unwrap_or(50)));
}

/// Returns an error if counts are left; the message has the joint and possible reasons.
pub fn check_arrived(joint: char, left: i32) -> Result<()> {
    if left <= 0 {
        return Ok(());
    }
    Err(error(&format!(
        "{joint} stopped {left} counts short of its target. Is it blocked at a limit, or stalled? \
         Is a block in the jaws? Is the clock paused or slow? Look at the page or at `xr3 watch`"
    )))
}

/// An error with a readable message.
pub fn error(why: &str) -> Error {
    Error::new(ErrorKind::Other, why)
}

/// An environment variable; an empty one counts as not set.
fn setting(name: &str) -> Option<String> {
    env::var(name).ok().filter(|value| !value.is_empty())
}
