// One person at the studio: its server, a browser with its page, and what hands do there.
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before } from "node:test";

export const [program, hold] = process.argv.slice(2).map((path) => resolve(path));
const chromiumPath = process.env.RETARGET_CHROMIUM ?? "/usr/bin/chromium";

function skip(reason) {
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
if (!existsSync(chromiumPath)) skip(`no ${chromiumPath}`);
const { chromium } = playwright();

const kSoftwareGl = [
  "--no-sandbox",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-gpu-rasterization", // the processor draws the page faster without a detour
  "--disable-accelerated-2d-canvas",
];
const scratch = mkdtempSync(join(tmpdir(), "retarget-studio-"));
export const library = join(scratch, "library");
const clips = ["--clip-a", join(hold, "a.bvh"), "--clip-b", join(hold, "b.bvh")];
export const noise = []; // what the console said
export let page;
let server, url, browser;

// Starts the studio; resolves with its address.
function serve(...more) {
  mkdirSync(library, { recursive: true });
  server = spawn(program, ["studio", "--no-browser", "--library", library, ...clips, ...more], {
    env: { ...process.env, HOME: scratch, XDG_DATA_HOME: join(scratch, "data") },
  });
  return new Promise((done, failed) => {
    let said = "";
    server.stdout.on("data", (data) => {
      said += data;
      const found = /http:\/\/127\.0\.0\.1:\d+\/\?token=\S+/.exec(said);
      if (found) done(found[0]);
    });
    server.stderr.on("data", (data) => (said += data));
    server.on("exit", () => failed(new Error(`the studio ended: ${said}`)));
  });
}
const stopServer = () =>
  new Promise((done) => {
    server.removeAllListeners("exit");
    server.once("exit", done);
    server.kill("SIGINT");
  });

const usage = spawnSync(program, ["studio", "--help"], { encoding: "utf8" });
if (usage.status !== 0 || /no page/.test(usage.stdout)) skip("the program has no studio");

before(async () => {
  url = await serve("--template", join(hold, "template.yaml"));
  if ((await (await fetch(url)).text()).length < 1e5)
    skip("the program was built without the studio's page");
  browser = await chromium.launch({ executablePath: chromiumPath, args: kSoftwareGl });
  page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.on("console", (message) => noise.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => noise.push(`error: ${error.message}`));
  await open();
});
after(async () => {
  await browser?.close();
  if (server?.exitCode === null) await stopServer();
  rmSync(scratch, { recursive: true });
});

// Ends the studio and starts it anew at the same port; the page opens what it is given.
export async function restart() {
  const { port } = new URL(url);
  await stopServer();
  url = await serve("--port", port);
  await open();
}

async function open() {
  await page.goto(url, { timeout: 120000 });
  await until(() => Boolean(window.retargetStudio));
  await idle();
}

// The page's policy forbids what page.waitForFunction does.
export async function until(holds, argument) {
  for (let tries = 0; tries < 600; ++tries) {
    if (await page.evaluate(holds, argument).catch(() => false)) return;
    await page.waitForTimeout(50);
  }
  throw new Error(`never came true: ${holds}`);
}

// -- A person's hands -----------------------------------------------------------------------------

export const idle = () => page.evaluate(() => window.retargetStudio.idle());
export const state = async () => {
  await idle();
  return page.evaluate(() => window.retargetStudio.state());
};
export const ui = () => page.evaluate(() => window.retargetStudio.ui);
export const at = (name, view = "main") =>
  page.evaluate(([n, v]) => window.retargetStudio.project(...n.split("/"), v), [name, view]);
export const nodes = [
  "root",
  "chest",
  "neck",
  "head",
  "head_top",
  ...["left", "right"].flatMap((s) =>
    ["shoulder", "elbow", "wrist", "hand"].map((n) => `${s}_${n}`),
  ),
  ...["left", "right"].flatMap((s) => ["hip", "knee", "ankle", "toe"].map((n) => `${s}_${n}`)),
];
export const place = (of, name) => of.figures[name[0]].nodes[nodes.indexOf(name.slice(2))];
export const distance = (p, q) => Math.hypot(...p.map((x, k) => x - q[k]));
export const posture = ({ figures, holds, pins, name, supports, tangles, options }) => ({
  figures,
  holds,
  pins,
  name,
  supports,
  tangles,
  options,
});

export async function press(key) {
  await page.keyboard.press(key);
  await idle();
}
export async function click(name, view) {
  const { x, y } = await at(name, view);
  await page.mouse.click(x, y);
  await idle();
}
// Drags by mouse events; the button stays down where `hold` says so.
export async function drag(name, dx, dy, { view = "main", steps = 4, release = true } = {}) {
  const { x, y } = await at(name, view);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  if (release) await page.mouse.up();
  await idle();
}
// Pixels per metre of a side view, from two nodes that are apart in it.
export async function scaleOf(view) {
  const now = await state();
  const [p, q] = [place(now, "a/head_top"), place(now, "a/left_toe")];
  const [u, v] = [await at("a/head_top", view), await at("a/left_toe", view)];
  return (v.y - u.y) / (p[1] - q[1]);
}
export const tab = (name) => page.click(`#tab-${name}`);

export async function fromRest() {
  await page.keyboard.press("n");
  await page.getByRole("button", { name: "Start from rest" }).click();
  await until(() => !document.querySelector("dialog"));
  await idle();
}
