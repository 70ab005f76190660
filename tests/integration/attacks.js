// Tries all the ways in which a page can make a browser send requests to a port or read the answers, in parallel.
// Returns a list of [attempt, outcome]; "read: ..." is text of an answer that the page could read.
async (base, call) => {
  const tried = [];
  const patience_ms = 3000;
  const late = () => new Promise(done => setTimeout(() => done("nothing"), patience_ms));
  const attempt = (name, what) =>
    tried.push(Promise.race([what().catch(() => "failed"), late()]).then(came => [name, came]));
  const got = async answer => answer.type == "opaque" ? "opaque" : `read: ${answer.status} ${await answer.text()}`;
  const element = (tag, members) => new Promise(done => {
    const made = Object.assign(document.createElement(tag), members);
    made.onload = () => done("loaded");
    made.onerror = () => done("error");
    document.body.append(made);
  });
  const frame = async (name, start) => {
    const inner = document.createElement("iframe");
    inner.name = name;
    const loaded = new Promise(done => { inner.onload = done; });
    document.body.append(inner);
    await loaded;
    const again = new Promise(done => { inner.onload = done; });
    start(inner);
    await Promise.race([again, late()]);
    try {
      const text = inner.contentDocument.documentElement.innerText;
      return text ? `read: ${text}` : "empty";
    } catch {
      return "closed to us";
    }
  };

  for (const mode of ["cors", "no-cors", "same-origin", "navigate"]) {
    for (const path of ["", "state", "robot", "healthz", "metrics", "schema/v1.json"]) {
      attempt(`fetch ${mode} /${path}`, () => fetch(base + path, {mode}).then(got));
    }
    for (const method of ["POST", "PUT", "DELETE", "PATCH", "HEAD", "OPTIONS"]) {
      const body = method == "HEAD" ? undefined : call;
      attempt(`fetch ${mode} ${method}`, () => fetch(base, {mode, method, body}).then(got));
    }
    attempt(`fetch ${mode} as JSON`, () => fetch(base, {
      mode, method: "POST", body: call, headers: {"content-type": "application/json"}}).then(got));
  }
  attempt("beacon", async () => { navigator.sendBeacon(base, call); return "sent"; });
  for (const protocols of [[], ["xr3.v1"]]) {
    attempt(`WebSocket ${protocols}`, () => new Promise(done => {
      const socket = new WebSocket(base.replace("http", "ws") + "ws", protocols);
      socket.onopen = () => socket.send(call);
      socket.onmessage = message => done(`read: ${message.data}`);
      socket.onerror = () => done("error");
    }));
  }
  attempt("events", () => new Promise(done => {
    const source = new EventSource(base + "state");
    source.onmessage = message => done(`read: ${message.data}`);
    source.onerror = () => { source.close(); done("error"); };
  }));
  for (const enctype of ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data"]) {
    attempt(`form ${enctype}`, () => frame(`form ${enctype}`, inner => {
      const form = document.createElement("form");
      Object.assign(form, {method: "post", enctype, action: base, target: inner.name});
      form.append(Object.assign(document.createElement("input"), {name: call.slice(0, -1), value: call.slice(-1)}));
      document.body.append(form);
      form.submit();
    }));
  }
  attempt("frame", () => frame("frame", inner => { inner.src = base; }));
  attempt("frame of state", () => frame("frame of state", inner => { inner.src = base + "state"; }));
  attempt("image", () => element("img", {src: base + "camera.png"}));
  attempt("drawing", () => element("img", {src: base + "view.svg"}));
  attempt("script", () => element("script", {src: base + "state"}));
  attempt("style", () => element("link", {rel: "stylesheet", href: base + "state"}));
  return Promise.all(tried);
}
