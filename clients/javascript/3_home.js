// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     node 3_home.js [HOST [PORT]]

const { Robot, giveUp, giveUpStanding, move } = require("./robot");

// Where the switches close, in counts from the soft home: upper arm upright, forearm level, tool
// down. Seen from there each is open before this count, and closed from it on: for a few dozen
// counts on a real arm, for longer in the simulator. The elbow comes first, since it lifts the hand
// off the table; the jaws, joint A, come last.
const switches = { D: 40, E: -40, C: 40, B: -25, F: 30, A: 16 };

// One byte reports several switches: I those of joints C to F, J those of A and B. Each has one
// bit.
const bits = { D: ["I", 2], E: ["I", 4], C: ["I", 1], B: ["J", 2], F: ["I", 8], A: ["J", 1] };

const STEP = 10; // counts of one move of the search; a switch stays closed for longer
const WIDEST = 100; // more counts than a switch of a real arm stays closed
const FAR = 1600; // more counts than any joint has from a limit to its switch

// How far to search away from the soft home before trying the other direction. The shoulder must
// not lean far back, or the hand hits the base.
const REACH = { D: FAR, E: 60, C: FAR, B: FAR, F: FAR, A: FAR };

const robot = new Robot();
let closed; // what a closed switch reads, 0 or 1: not known until the first one has changed

// The bit of the joint's switch. Some controllers report a closed switch as 1, others as 0.
async function readSwitch(joint) {
  const [inquiry, bit] = bits[joint];
  return ((await robot.ask(inquiry)) - 32) & bit ? 1 : 0;
}

// Moves the joint and returns the counts that were left, 0 if it has arrived.
async function step(joint, counts) {
  robot.send(move(joint, counts) + "\r");
  return await robot.wait(joint); // as in example 2; cancels the move of a blocked joint
}

// Moves in steps of `counts` until the switch changes. Returns false if it does not within
// `farthest` counts, or before the joint is blocked.
async function changes(joint, counts, farthest) {
  const before = await readSwitch(joint);
  for (let gone = 0; gone < farthest; gone += Math.abs(counts)) {
    const left = await step(joint, counts);
    if ((await readSwitch(joint)) !== before) return true;
    if (left > 0) return false;
  }
  return false;
}

// Moves to the count at which the switch closes. Returns false if the switch does not change.
async function findNearEdge(joint, away) {
  // Watch the switch change, at whichever edge: first in one direction, then in the other. If it
  // reads like the closed ones before, the near edge lies towards the soft home.
  const isClosed = (await readSwitch(joint)) === closed;
  const way = isClosed ? -away : away;
  const reach = isClosed ? FAR : REACH[joint];
  const seen =
    (await changes(joint, STEP * way, reach)) ||
    (await changes(joint, -STEP * way, 2 * FAR)) ||
    (await changes(joint, STEP * way, 2 * FAR));
  if (!seen) return false;

  // Move towards the soft home until the switch has not changed for a long way: now it is open.
  while (await changes(joint, -STEP * away, WIDEST));

  // Quickly up to the near edge, back again, and then count by count.
  return (
    (await changes(joint, STEP * away, FAR)) &&
    (await changes(joint, -STEP * away, FAR)) &&
    (await changes(joint, away, FAR))
  );
}

async function main() {
  for (const [joint, place] of Object.entries(switches)) {
    if (!(await findNearEdge(joint, Math.sign(place)))) {
      giveUp(
        `the switch of ${joint} does not change. Is the joint blocked at a limit, or the arm ` +
          "stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its " +
          "own workcell)",
      );
    }
    closed = await readSwitch(joint);
    console.log(`${joint} is on its switch, at ${place > 0 ? "+" : ""}${place}`);
  }

  // All switches at once. J also reports four input lines, in its bits 4 to 32.
  const i = (await robot.ask("I")) - 32;
  const j = ((await robot.ask("J")) - 32) & 3;
  console.log(`a closed switch reads ${closed}; the switches of I are ${i}, those of J ${j}`);

  // The soft home is at count 0: move each joint back by the count of its switch.
  for (const [joint, place] of Object.entries(switches)) {
    const left = await step(joint, -place);
    if (left > 0) giveUpStanding(joint, left);
  }
  console.log("at the soft home");

  robot.close();
}

main();
