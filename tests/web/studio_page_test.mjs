// The studio as a person meets it, in a browser, with the server that belongs to it:
//   node studio_page_test.mjs RETARGET HOLD
// HOLD is a folder with template.yaml, a.bvh and b.bvh. Exit code 77 where the program has no
// studio, or Chromium (RETARGET_CHROMIUM, else /usr/bin/chromium) or playwright-core (in
// RETARGET_NODE_MODULES) is not there. One page is used throughout: the tests are one person's work.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { deflateSync, crc32 } from "node:zlib";

const [program, hold] = process.argv.slice(2).map((path) => resolve(path));
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
];
const scratch = mkdtempSync(join(tmpdir(), "retarget-studio-"));
const library = join(scratch, "library");
const clips = ["--clip-a", join(hold, "a.bvh"), "--clip-b", join(hold, "b.bvh")];
const noise = []; // what the console said
let server, url, browser, page;

// Starts the studio; resolves with its address.
function serve(...more) {
  execFileSync("mkdir", ["-p", library]);
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

async function open(address = url) {
  await page.goto(address);
  await until(() => Boolean(window.retargetStudio));
  await idle();
}

// The page's policy forbids what page.waitForFunction does.
async function until(holds, argument) {
  for (let tries = 0; tries < 600; ++tries) {
    if (await page.evaluate(holds, argument).catch(() => false)) return;
    await page.waitForTimeout(50);
  }
  throw new Error(`never came true: ${holds}`);
}

// -- A person's hands ------------------------------------------------------------------------------

const idle = () => page.evaluate(() => window.retargetStudio.idle());
const state = async () => {
  await idle();
  return page.evaluate(() => window.retargetStudio.state());
};
const ui = () => page.evaluate(() => window.retargetStudio.ui);
const at = (name, view = "main") =>
  page.evaluate(([n, v]) => window.retargetStudio.project(...n.split("/"), v), [name, view]);
const nodes = [
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
const place = (of, name) => of.figures[name[0]].nodes[nodes.indexOf(name.slice(2))];
const distance = (p, q) => Math.hypot(...p.map((x, k) => x - q[k]));
const posture = ({ figures, holds, pins, name, supports, tangles, options }) => ({
  figures,
  holds,
  pins,
  name,
  supports,
  tangles,
  options,
});

async function press(key) {
  await page.keyboard.press(key);
  await idle();
}
async function click(name, view) {
  const { x, y } = await at(name, view);
  await page.mouse.click(x, y);
  await idle();
}
// Drags by mouse events; the button stays down where `hold` says so.
async function drag(name, dx, dy, { view = "main", steps = 6, release = true } = {}) {
  const { x, y } = await at(name, view);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  if (release) await page.mouse.up();
  await idle();
}
// Pixels per metre of a side view, from two nodes that are apart in it.
async function scaleOf(view) {
  const now = await state();
  const [p, q] = [place(now, "a/head_top"), place(now, "a/left_toe")];
  const [u, v] = [await at("a/head_top", view), await at("a/left_toe", view)];
  return (v.y - u.y) / (p[1] - q[1]);
}
const tab = (name) => page.click(`#tab-${name}`);

async function fromRest() {
  await page.keyboard.press("n");
  await page.getByRole("button", { name: "Start from rest" }).click();
  await until(() => !document.querySelector("dialog"));
  await idle();
}

// A picture of our own, PNG.
function picture(width, height) {
  const rows = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const k = y * (3 * width + 1) + 1 + 3 * x;
      rows.set([(255 * x) / width, (255 * y) / height, 120], k);
    }
  }
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(sum(body), body.length + 4);
    return out;
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  return Buffer.concat([
    signature,
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}
// CRC-32 of PNG; older versions of node have none.
function sum(bytes) {
  if (crc32) return crc32(bytes);
  let c = 0xffffffff;
  for (const byte of bytes) {
    c ^= byte;
    for (let k = 0; k < 8; ++k) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  }
  return (c ^ 0xffffffff) >>> 0;
}

// -- The work --------------------------------------------------------------------------------------

test("opens with the template that was named", async () => {
  const now = await state();
  assert.equal(await page.inputValue("#topbar .name"), now.name);
  assert.match(
    readFileSync(join(hold, "template.yaml"), "utf8"),
    new RegExp(`name: "?${now.name}`),
  );
  assert.equal(now.dirty, false);
  for (const name of ["a/head", "b/left_toe"]) {
    const { x, y } = await at(name);
    assert.ok(x > 40 && x < 950 && y > 40 && y < 700, `${name} is seen`);
  }
  const wide = await page.evaluate(() => [
    document.documentElement.scrollWidth - innerWidth,
    document.documentElement.scrollHeight - innerHeight,
  ]);
  assert.ok(
    wide.every((px) => px <= 0),
    `${wide}`,
  );
  await page.setViewportSize({ width: 1060, height: 620 }); // fewer pixels for a processor to draw
});

test("the list of tangles is that of `retarget tangles` on the saved file", async () => {
  await tab("library");
  await page.getByRole("button", { name: "Save as" }).click();
  await page.keyboard.type("bear hug again");
  await page.keyboard.press("Enter");
  await until(() => !document.querySelector("dialog"));
  let now = await state();
  const file = join(library, `${now.saved_as}.yaml`);
  assert.ok(existsSync(file));
  assert.equal(now.dirty, false);
  const told = JSON.parse(execFileSync(program, ["tangles", file, "--json"]));
  assert.ok(told.tags.length > 0);
  await tab("tangles");
  await idle();
  const rows = await page.locator("[data-tag]").all();
  assert.equal(rows.length, told.tags.length);
  for (const [k, tag] of told.tags.entries()) {
    assert.equal(await rows[k].getAttribute("data-tag"), `${tag.a.join(" ")} x ${tag.b.join(" ")}`);
    const shown = Number((await rows[k].locator("output").textContent()).replace("−", "-"));
    assert.ok(Math.abs(shown - tag.gli) < 6e-4, `${shown} and ${tag.gli}`);
    assert.match(
      await rows[k].locator("small").textContent(),
      new RegExp(`^\\+${(Math.abs(tag.gli) - 0.5).toFixed(2)}`),
    );
  }
  now = await state();
  assert.equal(now.queries.literal_tangles, told.literal.length);
});

test("pointing at a tangle lights its paths; a tick makes it a tag", async () => {
  await page.hover("[data-tag] >> nth=0");
  assert.ok((await ui()).lit);
  await page.mouse.move(500, 60);
  assert.equal((await ui()).lit, null);
  const count = await page.locator("[data-tag]").count();
  await page.locator("[data-tag] input").first().uncheck();
  assert.equal((await state()).tangles.length, count - 1);
  await page.getByLabel("Leave it to the reduction").check();
  assert.equal((await state()).tangles.length, 0);
});

test("a dragged hand arrives, and a pinned one stays", async () => {
  await fromRest();
  const scale = await scaleOf("front");
  const before_ = await state();
  await drag("a/left_hand", -30, 45, { view: "front" });
  let now = await state();
  const start = place(before_, "a/left_hand");
  const wanted = [start[0] - 30 / Math.abs(scale), start[1] - 45 / Math.abs(scale), start[2]];
  assert.ok(
    distance(place(now, "a/left_hand"), wanted) < 0.01,
    `${place(now, "a/left_hand")}, wanted ${wanted}`,
  );

  await click("a/left_hand");
  await press("p");
  now = await state();
  assert.deepEqual(
    now.pins.map(({ figure, node }) => [figure, node]),
    [["a", "left_hand"]],
  );
  await drag("a/right_hand", 40, 70, { view: "front" });
  await drag("a/chest", 8, 6, { view: "side" });
  const later = await state();
  assert.ok(distance(place(later, "a/left_hand"), place(now, "a/left_hand")) < 0.005);
  assert.ok(distance(place(later, "a/chest"), place(now, "a/chest")) > 0.015);
  for (const foot of ["a/left_toe", "a/right_toe"]) {
    assert.ok(distance(place(later, foot), place(before_, foot)) < 0.005, `${foot} stays`);
  }
});

test("a drag in the main view follows the mouse, and Escape takes it back", async () => {
  const { x, y } = await at("b/right_hand");
  await drag("b/right_hand", 30, 50);
  const now = await at("b/right_hand");
  assert.ok(Math.hypot(now.x - x - 30, now.y - y - 50) < 2.5, `${now.x - x}, ${now.y - y}`);
  const kept = await state();
  await drag("b/left_hand", 20, 40, { release: false });
  assert.notDeepEqual((await state()).figures, kept.figures);
  await press("Escape");
  await page.mouse.up();
  assert.deepEqual((await state()).figures, kept.figures);
});

test("requests do not pile up while one drags", async () => {
  const before_ = await page.evaluate(() => window.retargetStudio.requests);
  await drag("b/right_hand", -25, -30, { steps: 25 });
  const made = (await page.evaluate(() => window.retargetStudio.requests)) - before_;
  assert.ok(made >= 2 && made <= 26, `${made} requests`);
  assert.equal((await state()).can_undo, true);
  await press("Control+z");
  await press("Control+Shift+z");
});

test("a hold is made by two clicks, closes, and holds", async () => {
  await press("7"); // from above, where no joint hides another
  await press("c");
  await click("a/right_hand");
  await click("b/left_wrist");
  let now = await state();
  assert.equal(now.holds.length, 1);
  assert.deepEqual([now.holds[0].from.node, now.holds[0].to.node], ["right_hand", "left_wrist"]);
  await press("s");
  now = await state();
  assert.ok(now.holds[0].error_m < 0.01, `${now.holds[0].error_m} m open`);
  const row = page.locator("[data-hold='0']");
  assert.match(await row.textContent(), /a's right hand.*b's left wrist/);
  const held = place(now, "a/right_hand");
  await drag("b/left_wrist", 12, -25, { view: "front" });
  now = await state();
  assert.ok(now.holds[0].error_m < 0.01);
  assert.ok(distance(place(now, "a/right_hand"), held) > 0.05, "the hand goes with the wrist");
  await press("c");
  await click("b/right_toe");
  const { x, y } = await at("b/right_toe");
  await page.mouse.click(x + 40, y + 25);
  assert.equal((await state()).holds[1].to.figure, "world");
  await page.locator("[data-hold='1']").getByRole("button", { name: "remove this hold" }).click();
  assert.equal((await state()).holds.length, 1);
  await press("0");
});

test("undo and redo go to the exact states", async () => {
  const seen = [posture(await state())];
  await tab("figures");
  await click("a/left_elbow");
  await press("r");
  await page.getByLabel(/^Y: rotation of the joint/).fill("-40");
  await page.keyboard.press("Enter");
  seen.push(posture(await state()));
  await page.evaluate(() => document.activeElement.blur());
  await press("q");
  await press("ArrowRight");
  seen.push(posture(await state()));
  await press("Shift+M");
  seen.push(posture(await state()));
  for (let k = seen.length - 1; k > 0; --k)
    assert.notDeepEqual(seen[k], seen[k - 1], `step ${k} changes something`);
  await page.getByRole("button", { name: "Swap a, b" }).click();
  seen.push(posture(await state()));
  for (let k = seen.length - 2; k >= 0; --k) {
    await press("Control+z");
    assert.deepEqual(posture(await state()), seen[k], `undone to step ${k}`);
  }
  for (let k = 1; k < seen.length; ++k) {
    await press("Control+Shift+z");
    assert.deepEqual(posture(await state()), seen[k], `done again to step ${k}`);
  }
});

test("mirrored twice is as it was", async () => {
  const before_ = await state();
  for (const key of ["m", "Shift+M"]) {
    await press(key);
    const once = await state();
    assert.ok(
      distance(place(once, "b/left_hand"), place(before_, "b/left_hand")) > 0.01 ||
        distance(place(once, "a/left_hand"), place(before_, "a/left_hand")) > 0.01,
    );
    await press(key);
    const twice = await state();
    for (const figure of ["a", "b"]) {
      twice.figures[figure].nodes.forEach((p, k) =>
        assert.ok(
          distance(p, before_.figures[figure].nodes[k]) < 1e-9,
          `${key}: ${figure}/${nodes[k]}`,
        ),
      );
    }
  }
});

test("the gizmo moves a whole figure in one step", async () => {
  await click("a/head");
  await press("t");
  const before_ = await state();
  const { x, y } = await at("a/root");
  // The arrow of the Y axis stands upright over the root.
  await page.mouse.move(x, y - 45);
  await idle();
  await page.mouse.down();
  await page.mouse.move(x, y - 75, { steps: 5 });
  await page.mouse.up();
  const now = await state();
  const shift = place(now, "a/root").map((v, k) => v - place(before_, "a/root")[k]);
  assert.ok(shift[1] > 0.03, `${shift}`);
  now.figures.a.nodes.forEach((p, k) =>
    assert.ok(
      distance(
        p,
        before_.figures.a.nodes[k].map((v, c) => v + shift[c]),
      ) < 1e-5,
    ),
  );
  await press("Control+z");
  assert.deepEqual((await state()).figures, before_.figures);
  await press("q");
});

test("a photo stands behind; a joint is pinned to one of its points", async () => {
  await tab("photo");
  await page.setInputFiles("input[type=file]", {
    name: "behind.png",
    mimeType: "image/png",
    buffer: picture(400, 300),
  });
  await until(() => document.querySelector(".photo").naturalWidth === 400);
  assert.ok((await state()).photo);
  const box = await page.locator(".photo").boundingBox();
  const view = await page.locator(".view.main").boundingBox();
  assert.ok(
    Math.abs(box.height - view.height) < 1 && Math.abs(box.width - (view.height * 4) / 3) < 1,
  );
  await page.getByLabel("opacity of the photo (%)").first().fill("0.8");
  assert.equal((await state()).photo.opacity, 0.8);

  await page.getByLabel("Lock photo and camera (L)").check();
  assert.ok((await state()).camera);
  const still = await at("a/head");
  await page.mouse.move(view.x + 20, view.y + 60);
  await page.mouse.down();
  await page.mouse.move(view.x + 120, view.y + 90, { steps: 4 });
  await page.mouse.up();
  await idle();
  assert.deepEqual(await at("a/head"), still, "locked");

  await page.evaluate(() => document.activeElement.blur());
  await press("o");
  const { x, y } = await at("b/right_hand");
  await drag("b/right_hand", 20, 30);
  const now = await state();
  const pin = now.pins.find((p) => p.figure === "b" && p.node === "right_hand");
  assert.ok(pin?.ray);
  const seen = await at("b/right_hand");
  assert.ok(Math.hypot(seen.x - x - 20, seen.y - y - 30) < 2.5);
  await press("q");
  await press("l");
});

test("unsaved work survives a reload, and the server's end", async () => {
  await page.fill("#topbar .name", "work in progress");
  await page.keyboard.press("Enter");
  const before_ = await state();
  assert.equal(before_.dirty, true);
  await until(() =>
    Object.keys(localStorage).some((k) => localStorage[k].includes("work in progress")),
  );
  await page.reload();
  await until(() => Boolean(window.retargetStudio));
  let now = await state();
  assert.deepEqual(posture(now), posture(before_));
  assert.equal(now.can_undo, true);

  const { port } = new URL(url);
  await stopServer();
  url = await serve("--port", port);
  await open();
  now = await state();
  assert.equal(now.name, "work in progress");
  for (const figure of ["a", "b"]) {
    now.figures[figure].nodes.forEach((p, k) =>
      assert.ok(distance(p, before_.figures[figure].nodes[k]) < 1e-5),
    );
  }
  noise.splice(0); // the old session's 404 and what asked while nobody answered
});

test("saves, duplicates, asks before it replaces or deletes", async () => {
  await tab("library");
  await page.keyboard.press("Control+s");
  await page.fill("dialog input", "bear hug again");
  await page.keyboard.press("Enter");
  await page.getByRole("heading", { name: "Replace the template?" }).waitFor();
  assert.equal(noise.splice(0).filter((line) => !/409/.test(line)).length, 0);
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.keyboard.press("Control+s");
  await page.fill("dialog input", "second hold");
  await page.keyboard.press("Enter");
  const item = page.locator(".templates li", { hasText: "second hold" });
  await item.waitFor();
  assert.ok(await item.locator("img").isVisible(), "a thumbnail");
  assert.equal((await state()).dirty, false);
  await item.getByRole("button", { name: "Duplicate" }).click();
  await page.fill("dialog input", "third hold");
  await page.keyboard.press("Enter");
  await until(() => document.querySelectorAll(".panel .templates li").length >= 3);
  assert.ok(existsSync(join(library, "third hold.yaml")));
  const copy = page.locator("[data-id='third hold']");
  await copy.getByRole("button", { name: "Delete" }).click();
  await page.locator("dialog").getByRole("button", { name: "Delete" }).click();
  await copy.waitFor({ state: "detached" });
  assert.ok(!existsSync(join(library, "third hold.yaml")));
  await page.fill("input[type=search]", "again");
  assert.equal(await page.locator("#panel-library .templates li").count(), 1);
});

test("keyboard map, focus and themes", async () => {
  await page.locator("#topbar").getByRole("button", { name: "keyboard map" }).click();
  assert.ok(await page.getByText("pin or free the joint").isVisible());
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  assert.equal(
    await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle),
    "solid",
  );
  const paper = () =>
    page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  const light = await paper();
  await page.getByRole("button", { name: "light or dark" }).click();
  assert.notEqual(await paper(), light);
  await page.getByRole("button", { name: "light or dark" }).click();
  assert.equal(await paper(), light);
});

test("two clips are solved, watched, and reported on the page", async () => {
  await tab("library");
  await page.fill("input[type=search]", "");
  await page.locator(".templates li", { hasText: "bear hug again" }).locator(".open").click();
  await until(() => window.retargetStudio.state().saved_as === "bear hug again");
  await tab("try");
  await page.getByLabel("frames, such as 0:240").fill("0:20");
  await page.getByLabel("where the solve starts").selectOption("template");
  await page.getByRole("button", { name: "Solve" }).click();
  await page.locator(".outcome .primary").waitFor({ timeout: 60000 });
  assert.match(await page.locator(".progress span").textContent(), /iteration \d+/);
  assert.ok((await page.locator(".outcome tr").count()) > 3);
  const verdict = await page.locator(".outcome p").first().textContent();
  await page.locator(".outcome .primary").click();
  const report = page.frameLocator("dialog iframe");
  await report.locator("h1").waitFor({ timeout: 30000 });
  assert.equal(await report.locator("h1").textContent(), verdict);
  await page.getByRole("button", { name: "Close", exact: true }).click();
});

test("nothing was complained of", () => assert.deepEqual(noise, []));
