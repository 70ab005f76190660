// @ts-check
// Where programs connect to the robot, as text.

/** @typedef {number | null} Port of the robot; null if the page may not know it */

/** The host by which this page was opened. */
const host = () => location.hostname.replace(/^\[|\]$/g, ""); // an IPv6 address has brackets

/** @param {Port} port */
export const addressOf = (port) => `${host()}, port ${port ?? "as xr3 serve has printed it"}`;

/** Lines that connect a program: in a terminal, and in Python. @param {Port} port */
export const linesOf = (port) => (port === null ? [] : [`nc ${host()} ${port}`, `import xr3; robot = xr3.connect(host="${host()}", port=${port})`]);

/** As programs take it in one word. @param {number} port */
export const hostAndPort = (port) => `${location.hostname}:${port}`;
