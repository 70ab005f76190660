// What the examples 2 to 6 share: the line to the robot, and the few things that one says on it.
// Whatever takes time returns a promise, so that a program reads from top to bottom with `await`.

const net = require("node:net");

const PAUSE_MS = 50; // between two questions

// A joint stands if its counter is the same after so many questions, in 2 seconds. The slowest speed
// is one count a second, and the simulator's clock may run slowly, so be patient.
const STANDS_AFTER = 40;

// Says what is wrong and ends the program.
function giveUp(message) {
  console.error(message);
  process.exit(1);
}

// The end of a program whose joint stands so many counts short of where it was sent.
function giveUpStanding(joint, left) {
  giveUp(
    `${joint} stands, ${left} counts short of where it was sent. Is it blocked at a limit, or ` +
      "stalled? Is a block in the jaws? Does time stand, or run slowly? Look at the page or at " +
      "`xr3 watch`",
  );
}

class Robot {
  // Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost
  // 9600.
  constructor() {
    const host = process.argv[2] || process.env.XR3_HOST || "localhost";
    const port = process.argv[3] || process.env.XR3_PORT || "9600";
    if (!/^\d+$/.test(port) || Number(port) < 1 || Number(port) > 65535) {
      giveUp(`the port has to be a number from 1 to 65535, not '${port}'`);
    }
    // Where the motors are, in counts from the soft home, as far as go() moved them.
    this.at = { F: 0, E: 0, D: 0, C: 0, B: 0, A: 0 };
    this.received = Buffer.alloc(0); // bytes that nobody has read yet
    this.arrived = () => {}; // called when there are more of them
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

  // Sends commands. A move has to end with \r.
  send(text) {
    this.line.write(text);
  }

  // Waits until so many bytes of an answer are there, and returns them.
  async read(count) {
    while (this.received.length < count) {
      await new Promise((resolve) => (this.arrived = resolve));
    }
    const bytes = this.received.subarray(0, count);
    this.received = this.received.subarray(count);
    return bytes;
  }

  // Asks, and returns the byte that answers.
  async ask(inquiry) {
    this.send(inquiry);
    const byte = (await this.read(1))[0];
    if (this.received.length > 0) giveUpStrange(); // more than we asked for
    return byte;
  }

  // How many counts the joint has still to go.
  async toGo(joint) {
    return (await this.ask(joint + "?")) - 32;
  }

  // Between two questions.
  pause() {
    return new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
  }

  // Waits until the joint is there. One that stands, at a limit or with the jaws at a block, is
  // stopped. Returns the counts that were left.
  async wait(joint) {
    let left = await this.toGo(joint);
    let same = 0; // how many answers in a row have been the same
    while (left > 0 && same < STANDS_AFTER) {
      await this.pause();
      const before = left;
      left = await this.toGo(joint);
      same = left === before ? same + 1 : 0;
    }
    if (left > 0) this.send(joint + "X");
    return left;
  }

  // Brings these motors to these counts together, in parts small enough for the error counter.
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

// "E+5": a joint, and a number that always shows its sign.
function move(joint, counts) {
  return joint + (counts < 0 ? "" : "+") + counts;
}

module.exports = { Robot, STANDS_AFTER, giveUp, giveUpStanding, move };
