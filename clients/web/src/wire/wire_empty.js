// @ts-check
// What stands in the wire as long as nothing was sent: a sentence, and a button that sends something.
import { setText } from "../lib/dom.js";
import { firstMove } from "../lib/first_move.js";

export class WireEmpty {
  /**
   * @param {{host: HTMLElement, button: HTMLButtonElement, send: (text: string) => Promise<unknown>, onError: (error: unknown) => void}} parts
   *   `send` sends text as bytes
   */
  constructor({ host, button, send, onError }) {
    this.host = host;
    this.button = button;
    button.onclick = () => send(`${this.move.command}\r`).catch(onError);
  }

  /** @param {import("../lib/monitor_types").Model} model */
  setModel({ robot }) {
    this.move = firstMove(robot);
    this.button.hidden = !this.move;
    if (this.move) setText(this.button, `Send ${this.move.command} (the ${this.move.name} moves ${this.move.amount})`);
  }

  /** @param {boolean} isEmpty */
  show(isEmpty) {
    this.host.hidden = !isEmpty;
  }
}
