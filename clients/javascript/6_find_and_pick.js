// 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
// down elsewhere, and look again.
//
//     node 6_find_and_pick.js [HOST [PORT]]
//
// The arm must be at its soft home, as when the simulator starts or after 3_home.js.

const { Robot, giveUp } = require("./robot");

const DEGREES = 180 / Math.PI;

// The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
// of 2 mm. Each byte of the picture has six pixels.
const PIXELS = 192;
const ROW_BYTES = PIXELS / 6;

const OPEN = -16; // count of A with open jaws
const SHUT = 64; // count of A with closed jaws
const Z = 20; // height of the largest block's centre, mm
const ABOVE = 100; // height above it for approach and departure, mm
const HOME = { F: 0, E: 0, D: 0, C: 0, B: 0, A: 0 };

const robot = new Robot();

// Requests the picture and returns its rows from the top, true where the camera sees a block. The
// leftmost of six pixels is the highest bit, and 32 is added to each byte.
async function look() {
  robot.send("A**");
  const bytes = await robot.read(PIXELS * ROW_BYTES);
  const picture = [];
  for (let row = 0; row < PIXELS; row++) {
    picture.push([]);
    for (let column = 0; column < PIXELS; column++) {
      const six = bytes[row * ROW_BYTES + Math.floor(column / 6)] - 32;
      picture[row].push(((six >> (5 - (column % 6))) & 1) === 1);
    }
  }
  return picture;
}

// Removes this pixel and all pixels connected to it from the picture, so that none is counted
// twice, and adds their positions on the table, in mm, to the patch.
function collect(picture, row, column, patch) {
  if (row < 0 || row >= PIXELS || column < 0 || column >= PIXELS) return;
  if (!picture[row][column]) return;
  picture[row][column] = false;
  patch.push({ x: 290 - 192 + 2 * (column + 0.5), y: 0 + 192 - 2 * (row + 0.5) });
  collect(picture, row, column + 1, patch);
  collect(picture, row, column - 1, patch);
  collect(picture, row + 1, column, patch);
  collect(picture, row - 1, column, patch);
}

// The centre of a patch is the average of its pixels. The long side has the direction of their
// largest spread, the principal axis of inertia.
function measure(patch) {
  let x = 0;
  let y = 0;
  for (const pixel of patch) {
    x += pixel.x / patch.length;
    y += pixel.y / patch.length;
  }
  let xx = 0;
  let yy = 0;
  let xy = 0;
  for (const pixel of patch) {
    xx += (pixel.x - x) ** 2;
    yy += (pixel.y - y) ** 2;
    xy += (pixel.x - x) * (pixel.y - y);
  }
  const angle = (Math.atan2(2 * xy, xx - yy) / 2) * DEGREES;
  return { x, y, angle: angle < 0 ? angle + 180 : angle };
}

async function findLargest() {
  const picture = await look();
  let largest = [];
  let patches = 0;
  for (let row = 0; row < PIXELS; row++) {
    for (let column = 0; column < PIXELS; column++) {
      const patch = [];
      collect(picture, row, column, patch);
      if (patch.length > 0) patches++;
      if (patch.length > largest.length) largest = patch;
    }
  }
  console.log(`blocks in the picture: ${patches}`);
  if (patches === 0) giveUp("the camera sees no block: is one on the table?");
  const { x, y, angle } = measure(largest);
  console.log(
    `the largest is at x ${x.toFixed(0)}, y ${y.toFixed(0)} mm, turned ${angle.toFixed(0)} degrees`,
  );
  return { x, y, angle };
}

// Inverse kinematics: moves the tool, pointing down, to a place at height z. Seen from the side,
// upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third side leads from the
// shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and 9.5 mm nearer to the
// base. Each motor sets the slope of one link, independently of the others.
async function goTo(place, z) {
  const out = Math.hypot(place.x, place.y) - 9.5;
  const up = z + 168.3 - 260.4;
  const base = Math.atan2(place.y, place.x) * DEGREES;
  const slope = Math.atan2(up, out) * DEGREES;
  const corner = Math.acos(Math.hypot(out, up) / 2 / 228.6) * DEGREES;
  const upperArm = slope + corner;
  const forearm = slope - corner;
  // A block looks the same after half a turn, so the roll can be reduced to -90...90.
  let roll = base - place.angle + 90;
  roll -= 180 * Math.round(roll / 180);
  await robot.go({
    F: Math.round(base / 0.2269),
    E: Math.round((90 - upperArm) / 0.1135),
    D: Math.round(forearm / 0.1135),
    C: 0,
    B: Math.round(roll / 0.3125),
  });
}

async function main() {
  const block = await findLargest();

  await robot.go({ A: OPEN });
  await goTo(block, Z + ABOVE);
  await goTo(block, Z);
  robot.send("A+90\r"); // as in example 5
  robot.at.A += 90 - (await robot.wait("A"));
  if (robot.at.A >= SHUT) {
    await goTo(block, Z + ABOVE); // back to the start position
    await robot.go(HOME);
    giveUp(
      `the jaws closed on nothing: is the block at x ${block.x.toFixed(0)}, ` +
        `y ${block.y.toFixed(0)} mm? (The examples 3 to 6 are for the Rhino XR-3 with its own ` +
        "workcell)",
    );
  }
  console.log(`the jaws closed on ${(50.8 - 0.79375 * robot.at.A).toFixed(1)} mm`);
  await goTo(block, Z + ABOVE);

  const target = { x: 392, y: 60, angle: 90 }; // a free place, the block's long side along y
  await goTo(target, Z + ABOVE);
  await goTo(target, Z);
  await robot.go({ A: OPEN });
  await goTo(target, Z + ABOVE);
  console.log(`put down at x ${target.x}, y ${target.y} mm`);

  await findLargest();
  await robot.go(HOME);
  console.log("back at the start");

  robot.close();
}

main();
