// Three of the shipped holds, made from an empty scene with nothing but the studio's page:
//   node studio_holds_test.mjs RETARGET HOLDS
// Each HOLDS/NAME/pose.sh lists the operations that made the template; here the page sends them,
// and saves. Skips as studio_page_test.mjs does. RETARGET_STUDIO_PICTURES: a folder for a picture
// each.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import {
  chmodSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";

const [program, holds] = process.argv.slice(2).map((path) => resolve(path));
const chromiumPath = process.env.RETARGET_CHROMIUM ?? "/usr/bin/chromium";
const pictures = process.env.RETARGET_STUDIO_PICTURES;

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}
let chromium;
try {
  const home = resolve(process.env.RETARGET_NODE_MODULES ?? "node_modules");
  ({ chromium } = createRequire(join(home, "here.js"))("playwright-core"));
} catch {
  skip("playwright-core not found");
}
if (!existsSync(chromiumPath)) skip(`no ${chromiumPath}`);
const usage = spawnSync(program, ["studio", "--help"], { encoding: "utf8" });
if (usage.status !== 0 || /no page/.test(usage.stdout)) skip("the program has no studio");

const scratch = mkdtempSync(join(tmpdir(), "retarget-holds-"));
const library = join(scratch, "library");
const noise = [];
let server, url, browser, page;

before(async () => {
  mkdirSync(library);
  server = spawn(program, ["studio", "--no-browser", "--library", library], {
    env: { ...process.env, HOME: scratch, XDG_DATA_HOME: join(scratch, "data") },
  });
  url = await new Promise((done, failed) => {
    server.stdout.on("data", (data) => {
      const found = /http:\/\/\S+/.exec(String(data));
      if (found) done(found[0]);
    });
    server.on("exit", () => failed(new Error("the studio ended")));
  });
  browser = await chromium.launch({
    executablePath: chromiumPath,
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
    ],
  });
});
after(async () => {
  await browser?.close();
  server?.removeAllListeners("exit");
  server?.kill("SIGINT");
  rmSync(scratch, { recursive: true });
});

// -- What a script says, as the page says it ------------------------------------------------------

// The words that pose.sh gives to `retarget pose`, told by a program that does nothing else.
function wordsOf(hold) {
  const echo = join(scratch, "echo.sh");
  writeFileSync(echo, "#!/bin/sh\nprintf '%s\\0' \"$@\"\n");
  chmodSync(echo, 0o755);
  const said = execFileSync("sh", [join(holds, hold, "pose.sh"), echo, "unused"], {
    encoding: "utf8",
  });
  return said.split("\0").slice(1, -1);
}

const numbers = (text) => text.split(",").map(Number);
const names = (text) => text.split(",").filter((name) => name !== "");
const node = (name) => name.replace(/_foot$/, "_ankle");
function quaternion(degrees) {
  const [x, y, z] = degrees.map((v) => (v * Math.PI) / 180);
  const angle = Math.hypot(x, y, z);
  const s = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
  return [s * x, s * y, s * z, Math.cos(angle / 2)];
}
function halves(text, at) {
  const k = text.indexOf(at);
  return [text.slice(0, k), text.slice(k + 1)];
}
const place = (text) => {
  const [figure, name] = halves(text, "/");
  return { figure, node: node(name) };
};

let gesture = 0;
const operations = {
  stature: (v) => ({ op: "set_stature", figure: v[0], stature: Number(v.slice(2)) }),
  root: (v) => {
    const n = numbers(v.slice(2));
    const turn = n.length === 6 ? { rotation_vector: n.slice(3) } : {};
    return { op: "set_root", figure: v[0], position: n.slice(0, 3), ...turn };
  },
  turn: (v) => {
    const n = numbers(v.slice(2));
    return {
      op: "turn_figure",
      figure: v[0],
      rotation: quaternion(n.length === 1 ? [0, n[0], 0] : n),
    };
  },
  move: (v) => ({ op: "move_figure", figure: v[0], shift: numbers(v.slice(2)) }),
  rotate: (v) => {
    const [to, value] = halves(v, "=");
    const [figure, joint] = halves(to, "/");
    const parts = value.split(",");
    return {
      op: "rotate_joint",
      figure,
      joint,
      rotation: quaternion(parts.slice(0, 3).map(Number)),
      world: parts[3] === "world",
    };
  },
  drag: (v) => {
    const [to, value] = halves(v, "=");
    return { op: "drag", ...place(to), target: numbers(value), gesture: ++gesture };
  },
  settle: () => ({ op: "settle" }),
  pin: (v) => ({ op: "pin", ...place(v) }),
  unpin: (v) => ({ op: "unpin", ...place(v) }),
  option: (v) => ({ op: "set_option", option: halves(v, "=")[0], on: halves(v, "=")[1] === "on" }),
  hold: (v) => {
    const [from, to] = halves(v, "=");
    return { op: "add_hold", from: place(from), to: place(to), rotation: false };
  },
  supports: (v) => ({ op: "set_supports", figure: v[0], nodes: names(v.slice(2)).map(node) }),
  leader: (v) => ({ op: "set_root_leader", figure: v[0], leader: v.slice(2) }),
  name: (v) => ({ op: "set_name", name: v }),
  description: (v) => ({ op: "set_description", description: v }),
  tags: (v) => ({ op: "set_tags", tags: names(v).map((tag) => tag.trim()) }),
};

function* steps(words) {
  for (let k = 0; k < words.length; ++k) {
    const option = words[k].slice(2);
    if (option === "rest" || option === "force") continue;
    if (option === "out") ++k;
    else if (option === "settle") yield operations.settle();
    else {
      assert.ok(operations[option], `--${option}: the page's script knows it`);
      yield operations[option](words[++k]);
    }
  }
}

// -- The page -------------------------------------------------------------------------------------

// A page of its own for every hold: nothing is left of the one before.
async function open() {
  await page?.context().close();
  const size = pictures ? { width: 1280, height: 720 } : { width: 1060, height: 620 };
  page = await (await browser.newContext({ viewport: size })).newPage();
  page.on("console", (message) => noise.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => noise.push(`error: ${error.message}`));
  await page.goto(url, { timeout: 120000 });
}

// The page's policy forbids what page.waitForFunction does.
async function until(holds) {
  for (let tries = 0; tries < 600; ++tries) {
    if (await page.evaluate(holds).catch(() => false)) return;
    await page.waitForTimeout(50);
  }
  throw new Error(`never came true: ${holds}`);
}

// Numbers of a template by where they stand.
const numbersIn = (yaml) => (yaml.match(/-?\d+(\.\d+)?(e-?\d+)?/g) ?? []).map(Number);
const shapeOf = (yaml) => yaml.replace(/-?\d+(\.\d+)?(e-?\d+)?/g, "#");

for (const hold of ["full_nelson", "rear_choke", "piggyback"]) {
  test(`${hold}: made from an empty scene`, async () => {
    await open();
    await until(() => Boolean(window.retargetStudio));
    await page.evaluate(() => window.retargetStudio.idle());
    const ops = [...steps(wordsOf(hold))];
    assert.ok(ops.length > 20);
    const refused = await page.evaluate(async (all) => {
      for (const op of all) if (!(await window.retargetStudio.do(op))) return op;
      return null;
    }, ops);
    assert.equal(refused, null);
    await page.keyboard.press("Control+s");
    // Saving gives the template its file's name.
    const { name } = ops.find((op) => op.op === "set_name");
    await page.fill("dialog input", name);
    await page.keyboard.press("Enter");
    await until(() => window.retargetStudio.state().saved_as !== null);
    if (pictures) {
      await page.keyboard.press("Home");
      await page.evaluate(() => window.retargetStudio.idle());
      await page.screenshot({ path: join(pictures, `${hold}.png`) });
    }
    const saved = readFileSync(join(library, `${name}.yaml`), "utf8");
    const shipped = readFileSync(join(holds, hold, "template.yaml"), "utf8");
    assert.equal(shapeOf(saved), shapeOf(shipped));
    const [one, other] = [numbersIn(saved), numbersIn(shipped)];
    one.forEach((value, k) => {
      assert.ok(Math.abs(value - other[k]) < 0.05, `number ${k}: ${value} and ${other[k]}`);
    });
    assert.deepEqual(noise.splice(0), []);
  });
}
