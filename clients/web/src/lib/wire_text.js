// Text for `line` messages, shared by wire panel and console: transcript lines and warnings.

const kWarnings = /unknown|range|no_joint|incomplete|bad_|disabled|overflow|no_such|narrow|below|in_air|overlap|suppressed|held_back|not_for_device|device_silent|hurry|pty_cooked|decimal|^word$/;

/** Whether the code of a `line` message's item means that a command was not executed or failed. */
export const isWarning = (code) => kWarnings.test(code);
/** Whether the code means that a command went to the physical controller, or that it answered. */
export const isOfDevice = (code) => code === "to_device" || code === "from_device";

/** One `line` message, or a note, as a transcript line. */
export function transcriptLine(message) {
  if (message.note) return `# ${message.note}`;
  const arrow = message.dir === "in" ? ">" : "<";
  const parsed = message.parsed.map((item) => item.message).join("; ");
  return `@${message.tick} line ${message.line} ${arrow} ${message.text}${parsed ? `    # ${parsed}` : ""}`;
}

export const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
