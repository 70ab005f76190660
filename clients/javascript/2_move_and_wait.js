// 2. Move and wait: move a joint and ask until it has arrived.
//
//     node 2_move_and_wait.js [HOST [PORT]]

const { Robot, STANDS_AFTER, giveUpStanding } = require("./robot");

const robot = new Robot();

// Asks for the remaining counts until none are left, with a pause between two questions. A blocked
// joint would never finish, so the program gives up after a number of equal answers.
async function waitFor(joint) {
  let left = await robot.toGo(joint);
  let same = 0; // number of equal answers in a row
  while (left > 0) {
    console.log(`  ${left} counts to go`);
    await robot.pause();
    const before = left;
    left = await robot.toGo(joint);
    same = left === before ? same + 1 : 0;
    if (same === STANDS_AFTER) {
      robot.send(joint + "X"); // cancels the rest of the move
      giveUpStanding(joint, left);
    }
  }
  console.log(`${joint} is there`);
}

async function main() {
  // Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
  // starts to move and does not answer, so the program has to ask.
  console.log("E+50");
  robot.send("E+50\r");
  await waitFor("E");

  // Move back.
  console.log("E-50");
  robot.send("E-50\r");
  await waitFor("E");

  robot.close();
}

main();
