// Runs Khronos' gltf-validator on files:
//   node validate_glb.mjs FILE...
// Prints one line of JSON, {"FILE": {"errors": n, "warnings": n, "infos": n, "hints": n,
// "messages": [...]}}. Exit code: 0 no errors and no warnings, 1 some, 2 bad usage or an unreadable
// file, 3 the validator is not installed. It is looked for in the directory that
// RETARGET_NODE_MODULES names (a node_modules folder or one that holds it), else in ./node_modules.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node validate_glb.mjs FILE...");
  process.exit(2);
}

let validator;
try {
  const home = resolve(process.env.RETARGET_NODE_MODULES || "node_modules");
  validator = createRequire(join(home, "here.js"))("gltf-validator");
} catch (error) {
  console.error(`gltf-validator not found: ${error.message.split("\n")[0]}`);
  process.exit(3);
}

const verdict = {};
let clean = true;
for (const file of files) {
  let bytes;
  try {
    bytes = new Uint8Array(readFileSync(file));
  } catch (error) {
    console.error(error.message);
    process.exit(2);
  }
  const { issues } = await validator.validateBytes(bytes);
  verdict[file] = {
    errors: issues.numErrors,
    warnings: issues.numWarnings,
    infos: issues.numInfos,
    hints: issues.numHints,
    messages: issues.messages.slice(0, 20),
  };
  clean &&= issues.numErrors === 0 && issues.numWarnings === 0;
}
console.log(JSON.stringify(verdict));
process.exit(clean ? 0 : 1);
