// The monitor protocol over a WebSocket, or over an object with the same members: matches responses to requests, reconnects and renews
// subscriptions, pings a silent server, and forwards channel messages. Independent of the page.
import { Refused } from "./refusal.js";

const kFirstRetryMs = 300;
const kMaxRetryMs = 3000;
const kAnswerWithinMs = 15000;
const kQuietMs = 5000; // of silence before a ping
const kPongWithinMs = 5000;

const kOfCells = new Set(["get", "call"]); // the requests of `request` that concern a cell

const bytesOf = (text) => new TextEncoder().encode(text).length;
const kib = (bytes) => `${Math.ceil(bytes / 1024)} KiB`;

export class Connection {
  /**
   * @param {() => WebSocket} connect opens the WebSocket, or something with its members readyState, send, close,
   *   onmessage and onclose; with `mayBeSilent`, it is not asked whether it is still there
   * @param {object} handlers
   *   onMessage(message) receives `hello` and channel messages; onStatus(status) "open", "silent"
   *   (the server does not answer) or "lost"; onTokenRefused(error) reports a rejected token.
   */
  constructor(connect, handlers) {
    this.connect = connect;
    this.handlers = handlers;
    this.token = "";
    this.cell = null; // the cell that requests concern; null: the server's default
    this.subscriptions = new Map();
    this.pending = new Map();
    this.lastId = 0;
    this.retryMs = kFirstRetryMs;
    this.limits = {};
    setInterval(() => this.#askIfQuiet(), kQuietMs);
  }

  /** Seconds until the next attempt to connect; null while there is none to wait for. */
  get retryInS() {
    return this.socket || !this.retryAt ? null : Math.max(0, (this.retryAt - performance.now()) / 1000);
  }

  /** Tries to connect at once. */
  retry() {
    if (this.socket) return;
    clearTimeout(this.retryTimer);
    this.open();
  }

  open() {
    this.openedAt = performance.now();
    this.socket = this.connect();
    this.socket.onmessage = ({ data }) => this.#take(JSON.parse(data));
    this.socket.onclose = () => this.#lost("lost");
  }

  #lost(status) {
    this.socket = null;
    this.isGreeted = false;
    for (const { reject, timer } of this.pending.values()) {
      clearTimeout(timer);
      reject(new Error("the connection was lost"));
    }
    this.pending.clear();
    this.handlers.onStatus(status);
    this.retryAt = performance.now() + this.retryMs;
    this.retryTimer = setTimeout(() => this.open(), this.retryMs);
    this.retryMs = Math.min(this.retryMs * 1.6, kMaxRetryMs);
  }

  // --- Keep-alive: a cut network or a hanging server does not close the socket.

  #askIfQuiet() {
    if (!this.socket || this.socket.mayBeSilent || performance.now() - Math.max(this.heardAt ?? 0, this.openedAt) < kQuietMs) return;
    if (!this.isGreeted) return this.#giveUp();
    this.request({ op: "ping" }, { withinMs: kPongWithinMs }).catch((error) => error.isTimeout && this.#giveUp());
  }

  /** Abandons the socket, since its closing handshake may take minutes, and reconnects. */
  #giveUp() {
    const { socket } = this;
    socket.onmessage = socket.onclose = null;
    socket.close();
    this.#lost("silent");
  }

  // --- Receiving.

  #take(message) {
    this.heardAt = performance.now();
    if (message.op === "hello") return this.#greeted(message);
    const waiting = this.pending.get(message.id);
    if (waiting && message.op === waiting.collects) return waiting.onEach(message);
    if (!waiting || !["result", "pong", waiting.channel].includes(message.op)) return this.handlers.onMessage(message);
    this.pending.delete(message.id);
    clearTimeout(waiting.timer);
    if (message.ok === false) waiting.reject(new Refused(message.error));
    else waiting.resolve(message.op === waiting.channel ? message : message.value);
  }

  async #greeted(hello) {
    this.retryMs = kFirstRetryMs;
    this.isGreeted = true;
    this.limits = hello.limits;
    this.handlers.onStatus("open");
    const isLocked = hello.access === "none"; // it does not describe the cell
    if (this.token && hello.access !== "control") hello.access = await this.#tryToken(hello.access);
    if (!this.isGreeted) return; // connection lost meanwhile
    if (isLocked && hello.access !== "none") return; // the complete one follows
    this.handlers.onMessage(hello);
    this.renew();
  }

  async #tryToken(access) {
    try {
      return await this.authorize(this.token);
    } catch (error) {
      if (error instanceof Refused) {
        this.token = "";
        this.handlers.onTokenRefused(error);
      }
      return access;
    }
  }

  /** Sends all subscriptions again, for example after a token has given access to them. */
  renew() {
    for (const subscription of this.subscriptions.values()) this.#send(JSON.stringify({ ...this.#ofCell(), ...subscription }));
  }

  #ofCell() {
    return this.cell === null ? {} : { cell: this.cell };
  }

  // --- Sending.

  #send(text) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
  }

  /**
   * Sends a request. Resolves to the value of its `result`, or, if `channel` is given, to the
   * message of that channel with the request's id. Until then, messages of the channel `collects`
   * with this id are passed to `onEach`. Rejects with Refused, or with Error on timeout or
   * connection loss.
   */
  request(message, { channel, collects, onEach, withinMs = kAnswerWithinMs } = {}) {
    const id = ++this.lastId;
    const text = JSON.stringify({ ...(kOfCells.has(message.op) ? this.#ofCell() : {}), ...message, id });
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Error("not connected"));
      if (this.#isTooBig(text)) return reject(this.#tooBig(text));
      const timer = setTimeout(() => this.#late(id), withinMs);
      this.pending.set(id, { resolve, reject, timer, channel, collects, onEach });
      this.#send(text);
    });
  }

  // The server closes the connection on messages over its limit.
  #isTooBig(text) {
    return bytesOf(text) > (this.limits.message_bytes ?? Infinity);
  }
  #tooBig(text) {
    return new Error(`too large to send: ${kib(bytesOf(text))}; the server accepts at most ${kib(this.limits.message_bytes)}`);
  }

  #late(id) {
    const { reject } = this.pending.get(id);
    this.pending.delete(id);
    reject(Object.assign(new Error("the server did not answer"), { isTimeout: true }));
  }

  call(fn, args = {}) {
    return this.request({ op: "call", fn, args });
  }

  /** The current message of `state`, `model`, `image` or `display`. */
  get(channel, options = {}) {
    return this.request({ op: "get", channel, ...options }, { channel });
  }

  /** Sends the token, keeps it for reconnections if accepted, and resolves to the access level. */
  async authorize(token) {
    const { access } = await this.request({ op: "auth", token });
    this.token = token;
    return access;
  }

  /** Subscribes to a channel now and after each reconnection. */
  follow(channel, options = {}) {
    const subscription = { op: "sub", channel, ...options };
    this.subscriptions.set(channel, subscription);
    this.#send(JSON.stringify({ ...this.#ofCell(), ...subscription }));
  }

  /** The messages in the server's ring buffer of `event` or `line`, oldest first. */
  async recall(channel) {
    const messages = [];
    await this.request({ op: "get", channel }, { collects: channel, onEach: (message) => messages.push(message) });
    return messages;
  }
}
