// Drawn over a view: handles, pins, holds, where feet stand, where bodies overlap.

import { Vector3 } from "three";
import { cssOf, figureColour, mix, rgbOf } from "../../shared/colours";
import { figureNames } from "../../shared/names";
import { themeColour } from "../../shared/theme";
import { drawLimits } from "./limit_arcs";
import { isOpen, stands } from "../state/measures";
import { isBehind, isMinor, unit } from "./picking";
import type { Vec } from "../state/protocol";
import type { Pick, Store } from "../state/store";
import type { View } from "./view";
import { cm, nodeOf } from "../state/words";

const kOverlapFrom = 0.01; // m; less is contact

type Context = CanvasRenderingContext2D;
type Point = { x: number; y: number };

const same = (a: Pick | null, b: Pick) => a !== null && a.figure === b.figure && a.node === b.node;

function disc(context: Context, at: Point, radius: number): void {
  context.beginPath();
  context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
}
function line(context: Context, from: Point, to: Point): void {
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}
function diamond(context: Context, at: Point, r: number): void {
  context.beginPath();
  context.moveTo(at.x, at.y - r);
  context.lineTo(at.x + r, at.y);
  context.lineTo(at.x, at.y + r);
  context.lineTo(at.x - r, at.y);
  context.closePath();
}

function onPage(view: View, place: Vector3 | Vec): Point | null {
  const at = view.project(place);
  return at && { x: at.x / unit(), y: at.y / unit() };
}

// Words on a plate, kept inside the view.
function label(context: Context, view: View, text: string, at: Point, colour: string): void {
  context.font = "600 12px system-ui, sans-serif";
  const width = context.measureText(text).width + 12;
  const height = 20;
  const box = view.element.getBoundingClientRect();
  const [left, top, right, bottom] = [box.left, box.top, box.right, box.bottom].map(
    (v) => v / unit(),
  );
  const x = Math.min(Math.max(at.x + 12, left + 4), right - width - 4);
  const y = Math.min(Math.max(at.y - height - 8, top + 4), bottom - height - 4);
  context.fillStyle = themeColour("--card");
  context.strokeStyle = themeColour("--edge");
  context.lineWidth = 1;
  context.beginPath();
  context.roundRect(x, y, width, height, 4);
  context.fill();
  context.stroke();
  context.fillStyle = colour;
  context.textBaseline = "middle";
  context.fillText(text, x + 6, y + height / 2 + 0.5);
}

export class Overlay {
  constructor(private readonly store: Store) {}

  draw(context: Context, view: View): void {
    if (view.name === "main") drawLimits(context, view, this.store);
    context.scale(unit(), unit());
    this.rays(context, view);
    this.holds(context, view);
    this.supports(context, view);
    this.handles(context, view);
    this.pins(context, view);
    this.overlaps(context, view);
    this.target(context, view);
    this.tooltip(context, view);
  }

  private handles(context: Context, view: View): void {
    const { store } = this;
    const { ui } = store;
    const small = view.name === "main" ? 1 : 0.72;
    for (const figure of figureNames) {
      if (ui.shown[figure] !== "shown") continue;
      const colour = rgbOf(figureColour[figure]);
      store.body[figure].nodes.forEach(({ name }, node) => {
        const pick = { figure, node };
        const at = onPage(view, store.place(pick));
        if (!at) return;
        const [hovered, selected] = [same(ui.hovered, pick), same(ui.selected, pick)];
        const behind = !hovered && !selected && isBehind(store, view, pick);
        const radius = (hovered || selected ? 6.5 : isMinor(name) ? 3.4 : 4.6) * small;
        context.globalAlpha = behind ? 0.3 : 1;
        disc(context, at, radius);
        context.fillStyle = cssOf(mix(colour, [1, 1, 1], hovered ? 0.65 : 0.25));
        context.fill();
        context.lineWidth = 1.5;
        context.strokeStyle = "rgb(255 255 255 / 0.95)";
        context.stroke();
        disc(context, at, radius + 1.3);
        context.lineWidth = 1;
        context.strokeStyle = "rgb(0 0 0 / 0.55)";
        context.stroke();
        if (selected || same(ui.holdFrom, pick)) {
          disc(context, at, radius + 4);
          context.lineWidth = 2;
          context.strokeStyle = themeColour("--accent");
          context.stroke();
        }
        context.globalAlpha = 1;
      });
    }
  }

  private pins(context: Context, view: View): void {
    for (const pin of this.store.state.pins) {
      const at = onPage(view, pin.position);
      if (!at) continue;
      diamond(context, at, view.name === "main" ? 7 : 5);
      context.fillStyle = "#F0E442";
      context.fill();
      context.lineWidth = 1.5;
      context.strokeStyle = "rgb(0 0 0 / 0.8)";
      context.stroke();
    }
  }

  // Lines of sight that nodes are pinned to.
  private rays(context: Context, view: View): void {
    context.setLineDash([6, 4]);
    context.lineWidth = 1.5;
    context.strokeStyle = themeColour("--accent");
    for (const { ray } of this.store.state.pins) {
      if (!ray) continue;
      const [origin, direction] = [
        new Vector3(...ray.origin),
        new Vector3(...ray.direction).normalize(),
      ];
      const [from, to] = [0.5, 9].map((s) =>
        onPage(view, origin.clone().addScaledVector(direction, s)),
      );
      if (from && to && Math.hypot(from.x - to.x, from.y - to.y) > 3) line(context, from, to);
    }
    context.setLineDash([]);
  }

  private holds(context: Context, view: View): void {
    this.store.state.holds.forEach((hold, k) => {
      const [from, to] = [onPage(view, hold.from_place), onPage(view, hold.to_place)];
      if (!from || !to) return;
      const open = isOpen(hold);
      const lit = this.store.ui.litHold === k;
      const colour = open ? themeColour("--bad") : themeColour("--good");
      context.setLineDash(open ? [5, 4] : []);
      context.lineCap = "round";
      for (const [width, stroke] of [
        [lit ? 8 : 5.5, "rgb(255 255 255 / 0.9)"],
        [lit ? 5 : 3, colour],
      ] as const) {
        context.lineWidth = width;
        context.strokeStyle = stroke;
        line(context, from, to);
      }
      context.setLineDash([]);
      const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
      // Two links of a chain.
      for (const shift of [-4, 4]) {
        context.beginPath();
        context.ellipse(middle.x + shift, middle.y, 6, 4, 0, 0, 2 * Math.PI);
        context.lineWidth = lit ? 5.5 : 4.5;
        context.strokeStyle = "rgb(255 255 255 / 0.95)";
        context.stroke();
        context.lineWidth = lit ? 3.2 : 2.2;
        context.strokeStyle = colour;
        context.stroke();
      }
      if (hold.to.figure === "world") {
        context.lineWidth = 2;
        line(context, { x: to.x - 9, y: to.y + 8 }, { x: to.x + 9, y: to.y + 8 });
      }
      if (open && view.name === "main") label(context, view, cm(hold.error_m), middle, colour);
    });
  }

  // A short bar under each node that may be planted and stands.
  private supports(context: Context, view: View): void {
    if (view.name === "top") return;
    context.lineWidth = 2.5;
    context.strokeStyle = themeColour("--good");
    for (const figure of figureNames) {
      if (this.store.ui.shown[figure] === "hidden") continue;
      for (const name of this.store.state.supports[figure]) {
        const node = this.store.findNode(figure, name);
        const place = this.store.place({ figure, node });
        if (!stands(place)) continue;
        const at = onPage(view, [place[0], 0, place[2]] as Vec);
        const across = new Vector3()
          .setFromMatrixColumn(view.camera.matrixWorld, 0)
          .multiplyScalar(0.045);
        const edge = onPage(view, new Vector3(place[0], 0, place[2]).add(across));
        if (!at || !edge) continue;
        const half = Math.hypot(edge.x - at.x, edge.y - at.y);
        line(context, { x: at.x - half, y: at.y }, { x: at.x + half, y: at.y });
      }
    }
  }

  private overlaps(context: Context, view: View): void {
    const colour = "#D55E00";
    // Deepest first; that one alone says how deep.
    for (const [k, { depth_m, place }] of this.store.state.queries.overlaps.entries()) {
      if (depth_m < kOverlapFrom) continue;
      const at = onPage(view, place);
      if (!at) continue;
      disc(context, at, 9);
      context.fillStyle = "rgb(213 94 0 / 0.35)";
      context.fill();
      context.lineWidth = 2;
      context.strokeStyle = colour;
      context.stroke();
      if (view.name === "main" && k === 0)
        label(context, view, `${cm(depth_m)} inside`, at, themeColour("--bad"));
    }
  }

  // Where a drag wants the node to be.
  private target(context: Context, view: View): void {
    const { dragTarget, selected } = this.store.ui;
    if (!dragTarget || !selected) return;
    const [at, node] = [onPage(view, dragTarget), onPage(view, this.store.place(selected))];
    if (!at || !node) return;
    context.lineWidth = 1.5;
    context.strokeStyle = themeColour("--ink");
    context.setLineDash([3, 3]);
    line(context, node, at);
    context.setLineDash([]);
    line(context, { x: at.x - 6, y: at.y }, { x: at.x + 6, y: at.y });
    line(context, { x: at.x, y: at.y - 6 }, { x: at.x, y: at.y + 6 });
  }

  private tooltip(context: Context, view: View): void {
    const { hovered, selected, dragging } = this.store.ui;
    const named = hovered ?? (dragging ? selected : null);
    if (!named) return;
    const at = onPage(view, this.store.place(named));
    if (!at || (view.name !== "main" && !view.element.matches(":hover"))) return;
    label(
      context,
      view,
      nodeOf(named.figure, this.store.nodeName(named)),
      at,
      themeColour(`--figure-${named.figure}`),
    );
  }
}
