// What the examples 2 to 6 share: the line to the robot, and the few things that one says on it. It
// knows joints and their counts, but neither millimetres nor the camera.

#![allow(dead_code)] // no example uses all of it

use std::env;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::thread::sleep;
use std::time::Duration;

/// The joints' letters from the base to the jaws.
pub const LETTERS: [char; 6] = ['F', 'E', 'D', 'C', 'B', 'A'];

/// Where the jaws, joint A, have their place in counts.
pub const JAWS: usize = 5;

/// A count for each motor, in the order of LETTERS.
pub type Counts = [i32; 6];

pub struct Robot {
    /// Where the motors are, in counts from the soft home, as far as go() moved them.
    pub at: Counts,
    line: TcpStream,
}

impl Robot {
    /// Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost
    /// 9600.
    pub fn connect() -> Result<Robot> {
        let host = env::args().nth(1).or(env::var("XR3_HOST").ok());
        let port = env::args().nth(2).or(env::var("XR3_PORT").ok());
        let host = host.unwrap_or("localhost".to_string());
        let port = port.unwrap_or("9600".to_string());
        let line = TcpStream::connect(format!("{host}:{port}"))?;
        line.set_nodelay(true)?; // few bytes at a time shall go out at once, not be gathered first
        Ok(Robot { at: [0; 6], line })
    }

    /// Sends commands. A move has to end with \r.
    pub fn send(&mut self, text: &str) -> Result<()> {
        self.line.write_all(text.as_bytes())
    }

    /// Reads exactly so many bytes of an answer.
    pub fn read(&mut self, count: usize) -> Result<Vec<u8>> {
        let mut bytes = vec![0; count];
        self.line.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// Asks, and returns the byte that answers.
    pub fn ask(&mut self, inquiry: &str) -> Result<i32> {
        self.send(inquiry)?;
        Ok(self.read(1)?[0].into())
    }

    /// How many counts the joint has still to go.
    pub fn to_go(&mut self, joint: char) -> Result<i32> {
        Ok(self.ask(&format!("{joint}?"))? - 32)
    }

    /// Waits until the joint is there. One that makes no count between two questions stands, at a
    /// limit or with the jaws at a block, and is stopped. Returns the counts that were left.
    pub fn wait(&mut self, joint: char) -> Result<i32> {
        let mut left = self.to_go(joint)?;
        while left > 0 {
            pause();
            let before = left;
            left = self.to_go(joint)?;
            if left == before {
                self.send(&format!("{joint}X"))?;
                break;
            }
        }
        Ok(left)
    }

    /// Brings all motors to these counts together, in parts small enough for the error counter.
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
                if self.wait(joint)? > 0 {
                    let why = format!("{joint} stands and is not where it was sent");
                    return Err(Error::new(ErrorKind::Other, why));
                }
            }
        }
        Ok(())
    }

    /// Brings the arm to these counts of F, E, D, C and B, and leaves the jaws as they are.
    pub fn go_arm(&mut self, arm: [i32; 5]) -> Result<()> {
        self.go([arm[0], arm[1], arm[2], arm[3], arm[4], self.at[JAWS]])
    }

    /// Brings the jaws to this count, and leaves the arm where it is.
    pub fn go_jaws(&mut self, count: i32) -> Result<()> {
        let mut wanted = self.at;
        wanted[JAWS] = count;
        self.go(wanted)
    }
}

/// Between two questions: time enough for a count at 20 counts a second and more.
pub fn pause() {
    sleep(Duration::from_millis(50));
}
