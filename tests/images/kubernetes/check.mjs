// Checks Kubernetes objects, a JSON array on standard input, against the OpenAPI document of Kubernetes, from
// which the package kubernetes-models is generated: its validators check values, and its types, with
// TypeScript, find members that do not exist. (The validators allow those.) Prints a line for each fault.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import ts from "typescript";

const objects = JSON.parse(readFileSync(0, "utf8"));
const place = (object) => `${object.kind} ${object.metadata?.name}`;
const modelOf = (object) => `kubernetes-models/${object.apiVersion}/${object.kind}`;

async function invalidValues(object) {
  let model;
  try {
    model = (await import(modelOf(object)))[object.kind];
  } catch {
    return [`${place(object)}: ${object.apiVersion} has no such kind`];
  }
  try {
    new model(object).validate();
    return [];
  } catch (fault) {
    return [`${place(object)}: ${fault.message}`];
  }
}

/** A program that assigns every object to a variable of its type. */
function program() {
  return objects.map((object, i) =>
    `import type { I${object.kind} as Type${i} } from "${modelOf(object)}";\n` +
    `export const object${i}: Type${i} = ${JSON.stringify(object, null, 1)};\n`).join("");
}

function wrongTypes() {
  const name = fileURLToPath(new URL("manifests.ts", import.meta.url));
  const options = {
    noEmit: true, strict: true, skipLibCheck: true, types: [], target: ts.ScriptTarget.ES2022,
    module: ts.ModuleKind.ESNext, moduleResolution: ts.ModuleResolutionKind.Bundler,
  };
  const host = ts.createCompilerHost(options);
  const { readFile, fileExists, getSourceFile } = host;
  host.fileExists = (file) => file === name || fileExists(file);
  host.readFile = (file) => (file === name ? program() : readFile(file));
  host.getSourceFile = (file, version) =>
    file === name ? ts.createSourceFile(file, program(), version) : getSourceFile.call(host, file, version);
  return ts.getPreEmitDiagnostics(ts.createProgram([name], options, host)).map((found) => {
    const text = ts.flattenDiagnosticMessageText(found.messageText, " ");
    const line = found.file?.text.split("\n")[found.file.getLineAndCharacterOfPosition(found.start).line];
    return `${line?.trim()}: ${text}`;
  });
}

const faults = [...(await Promise.all(objects.map(invalidValues))).flat(), ...wrongTypes()];
for (const fault of faults) console.log(fault);
