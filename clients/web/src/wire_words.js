// What is said about bytes, wherever bytes are shown: as a line of a transcript, and whether the controller
// warns of them.

const kWarnings = /unknown|range|no_joint|incomplete|bad_|disabled|overflow|no_such|narrow|below|suppressed|held_back/;

/** Whether the code of an item of a `line` message means that something was not obeyed, or did not go well. */
export const isWarning = (code) => kWarnings.test(code);

/** One `line` message, or a note between them, as a line of a transcript. */
export function transcriptLine(message) {
  if (message.note) return `# ${message.note}`;
  const arrow = message.dir === "in" ? ">" : "<";
  const made = message.parsed.map((item) => item.message).join("; ");
  return `@${message.tick} line ${message.line} ${arrow} ${message.text}${made ? `    # ${made}` : ""}`;
}

export const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
