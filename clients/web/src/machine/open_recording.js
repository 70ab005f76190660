// @ts-check
// Opening a recording of a server, or of another page: by a button, or by dropping the file on the page.
import { byId } from "../lib/dom.js";
import { recorded } from "./setup.js";

/** @typedef {import("./machine.js").Machine} Machine */

const kMostMiB = 64;

/**
 * @param {{machine: Machine, onOpened: (name: string) => void, onError: (error: unknown) => void}} parts
 *   `onOpened` is called with the name of the file when the robot is where the recording ends
 */
export function connectOpenRecording({ machine, onOpened, onError }) {
  /** @param {File | undefined} file */
  const open = async (file) => {
    if (!file) return;
    try {
      if (file.size > kMostMiB << 20) throw new Error(`${file.name} has ${Math.ceil(file.size / 2 ** 20)} MiB; the page opens recordings of at most ${kMostMiB} MiB. xr3 replay repeats it.`);
      await machine.open(recorded(await file.text()));
      onOpened(file.name);
    } catch (error) {
      onError(error);
    }
  };
  const input = byId("recording-file");
  input.onchange = () => {
    open(input.files[0]);
    input.value = ""; // the file may be chosen again
  };
  byId("open-recording").hidden = false;
  byId("open-recording").onclick = () => {
    byId("more").hidePopover();
    input.click();
  };
  document.addEventListener("dragover", (event) => isRecording(event) && event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (!isRecording(event)) return;
    event.preventDefault();
    open(event.dataTransfer?.files[0]);
  });
}

/** Only files: the text of a page is dropped elsewhere. While they are dragged their names are not known. @param {DragEvent} event */
function isRecording({ dataTransfer }) {
  const file = dataTransfer?.files[0];
  return file ? file.name.endsWith(".xr3rec") : (dataTransfer?.types.includes("Files") ?? false);
}
