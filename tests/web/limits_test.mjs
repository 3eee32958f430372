// The pages' reading of joint limits, against rotations made from known angles, and against what
// the program says of the same rotations (model/body/joint_limit.h):
//   node limits_test.mjs RETARGET WEB_BUILD
// Exit code 77 where the program has no studio or the pages' tools are not there.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { canBundle, modulesOf } from "./bundle.mjs";
import { hasStudio, StudioServer } from "./studio_server.mjs";

const [program, build] = process.argv.slice(2);
if (!hasStudio(program) || !canBundle(build)) {
  console.log(`skipped: ${program} has no studio, or no ${build}/node_modules`);
  process.exit(77);
}
const { readLimits, rotationOf, rotationVectorOf } = await modulesOf(build, "limits_for_test", [
  "studio/state/limits",
]);

// -- Rotations as 3 x 3 matrices (rows), angles in degrees ----------------------------------------

const kDegree = Math.PI / 180;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const times = (m, v) => m.map((row) => dot(row, v));
const columns = (m) => [0, 1, 2].map((c) => m.map((row) => row[c]));
const product = (m, n) => m.map((row) => columns(n).map((column) => dot(row, column)));

// About a unit axis (Rodrigues): c I + s [u]x + (1 - c) u u^T.
function turn([x, y, z], degrees) {
  const [c, s] = [Math.cos(degrees * kDegree), Math.sin(degrees * kDegree)];
  const k = 1 - c;
  return [
    [c + k * x * x, k * x * y - s * z, k * x * z + s * y],
    [k * x * y + s * z, c + k * y * y, k * y * z - s * x],
    [k * x * z - s * y, k * y * z + s * x, c + k * z * z],
  ];
}

// The least turn that takes a unit direction to another.
function swing(from, to) {
  const axis = cross(from, to);
  const sine = Math.hypot(...axis);
  if (sine < 1e-12) return turn([1, 0, 0], 0);
  return turn(unit(axis), Math.atan2(sine, dot(from, to)) / kDegree);
}

// From the trace and what is skew-symmetric; not at half a turn.
function rotationVector(m) {
  const skew = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
  const sine = Math.hypot(...skew);
  const angle = Math.atan2(sine, m[0][0] + m[1][1] + m[2][2] - 1) / kDegree;
  return sine < 1e-12 ? [0, 0, 0] : skew.map((x) => (x * angle) / sine);
}

// -- Seeded numbers -------------------------------------------------------------------------------

// Uniform in [low, high), by the linear congruential generator of Numerical Recipes.
let seed = 20240607;
function random(low, high) {
  seed = (Math.imul(1664525, seed) + 1013904223) >>> 0;
  return low + ((high - low) * seed) / 2 ** 32;
}
function randomDirection() {
  for (;;) {
    const v = [0, 1, 2].map(() => random(-1, 1));
    const length = Math.hypot(...v);
    if (length > 0.1 && length < 1) return unit(v);
  }
}

// -- Tests ----------------------------------------------------------------------------------------

let server, body, session;
before(async () => {
  server = new StudioServer(program);
  await server.start();
  ({ body, session } = await server.post("/api/session", {}));
});
after(() => server?.remove());

const limitsOf = (kind) =>
  body.a.links
    .filter((l) => l.limits.kind === kind && l.limits.axis)
    .map((l) => [l.name, l.limits]);
const near = (value, wanted, what) =>
  assert.ok(Math.abs(value - wanted) < 1e-3, `${what}: ${value}, not ${wanted}`);

// Reads `twist` after the least swing that takes the bone to `direction`; both in degrees.
function readingsOf(limits, direction, twist) {
  const rotation = product(swing(unit(limits.axis), direction), turn(unit(limits.axis), twist));
  const vector = rotationVector(rotation);
  const readings = readLimits(limits, vector);
  // The same rotation, the long way round.
  const longer = 1 - 360 / Math.hypot(...vector);
  readLimits(
    limits,
    vector.map((x) => longer * x),
  ).forEach(({ name, value }, k) => near(value, readings[k].value, `${name}, the long way`));
  return new Map(readings.map((reading) => [reading.name, reading]));
}

function assertLine({ value, min, max, beyond }, wanted, what) {
  near(value, wanted, what);
  const [least, most] = [min - 0.5, max + 0.5]; // half a degree is no offence
  const clear = Math.min(Math.abs(wanted - least), Math.abs(wanted - most)) > 1e-3;
  if (clear) assert.equal(beyond, wanted < least || wanted > most, `${what}: ${wanted}`);
}

test("a hinge bends, leaves its plane and twists by the angles that made the rotation", () => {
  const hinges = limitsOf("hinge");
  assert.equal(hinges.length, 4); // elbows and knees
  for (const [name, limits] of hinges) {
    const { axis, hinge_axis: hinge } = limits;
    assert.ok(Math.abs(dot(axis, hinge)) < 1e-6, `${name}: the bone lies in the plane of bending`);
    for (let k = 0; k < 100; ++k) {
      const [bend, side, twist] = [random(-85, 165), random(-70, 70), random(-150, 150)];
      // In the plane by the bend, then up to the hinge by the side: a latitude.
      const along = times(turn(hinge, bend), axis);
      const direction = along.map(
        (x, c) => Math.cos(side * kDegree) * x + Math.sin(side * kDegree) * hinge[c],
      );
      const readings = readingsOf(limits, direction, twist);
      assert.deepEqual([...readings.keys()], ["bend", "sideways", "twist"]);
      assertLine(readings.get("bend"), bend, `${name} bend`);
      assertLine(readings.get("sideways"), side, `${name} sideways`);
      assertLine(readings.get("twist"), twist, `${name} twist`);
    }
  }
});

test("a bend past half a turn is more bent, not bent backwards", () => {
  for (const [name, limits] of limitsOf("hinge")) {
    for (const bend of [-89, -1, 0, 90, 179, 181, 230, 269]) {
      const rotation = turn(limits.hinge_axis, bend);
      const [reading] = readLimits(limits, rotationVector(rotation));
      assertLine(reading, bend, `${name} ${bend}`);
    }
  }
});

// The rotation that a quaternion [x, y, z, w] stands for.
function matrixOf([x, y, z, w]) {
  const sine = Math.hypot(x, y, z);
  return sine < 1e-12
    ? turn([1, 0, 0], 0)
    : turn(unit([x, y, z]), (2 * Math.atan2(sine, w)) / kDegree);
}

test("a swing and a twist are those that made the rotation", () => {
  const cones = limitsOf("swing_twist");
  assert.equal(cones.length, 14);
  let checked = 0;
  for (const [name, limits] of cones) {
    const middle = matrixOf(limits.middle);
    const centre = times(middle, limits.axis);
    const about = unit(limits.swing_axis);
    const across = cross(centre, about);
    for (let k = 0; k < 100; ++k) {
      // Directions come rounded to 1e-6, which an arc cosine near 0 or half a turn magnifies.
      const [away, way, twist] = [random(5, 165), random(0, 360), random(-170, 170)];
      const [u, v] = [Math.cos(way * kDegree), Math.sin(way * kDegree)];
      const swung = turn(unit(about.map((x, c) => u * x + v * across[c])), away);
      const twisted = turn(unit(centre), twist);
      const made = limits.twist_with_parent ? product(twisted, swung) : product(swung, twisted);
      const forearm = { axis: [1, 0, 0], rotation_vector: [30, 0, 0] };
      const readings = readLimits(limits, rotationVector(product(made, middle)), forearm);
      const wrist = ["swing", "twist", "twist with forearm"];
      const names = limits.twist_with_parent ? wrist : ["swing", "twist"];
      assert.deepEqual(
        readings.map((r) => r.name),
        names,
      );
      const most = [
        u < 0 ? -limits.swing[0] : limits.swing[1],
        v < 0 ? -limits.side[0] : limits.side[1],
      ];
      assertLine(readings[0], away, `${name} swing`);
      near(readings[0].max, 1 / Math.hypot(u / most[0], v / most[1]), `${name} reach`);
      assertLine(readings[1], twist, `${name} twist`);
      if (readings[2]) assertLine(readings[2], twist + 30, `${name} twist of both`);
      ++checked;
    }
  }
  assert.equal(checked, 1400);
});

test("joints without limits have no readings", () => {
  assert.deepEqual(readLimits({ kind: "free" }, [10, 20, 30]), []);
  assert.deepEqual(readLimits({ kind: "fixed" }, [0, 0, 0]), []);
});

test("rotation vectors there and back", () => {
  for (let k = 0; k < 200; ++k) {
    const axis = randomDirection();
    const angle = random(0, 355);
    const back = rotationVectorOf(rotationOf(axis.map((x) => angle * x)));
    const shorter = angle > 180 ? angle - 360 : angle; // the same rotation
    axis.forEach((x, c) => near(back[c], shorter * x, `${angle} degrees`));
    const made = turn(axis, angle);
    const { x, y, z, w } = rotationOf(axis.map((x_) => angle * x_));
    near(1 - 2 * (y * y + z * z), made[0][0], "the matrix of the quaternion");
    near(2 * (x * y + z * w), made[1][0], "the matrix of the quaternion");
  }
  assert.deepEqual(rotationVectorOf(rotationOf([0, 0, 0])), [0, 0, 0]);
});

// The program names the joints that are more than a degree beyond a limit, and by how much.
test("as far beyond as the program says", async () => {
  const worst = new Map(); // how often each kind of reading was the one that counted
  for (let round = 0; round < 24; ++round) {
    const turns = new Map();
    const ops = ["a", "b"].flatMap((figure) =>
      body[figure].links.slice(1).map(({ name: joint }) => {
        const angle = random(0, 150);
        const rotation_vector = randomDirection().map((x) => angle * x);
        turns.set(`${figure}/${joint}`, rotation_vector);
        return { op: "set_joint", figure, joint, rotation_vector };
      }),
    );
    const { state } = await server.post("/api/do", { session, ops, live: false });
    const said = state.queries.beyond_limits_deg;
    for (const [name, vector] of turns) {
      const [figure, joint] = name.split("/");
      const { limits, parent } = body[figure].links.find((link) => link.name === joint);
      const before = body[figure].links[parent];
      const turned = turns.get(`${figure}/${before.name}`);
      const forearm = turned && { axis: before.limits.axis, rotation_vector: turned };
      const beyond = readLimits(limits, vector, forearm).map(({ name: kind, value, min, max }) => ({
        kind,
        by: Math.max(min - value, value - max),
      }));
      const most = beyond.reduce((x, y) => (y.by > x.by ? y : x));
      if (name in said) {
        near(most.by, said[name], `${name} ${most.kind}`);
        worst.set(most.kind, (worst.get(most.kind) ?? 0) + 1);
      } else {
        assert.ok(most.by < 1.001, `${name}: ${most.kind} ${most.by}, which the program allows`);
        worst.set("within", (worst.get("within") ?? 0) + 1);
      }
    }
  }
  for (const kind of ["bend", "sideways", "swing", "twist", "twist with forearm", "within"]) {
    assert.ok(worst.get(kind) >= 5, `${kind}: ${worst.get(kind)} times`);
  }
});
