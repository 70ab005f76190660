// A program as plain bytes. Bytes do not wait: what makes them safe is that each byte takes its time. So after
// each move the file has as many CR, which have no other effect, as the move takes at the fastest permitted line.
import { gripTarget, moveText, speedAt, strides } from "../lib/stride.js";
import { kNoMarkIII, programOf } from "./program.js";

const kCharactersPerS = 960; // 9600 baud with 10 bits a character, the fastest permitted
const kSpare = 1.1; // a tenth longer than the motors need
const kLineLength = 80;

const pad = (ms) => {
  const count = Math.ceil((ms / 1000) * kCharactersPerS);
  return "\r".repeat(count);
};
const waitFor = (moves, speeds, percent) =>
  pad(kSpare * Math.max(...Object.entries(moves).map(([label, counts]) => ((Math.abs(counts) + 1) * 1000) / speedAt(speeds[label], percent))));

/** { name, text, notes, companion }: the bytes, how to send them, and the same notes as a file. */
export function byteProgram(robot, points) {
  const program = programOf(robot, points);
  const name = program.name;
  const text = bytesOf(program);
  const notes = notesOf(program, text.length);
  return { name: `${name}.bytes`, text, notes, companion: { name: `${name}-notes.txt`, text: `${wrapped(notes)}\n`, what: "these notes as a file" } };
}

function bytesOf(program) {
  const { labels, jaws, speeds, usesSpeeds } = program;
  const at = Object.fromEntries(Object.keys(speeds).map((label) => [label, 0]));
  let text = "";
  let holds = false;
  const go = (wanted, percent) => {
    const way = Object.fromEntries(Object.entries(wanted).map(([label, count]) => [label, count - at[label]]));
    for (const moves of strides(way)) text += moveText(moves) + waitFor(moves, speeds, percent);
    Object.assign(at, wanted);
  };
  const setSpeed = (percent) => usesSpeeds && (text += Object.entries(speeds).map(([label, speed]) => `${label}${speedAt(speed, percent)}S`).join(""));
  for (const { counts, jaws: count, grip, percent, pause } of program.points) {
    setSpeed(percent);
    go(Object.fromEntries(labels.map((label, i) => [label, counts[i]])), percent);
    if (!grip) go({ [jaws.label]: count }, percent);
    else if (!holds) {
      go({ [jaws.label]: gripTarget(jaws, count) }, percent);
      text += `${jaws.label}X`; // the block has stopped them; the rest would be added to the next move
      at[jaws.label] = count;
    }
    holds = grip;
    text += pad(pause * 1000);
  }
  setSpeed(100);
  return text;
}

function notesOf({ name, usesSpeeds, points }, bytes) {
  return [
    "Bytes do not wait: this file is right only where each byte takes its time, at 9600 baud or slower. After each move it has as many CR as the move takes there.",
    `Start the server with xr3 serve --line-speed 9600-8n1, and send the file: nc -N localhost 9600 < ${name}.bytes. Or send it on a serial port that is set to 9600 baud or slower.`,
    `Without --line-speed all ${bytes} bytes arrive at once, the moves add up in the 8-bit error counters, and the arm goes elsewhere. Then use the program in Python or C: they ask where the arm is.`,
    "The arm must stand at its soft home, with nothing else sending. The file cannot notice a stall, a limit, a slower motor, or jaws that close on nothing: it goes on.",
    ...(points.some(({ grip }) => grip) ? ["It assumes that each block has the width that it had when the point was taught."] : []),
    ...(usesSpeeds ? [kNoMarkIII] : []),
  ].join("\n");
}

/** Lines of at most 80 letters, where words allow it. */
const wrapped = (text) => text.split("\n").map((paragraph) => {
  const lines = [""];
  for (const word of paragraph.split(" ")) {
    const longer = lines.at(-1) ? `${lines.at(-1)} ${word}` : word;
    if (longer.length > kLineLength && lines.at(-1)) lines.push(word);
    else lines[lines.length - 1] = longer;
  }
  return lines.join("\n");
}).join("\n\n");
