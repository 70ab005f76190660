// @ts-check
// Whether the robot is in the page itself: then no server is needed, and there is nothing of one, such as ports, tokens
// and other people's lines. The page of the static folder says so in its first element.

import { starterOf } from "../machine/exercise.js";
import { fragmentOf, sharedIn } from "../machine/share.js";
import { programOf } from "../program/program_files.js";

export const isHere = document.documentElement.dataset.robot === "here";

/** The robot, its files and the program in the address of the page. Rejects with an Error for the user if the address is damaged. */
export const sharedHere = async () => (await sharedIn(location.hash)) ?? {};

if (isHere) addEventListener("hashchange", () => location.reload()); // another link in the same tab

/** The program in the address, or with which its exercise begins, the address, the exercise, and whether there are goals. */
export async function givenHere() {
  const { exercise, program, goals } = await sharedHere();
  const hasGoals = exercise !== undefined || goals !== undefined;
  if (program === undefined && exercise === undefined) return { origin: "", hasGoals };
  return { program: program === undefined ? await starterOf(exercise) : programOf(program), origin: location.hash, exercise, hasGoals };
}

/** The robots that the page has the files of. @returns {Promise<{name: string, title: string}[]>} */
export async function robotsHere() {
  const response = await fetch("data/robots.json");
  return response.ok ? response.json() : [];
}

/** Loads the page again with this robot. @param {string} name */
export async function chooseRobot(name) {
  location.hash = await fragmentOf({ robot: name });
}

/** Loads the page again with this exercise. @param {string} name */
export async function chooseExercise(name) {
  const fragment = await fragmentOf({ exercise: name });
  if (fragment === location.hash) location.reload();
  else location.hash = fragment;
}
