// One person at the studio: a server of one's own, a page of it, and what hands do there.
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { after, before, test } from "node:test";
import { launch, listen, skip } from "./browser.mjs";
import { hasStudio, StudioServer } from "./studio_server.mjs";

// The program, and the folder that the test is about.
export const [program, folder] = process.argv.slice(2).map((path) => resolve(path));
if (!hasStudio(program)) skip("the program has no studio");

export const noise = []; // what the console of the page said; none is left when a test ends
export let server, page;
let browser;

before(async () => {
  browser = await launch();
});
after(() => browser?.close());

// A test with a server, a library and so a session of its own: nothing is left of the one before.
// `args` are the server's; without a template it begins with two T-poses. `prepare` is
// told the library's folder, still empty. The size is that of the page: fewer pixels are less work
// for a processor that draws.
export function studioTest(name, { args = [], prepare, ...size }, act) {
  test(name, async () => {
    server = new StudioServer(program);
    try {
      prepare?.(server.library);
      await server.start(...args);
      await blankPage(size);
      await open();
      await act();
      assert.deepEqual(noise, []);
      await page.goto("about:blank"); // before the server goes, which the studio would miss
    } catch (error) {
      await page?.context().close();
      page = null;
      throw error;
    } finally {
      await server.remove();
    }
  });
}

// The tab is kept as long as all goes well, since a new one takes its time. Each server has a port,
// and the page by it a storage, of its own.
async function blankPage({ width = 1060, height = 620 }) {
  if (!page) {
    page = await browser.newPage();
    listen(page, noise);
  }
  await page.setViewportSize({ width, height });
  await page.mouse.move(0, 0);
  noise.splice(0);
}

// Ends the studio and starts it anew at the same port; the page opens what it is given.
export async function restart(...args) {
  await server.restart(...args);
  await open();
}

async function open() {
  await page.goto(server.url, { timeout: 120000 });
  if ((await page.content()).length < 1e5) skip("the program was built without the studio's page");
  await until(() => Boolean(window.retargetStudio));
  await idle();
}

// The page's policy forbids what page.waitForFunction does.
export async function until(holds, argument) {
  for (let tries = 0; tries < 1500; ++tries) {
    if (await page.evaluate(holds, argument).catch(() => false)) return;
    await page.waitForTimeout(20);
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
// What the controls would send, as one step of the history.
export async function operate(...ops) {
  assert.ok(await page.evaluate((all) => window.retargetStudio.do(...all), ops));
  await idle();
}
export const tab = (name) => page.click(`#tab-${name}`);

export async function fromRest() {
  await page.keyboard.press("n");
  await page.getByRole("button", { name: "Start from rest" }).click();
  await until(() => !document.querySelector("dialog"));
  await idle();
}
