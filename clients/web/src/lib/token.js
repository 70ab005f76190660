// @ts-check
// The token: read from the URL fragment, which browsers do not send to the server, and kept in the
// tab's sessionStorage, so that it survives a reload.

const kKey = "xr3-token";

/** The token in a fragment, or null. Only % is decoded: `+` is a plus. @param {string} fragment */
export function tokenOf(fragment) {
  const given = /(?:^#?|&)token=([^&]*)/.exec(fragment)?.[1];
  return given ? decoded(given) : null;
}
/** @param {string} text */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a lone % in a token that was not encoded
  }
}

/**
 * Returns the token in the address, or null, and removes it there, lest it be copied with the URL.
 */
export function takeFromAddress() {
  const token = tokenOf(location.hash);
  if (token !== null) history.replaceState(null, "", location.pathname + location.search);
  return token;
}

// sessionStorage throws if the browser blocks storage: the token is then lost on reload.
export function kept() {
  try {
    return sessionStorage.getItem(kKey) ?? "";
  } catch {
    return "";
  }
}
/** @param {string | null} token empty: forgets it */
export function keep(token) {
  try {
    if (token) sessionStorage.setItem(kKey, token);
    else sessionStorage.removeItem(kKey);
  } catch {
    return;
  }
}
