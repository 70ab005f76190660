// Where the page has its token from, and where it keeps it: behind the # of the address, which browsers do
// not send, and from there in this tab's own memory, so that a reload need not ask for it again.

const kKey = "xr3-token";

/** The token of a fragment, as it is meant: `+` is a plus, only % is decoded. Null where there is none. */
export function tokenOf(fragment) {
  const given = /(?:^#?|&)token=([^&]*)/.exec(fragment)?.[1];
  return given ? decoded(given) : null;
}
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a lone % of a token that was never encoded
  }
}

/** Takes the token out of the address bar, where it would be copied along; null where there is none. */
export function takeFromAddress() {
  const token = tokenOf(location.hash);
  if (token !== null) history.replaceState(null, "", location.pathname + location.search);
  return token;
}

// A browser that is told to keep nothing throws here: then it is asked for after each reload.
export function kept() {
  try {
    return sessionStorage.getItem(kKey) ?? "";
  } catch {
    return "";
  }
}
export function keep(token) {
  try {
    if (token) sessionStorage.setItem(kKey, token);
    else sessionStorage.removeItem(kKey);
  } catch {
    return;
  }
}
