// 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
//
//     node 5_pick_and_place.js [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.js.

const { Robot, giveUp } = require("./robot");

// Motor counts from the soft home for each position of the tool.
// `xr3 kin --pose 262,0,20 --down 90` computes those at the block, whose centre is at x 262, y 0
// and z 20 mm, with a yaw of 90 degrees. "Above" is 100 mm higher. On a real arm one would move
// there manually and note the counts.
const aboveBlock = { F: 0, E: 242, D: -440, C: 0, B: 0 };
const atBlock = { F: 0, E: 449, D: -625, C: 0, B: 0 };
const abovePlace = { F: 0, E: 483, D: -238, C: 0, B: 288 }; // x 400, y 0, not turned
const atPlace = { F: 0, E: 623, D: -354, C: 0, B: 288 };
const home = { F: 0, E: 0, D: 0, C: 0, B: 0, A: 0 };
const SHUT = 64; // count of A at which the jaws are closed

const robot = new Robot();

async function main() {
  // robot.go() moves all joints to these counts together. A single move is limited to 127 counts,
  // so go() sends several and waits after each.
  await robot.go({ A: -16 });
  console.log("the jaws are open");
  await robot.go(aboveBlock);
  console.log("above the block");
  await robot.go(atBlock);

  // Command the jaws to close much further than the block permits. They stop at the block, and the
  // remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
  // wait() also cancels the remaining counts (AX); otherwise the jaws would keep pressing.
  robot.send("A+90\r");
  robot.at.A += 90 - (await robot.wait("A"));
  if (robot.at.A >= SHUT) {
    await robot.go(aboveBlock); // back to the start position
    await robot.go(home);
    giveUp(
      "the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to have it " +
        "there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell)",
    );
  }
  console.log(`the jaws closed on ${(50.8 - 0.79375 * robot.at.A).toFixed(1)} mm`);

  await robot.go(aboveBlock);
  console.log("lifted");
  await robot.go(abovePlace);
  await robot.go(atPlace);
  console.log("at its new place");
  await robot.go({ A: -16 });
  console.log("let go");
  await robot.go(abovePlace);
  await robot.go(home);
  console.log("back at the start");

  robot.close();
}

main();
