// 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
// switch that closes at one place of its way. Looking for that place is how a robot finds out.
//
//     node 3_home.js [HOST [PORT]]

const { Robot, move } = require("./robot");

// Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool
// down. The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
const switches = { D: 40, E: -40, C: 40, B: -25, F: 30, A: 16 };

const robot = new Robot();

async function isClosed(joint) {
  return (await robot.ask(joint + "V")) === 1; // a plain 0 or 1, nothing is added
}

async function step(joint, counts) {
  robot.send(move(joint, counts) + "\r");
  await robot.wait(joint); // asks as in example 2, and stops the joint if it cannot go on
}

async function main() {
  for (const [joint, place] of Object.entries(switches)) {
    const way = place > 0 ? 1 : -1;
    while (!(await isClosed(joint))) await step(joint, 5 * way); // quickly, until it closes
    while (await isClosed(joint)) await step(joint, -way); // back, until it opens again
    while (!(await isClosed(joint))) await step(joint, way); // slowly: now we know to the count
    console.log(`${joint} stands on its switch, at ${place > 0 ? "+" : ""}${place}`);
  }

  // All switches at once: I tells of joints C to F, J of A and B.
  const i = (await robot.ask("I")) - 32;
  const j = (await robot.ask("J")) - 32;
  console.log(`switches closed: ${i} of I, ${j} of J`);

  // From here the soft home is as far away as the switches are from it.
  for (const [joint, place] of Object.entries(switches)) await step(joint, -place);
  console.log("at the soft home");

  robot.close();
}

main();
