// Modules of the pages for a test without a browser, bundled by what their build has installed.
import { existsSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

export const canBundle = (build) => existsSync(join(build, "node_modules"));

// All that `paths` export, such as "shared/gli", from the copy of the sources in `build`. `name`
// is the bundle's.
export async function modulesOf(build, name, paths) {
  const { buildSync } = createRequire(resolve(build, "here.js"))("esbuild");
  const contents = paths.map((path) => `export * from "./src/${path}";`).join("\n");
  const { outputFiles } = buildSync({
    stdin: { contents, resolveDir: resolve(build) },
    bundle: true,
    write: false,
    format: "esm",
  });
  const bundle = resolve(build, `${name}.mjs`);
  writeFileSync(bundle, outputFiles[0].text);
  return import(pathToFileURL(bundle));
}
