// @ts-check
// Whether the robot is in the page itself: then no server is needed, and there is nothing of one, such as ports, tokens
// and other people's lines. The page of the static folder says so in its first element.

import { fragmentOf, sharedIn } from "../machine/share.js";

export const isHere = document.documentElement.dataset.robot === "here";

/** The robot, its files and the program in the address of the page. Rejects with an Error for the user if the address is damaged. */
export const sharedHere = async () => (await sharedIn(location.hash)) ?? {};

if (isHere) addEventListener("hashchange", () => location.reload()); // another link in the same tab

/** The robots that the page has the files of. @returns {Promise<{name: string, title: string}[]>} */
export async function robotsHere() {
  const response = await fetch("data/robots.json");
  return response.ok ? response.json() : [];
}

/** Loads the page again with this robot. @param {string} name */
export async function chooseRobot(name) {
  location.hash = await fragmentOf({ robot: name });
}
