// @ts-check
// The drawer: tabs, one panel at a time, open or shut. On phones the sections of the inspector are tabs here, too.
import { byId } from "../lib/dom.js";
import { isHere } from "../lib/here.js";
import { recall, remember } from "../lib/memory.js";
import { rove } from "../lib/roving_focus.js";

const kPhone = matchMedia("(max-width: 899px)");
const kSmall = matchMedia("(max-width: 1199px), (max-height: 700px)");

export class Drawer {
  /** @param {(panel: string) => void} onShow called with the id of a panel when it is shown */
  constructor(onShow) {
    this.onShow = onShow;
    this.app = byId("cell-page");
    if (isHere) document.querySelectorAll(".tabs [data-server]").forEach((tab) => tab.remove());
    this.tabs = /** @type {HTMLElement[]} */ ([...document.querySelectorAll(".tabs [role=tab]")]);
    const { choose } = rove(this.tabs, (tab) => this.#chosen(tab));
    this.chooseTab = choose;
    byId("drawer-toggle").onclick = () => this.#setOpen(!this.isOpen);
    this.#setOpen(recall("drawer.open", !kSmall.matches), { isKept: true });
    const last = byId(recall("drawer.tab", kPhone.matches ? "tab-joints" : "tab-wire"));
    choose(last && !last.hidden ? last : byId("tab-wire"));
    if (!this.isOpen) this.#setOpen(false, { isKept: true });
    this.isReady = true;
    kPhone.addEventListener("change", () => this.#leavePhone());
  }

  get isOpen() {
    return !this.app.classList.contains("drawer-shut");
  }

  /** Shows the panel of a tab, and opens the drawer. @param {string} id */
  choose(id) {
    this.chooseTab(byId(id));
  }

  /** @param {HTMLElement} tab */
  #chosen(tab) {
    for (const each of this.tabs) each.setAttribute("aria-selected", String(each === tab));
    const { phone } = tab.dataset;
    if (phone) this.app.dataset.phone = phone;
    else this.#showPanel(tab.getAttribute("aria-controls"));
    if (!this.isReady) return;
    remember("drawer.tab", tab.id);
    if (!phone) this.#setOpen(true);
  }

  /** @param {string} id */
  #showPanel(id) {
    delete this.app.dataset.phone;
    for (const panel of /** @type {NodeListOf<HTMLElement>} */ (this.app.querySelectorAll(".drawer > [role=tabpanel]"))) panel.hidden = panel.id !== id;
    this.onShow(id);
  }

  /** @param {boolean} isOpen */
  #setOpen(isOpen, { isKept = false } = {}) {
    this.app.classList.toggle("drawer-shut", !isOpen);
    const button = byId("drawer-toggle");
    const name = isOpen ? "Close the drawer" : "Open the drawer";
    button.setAttribute("aria-expanded", String(isOpen));
    Object.assign(button, { title: name, ariaLabel: name });
    if (!isKept) remember("drawer.open", isOpen);
  }

  // A window that grows shows the inspector beside the stage.
  #leavePhone() {
    if (!kPhone.matches && this.app.dataset.phone) this.choose("tab-wire");
  }
}
