// 1. Hello: connect to the robot, ask it two questions, print the answers.
//
//     node 1_hello.js [HOST [PORT]]
//
// A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
// and everything else with silence.

const net = require("node:net");

// Where the robot is: from the arguments, else from the environment, else this machine.
const host = process.argv[2] || process.env.XR3_HOST || "localhost";
const port = process.argv[3] || process.env.XR3_PORT || "9600";
if (!/^\d+$/.test(port) || Number(port) < 1 || Number(port) > 65535) {
  giveUp(`the port has to be a number from 1 to 65535, not '${port}'`);
}

function giveUp(message) {
  console.error(message);
  process.exit(1);
}

// "localhost" may have several addresses: the first one that answers is taken.
const robot = net.connect({ host, port, autoSelectFamily: true });
let question = "E?";

robot.on("connect", () => {
  robot.write(question);
  robot.setTimeout(5000, strange); // a robot answers at once
});

function strange() {
  giveUp("no robot answers like this; is it the monitor port? The robot port is 9600");
}

// Node calls this when bytes have come.
robot.on("data", (bytes) => {
  if (bytes.length !== 1) strange();
  const reply = bytes[0];
  if (question === "E?") {
    // How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
    // blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on.
    console.log(`E? is answered by ${reply}: ${reply - 32} counts to go`);
    question = "I";
    robot.write(question);
  } else {
    // Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
    console.log(`I is answered by ${reply}: switches ${reply - 32}`);
    robot.end();
  }
});

robot.on("error", (error) => {
  giveUp(
    `no robot answers at ${host} port ${port}: is the server running? ./run (${error.code})`,
  );
});
