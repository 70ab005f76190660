// Shows the robot of a link (play.py) in the page. One is alive at a time: the next one takes its place, and its link returns.
"use strict";
(() => {
  /** @type {{place: Element, link: Element} | null} */
  let shown = null;

  function hide() {
    shown?.place.replaceChildren(shown.link);
    shown = null;
  }

  function show(link) {
    const place = link.parentElement;
    const frame = Object.assign(document.createElement("iframe"), { src: link.href, title: "A robot without a server" });
    const close = Object.assign(document.createElement("button"), { type: "button", textContent: "Close it", onclick: hide });
    const own = Object.assign(document.createElement("a"), { href: link.href, target: "_blank", textContent: "In a tab of its own" });
    place.replaceChildren(frame, close, own);
    shown = { place, link };
    frame.focus();
  }

  document.addEventListener("click", (event) => {
    const link = event.target.closest?.(".robot > a.md-button");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return; // the browser opens a tab
    event.preventDefault();
    hide();
    show(link);
  });
})();
