// The monitor's protocol over a WebSocket: requests with their answers, subscriptions that are renewed
// after every reconnection, a ping where nothing is heard, and messages of the channels handed on. It knows
// nothing of the page.
import { Refused } from "./refusal.js";

const kFirstRetryMs = 300;
const kLongestRetryMs = 3000;
const kAnswerWithinMs = 15000;
const kQuietMs = 5000; // of silence, before somebody asks
const kPongWithinMs = 5000;

const bytesOf = (text) => new TextEncoder().encode(text).length;
const kib = (bytes) => `${Math.ceil(bytes / 1024)} KiB`;

export class Connection {
  /**
   * @param {string} url of the WebSocket
   * @param {{onMessage: (message: object) => void, onStatus: (status: string) => void, onTokenRefused: (error: Error) => void}} handlers
   *   status is "connecting", "open", "silent" (it is there, but does not answer) or "lost"; `hello` comes as a message.
   */
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.token = "";
    this.subscriptions = new Map();
    this.pending = new Map();
    this.lastId = 0;
    this.retryMs = kFirstRetryMs;
    this.limits = {};
    setInterval(() => this.#askIfQuiet(), kQuietMs);
  }

  open() {
    this.heardAt = performance.now();
    this.socket = new WebSocket(this.url, "xr3.v1");
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
    setTimeout(() => this.open(), this.retryMs);
    this.retryMs = Math.min(this.retryMs * 1.6, kLongestRetryMs);
  }

  // --- Is it still there? A line that is cut, or a server that hangs, closes nothing.

  #askIfQuiet() {
    if (!this.socket || performance.now() - this.heardAt < kQuietMs) return;
    if (!this.isGreeted) return this.#giveUp();
    this.request({ op: "ping" }, { withinMs: kPongWithinMs }).catch((error) => error.isTimeout && this.#giveUp());
  }

  /** Leaves the socket alone, since its closing may take minutes, and tries another. */
  #giveUp() {
    const { socket } = this;
    socket.onmessage = socket.onclose = null;
    socket.close();
    this.#lost("silent");
  }

  // --- What comes.

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
    if (this.token && hello.access !== "control") hello.access = await this.#tryToken(hello.access);
    if (!this.isGreeted) return; // lost meanwhile
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

  /** Subscribes to everything again: what was refused without a token may be read with it. */
  renew() {
    for (const subscription of this.subscriptions.values()) this.#send(JSON.stringify(subscription));
  }

  // --- What goes.

  #send(text) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
  }

  /**
   * Asks and waits for the value of the result, or for the message of `channel`, where one is named, that bears
   * the id; messages of the channel `collects` go to `onEach` until then. Rejects with Refused, or when no answer
   * can come.
   */
  request(message, { channel, collects, onEach, withinMs = kAnswerWithinMs } = {}) {
    const id = ++this.lastId;
    const text = JSON.stringify({ ...message, id });
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Error("not connected"));
      if (this.#isTooBig(text)) return reject(this.#tooBig(text));
      const timer = setTimeout(() => this.#late(id), withinMs);
      this.pending.set(id, { resolve, reject, timer, channel, collects, onEach });
      this.#send(text);
    });
  }

  // The server would end the connection.
  #isTooBig(text) {
    return bytesOf(text) > (this.limits.message_bytes ?? Infinity);
  }
  #tooBig(text) {
    return new Error(`too big to be sent: ${kib(bytesOf(text))}, and the server takes at most ${kib(this.limits.message_bytes)} at once`);
  }

  #late(id) {
    const { reject } = this.pending.get(id);
    this.pending.delete(id);
    reject(Object.assign(new Error("the server did not answer"), { isTimeout: true }));
  }

  call(fn, args = {}) {
    return this.request({ op: "call", fn, args });
  }

  /** The newest message of `state`, `model`, `image` or `display`, as the server has it now. */
  get(channel, options = {}) {
    return this.request({ op: "get", channel, ...options }, { channel });
  }

  /** Gives the token, and remembers it for the next connection if it is right; tells the access. */
  async authorize(token) {
    const { access } = await this.request({ op: "auth", token });
    this.token = token;
    return access;
  }

  /** Follows a channel from now on, and again after each reconnection. */
  follow(channel, options = {}) {
    const subscription = { op: "sub", channel, ...options };
    this.subscriptions.set(channel, subscription);
    this.#send(JSON.stringify(subscription));
  }

  /** The messages that the ring of `event` or `line` still holds, oldest first. */
  async recall(channel) {
    const messages = [];
    await this.request({ op: "get", channel }, { collects: channel, onEach: (message) => messages.push(message) });
    return messages;
  }
}
