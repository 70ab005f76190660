// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     node 3_home.js [HOST [PORT]]

const { Robot, giveUp, giveUpStanding, move } = require("./robot");

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
const switches = { D: 40, E: -40, C: 40, B: -25, F: 30, A: 16 };
const FARTHEST = 2500; // more counts than the full travel of any joint

const robot = new Robot();

async function isClosed(joint) {
  return (await robot.ask(joint + "V")) === 1; // 0 or 1, without the 32
}

// Moves the joint and returns the counts that were left, 0 if it has arrived.
async function step(joint, counts) {
  robot.send(move(joint, counts) + "\r");
  return await robot.wait(joint); // as in example 2; cancels the move of a blocked joint
}

// Moves in steps of `counts` until the switch is closed (true) or open (false).
async function search(joint, counts, closed) {
  let gone = 0;
  while ((await isClosed(joint)) !== closed) {
    const left = await step(joint, counts);
    gone += Math.abs(counts) - left;
    if (left === Math.abs(counts) || gone > FARTHEST) {
      giveUp(
        `${joint} went ${gone} counts and found no switch. Is it blocked at a limit, or stalled? ` +
          "Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its own " +
          "workcell, in the profile paper)",
      );
    }
  }
}

async function main() {
  // Some controllers report their switches inverted. The answer to I shows it: the highest of its
  // six bits belongs to no switch and should be 0.
  if ((await robot.ask("I")) - 32 >= 32) {
    giveUp(
      "the switches of D and of all other joints read 1 when they are open, as in the profile " +
        "mark3. This example is for the profile paper",
    );
  }

  for (const [joint, place] of Object.entries(switches)) {
    const way = place > 0 ? 1 : -1;
    await search(joint, 5 * way, true); // quickly, until the switch closes
    await search(joint, -5 * way, false); // back, until it opens again
    await search(joint, way, true); // slowly, to find the exact count at which it closes
    console.log(`${joint} is on its switch, at ${place > 0 ? "+" : ""}${place}`);
  }

  // All switches at once: I reports joints C to F, J reports A and B.
  const i = (await robot.ask("I")) - 32;
  const j = (await robot.ask("J")) - 32;
  console.log(`switches closed: ${i} of I, ${j} of J`);

  // The soft home is at count 0: move each joint back by the count of its switch.
  for (const [joint, place] of Object.entries(switches)) {
    const left = await step(joint, -place);
    if (left > 0) giveUpStanding(joint, left);
  }
  console.log("at the soft home");

  robot.close();
}

main();
