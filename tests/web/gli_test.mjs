// The pages' Gauss Linking Integral against numerical integration in high precision:
//   node gli_test.mjs GOLDEN_DIR WEB_BUILD
// Exit code 77 where the pages' tools are not there.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { canBundle, modulesOf } from "./bundle.mjs";

const [folder, build] = process.argv.slice(2);
const golden = (name) => JSON.parse(readFileSync(join(folder, name), "utf8"));
if (!canBundle(build)) {
  console.log(`skipped: no ${build}/node_modules`);
  process.exit(77);
}
const { findNode, gliTable, nodeNames, numSegments, parentOf, pathGli, pathSigns, segmentGli } =
  await modulesOf(build, "gli_for_test", ["shared/gli", "shared/body"]);

const ofPair = ({ a, b, c, d }) => segmentGli([...a, ...b], 0, 1, [...c, ...d], 0, 1);

test("random segment pairs", () => {
  const pairs = golden("segment_pairs.json");
  assert.ok(pairs.length >= 100);
  for (const pair of pairs) {
    assert.ok(Math.abs(ofPair(pair) - Number(pair.gli)) < 1e-13, `${pair.id}: ${ofPair(pair)}`);
  }
});

test("degenerate segment pairs", () => {
  const pairs = golden("degenerate_pairs.json");
  assert.ok(pairs.length >= 20);
  for (const pair of pairs) {
    const value = pair.touching ? 0 : Number(pair.gli);
    assert.ok(
      Math.abs(ofPair(pair) - value) <= Number(pair.tol_abs ?? 1e-12),
      `${pair.id}: ${ofPair(pair)}`,
    );
  }
});

test("tables and paths of whole bodies", () => {
  const postures = golden("postures.json");
  for (const posture of postures) {
    assert.deepEqual(posture.parent_of_node, parentOf);
    const table = gliTable(posture.A.flat(), posture.B.flat());
    const rows = posture.gli_segments.flat().map(Number);
    assert.equal(rows.length, numSegments ** 2);
    rows.forEach((value, k) =>
      assert.ok(Math.abs(table[k] - value) < 1e-12, `${posture.name} ${k}`),
    );
    const signs = (path) => pathSigns(...path.map((name) => posture.nodes.indexOf(name)));
    assert.ok(posture.tangles.length > 200);
    for (const { a, b, gli } of posture.tangles) {
      assert.ok(Math.abs(pathGli(table, signs(a), signs(b)) - Number(gli)) < 1e-12, `${a} ${b}`);
    }
  }
});

test("a path is the sum of its segments, turned where it runs inward", () => {
  const signs = pathSigns(findNode("left_hand"), findNode("right_elbow"));
  const walked = nodeNames.slice(1).filter((_, k) => signs[k] !== 0);
  assert.deepEqual(walked.sort(), [
    "left_elbow",
    "left_hand",
    "left_shoulder",
    "left_wrist",
    "right_elbow",
    "right_shoulder",
  ]);
  assert.equal(signs[findNode("left_wrist") - 1], -1);
  assert.equal(signs[findNode("right_elbow") - 1], 1);
  const ones = new Float64Array(numSegments ** 2).fill(1);
  assert.equal(pathGli(ones, signs, pathSigns(0, findNode("head_top"))), (2 - 4) * 4);
});
