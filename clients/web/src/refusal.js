// What the server answered to a refused request, in words for the person at the page: what was wrong where,
// and what is allowed there.

const kMostDetails = 8;
const kMostLetters = 40;
export const kLooksOn = "This page only looks on: press Unlock and give the token.";
const kOfThePage = {
  token_required: kLooksOn,
  bad_token: "This is not the server's token. After five wrong ones the server ends the connection.",
};

const short = (text) => (text.length > kMostLetters ? `${text.slice(0, kMostLetters)}…` : text);

/** `/args/size_mm/0` is `size_mm/0` to a person, who knows no `args`. */
const placeOf = (pointer) => pointer.replace(/^\/(args\/)?/, "") || "the whole";

const lineOf = ({ pointer, found, allowed }) =>
  `${placeOf(pointer)}: ${found === null ? "nothing" : short(JSON.stringify(found))} was given, allowed is ${allowed}`;

/** An error that the server answered: `code`, `message` in words, `hint`, `details`. */
export class Refused extends Error {
  constructor({ code, message, hint, details = [] }) {
    super(kOfThePage[code] ?? (hint ? `${message} (${hint})` : message));
    Object.assign(this, { code, hint, details });
  }
}

/** All that is known of an error; what is wrong in detail a line each, the first of them. */
export function wordsOf({ message, details = [] }) {
  const more = details.length > kMostDetails ? [`and ${details.length - kMostDetails} more`] : [];
  return [message, ...details.slice(0, kMostDetails).map(lineOf), ...more].join("\n");
}
