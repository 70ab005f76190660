// 2. Move and wait: send a joint somewhere, and ask until it has arrived.
//
//     node 2_move_and_wait.js [HOST [PORT]]

const { Robot, STANDS_AFTER, giveUpStanding } = require("./robot");

const robot = new Robot();

// Asks how far there is still to go until nothing is left. Between two questions it does nothing
// for a while. A joint that is blocked would let us ask forever: we give up after so many questions
// with the same answer.
async function waitFor(joint) {
  let left = await robot.toGo(joint);
  let same = 0; // how many answers in a row have been the same
  while (left > 0) {
    console.log(`  ${left} counts to go`);
    await robot.pause();
    const before = left;
    left = await robot.toGo(joint);
    same = left === before ? same + 1 : 0;
    if (same === STANDS_AFTER) {
      robot.send(joint + "X"); // forgets the rest of the move
      giveUpStanding(joint, left);
    }
  }
  console.log(`${joint} is there`);
}

async function main() {
  // The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that
  // the number ends here. It starts to move, and answers nothing: so we ask.
  console.log("E+50");
  robot.send("E+50\r");
  await waitFor("E");

  // And back again.
  console.log("E-50");
  robot.send("E-50\r");
  await waitFor("E");

  robot.close();
}

main();
