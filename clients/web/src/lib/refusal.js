// @ts-check
// Error responses of the server as text for the user: which member was wrong and what is expected
// there.

const kMaxDetails = 8;
const kMaxLetters = 40;
export const kReadOnly = "This page is read-only: press Unlock and enter the token.";
const kOfThePage = /** @type {Record<string, string>} */ ({
  token_required: kReadOnly,
  bad_token: "Wrong token. After five wrong tokens the server closes the connection.",
  no_history: "This server keeps no history of this robot. Start it with --history 1h, and without a physical controller, to look back.",
  in_the_past: "The robot was taken back in time, and programs wait. Press Resume first.",
});

const short = (/** @type {string} */ text) => (text.length > kMaxLetters ? `${text.slice(0, kMaxLetters)}…` : text);

/** Omits the protocol's `args` from a JSON pointer: `/args/size_mm/0` becomes `size_mm/0`. */
const placeOf = (/** @type {string} */ pointer) => pointer.replace(/^\/(args\/)?/, "") || "value";

const lineOf = (/** @type {any} */ { pointer, found, allowed }) =>
  `${placeOf(pointer)}: ${found === null ? "missing" : `got ${short(JSON.stringify(found))}`}, expected ${allowed}`;

/** An error response of the server: `code`, `message`, `hint`, `details`. */
export class Refused extends Error {
  /** @param {{code: string, message: string, hint?: string, details?: any[], [more: string]: any}} error */
  constructor({ code, message, hint, details = [], ...more }) {
    super(code === "unreachable" ? `Cannot go there: ${message}.` : kOfThePage[code] ?? (hint ? `${message} (${hint})` : message));
    this.code = code;
    this.hint = hint;
    this.details = details;
    this.more = more; // by the code
  }
}

/** The text of an error: the message, then one line for each of the first details. */
export function textOf(/** @type {any} */ { message, details = [] }) {
  const more = details.length > kMaxDetails ? [`and ${details.length - kMaxDetails} more`] : [];
  return [message, ...details.slice(0, kMaxDetails).map(lineOf), ...more].join("\n");
}
