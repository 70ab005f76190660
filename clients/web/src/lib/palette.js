// @ts-check
// The sixteen colours of robot and workcell files, adapted to solid surfaces.

export const kColors = [
  "#2b3036", "#3b6fd4", "#3f9e5a", "#7d93a6", "#b3524a", "#8a62b8", "#c98a3c", "#c9ced4",
  "#6b747e", "#4f8ff7", "#4fbf6b", "#8fa9bd", "#e0584f", "#c26fd6", "#efc443", "#f4f6f8",
];

/** @param {number} index */
export const colorOf = (index) => kColors[index] ?? kColors[7];

/** The names of the EGA palette, which the paper's machine used. */
export const kColorNames = [
  "black", "blue", "green", "cyan", "red", "magenta", "brown", "light grey",
  "dark grey", "light blue", "light green", "light cyan", "light red", "light magenta", "yellow", "white",
];
/** @param {number} index */
export const colorNameOf = (index) => kColorNames[index] ?? `colour ${index}`;
