// @ts-check
// The button that copies a link to this page with its robot, and its workcell as it is now.
import { byId, copyText, isSame } from "../lib/dom.js";
import { sharedHere } from "../lib/here.js";
import { fragmentOf, kMaxLink } from "./share.js";

/**
 * @param {{getModel: () => Promise<any>, getFirst: () => any, showMessage: (text: string) => void, onError: (error: unknown) => void}} parts
 *   `getFirst`: the model with which the page began
 */
export function connectCopyLink({ getModel, getFirst, showMessage, onError }) {
  const button = byId("copy-link");
  button.hidden = false;
  button.onclick = async () => {
    try {
      showMessage(await copy(await getModel(), getFirst()));
    } catch (error) {
      onError(error);
    }
  };
}

/** Returns what happened. @param {{workcell: object}} model @param {{workcell: object}} first */
async function copy({ workcell }, first) {
  const shared = await sharedHere();
  const now = isSame(workcell, first.workcell) ? shared : { ...shared, workcell: JSON.stringify(workcell) };
  const link = location.origin + location.pathname + (await fragmentOf(now));
  if (link.length > kMaxLink)
    return `A link to this workcell would have ${link.length} characters, and some programs cut links beyond ${kMaxLink}. Save the workcell as a file instead.`;
  return (await copyText(link)) ? "The link is copied. It holds the robot and its workcell; nothing is stored on a server." : `This browser does not copy. The link is: ${link}`;
}
