// Which node is meant by a point of the page.

import { Vector3 } from "three";
import { figureNames } from "../../shared/names";
import type { Pick, Store } from "../state/store";
import type { View } from "./view";

const kReach = 13; // units round a handle
const kBehind = 5; // units that a hidden handle counts as further away

// CSS pixels of a stroke that is 1 wide on a usual screen; more where the style sheet makes
// everything larger.
export function unit(): number {
  known ||= parseFloat(getComputedStyle(document.documentElement).fontSize) / 13;
  return known;
}
let known = 0;
addEventListener("resize", () => (known = 0));

// Nodes in the crowd of the trunk: their handles are smaller.
const kMinor = new Set(["neck", "head_top", "root"]);
export const isMinor = (name: string) => kMinor.has(name);

// Distance of the point `p` of a ray to the segment a..b, both closest.
function gap(origin: Vector3, direction: Vector3, most: number, a: Vector3, b: Vector3) {
  const v = b.clone().sub(a);
  const w = origin.clone().sub(a);
  const vv = v.lengthSq();
  const uv = direction.dot(v);
  const denominator = vv - uv * uv;
  let t = denominator > 1e-9 ? (w.dot(v) - uv * w.dot(direction)) / denominator : 0;
  t = Math.min(1, Math.max(0, t));
  const s = Math.min(most, Math.max(0, uv * t - w.dot(direction)));
  return {
    distance: origin
      .clone()
      .addScaledVector(direction, s)
      .distanceTo(a.clone().addScaledVector(v, t)),
    along: s,
  };
}

// Whether a limb that the node is no end of stands between the main camera and the node.
export function isBehind(store: Store, view: View, pick: Pick): boolean {
  const place = new Vector3(...store.place(pick));
  const origin =
    view.name === "main"
      ? view.camera.position.clone()
      : place.clone().addScaledVector(view.towardsViewer(), 5);
  const direction = place.clone().sub(origin);
  const most = direction.length();
  direction.normalize();
  for (const figure of figureNames) {
    if (store.ui.shown[figure] !== "shown") continue;
    const { nodes } = store.body[figure];
    const at = store.state.figures[figure].nodes;
    for (let n = 1; n < nodes.length; ++n) {
      const { parent, radius_m } = nodes[n];
      if (figure === pick.figure && (n === pick.node || parent === pick.node)) continue;
      const { distance, along } = gap(
        origin,
        direction,
        most,
        new Vector3(...at[parent]),
        new Vector3(...at[n]),
      );
      if (distance < 0.9 * radius_m && along < most - radius_m) return true;
    }
  }
  return false;
}

// The node whose handle is at the page's point (x, y); null where there is none.
export function pickNode(store: Store, view: View, x: number, y: number): Pick | null {
  let best: Pick | null = null;
  let least = Infinity;
  for (const figure of figureNames) {
    if (store.ui.shown[figure] !== "shown") continue;
    for (let node = 0; node < store.body[figure].nodes.length; ++node) {
      const at = view.project(store.state.figures[figure].nodes[node]);
      if (!at) continue;
      const distance = Math.hypot(at.x - x, at.y - y);
      if (distance > kReach * unit()) continue;
      const pick = { figure, node };
      const cost =
        distance +
        (isMinor(store.nodeName(pick)) ? 2 : 0) +
        (isBehind(store, view, pick) ? kBehind : 0);
      if (cost < least) [best, least] = [pick, cost];
    }
  }
  return best;
}
