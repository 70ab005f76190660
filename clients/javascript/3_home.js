// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     node 3_home.js [HOST [PORT]]

const { Robot, giveUp, giveUpStanding, move } = require("./robot");

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const switches = { D: 40, E: -40, C: 40, B: -25, F: 30, A: 16 };
const FARTHEST = 2500; // no joint has so many counts to go from one end of its way to the other

const robot = new Robot();

async function isClosed(joint) {
  return (await robot.ask(joint + "V")) === 1; // a plain 0 or 1, nothing is added
}

// Moves the joint and returns how many counts were left, if it could not go on.
async function step(joint, counts) {
  robot.send(move(joint, counts) + "\r");
  return await robot.wait(joint); // asks as in example 2, and stops a joint that stands
}

// Steps of so many counts until the switch is as wanted: closed, or open.
async function search(joint, counts, closed) {
  let gone = 0;
  while ((await isClosed(joint)) !== closed) {
    const left = await step(joint, counts);
    gone += Math.abs(counts) - left;
    if (left === Math.abs(counts) || gone > FARTHEST) {
      giveUp(
        `${joint} went ${gone} counts and found no switch. Is it blocked at a limit, or stalled? ` +
          "Does time stand? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell, in " +
          "the profile paper)",
      );
    }
  }
}

async function main() {
  // A robot may tell of its switches the other way round. I shows it: the highest of its six bits
  // belongs to no switch, and should be 0.
  if ((await robot.ask("I")) - 32 >= 32) {
    giveUp(
      "the switches of D and of all other joints tell 1 when they are open, as in the profile " +
        "mark3. This example is for the profile paper",
    );
  }

  for (const [joint, place] of Object.entries(switches)) {
    const way = place > 0 ? 1 : -1;
    await search(joint, 5 * way, true); // quickly, until the switch closes
    await search(joint, -5 * way, false); // back, until it opens again
    await search(joint, way, true); // slowly: now we know to the count where it closes
    console.log(`${joint} stands on its switch, at ${place > 0 ? "+" : ""}${place}`);
  }

  // All switches at once: I tells of joints C to F, J of A and B.
  const i = (await robot.ask("I")) - 32;
  const j = (await robot.ask("J")) - 32;
  console.log(`switches closed: ${i} of I, ${j} of J`);

  // From here the soft home is as far away as the switches are from it.
  for (const [joint, place] of Object.entries(switches)) {
    const left = await step(joint, -place);
    if (left > 0) giveUpStanding(joint, left);
  }
  console.log("at the soft home");

  robot.close();
}

main();
