// 4. Two joints at once, with speeds: base and shoulder start together and arrive together.
//
//     node 4_two_joints.js [HOST [PORT]]

const { Robot } = require("./robot");

const robot = new Robot();

async function main() {
  // A number with an S behind it is a speed, in counts a second. E has twice as far to go as F,
  // so it gets twice the speed.
  robot.send("F40S E80S\r");
  console.log("F runs at 40 counts a second, E at 80");

  // Each joint has a motor of its own, and the robot does not wait: both run from here on.
  robot.send("F+40 E+80\r");
  console.log("F+40 E+80");

  let f = await robot.toGo("F");
  let e = await robot.toGo("E");
  while (f > 0 || e > 0) {
    console.log(`  F ${f}, E ${e} counts to go`);
    await robot.pause();
    f = await robot.toGo("F");
    e = await robot.toGo("E");
  }
  console.log("both are there");

  // And back again. wait() is example 2 once more, for one joint after the other.
  robot.send("F-40 E-80\r");
  await robot.wait("F");
  await robot.wait("E");
  console.log("both are back");

  robot.close();
}

main();
