// @ts-check
// The button that copies a link to this page with its robot, its workcell as it is now, and the program.
import { byId, copyText, isSame } from "../lib/dom.js";
import { sharedHere } from "../lib/here.js";
import { fragmentOf, kMaxLink } from "./share.js";

const kOpened = "This robot is of a recording, which is too long for a link. Save the recording as a file instead.";

/**
 * @param {{getModel: () => Promise<any>, getFirst: () => any, isOpened: () => boolean, getProgram: () => import("./share.js").Shared["program"], showMessage: (text: string) => void, onError: (error: unknown) => void}} parts
 *   `getFirst`: the model with which the page began; `isOpened`: whether the robot is of a recording that is in no address
 */
export function connectCopyLink({ getModel, getFirst, isOpened, getProgram, showMessage, onError }) {
  const button = byId("copy-link");
  button.hidden = false;
  button.onclick = async () => {
    byId("more").hidePopover();
    try {
      showMessage(isOpened() ? kOpened : await copy(await getModel(), getFirst(), getProgram()));
    } catch (error) {
      onError(error);
    }
  };
}

/** Returns what happened. @param {{workcell: object}} model @param {{workcell: object}} first @param {import("./share.js").Shared["program"]} program */
async function copy({ workcell }, first, program) {
  const shared = { ...(await sharedHere()), program };
  const now = shared.recording || isSame(workcell, first.workcell) ? shared : { ...shared, ...(shared.exercise || shared.vary ? { vary: "" } : {}), workcell: JSON.stringify(workcell) };
  const link = location.origin + location.pathname + (await fragmentOf(now));
  if (link.length > kMaxLink)
    return `A link to this would have ${link.length} characters, and some programs cut links beyond ${kMaxLink}. Save workcell and program as files instead.`;
  return (await copyText(link)) ? "The link is copied. It holds the robot, its workcell and the program; nothing is stored on a server." : `This browser does not copy. The link is: ${link}`;
}
