// 4. Two joints at once: base and shoulder start together, and the program waits for both.
//
//     node 4_two_joints.js [HOST [PORT]]

const { Robot, STANDS_AFTER, giveUpStanding } = require("./robot");

const robot = new Robot();

async function main() {
  // Each joint has its own motor, and the robot does not wait: both start now.
  // The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
  robot.send("F+40 E+80\r");
  console.log("F+40 E+80");

  let f = await robot.toGo("F");
  let e = await robot.toGo("E");
  let same = 0; // number of equal answers in a row, as in example 2
  while (f > 0 || e > 0) {
    console.log(`  F ${f}, E ${e} counts to go`);
    await robot.pause();
    const before = f + e;
    f = await robot.toGo("F");
    e = await robot.toGo("E");
    same = f + e === before ? same + 1 : 0;
    if (same === STANDS_AFTER) {
      robot.send("FX EX"); // cancels the rest of the moves
      break;
    }
  }
  if (f > 0) giveUpStanding("F", f);
  if (e > 0) giveUpStanding("E", e);
  console.log("both are there");

  // Move back. wait() is the loop of example 2, for one joint after the other.
  robot.send("F-40 E-80\r");
  f = await robot.wait("F");
  e = await robot.wait("E");
  if (f > 0) giveUpStanding("F", f);
  if (e > 0) giveUpStanding("E", e);
  console.log("both are back");

  robot.close();
}

main();
