// One page in, one file out: `PAGE=report vite build --outDir DIR` writes DIR/report.html. The
// script is inlined as a classic one, for pages opened from disk: browsers refuse modules there.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const page = process.env.PAGE ?? "report";

// The bundle stands at the end of the body, where everything that it reads has been parsed.
function classicScriptLast(): Plugin {
  return {
    name: "classic-script-last",
    writeBundle({ dir }) {
      const path = join(dir!, `${page}.html`);
      const html = readFileSync(path, "utf8");
      const script = /<script type="module"[^>]*>([\s\S]*?)<\/script>\s*/.exec(html);
      if (!script?.[1]) throw new Error(`${path}: no inlined script`);
      const rest = html.slice(0, script.index) + html.slice(script.index + script[0].length);
      const end = rest.lastIndexOf("</body>");
      writeFileSync(path, `${rest.slice(0, end)}<script>${script[1]}</script>\n${rest.slice(end)}`);
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [viteSingleFile(), classicScriptLast()],
  build: {
    target: "es2020",
    modulePreload: false,
    emptyOutDir: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 4096,
    rollupOptions: { input: `${page}.html`, output: { format: "iife" } },
  },
});
