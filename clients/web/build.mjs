// Bundles the page: one script, one style sheet, index.html and the icon.
//   node build.mjs               into dist/, which the server's build embeds in its binary (server/resources/web_assets.cmake)
//   node build.mjs --here DIR    into DIR, for a page that has the robot in itself: also the workers. DIR has xr3.wasm and data/
//                                already (scripts/playground)
import { build } from "esbuild";
import { copyFile, mkdir, readdir, readFile, rm, stat, writeFile } from "node:fs/promises";
import { createHash } from "node:crypto";
import { join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const kMaxBundleBytes = 880_000;
// A static host sends no policy: the page brings its own, which its worker inherits. `wasm-unsafe-eval` compiles
// WebAssembly; scripts from texts stay forbidden.
const kPolicy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; img-src 'self' data: blob:; font-src 'none'; object-src 'none'; base-uri 'self'; form-action 'none'";

const kNotice = `xr3 is under the licence MIT. This folder also has, each under its own licence:

three.js, uPlot, uqr, CodeMirror   MIT: assets/*-license.txt
${`Pyodide ${JSON.parse(await readFile(new URL("node_modules/pyodide/package.json", import.meta.url), "utf8")).version}`.padEnd(30)}Mozilla Public License 2.0: licences/pyodide.txt. It is unchanged; its source is at https://github.com/pyodide/pyodide
CPython, in Pyodide           Python Software Foundation License, with those of the libraries in it, such as expat, libffi, libmpdec
                              and zlib: licences/cpython.txt. Pyodide also has bzip2, liblzma and SQLite.
xr3.wasm                      has Eigen (Mozilla Public License 2.0, unchanged: https://eigen.tuxfamily.org), nlohmann/json (MIT), and
                              of Emscripten musl (MIT) and libc++ (Apache License 2.0 with LLVM Exceptions): licences/
`;

const path = (name) => fileURLToPath(new URL(name, import.meta.url)); // (an address has %20 for a blank)
const isHere = process.argv[2] === "--here";
const out = isHere ? resolve(process.argv[3]) : path("dist");
const { version } = JSON.parse(await readFile(path("package.json"), "utf8"));

/** index.html for a page that has the robot in itself, in whatever folder of a host. */
const forHere = (html) => html.replaceAll('"/assets/', '"assets/').replace("<html ", '<html data-robot="here" ')
  .replace("<meta charset=\"utf-8\">", `$&\n    <meta http-equiv="Content-Security-Policy" content="${kPolicy}">`);

/** The names of the robots that the page can have, with their titles. */
async function robots() {
  const names = (await readdir(path("../../data/robots"))).filter((name) => name.endsWith(".json")).map((name) => name.slice(0, -5));
  return Promise.all(names.map(async (name) => {
    const text = await readFile(path(`../../data/robots/${name}.json`), "utf8"); // with comments, so not JSON
    return { name, title: /"name": *"([^"]+)"/.exec(text)[1] };
  }));
}

/** The programs of data/examples, with the titles in their first lines. */
async function examples() {
  const names = (await readdir(join(out, "data/examples"))).sort();
  return Promise.all(names.map(async (name) => ({ name, title: /^"""([^:]+):/.exec(await readFile(join(out, "data/examples", name), "utf8"))?.[1] ?? name })));
}

/** The exercises of data/course, with their titles and the programs with which they begin. */
async function exercises() {
  const names = (await readdir(join(out, "data/course"))).sort();
  return Promise.all(names.map(async (name) => {
    const folder = join(out, "data/course", name);
    const [starter] = await readdir(join(folder, "starter"));
    return { name, title: JSON.parse(await readFile(join(folder, "exercise.json"), "utf8")).title, starter };
  }));
}

/** The package xr3 for completion and Help (src/lib/python_api.js), without the last section of docs/python-api.md, which is not for the page. A test
 * compares docs/python-api.md with the docstrings. */
async function pythonApi() {
  const [reference, elsewhere] = (await readFile(path("../../docs/python-api.md"), "utf8")).split("\n## Servers and verdicts\n");
  const names = [.../__all__ = \[(.*?)\]/s.exec(await readFile(path("../../clients/python/xr3/__init__.py"), "utf8"))[1].matchAll(/\w+/g)];
  const here = names.filter(([name]) => !elsewhere.includes(`\n### ${name}\n`));
  const api = { xr3: Object.fromEntries(here.map(([name]) => [name, { args: "", form: name, text: "" }])) };
  for (const [, heading, code, paragraph] of reference.matchAll(/^####? ([\w.]+)\n\n```python\n(.+?)\n```\n\n(.+?)\n\n/gms)) {
    const [owner, name] = heading.includes(".") ? heading.split(".") : ["xr3", heading];
    (api[owner] ??= {})[name] = described(code.replace(/\s+/g, " "), paragraph.replace(/\s+/g, " "));
  }
  return api;
}
const withoutBrackets = (text) => {
  const shorter = text.replace(/\[[^[\]]*\]/g, "");
  return shorter === text ? text : withoutBrackets(shorter);
};
/** The arguments of a signature that must be given, and those with a number as default. */
function argumentsOf(form) {
  const inside = form.startsWith("class ") ? null : /\((.*?)\)/.exec(withoutBrackets(form));
  const named = (each) => each.replace(/: \w*( = )?/, (_, isOptional) => (isOptional ? "=" : ""));
  return inside ? `(${inside[1].split(", ").filter((each) => !/\*|= (?![\d.]+$)/.test(each)).map(named).join(", ")})` : "";
}
const described = (form, text) => ({ args: argumentsOf(form), form, text: text.split(/(?<=\.) /)[0].replaceAll("`", "") });

/** The bytes that come by fetch() when Python is loaded; scripts are imported. */
async function pythonBytes() {
  const files = (await readdir(join(out, "python"))).filter((name) => /\.(wasm|zip|json)$/.test(name));
  const sizes = await Promise.all(files.map(async (name) => (await stat(join(out, "python", name))).size));
  return sizes.reduce((sum, size) => sum + size, 0);
}

/** The service worker, last, since it knows all other files of the folder but the licences. */
async function bundleOffline() {
  const names = (await readdir(out, { recursive: true, withFileTypes: true })).filter((entry) => entry.isFile() && entry.name !== "offline.js" && !entry.name.endsWith(".txt"))
    .map(({ parentPath, path: older, name }) => relative(out, join(parentPath ?? older, name)));
  const sum = createHash("sha256");
  for (const name of names.sort()) sum.update(name).update(await readFile(join(out, name)));
  await build({
    entryPoints: [path("src/machine/offline.js")], outdir: out, bundle: true, minify: true, format: "iife", target: "es2022", logLevel: "warning",
    define: { XR3_FILES: JSON.stringify({ version: sum.digest("hex").slice(0, 16), names }) },
  });
}

await rm(join(out, isHere ? "assets" : ""), { recursive: true, force: true });
await mkdir(join(out, "assets"), { recursive: true });
await build({
  entryPoints: ["src/main.js", "src/style.css", ...(isHere ? ["src/machine/worker.js", "src/machine/server_worker.js", "src/program/editor.js"] : [])].map(path),
  entryNames: "[name]",
  outdir: join(out, "assets"),
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "none",
  logLevel: "warning",
  define: { XR3_VERSION: JSON.stringify(version), ...(isHere ? { XR3_PYTHON_BYTES: String(await pythonBytes()) } : {}) },
});
const html = await readFile(path("src/index.html"), "utf8");
await writeFile(join(out, "index.html"), isHere ? forHere(html) : html);
await copyFile(path("src/icon.svg"), join(out, "assets/icon.svg"));
for (const library of ["three", "uplot", "uqr"])
  await copyFile(path(`node_modules/${library}/LICENSE`), join(out, `assets/${library}-license.txt`));

if (isHere) {
  await copyFile(path("node_modules/codemirror/LICENSE"), join(out, "assets/codemirror-license.txt"));
  await writeFile(join(out, "NOTICE.txt"), kNotice);
  await mkdir(join(out, "data"), { recursive: true });
  await writeFile(join(out, "data/robots.json"), JSON.stringify(await robots()));
  await writeFile(join(out, "data/examples.json"), JSON.stringify(await examples()));
  await writeFile(join(out, "data/course.json"), JSON.stringify(await exercises()));
  await writeFile(join(out, "data/python.json"), JSON.stringify(await pythonApi()));
  await bundleOffline();
}

const { size } = await stat(join(out, "assets/main.js"));
console.log(`viewer: ${Math.round(size / 1000)} kB of script`);
if (size > kMaxBundleBytes) throw new Error(`the script has ${size} bytes, the limit is ${kMaxBundleBytes}`);
