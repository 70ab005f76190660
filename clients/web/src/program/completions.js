// @ts-check
// Completions of the package xr3: its names after `xr3.`, and methods after a name to which the program gives one of its objects.
import { ifNotIn } from "@codemirror/autocomplete";
import { pythonLanguage } from "@codemirror/lang-python";
import { pythonApi } from "../lib/python_api.js";

/** @typedef {import("../lib/python_api.js").PythonApi} PythonApi */

/** The function that gives a variable its value: `name = xr3.connect(`, `with xr3.Robot() as name`. @param {string} program @param {string} name */
function makerOf(program, name) {
  const assigned = new RegExp(String.raw`\b${name}\s*=\s*(?:\w+\.)*(\w+)\(|\bwith\s+(?:\w+\.)*(\w+)\(.*\)\s+as\s+${name}\b`).exec(program);
  return assigned?.[1] ?? assigned?.[2] ?? null;
}

/** The class of what a function of the package returns; a class returns its own objects. @param {PythonApi} api @param {string} maker */
function returnedBy(api, maker) {
  const form = Object.values(api).find((owner) => maker in owner)?.[maker].form ?? "";
  return /-> "?(\w+)"?$/.exec(form)?.[1] ?? maker;
}

/** @param {PythonApi} api @param {string} program @param {string} name */
function membersOf(api, program, name) {
  if (name in api) return api[name];
  const maker = makerOf(program, name) ?? (name === "robot" ? "connect" : null);
  return maker ? api[returnedBy(api, maker)] : null;
}

const isClass = (/** @type {string} */ name) => /^[A-Z]/.test(name);

/** @param {import("@codemirror/autocomplete").CompletionContext} context */
async function complete(context) {
  const before = context.matchBefore(/\b[A-Za-z_]\w*\.\w*/);
  if (!before) return null;
  const [name, begun] = before.text.split(".");
  const members = membersOf(await pythonApi(), context.state.doc.toString(), name);
  return members && {
    from: context.pos - begun.length, validFor: /^\w*$/,
    options: Object.entries(members).map(([label, { args, form, text }]) => ({ label, detail: args, info: `${form}\n${text}`, type: isClass(label) ? "class" : "method" })),
  };
}

export const completions = pythonLanguage.data.of({ autocomplete: ifNotIn(["String", "FormatString", "Comment"], complete) });
