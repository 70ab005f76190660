// @ts-check
// The folder with what programs in the page need: scripts, Python and examples. A page with the robot in itself is in it; a server has it
// at /play/, where it is installed.
export const folder = new URL(document.documentElement.dataset.robot === "here" ? "./" : "/play/", document.baseURI);
