// Three of the shipped holds, made from an empty scene with nothing but the studio's page:
//   node studio_holds_test.mjs RETARGET HOLDS
// Each HOLDS/NAME/pose.sh lists the operations that made the template; here the page sends them,
// and saves. Skips as studio_page_test.mjs does. RETARGET_STUDIO_PICTURES: a folder for a picture
// each.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { chmodSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { page, folder as holds, press, server, studioTest, until } from "./studio_person.mjs";

const pictures = process.env.RETARGET_STUDIO_PICTURES;
const size = pictures ? { width: 1280, height: 720 } : {};

// -- What a script says, as the page says it ------------------------------------------------------

// The words that pose.sh gives to `retarget pose`, told by a program that does nothing else.
function wordsOf(hold) {
  const echo = join(server.home, "echo.sh");
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

// Numbers of a template by where they stand.
const numbersIn = (yaml) => (yaml.match(/-?\d+(\.\d+)?(e-?\d+)?/g) ?? []).map(Number);
const shapeOf = (yaml) => yaml.replace(/-?\d+(\.\d+)?(e-?\d+)?/g, "#");

for (const hold of ["full_nelson", "rear_choke", "piggyback"]) {
  studioTest(`${hold}: made from an empty scene`, size, async () => {
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
      await press("Home");
      await page.screenshot({ path: join(pictures, `${hold}.png`) });
    }
    const saved = readFileSync(join(server.library, `${name}.yaml`), "utf8");
    const shipped = readFileSync(join(holds, hold, "template.yaml"), "utf8");
    assert.equal(shapeOf(saved), shapeOf(shipped));
    const [one, other] = [numbersIn(saved), numbersIn(shipped)];
    one.forEach((value, k) => {
      assert.ok(Math.abs(value - other[k]) < 0.05, `number ${k}: ${value} and ${other[k]}`);
    });
  });
}
