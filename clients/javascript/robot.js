// What the examples 2 to 6 share: the line to the robot, and the few things that one says on it.
// Whatever takes time returns a promise, so that a program reads from top to bottom with `await`.

const net = require("node:net");

class Robot {
  // Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost
  // 9600.
  constructor() {
    const host = process.argv[2] || process.env.XR3_HOST || "localhost";
    const port = Number(process.argv[3] || process.env.XR3_PORT || 9600);
    // Where the motors are, in counts from the soft home, as far as go() moved them.
    this.at = { F: 0, E: 0, D: 0, C: 0, B: 0, A: 0 };
    this.received = Buffer.alloc(0); // bytes that nobody has read yet
    this.arrived = () => {}; // called when there are more of them
    this.line = net.connect({ host, port, noDelay: true, autoSelectFamily: true });
    this.line.on("data", (bytes) => {
      this.received = Buffer.concat([this.received, bytes]);
      this.arrived();
    });
    this.line.on("error", (error) => {
      console.error(`no robot at ${host} port ${port}: ${error.code}`);
      process.exit(1);
    });
    this.line.on("close", () => {
      if (!this.closing) {
        console.error("the robot has closed the line");
        process.exit(1);
      }
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
    return (await this.read(1))[0];
  }

  // How many counts the joint has still to go.
  async toGo(joint) {
    return (await this.ask(joint + "?")) - 32;
  }

  // Between two questions: time enough for a count at 20 counts a second and more.
  pause() {
    return new Promise((resolve) => setTimeout(resolve, 50));
  }

  // Waits until the joint is there. One that makes no count between two questions stands, at a
  // limit or with the jaws at a block, and is stopped. Returns the counts that were left.
  async wait(joint) {
    let left = await this.toGo(joint);
    while (left > 0) {
      await this.pause();
      const before = left;
      left = await this.toGo(joint);
      if (left === before) {
        this.send(joint + "X");
        break;
      }
    }
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
        if ((await this.wait(joint)) > 0) throw new Error(`${joint} stands and is not there`);
      }
    }
  }

  close() {
    this.closing = true;
    this.line.end();
  }
}

// "E+5": a joint, and a number that always shows its sign.
function move(joint, counts) {
  return joint + (counts < 0 ? "" : "+") + counts;
}

module.exports = { Robot, move };
