// @ts-check
// The page's serial line: typed commands, with a history. Bytes and their meaning are shown by the Wire panel.

const kNeedsCr = /[0-9]$|^[a-z]{3,}$/i; // a number ends, and a word is told that it is none

export class CommandLine {
  /**
   * @param {{form: HTMLFormElement, input: HTMLInputElement, send: (text: string) => Promise<unknown>, onError: (error: unknown) => void}} parts
   *   `send` sends text as bytes on a line of this page
   */
  constructor({ form, input, send, onError }) {
    this.input = input;
    this.sendBytes = send;
    this.onError = onError;
    /** @type {string[]} */
    this.history = [];
    this.at = 0;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#submit();
    });
    input.addEventListener("keydown", (event) => this.#recall(event));
  }

  /** Sends text as bytes. Rejects if the server refuses them or is away. @param {string} text */
  transmit(text) {
    return this.sendBytes(text.replaceAll("−", "-"));
  }

  #submit() {
    const text = this.input.value;
    if (!text) return;
    this.history.push(text);
    this.at = this.history.length;
    this.input.value = "";
    this.transmit(kNeedsCr.test(text) ? `${text}\r` : text).catch(this.onError);
  }

  /** @param {KeyboardEvent} event */
  #recall(event) {
    const way = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!way || this.history.length === 0) return;
    event.preventDefault();
    this.at = Math.min(Math.max(this.at + way, 0), this.history.length);
    this.input.value = this.history[this.at] ?? "";
  }
}
