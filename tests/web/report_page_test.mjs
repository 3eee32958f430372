// report.html as a person meets it, in a browser:
//   node report_page_test.mjs RUN_FOLDER
// RUN_FOLDER is what a run has written: report.html and the scenes beside it, by which the players
// are judged. Exit code 77 where the page, Chromium (RETARGET_CHROMIUM, else /usr/bin/chromium) or
// playwright-core (in RETARGET_NODE_MODULES) is not there, or the page was built without players.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { launch, listen, skip } from "./browser.mjs";
import { Glb } from "./glb.mjs";

const folder = resolve(process.argv[2] ?? ".");
const pagePath = join(folder, "report.html");
if (!existsSync(pagePath)) skip(`no ${pagePath}`);
const html = readFileSync(pagePath, "utf8");
if (!html.includes('id="series"')) skip("the page was built without players");

const element = (id) =>
  new RegExp(`<script type="[^"]*" id="${id}">([^]*?)</script>`).exec(html)?.[1];
const report = JSON.parse(element("report"));
const series = JSON.parse(element("series"));
const scenes = { source: "source.glb", result: "scene.glb" };
if (element("baseline-glb")) scenes.baseline = "baseline.glb";
const glb = Object.fromEntries(
  Object.entries(scenes).map(([which, file]) => [which, new Glb(join(folder, file))]),
);
const last = series.frames - 1;
const some = [...new Set([0, 1, Math.floor(last / 3), Math.floor((2 * last) / 3), last])];

let browser;
const scratch = mkdtempSync(join(tmpdir(), "retarget-page-"));
before(async () => {
  browser = await launch();
});
after(async () => {
  await browser?.close();
  rmSync(scratch, { recursive: true });
});

// An open page, and everything that it complained of or asked the network for.
async function open({ path = pagePath, from = browser, ...options } = {}) {
  const page = await from.newPage({ viewport: { width: 1280, height: 720 }, ...options });
  const noise = [];
  listen(page, noise);
  page.on("request", (request) => {
    const url = request.url();
    if (url !== pathToFileURL(path).href && !url.startsWith("data:")) noise.push(`request: ${url}`);
  });
  await page.goto(pathToFileURL(path).href, { timeout: 120000 });
  await page.waitForFunction(() => window.retargetReport?.ready, null, { timeout: 60000 });
  return { page, noise };
}

// One page for the tests that leave it as they found it, scrolled up and at rest.
let kept;
async function usual() {
  kept ??= await open();
  await kept.page.bringToFront();
  await kept.page.mouse.move(640, 5);
  await kept.page.evaluate(() => {
    document.activeElement.blur();
    scrollTo(0, 0);
  });
  return kept;
}

const seek = (page, frame) => page.evaluate((f) => window.retargetReport.seek(f), frame);
const frameOf = (page) => page.evaluate(() => window.retargetReport.frame);
const numberIn = (text) => Number(/-?\d+(\.\d+)?/.exec(text)[0]);
const pixels = async (page) => {
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
  return page.evaluate(() => document.querySelector("canvas.viewer").toDataURL());
};

// Every node of every player stands where the written scene has it at the page's frame.
async function assertPlayersStandAt(page, frame) {
  assert.equal(await frameOf(page), frame);
  for (const [which, scene] of Object.entries(glb)) {
    const names = scene.names();
    assert.equal(names.length, 42);
    const got = await page.evaluate(
      ([which_, names_]) => names_.map((n) => window.retargetReport.playerNodePosition(which_, n)),
      [which, names],
    );
    names.forEach((name, k) => {
      const expected = scene.position(name, frame);
      const error = Math.hypot(...expected.map((x, c) => x - got[k][c]));
      assert.ok(error < 1e-5, `${which} ${name}, frame ${frame}: ${error} m off`);
    });
  }
}

// How soon is told, not asserted: the machine may be busy with other things.
test("opens small, quietly and without network", async () => {
  assert.ok(statSync(pagePath).size < 4e6, `${statSync(pagePath).size} bytes`);
  const { page, noise } = await open();
  console.log(
    `ready after ${Math.round(await page.evaluate(() => window.retargetReport.readyMs))} ms`,
  );
  assert.deepEqual(noise, []);
  await page.close();
});

test("says what the report says", async () => {
  const { page } = await usual();
  assert.equal(await page.textContent("h1"), report.verdict[0]);
  const missed = report.requirements.filter((r) => !r.met).length;
  assert.equal(await page.locator("tr.missed").count(), missed);
  assert.equal(await page.locator("header.missed").count(), missed > 0 ? 1 : 0);
  assert.equal(await page.locator("tr[data-tag]").count(), report.tangles.length);
});

test("players show the frame that the page says", async () => {
  const { page, noise } = await usual();
  for (const frame of some) {
    await seek(page, frame);
    assert.match(await page.textContent(".counter"), new RegExp(`^frame ${frame} /`));
    await assertPlayersStandAt(page, frame);
    for (const which of Object.keys(glb)) {
      for (let tag = 0; tag < report.tangles.length; ++tag) {
        const gli = await page.evaluate(
          ([w, k]) => window.retargetReport.playerTagGli(w, k),
          [which, tag],
        );
        assert.ok(
          Math.abs(gli - series[which].tangles[tag][frame]) < 1e-3,
          `${which} tag ${tag}: ${gli}`,
        );
      }
    }
  }
  assert.deepEqual(noise, []);
});

test("plays, pauses and steps by keyboard", async () => {
  const { page, noise } = await usual();
  await page.keyboard.press("Space");
  await page.waitForFunction(() => window.retargetReport.frame > 2, null, { timeout: 20000 });
  assert.equal(await page.textContent(".play"), "Pause");
  await page.keyboard.press("Space");
  const stopped = await frameOf(page);
  await page.waitForTimeout(200);
  assert.equal(await frameOf(page), stopped);
  await seek(page, 5);
  await page.keyboard.press("ArrowRight");
  assert.equal(await frameOf(page), 6);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  await assertPlayersStandAt(page, 4);
  await page.keyboard.press("Tab");
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
  assert.equal(outline, "solid");
  assert.deepEqual(noise, []);
});

test("scrubs by bar and by plot, with one cursor for all", async () => {
  const { page, noise } = await usual();
  const bar = await page.locator(".scrub").boundingBox();
  await page.mouse.click(bar.x + bar.width / 2, bar.y + bar.height / 2);
  assert.ok(Math.abs((await frameOf(page)) - last / 2) <= 1);
  const plots = page.locator(".plot:not(.wide) .u-over");
  assert.ok((await plots.count()) >= 4);
  for (const [index, part] of [
    [0, 0.25],
    [2, 0.75],
  ]) {
    await plots.nth(index).scrollIntoViewIfNeeded();
    const box = await plots.nth(index).boundingBox();
    await page.mouse.click(box.x + part * box.width, box.y + box.height * 0.6);
    const frame = await frameOf(page);
    assert.ok(Math.abs(frame - part * last) <= 1, `clicked at ${part}: frame ${frame}`);
    await assertPlayersStandAt(page, frame);
    await page.mouse.move(2, 2);
    for (const playhead of await page.locator(".plot:not(.wide) .playhead").all()) {
      const [head, over] = [
        await playhead.boundingBox(),
        await playhead.locator("..").boundingBox(),
      ];
      assert.ok(Math.abs(head.x - over.x - (frame / last) * over.width) < 2);
    }
  }
  const strip = page.locator(".strip canvas").first();
  await strip.scrollIntoViewIfNeeded();
  const box = await strip.boundingBox();
  await page.mouse.click(box.x + box.width - 7, box.y + box.height / 2);
  assert.equal(await frameOf(page), last);
  assert.deepEqual(noise, []);
});

test("plots say the series' values", async () => {
  const { page } = await usual();
  const frame = some[2];
  await seek(page, frame);
  const value = async (title, line) =>
    numberIn(
      await page
        .locator(`figure[data-plot="${title}"] .key span`, { hasText: line })
        .locator("b")
        .textContent(),
    );
  for (const which of ["source", "result"]) {
    const s = series[which];
    assert.ok(Math.abs((await value("Tag 1: s GLI", which)) - s.tangles[0][frame]) <= 0.0051);
    assert.ok(
      Math.abs((await value("Penetration between the bodies", which)) - s.penetration_cm[frame]) <=
        0.0051,
    );
    const speed = Math.max(s.foot_speed_cm_s.a[frame], s.foot_speed_cm_s.b[frame]);
    assert.ok(Math.abs((await value("Speed of planted feet", which)) - speed) <= 0.051);
  }
});

test("a tag's row and button show it on the bodies; the heat map colours them", async () => {
  const { page, noise } = await usual();
  await page.mouse.move(640, 5);
  const plain = await pixels(page);
  await page.hover(".tag >> nth=0");
  const tagged = await pixels(page);
  assert.notEqual(tagged, plain);
  await page.mouse.move(640, 5);
  assert.equal(await pixels(page), plain);
  const heat = page.getByLabel("GLI heat map");
  await heat.check();
  const hot = await pixels(page);
  assert.notEqual(hot, plain);
  assert.ok(await page.locator("#transport .legend").isVisible());
  await heat.uncheck();
  assert.equal(await pixels(page), plain);
  await page.locator("tr[data-tag='0']").focus();
  const small = await pixels(page); // scrolled: the players are smaller now
  await page.evaluate(() => document.activeElement.blur());
  assert.notEqual(await pixels(page), small);
  assert.deepEqual(noise, []);
});

test("frames in tables are jumps", async () => {
  const { page } = await usual();
  const jumps = page.locator(".cards .jump");
  assert.ok((await jumps.count()) > 0);
  const frame = numberIn(await jumps.last().textContent());
  await seek(page, frame === 0 ? 1 : 0);
  await jumps.last().click();
  await assertPlayersStandAt(page, frame);
});

// A scene in which all is well in the frames, and a tag is lost and a hold open between two.
test("what is missed between frames is in the curves, on the scrub bar and in the players", async () => {
  const path = join(scratch, "between.html");
  const missing = structuredClone(series);
  const told = structuredClone(report);
  const [lost, open_] = [17, 40];
  missing.result.between.tangles[0][lost] = 0.3;
  missing.result.between.hold_cm[0][open_] = 4;
  for (const r of told.requirements) {
    r.met = !(r.kind === "tangle" && r.item === 0) && !(r.kind === "hold" && r.item === 0);
  }
  writeFileSync(
    path,
    html
      .replace(element("series"), () => JSON.stringify(missing))
      .replace(element("report"), () => JSON.stringify(told)),
  );
  const { page, noise } = await open({ path });
  const marks = page.locator(".miss");
  assert.equal(await marks.count(), 2);
  const mark = marks.first();
  assert.match(await mark.getAttribute("title"), /between frames 17 and 18/);
  const [at, bar] = [await mark.boundingBox(), await page.locator(".track").boundingBox()];
  const expected = bar.x + 6 + ((bar.width - 12) * (lost + 0.5)) / last;
  assert.ok(Math.abs(at.x + at.width / 2 - expected) < 1.5, `${at.x} for ${expected}`);
  // The track is dark there and nowhere else.
  const dark = await page.evaluate(() => {
    const canvas = document.querySelector(".track");
    const rows = Math.round(canvas.clientHeight / 9);
    const y = Math.round((canvas.height * 2.25) / rows); // result, upper half
    const { data } = canvas.getContext("2d").getImageData(0, y, canvas.width, 1);
    const colour = (x) => [...data.slice(4 * x, 4 * x + 3)].join();
    const held = colour(Math.round(canvas.width / 2));
    const inside = (6 * canvas.width) / canvas.clientWidth;
    const out = [];
    for (let x = Math.ceil(inside) + 1; x < canvas.width - inside - 1; ++x) {
      if (colour(x) !== held) out.push(((x + 0.5) * canvas.clientWidth) / canvas.width);
    }
    return out;
  });
  assert.ok(dark.length > 0);
  for (const x of dark) assert.ok(Math.abs(bar.x + x - expected) < 8, `${x}`);
  // There the players stand half way, and the words are those of that instant.
  await mark.click();
  assert.match(await page.textContent(".counter"), /^between 17 and 18 /);
  assert.match(
    await page.textContent(".panel[data-variant=result] .readout"),
    /lost: tag 1 \(0\.30\)/,
  );
  const [p, q] = [17, 18].map((frame) => glb.result.position("a/root", frame));
  const got = await page.evaluate(() =>
    window.retargetReport.playerNodePosition("result", "a/root"),
  );
  assert.ok(Math.hypot(...p.map((x, c) => 0.5 * (x + q[c]) - got[c])) < 1e-5);
  const key = page.locator('figure[data-plot="Tag 1: s GLI"] .key span', { hasText: "result" });
  assert.equal(numberIn(await key.locator("b").textContent()), 0.3);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frameOf(page), 17);
  assert.match(await page.textContent(".counter"), /^frame 17 /);
  assert.match(await page.textContent(".panel[data-variant=result] .readout"), /tangled/);
  await mark.click();
  await page.keyboard.press("ArrowRight");
  assert.equal(await frameOf(page), 18);
  await marks.last().click();
  assert.match(await page.textContent(".counter"), /^between 40 and 41 /);
  assert.deepEqual(noise, []);
  await page.close();
});

test("without a baseline a sentence stands in its place", async () => {
  const path = join(scratch, "no_baseline.html");
  const without = { ...series, baseline: null };
  writeFileSync(
    path,
    html
      .replace(element("series"), () => JSON.stringify(without))
      .replace(/<script type="text\/plain" id="baseline-glb">[^]*?<\/script>/, ""),
  );
  const { page, noise } = await open({ path });
  assert.ok((await page.textContent(".panel[data-variant=baseline] .absent")).length > 10);
  await seek(page, 3);
  const [got, expected] = [
    await page.evaluate(() => window.retargetReport.playerNodePosition("result", "a/left_wrist")),
    glb.result.position("a/left_wrist", 3),
  ];
  assert.ok(Math.hypot(...expected.map((x, c) => x - got[c])) < 1e-5);
  assert.deepEqual(noise, []);
  await page.close();
});

test("without WebGL the plots and tables work and the page says so", async () => {
  const plain = await launch(["--disable-3d-apis"]);
  try {
    const { page, noise } = await open({ from: plain });
    assert.match(await page.textContent("#panels > .absent"), /no WebGL/);
    const over = page.locator(".plot:not(.wide) .u-over").first();
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    assert.ok(Math.abs((await frameOf(page)) - last / 2) <= 1);
    assert.ok(await page.locator(".cards table").first().isVisible());
    assert.deepEqual(
      noise.filter((line) => !/WebGL/.test(line)),
      [],
    );
  } finally {
    await plain.close();
  }
});

test("prints in light colours, without controls, with whole tables", async () => {
  const { page } = await open({ colorScheme: "dark" });
  const colour = () =>
    page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  assert.notEqual(await colour(), "rgb(255, 255, 255)");
  await page.emulateMedia({ media: "print" });
  await page.waitForFunction(() => document.querySelector("details").open);
  assert.equal(await colour(), "rgb(255, 255, 255)");
  assert.equal(await page.locator("#transport").isVisible(), false);
  assert.ok(await page.locator(".settings").isVisible());
  const cut = await page.evaluate(
    () =>
      [...document.querySelectorAll(".card")].filter(
        (card) => card.scrollHeight > card.clientHeight + 1,
      ).length,
  );
  assert.equal(cut, 0);
  await page.emulateMedia({ media: "screen" });
  await page.waitForFunction(() => !document.querySelector("details").open);
  await page.close();
});

test("fits a laptop and a narrow window", async () => {
  const { page } = await open();
  for (const width of [1280, 1024, 640]) {
    await page.setViewportSize({ width, height: 720 });
    await page.waitForTimeout(100);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px too wide at ${width}`);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.evaluate(() => scrollTo(0, 0));
  const stage = await page.locator("#transport .scrubber").boundingBox();
  assert.ok(stage.y + stage.height < 720, "the scrub bar is on the first screen");
  await page.close();
});
