// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     node 1_hello.js [HOST [PORT]]
//
// The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
// with one byte and does not answer other commands.

const net = require("node:net");

// Host and port: from the arguments, else from the environment, else the defaults.
const host = process.argv[2] || process.env.XR3_HOST || "localhost";
const port = process.argv[3] || process.env.XR3_PORT || "9600";
if (!/^\d+$/.test(port) || Number(port) < 1 || Number(port) > 65535) {
  giveUp(`the port has to be a number from 1 to 65535, not '${port}'`);
}

function giveUp(message) {
  console.error(message);
  process.exit(1);
}

// "localhost" may have several addresses: use the first one that accepts a connection.
const robot = net.connect({ host, port, autoSelectFamily: true });
let question = "E?";

robot.on("connect", () => {
  robot.write(question);
  robot.setTimeout(5000, wrongReply); // a robot answers at once
});

function wrongReply() {
  giveUp("no robot answers like this; is it the monitor port? The robot port is 9600");
}

// Node calls this when bytes have arrived.
robot.on("data", (bytes) => {
  if (bytes.length !== 1) wrongReply();
  const reply = bytes[0];
  if (question === "E?") {
    // Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is
    // added to the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so
    // on.
    console.log(`E? is answered by ${reply}: ${reply - 32} counts to go`);
    question = "I";
    robot.write(question);
  } else {
    // Which microswitches are closed? Again 32 is added; each switch has one bit.
    console.log(`I is answered by ${reply}: switches ${reply - 32}`);
    robot.end();
  }
});

robot.on("error", (error) => {
  giveUp(
    `no robot answers at ${host} port ${port}: is the server running? ./run (${error.code})`,
  );
});
