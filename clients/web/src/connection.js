// The monitor's protocol over a WebSocket: requests with their answers, subscriptions that are renewed
// after every reconnection, and messages of the channels handed on. It knows nothing of the page.

const kFirstRetryMs = 300;
const kLongestRetryMs = 3000;
const kAnswerWithinMs = 15000;

/** An error that the server answered: `code`, `message`, `hint`, `details`. */
export class Refused extends Error {
  constructor({ code, message, hint, details }) {
    super(hint ? `${message} (${hint})` : message);
    Object.assign(this, { code, hint, details });
  }
}

export class Connection {
  /**
   * @param {string} url of the WebSocket
   * @param {{onMessage: (message: object) => void, onStatus: (status: string) => void}} handlers
   *   status is "connecting", "open" or "lost"; `hello` comes as a message.
   */
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.token = "";
    this.subscriptions = new Map();
    this.pending = new Map();
    this.lastId = 0;
    this.retryMs = kFirstRetryMs;
    this.lastSeq = new Map();
  }

  open() {
    this.handlers.onStatus("connecting");
    this.socket = new WebSocket(this.url, "xr3.v1");
    this.socket.onmessage = ({ data }) => this.#take(JSON.parse(data));
    this.socket.onclose = () => this.#lost();
  }

  #lost() {
    for (const { reject } of this.pending.values()) reject(new Error("the connection was lost"));
    this.pending.clear();
    this.handlers.onStatus("lost");
    setTimeout(() => this.open(), this.retryMs);
    this.retryMs = Math.min(this.retryMs * 1.6, kLongestRetryMs);
  }

  #take(message) {
    if (message.op === "hello") return this.#greeted(message);
    if (message.op === "event" || message.op === "line") this.lastSeq.set(message.op, message.seq);
    const waiting = this.pending.get(message.id);
    if (!waiting || !["result", "pong", waiting.channel].includes(message.op)) return this.handlers.onMessage(message);
    this.pending.delete(message.id);
    clearTimeout(waiting.timer);
    if (message.ok === false) waiting.reject(new Refused(message.error));
    else waiting.resolve(message.op === waiting.channel ? message : message.value);
  }

  async #greeted(hello) {
    this.retryMs = kFirstRetryMs;
    this.handlers.onStatus("open");
    if (this.token && hello.access !== "control") {
      hello.access = await this.request({ op: "auth", token: this.token }).then(
        (value) => value.access,
        () => hello.access,
      );
    }
    this.handlers.onMessage(hello);
    for (const subscription of this.subscriptions.values()) this.#send(subscription);
  }

  #send(message) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /**
   * Asks and waits for the value of the result, or for the message of `channel`, where one is named, that bears
   * the id; rejects with Refused, or when the connection is lost.
   */
  request(message, channel) {
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Error("not connected"));
      const timer = setTimeout(() => {
        this.pending.delete(id);
        reject(new Error("the server did not answer"));
      }, kAnswerWithinMs);
      this.pending.set(id, { resolve, reject, timer, channel });
      this.#send({ ...message, id });
    });
  }

  call(fn, args = {}) {
    return this.request({ op: "call", fn, args });
  }

  /** The newest message of `state`, `model`, `image` or `display`, as the server has it now. */
  get(channel, options = {}) {
    return this.request({ op: "get", channel, ...options }, channel);
  }

  async authorize(token) {
    this.token = token;
    return (await this.request({ op: "auth", token })).access;
  }

  /** Follows a channel from now on, and again after each reconnection. */
  follow(channel, options = {}) {
    const subscription = { op: "sub", channel, ...options };
    this.subscriptions.set(channel, subscription);
    this.#send(subscription);
  }

  unfollow(channel) {
    if (this.subscriptions.delete(channel)) this.#send({ op: "unsub", channel });
  }

  /** What the ring of `event` or `line` still holds; the messages come as they do when followed. */
  recall(channel) {
    return this.request({ op: "get", channel });
  }
}
