// What tests of pages need of the machine: Chromium (RETARGET_CHROMIUM, else /usr/bin/chromium) and
// playwright-core (in RETARGET_NODE_MODULES). Without them the test is skipped: exit code 77.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const executablePath = process.env.RETARGET_CHROMIUM ?? "/usr/bin/chromium";
const kSoftwareGl = [
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-gpu-rasterization", // the processor draws the page faster without a detour
  "--disable-accelerated-2d-canvas",
];

export function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

function playwright() {
  try {
    const home = resolve(process.env.RETARGET_NODE_MODULES ?? "node_modules");
    return createRequire(join(home, "here.js"))("playwright-core");
  } catch (error) {
    return skip(`playwright-core not found: ${error.message.split("\n")[0]}`);
  }
}

if (!existsSync(executablePath)) skip(`no ${executablePath}`);
const { chromium } = playwright();

export const launch = (args = kSoftwareGl) =>
  chromium.launch({ executablePath, args: ["--no-sandbox", ...args] });

// Adds to `noise` what the page's console says and what goes wrong in its scripts.
export function listen(page, noise) {
  page.on("console", (message) => noise.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => noise.push(`error: ${error.message}`));
}
