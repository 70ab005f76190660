// 4. Two joints at once, with speeds: base and shoulder start together and arrive together.
//
//     node 4_two_joints.js [HOST [PORT]]

const { Robot, STANDS_AFTER, giveUpStanding } = require("./robot");

const robot = new Robot();

async function main() {
  // A number followed by S sets a speed in counts per second. E moves twice as far as F, so it gets
  // twice the speed.
  robot.send("F40S E80S\r");
  console.log("F runs at 40 counts a second, E at 80");

  // Each joint has its own motor, and the robot does not wait: both start now.
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

  // And back again. wait() is the loop of example 2, for one joint after the other.
  robot.send("F-40 E-80\r");
  f = await robot.wait("F");
  e = await robot.wait("E");
  if (f > 0) giveUpStanding("F", f);
  if (e > 0) giveUpStanding("E", e);
  console.log("both are back");

  robot.close();
}

main();
