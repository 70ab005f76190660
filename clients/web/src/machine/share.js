// @ts-check
// What a link to the page holds: everything that makes a robot, in the fragment of the address, which browsers do not send
// to a server. It is JSON, compressed by deflate, in base64url: `#xr3=...`. What comes from a link is checked here for its
// form and its size; the robot checks the contents of the files.
import { programOf } from "../program/program_files.js";

/**
 * `robot`, `workcell`, `faults` and `goals` are names of files that the page has, or their contents; they take precedence over those of
 * the exercise, which the page has, too. `recording` is the path of one, instead of a robot. `program`: its text if it has one file.
 * @typedef {{exercise?: string, robot?: string, workcell?: string, faults?: string, goals?: string, clock?: string, vary?: string, compat?: string,
 *   recording?: string, program?: string | import("../program/program_files.js").Program}} Shared
 */

const kName = "xr3";
const kMembers = ["exercise", "robot", "workcell", "faults", "goals", "clock", "vary", "compat", "recording"];
const kMaxBytes = 1 << 20; // of the JSON: a short link can be large when it is unpacked
/** Longer links are cut by some programs. */
export const kMaxLink = 8192;

/** @param {Shared} shared @returns {Promise<string>} the fragment, with # */
export async function fragmentOf(shared) {
  const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(shared)));
  return `#${kName}=${base64url(packed)}`;
}

/**
 * What a fragment holds; null if it is not that of a link. Rejects with an Error for the user if the link is damaged.
 * @param {string} fragment @returns {Promise<Shared | null>}
 */
export async function sharedIn(fragment) {
  const packed = new RegExp(`(?:^#|&)${kName}=([\\w-]*)`).exec(fragment)?.[1];
  if (packed === undefined) return null;
  try {
    const json = await through(new DecompressionStream("deflate-raw"), bytesOf(packed), kMaxBytes);
    return checked(JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(json)));
  } catch (cause) {
    throw new Error("This link is damaged: a part of it may be missing. Copy it again.", { cause });
  }
}

/** @param {any} found @returns {Shared} */
function checked(found) {
  if (found?.constructor !== Object) throw new Error("not an object");
  const { program, ...texts } = found;
  const wrong = Object.entries(texts).find(([name, value]) => !kMembers.includes(name) || typeof value !== "string");
  if (wrong) throw new Error(`unknown: ${wrong[0]}`);
  if (program !== undefined) programOf(program);
  return found;
}

/**
 * @param {CompressionStream | DecompressionStream} stream @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} most throws if more come out
 */
async function through(stream, bytes, most = Infinity) {
  const writer = stream.writable.getWriter();
  const written = writer.write(bytes).then(() => writer.close()).catch(() => {}); // the reader fails, too
  const parts = [];
  let size = 0;
  for (const reader = stream.readable.getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error(`more than ${most} bytes`);
    parts.push(value);
  }
  await written;
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** @param {Uint8Array} bytes */
const base64url = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
/** @param {string} text */
const bytesOf = (text) => Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (char) => char.charCodeAt(0));
