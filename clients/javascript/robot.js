// Shared by examples 2 to 6: the connection to the robot and its basic commands. Functions that
// take time return a promise, to be used with `await`.

const net = require("node:net");

const PAUSE_MS = Number(process.env.XR3_POLL_MS || 50); // between two questions

// A joint counts as stopped if its counter is the same after this many questions, over 2 seconds.
// The slowest speed is one count per second, and the simulator's clock may run slowly, hence the
// long wait.
const STANDS_AFTER = 40;

// Prints a message and ends the program.
function giveUp(message) {
  console.error(message);
  process.exit(1);
}

// Ends the program because a joint has stopped `left` counts short of its target.
function giveUpStanding(joint, left) {
  giveUp(
    `${joint} stopped ${left} counts short of its target. Is it blocked at a limit, or stalled? ` +
      "Is a block in the jaws? Is the clock paused or slow? Look at the page or at `xr3 watch`",
  );
}

class Robot {
  // Connects to HOST and PORT from the arguments, else XR3_HOST and XR3_PORT, else localhost 9600.
  constructor() {
    const host = process.argv[2] || process.env.XR3_HOST || "localhost";
    const port = process.argv[3] || process.env.XR3_PORT || "9600";
    if (!/^\d+$/.test(port) || Number(port) < 1 || Number(port) > 65535) {
      giveUp(`the port has to be a number from 1 to 65535, not '${port}'`);
    }
    // Motor positions in counts from the soft home, as tracked by go().
    this.at = { F: 0, E: 0, D: 0, C: 0, B: 0, A: 0 };
    this.received = Buffer.alloc(0); // received bytes that are not read yet
    this.arrived = () => {}; // called when more bytes arrive
    this.line = net.connect({ host, port, noDelay: true, autoSelectFamily: true });
    this.line.on("data", (bytes) => {
      this.received = Buffer.concat([this.received, bytes]);
      this.arrived();
    });
    this.line.on("connect", () => {
      this.line.setTimeout(5000, giveUpStrange); // a robot answers at once
    });
    this.line.on("error", (error) => {
      giveUp(
        `no robot answers at ${host} port ${port}: is the server running? ./run (${error.code})`,
      );
    });
    this.line.on("close", () => {
      if (!this.closing) giveUp("the robot has closed the line");
    });
  }

  // Sends commands. A move must end with \r.
  send(text) {
    this.line.write(text);
  }

  // Reads exactly `count` bytes of an answer.
  async read(count) {
    while (this.received.length < count) {
      await new Promise((resolve) => (this.arrived = resolve));
    }
    const bytes = this.received.subarray(0, count);
    this.received = this.received.subarray(count);
    return bytes;
  }

  // Sends an inquiry and returns the one-byte answer.
  async ask(inquiry) {
    this.send(inquiry);
    const byte = (await this.read(1))[0];
    if (this.received.length > 0) giveUpStrange(); // more than we asked for
    return byte;
  }

  // The counts that the joint still has to go. A Mark III answers with seven bits: for more than
  // 95 counts the answer is wrong there, so no move of these programs is longer.
  async toGo(joint) {
    return (await this.ask(joint + "?")) - 32;
  }

  // Pauses between two questions.
  pause() {
    return new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
  }

  // Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels
  // its move. Returns the counts that were left.
  async wait(joint) {
    let left = await this.toGo(joint);
    let same = 0; // number of equal answers in a row
    while (left > 0 && same < STANDS_AFTER) {
      await this.pause();
      const before = left;
      left = await this.toGo(joint);
      same = left === before ? same + 1 : 0;
    }
    if (left > 0) this.send(joint + "X");
    return left;
  }

  // Moves these motors to these counts together, in parts small enough for the error counter.
  async go(wanted) {
    const start = { ...this.at };
    const joints = Object.keys(wanted);
    const longest = Math.max(...joints.map((joint) => Math.abs(wanted[joint] - start[joint])));
    const parts = Math.ceil(longest / 60); // no move is longer than 60 counts
    for (let part = 1; part <= parts; part++) {
      for (const joint of joints) {
        const next = start[joint] + Math.round(((wanted[joint] - start[joint]) * part) / parts);
        if (next !== this.at[joint]) this.send(move(joint, next - this.at[joint]) + "\r");
        this.at[joint] = next;
      }
      for (const joint of joints) {
        const left = await this.wait(joint);
        if (left > 0) giveUpStanding(joint, left);
      }
    }
  }

  close() {
    this.closing = true;
    this.line.end();
  }
}

function giveUpStrange() {
  giveUp("no robot answers like this; is it the monitor port? The robot port is 9600");
}

// A move command such as "E+5": the joint and a number with explicit sign.
function move(joint, counts) {
  return joint + (counts < 0 ? "" : "+") + counts;
}

module.exports = { Robot, STANDS_AFTER, giveUp, giveUpStanding, move };
