// 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
// switch that closes at a known position. Searching for it tells where the joint is.
//
//     node 3_home.js [HOST [PORT]]

const { Robot, giveUp, giveUpStanding, move } = require("./robot");

// Counts at which the switches close, from the soft home: upper arm upright, forearm level, tool
// down. Seen from there each is open before this count, and closed from it on: for a few dozen
// counts on a real arm, for longer in the simulator. The jaws, joint A, come first: they show how a
// closed switch reads. The elbow follows, since it lifts the hand off the table.
const switches = { A: -16, D: 40, E: -40, C: 40, B: -25, F: 30 };

// One byte reports several switches: I those of joints C to F, J those of A and B. Each has one
// bit.
const bits = { D: ["I", 2], E: ["I", 4], C: ["I", 1], B: ["J", 32], F: ["I", 8], A: ["J", 16] };

const STEP = 10; // counts of one move of the search; a switch stays closed for longer
const FAR = 1600; // more counts than any joint has from a limit to its switch
const LEAN = 400; // counts forward that bring the shoulder out of its backmost position

const robot = new Robot();
let closed; // the reading of a closed switch, 0 or 1

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

// Moves until the switch closes, usually away from the soft home first. Returns false if it does
// not close.
async function search(joint, away) {
  if (joint === "E") {
    // Forwards first: a shoulder that leans back folds the arm into its base.
    return (await changes("E", STEP, LEAN)) || (await changes("E", -STEP, 2 * FAR));
  }
  if (await changes(joint, STEP * away, FAR)) return true;
  // The shoulder may lean far back: it must not when the forearm comes down.
  if (joint === "D") await changes("E", STEP, LEAN);
  return await changes(joint, -STEP * away, 2 * FAR);
}

// Moves to the count at which the switch closes. Returns false if the switch does not change.
async function findNearEdge(joint) {
  const away = Math.sign(switches[joint]);
  if ((await readSwitch(joint)) !== closed && !(await search(joint, away))) return false;
  // Back until the switch opens, and then count by count until it closes.
  return (await changes(joint, -STEP * away, FAR)) && (await changes(joint, away, FAR));
}

async function main() {
  // The open jaws are at the end of their travel, and on their switch. It opens when they close.
  await changes("A", -STEP, FAR);
  closed = await readSwitch("A");

  // A shoulder on its switch may lean far back: it comes forward before the forearm moves.
  if ((await readSwitch("E")) === closed) await findNearEdge("E");

  for (const [joint, place] of Object.entries(switches)) {
    if (!(await findNearEdge(joint))) {
      giveUp(
        `the switch of ${joint} does not change. Is the joint blocked at a limit, or the arm ` +
          "stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its " +
          "own workcell)",
      );
    }
    console.log(`${joint} is on its switch, at ${place > 0 ? "+" : ""}${place}`);
  }

  // All switches at once. J also reports four input lines, in its bits 1 to 8.
  const i = (await robot.ask("I")) - 32;
  const j = ((await robot.ask("J")) - 32) & 48;
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
