// The lower part of the page: the tabs and the buttons of the wire and workcell panels.
import { byId, setText } from "../lib/dom.js";
import { colorOf } from "../lib/palette.js";
import { rove } from "../lib/roving_focus.js";
import { colorOptions } from "./workcell_panel.js";

const kTurnDegrees = 5;

/** Makes each tab show its panel, and calls `onShow(id of the panel)`. Returns a function that chooses a tab. */
export function wireTabs(onShow) {
  const tabs = [...document.querySelectorAll("[role=tab]")];
  const { choose } = rove(tabs, (chosen) => {
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", String(tab === chosen));
      byId(tab.getAttribute("aria-controls")).hidden = tab !== chosen;
    }
    onShow(chosen.getAttribute("aria-controls"));
  });
  return (id) => choose(byId(id));
}

/** Connects the buttons of the wire panel. */
export function wireWireBar(wire) {
  byId("wire-pause").onclick = ({ target }) => {
    wire.setPaused(!wire.isPaused);
    target.setAttribute("aria-pressed", String(wire.isPaused));
    setText(target, wire.isPaused ? "Resume" : "Pause");
  };
  byId("wire-clear").onclick = () => wire.clear();
  byId("wire-copy").onclick = () => wire.copy();
  byId("wire-save").onclick = () => wire.save();
  byId("wire-source").onclick = () => {
    wire.setSource(null);
    byId("wire-filter").focus();
  };
}

/** Connects the buttons of the workcell panel. */
export function wireWorkcellBar(workcell) {
  wireColorChoice();
  byId("turn-left").onclick = () => workcell.turn(kTurnDegrees);
  byId("turn-right").onclick = () => workcell.turn(-kTurnDegrees);
  byId("block-remove").onclick = () => workcell.remove();
  byId("block-form").onsubmit = async (event) => {
    event.preventDefault();
    const size = byId("block-size").value.trim().split(/\s+/).map(Number);
    const isAdded = await workcell.add({ name: byId("block-name").value.trim(), size, color: Number(byId("block-color").value) });
    if (isAdded) byId("block-name").value = "";
  };
  byId("workcell-save").onclick = () => workcell.save();
  byId("workcell-load").onchange = async ({ target }) => {
    if (target.files[0]) await workcell.load(target.files[0]);
    target.value = "";
  };
}

// Not every browser shows colours in a <select>: a swatch beside it shows the selected colour.
function wireColorChoice() {
  const choice = byId("block-color");
  const show = () => (byId("block-swatch").style.background = colorOf(Number(choice.value)));
  choice.replaceChildren(...colorOptions());
  choice.onchange = show;
  show();
}
