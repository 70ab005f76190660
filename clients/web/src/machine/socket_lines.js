// @ts-check
// The connections of a program in the page to a server's robot, over WebSockets: serial lines, and clients of the monitor. They have
// the members of the lines of a robot in the page (program_lines.js).
import { Arrived } from "./arrived.js";

/** @typedef {{base: string, cell: string | null, token: string | null}} ServerAddress `base` is `ws://host:port`; `cell`: the server's usual one if null */

const Socket = globalThis.WebSocket; // which is taken from the worker before a program runs
const kMostQueued = 1 << 16; // bytes that were not sent yet
const kMostAMessage = 1 << 14;
const kAuthId = "page";

/** A program holds such objects: it gets no WebSocket by them. */
class SocketConnection {
  #socket;
  #wake;
  #arrived = new Arrived();
  isOpening = true;
  isClosed = false;

  /** @param {string} path @param {string} protocol @param {ServerAddress} server @param {() => void} wake called when something has arrived */
  constructor(path, protocol, { base, cell }, wake) {
    this.#wake = wake;
    this.#socket = new Socket(`${base}${path}${cell === null ? "" : `?cell=${encodeURIComponent(cell)}`}`, protocol);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onopen = () => this.opened();
    this.#socket.onmessage = ({ data }) => this.take(data);
    this.#socket.onclose = () => {
      this.isClosed = true;
      this.setReady();
    };
  }
  opened() {}
  /** @param {any} _data */
  take(_data) {}

  setReady() {
    this.isOpening = false;
    this.#wake();
  }
  /** @param {Uint8Array} bytes */
  add(bytes) {
    this.#arrived.add(bytes);
    this.#wake();
  }
  /** @param {string | Uint8Array<ArrayBuffer>} message */
  transmit(message) {
    if (!this.isClosed) this.#socket.send(message);
  }
  get isFull() {
    return this.#socket.bufferedAmount > kMostQueued;
  }
  /** The number of bytes that can be read now; -1 at the end. */
  waiting() {
    return this.#arrived.bytes.length || (this.isClosed ? -1 : 0);
  }
  /** @param {number} size @param {boolean} peek */
  read(size, peek) {
    return this.#arrived.read(size, peek);
  }
  close() {
    this.#socket.close();
  }
}

export class SocketLine extends SocketConnection {
  #token;

  /** @param {ServerAddress} server @param {() => void} wake */
  constructor(server, wake) {
    super("/line", "xr3.line.v1", server, wake);
    this.#token = server.token;
  }
  opened() {
    if (this.#token) this.transmit(JSON.stringify({ op: "auth", id: kAuthId, token: this.#token }));
    this.setReady();
  }
  /** @param {ArrayBuffer} data */
  take(data) {
    this.add(new Uint8Array(data));
  }
  /** The number of bytes taken. @param {Uint8Array} bytes */
  send(bytes) {
    if (this.isFull) return 0;
    const part = new Uint8Array(bytes.slice(0, kMostAMessage));
    this.transmit(part);
    return part.length;
  }
  /** Ends sending. */
  finish() {
    this.transmit(new Uint8Array());
  }
}

/** A client of the monitor in the form of JSON lines, which has the token of the page already. */
export class SocketMonitor extends SocketConnection {
  #token;
  #unfinished = "";
  #decoder = new TextDecoder();
  #encoder = new TextEncoder();
  /** @type {any} */
  #hello = null;

  /** @param {ServerAddress} server @param {() => void} wake */
  constructor(server, wake) {
    super("/ws", "xr3.v1", server, wake);
    this.#token = server.token;
  }
  /** @param {string} text */
  take(text) {
    if (!this.isOpening) return this.add(this.#encoder.encode(`${text}\n`));
    const message = JSON.parse(text);
    if (message.id === kAuthId && this.#hello.access === "none" && message.ok) return; // another hello follows
    if (message.id === kAuthId) return this.#greet(message.ok ? { ...this.#hello, access: "control" } : this.#hello);
    if (this.#hello || message.access === "control" || !this.#token) return this.#greet(message);
    this.#hello = message;
    this.transmit(JSON.stringify({ op: "auth", id: kAuthId, token: this.#token }));
  }
  /** @param {object} hello */
  #greet(hello) {
    this.add(this.#encoder.encode(`${JSON.stringify(hello)}\n`));
    this.setReady();
  }
  /** @param {Uint8Array} bytes */
  send(bytes) {
    const lines = (this.#unfinished + this.#decoder.decode(bytes, { stream: true })).split("\n");
    this.#unfinished = lines.pop() ?? "";
    for (const line of lines) if (line.trim()) this.transmit(line);
    return bytes.length;
  }
  finish() {
    this.close();
  }
}
