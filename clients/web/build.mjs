// Bundles the page into dist/: one script, one style sheet, index.html and the icon. The server's
// build embeds these files in its binary (server/resources/web_assets.cmake).
import { build } from "esbuild";
import { copyFile, mkdir, readFile, rm, stat } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const kMaxBundleBytes = 800_000;
const path = (name) => fileURLToPath(new URL(name, import.meta.url)); // (an address has %20 for a blank)

await rm(path("dist"), { recursive: true, force: true });
await mkdir(path("dist/assets"), { recursive: true });
await build({
  entryPoints: [path("src/main.js"), path("src/style.css")],
  outdir: path("dist/assets"),
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "none",
  logLevel: "warning",
});
await copyFile(path("src/index.html"), path("dist/index.html"));
await copyFile(path("src/icon.svg"), path("dist/assets/icon.svg"));
for (const library of ["three", "uplot"])
  await copyFile(path(`node_modules/${library}/LICENSE`), path(`dist/assets/${library}-license.txt`));

const { size } = await stat(path("dist/assets/main.js"));
await readFile(path("dist/index.html"));
console.log(`viewer: ${Math.round(size / 1000)} kB of script`);
if (size > kMaxBundleBytes) throw new Error(`the script has ${size} bytes, the limit is ${kMaxBundleBytes}`);
