// The studio as a person meets it, in a browser, with the server that belongs to it:
//   node studio_page_test.mjs RETARGET HOLD
// HOLD is a folder with template.yaml, a.bvh and b.bvh. Exit code 77 where the program has no
// studio, or Chromium (RETARGET_CHROMIUM, else /usr/bin/chromium) or playwright-core (in
// RETARGET_NODE_MODULES) is not there. Every test begins with a server and a session of its own.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { picture } from "./png.mjs";
import {
  at,
  click,
  distance,
  drag,
  folder as hold,
  fromRest,
  idle,
  nodes,
  noise,
  operate,
  page,
  place,
  posture,
  press,
  program,
  restart,
  scaleOf,
  server,
  state,
  studioTest,
  tab,
  ui,
  until,
} from "./studio_person.mjs";

const template = join(hold, "template.yaml");
const clips = ["--clip-a", join(hold, "a.bvh"), "--clip-b", join(hold, "b.bvh")];
const withTemplate = { args: ["--template", template] };
// A library that has the template under this name.
const known = "bear hug again";
const prepare = (library) => {
  const renamed = readFileSync(template, "utf8").replace(/^name: .*$/m, `name: ${known}`);
  writeFileSync(join(library, `${known}.yaml`), renamed);
};

// Work in hand: a figure that leans, a hold, a pin.
const work = [
  { op: "set_joint", figure: "a", joint: "chest", rotation_vector: [14, 6, -9] },
  { op: "set_joint", figure: "b", joint: "left_shoulder", rotation_vector: [5, -30, 40] },
  {
    op: "add_hold",
    from: { figure: "a", node: "right_hand" },
    to: { figure: "b", node: "left_wrist" },
    rotation: false,
  },
  { op: "pin", figure: "a", node: "left_hand" },
];

studioTest(
  "opens with the template that was named",
  { ...withTemplate, width: 1280, height: 720 },
  async () => {
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
  },
);

studioTest(
  "the list of tangles is that of `retarget tangles` on the saved file",
  withTemplate,
  async () => {
    await tab("library");
    await page.getByRole("button", { name: "Save as" }).click();
    await page.keyboard.type("bear hug again");
    await page.keyboard.press("Enter");
    await until(() => !document.querySelector("dialog"));
    let now = await state();
    const file = join(server.library, `${now.saved_as}.yaml`);
    assert.ok(existsSync(file));
    assert.equal(now.dirty, false);
    const told = JSON.parse(execFileSync(program, ["tangles", file, "--json"]));
    assert.ok(told.tags.length > 0);
    await tab("tangles");
    await idle();
    const rows = await page.locator("[data-tag]").all();
    assert.equal(rows.length, told.tags.length);
    for (const [k, tag] of told.tags.entries()) {
      assert.equal(
        await rows[k].getAttribute("data-tag"),
        `${tag.a.join(" ")} x ${tag.b.join(" ")}`,
      );
      const shown = Number((await rows[k].locator("output").textContent()).replace("−", "-"));
      assert.ok(Math.abs(shown - tag.gli) < 6e-4, `${shown} and ${tag.gli}`);
      assert.match(
        await rows[k].locator("small").textContent(),
        new RegExp(`^\\+${(Math.abs(tag.gli) - 0.5).toFixed(2)}`),
      );
    }
    now = await state();
    assert.equal(now.queries.literal_tangles, told.literal.length);
  },
);

studioTest(
  "pointing at a tangle lights its paths; a tick makes it a tag",
  withTemplate,
  async () => {
    await tab("tangles");
    await idle();
    await page.hover("[data-tag] >> nth=0");
    assert.ok((await ui()).lit);
    await page.mouse.move(500, 60);
    assert.equal((await ui()).lit, null);
    const count = await page.locator("[data-tag]").count();
    // Not uncheck(), which looks again: the row may have changed its place by then.
    await page.locator("[data-tag] input").first().click();
    assert.equal((await state()).tangles.length, count - 1);
    await page.getByLabel("Leave it to the reduction").check();
    assert.equal((await state()).tangles.length, 0);
  },
);

studioTest("a dragged hand arrives, and a pinned one stays", withTemplate, async () => {
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

studioTest("a drag in the main view follows the mouse, and Escape takes it back", {}, async () => {
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

studioTest("requests do not pile up while one drags", {}, async () => {
  const before_ = await page.evaluate(() => window.retargetStudio.requests);
  await drag("b/right_hand", -25, -30, { steps: 16 });
  const made = (await page.evaluate(() => window.retargetStudio.requests)) - before_;
  assert.ok(made >= 2 && made <= 17, `${made} requests`);
  assert.equal((await state()).can_undo, true);
  await press("Control+z");
  await press("Control+Shift+z");
});

studioTest("a hold is made by two clicks, closes, and holds", {}, async () => {
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

studioTest("undo and redo go to the exact states", {}, async () => {
  await operate(...work);
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

studioTest("mirrored twice is as it was", {}, async () => {
  await operate(...work);
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

studioTest("the gizmo moves a whole figure in one step", {}, async () => {
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

studioTest("a photo stands behind; a joint is pinned to one of its points", {}, async () => {
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

studioTest("unsaved work survives a reload, and the server's end", {}, async () => {
  await operate(...work);
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

  await restart();
  now = await state();
  assert.equal(now.name, "work in progress");
  for (const figure of ["a", "b"]) {
    now.figures[figure].nodes.forEach((p, k) =>
      assert.ok(distance(p, before_.figures[figure].nodes[k]) < 1e-5),
    );
  }
  noise.splice(0); // the old session's 404 and what asked while nobody answered
});

studioTest("saves, duplicates, asks before it replaces or deletes", { prepare }, async () => {
  await tab("library");
  await page.keyboard.press("Control+s");
  await page.fill("dialog input", known);
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
  assert.ok(existsSync(join(server.library, "third hold.yaml")));
  const copy = page.locator("[data-id='third hold']");
  await copy.getByRole("button", { name: "Delete" }).click();
  await page.locator("dialog").getByRole("button", { name: "Delete" }).click();
  await copy.waitFor({ state: "detached" });
  assert.ok(!existsSync(join(server.library, "third hold.yaml")));
  await page.fill("input[type=search]", "again");
  assert.equal(await page.locator("#panel-library .templates li").count(), 1);
});

studioTest("keyboard map, focus and themes", {}, async () => {
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

studioTest(
  "two clips are solved, watched, and reported on the page",
  { args: clips, prepare },
  async () => {
    await tab("library");
    await page.locator(".templates li", { hasText: known }).locator(".open").click();
    await until((name) => window.retargetStudio.state().saved_as === name, known);
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
  },
);
