// One plot over the frames: thin lines, a limit, the values in words above, and the frame that the
// players show. Clicking or dragging takes the players along.

import uPlot from "uplot";
import { element } from "../shared/dom";
import { onThemeChange, themeColour } from "../shared/theme";
import type { Clock } from "./clock";

export interface Line {
  label: string;
  values: (number | null)[]; // one per frame, or frames and the instants between them in turn
  colour: string; // a custom property of the style sheet, or a colour
  dash?: number[];
  width?: number;
}

export interface PlotOptions {
  title: string;
  unit: string;
  lines: Line[];
  digits: number;
  limit?: { value: number; text: string };
  range: (least: number, most: number) => [number, number];
  clock?: Clock; // x are its frames; without it x counts from 1 and nothing jumps
  marks?: number[]; // x of vertical lines
  logarithmic?: boolean;
}

const kHeight = 150;
const sync = uPlot.sync("frames");
const colourOf = (name: string) => (name.startsWith("--") ? themeColour(name) : name);

// The sample of a line, as it is drawn in the plot.
function swatch({ colour, dash, width }: Line): SVGSVGElement {
  const ns = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(ns, "svg");
  svg.setAttribute("class", "swatch");
  svg.setAttribute("viewBox", "0 0 22 8");
  const line = document.createElementNS(ns, "line");
  const attributes: Record<string, string> = {
    x1: "0",
    x2: "22",
    y1: "4",
    y2: "4",
    "stroke-width": String(width ?? 2),
    "stroke-dasharray": (dash ?? []).join(" "),
  };
  for (const [key, value] of Object.entries(attributes)) line.setAttribute(key, value);
  line.style.stroke = colour.startsWith("--") ? `var(${colour})` : colour;
  svg.append(line);
  return svg;
}

function drawGuides(u: uPlot, { limit, marks }: PlotOptions): void {
  const { ctx, bbox } = u;
  const ratio = uPlot.pxRatio;
  ctx.save();
  ctx.lineWidth = ratio;
  if (limit) {
    const y = Math.round(u.valToPos(limit.value, "y", true)) + 0.5;
    ctx.strokeStyle = ctx.fillStyle = themeColour("--bad");
    ctx.setLineDash([5 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = "right";
    ctx.textBaseline = y - bbox.top > 16 * ratio ? "bottom" : "top";
    ctx.fillText(limit.text, bbox.left + bbox.width - 4 * ratio, y - ratio);
  }
  ctx.setLineDash([2 * ratio, 4 * ratio]);
  ctx.strokeStyle = themeColour("--muted");
  for (const mark of marks ?? []) {
    const x = Math.round(u.valToPos(mark, "x", true)) + 0.5;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
  }
  ctx.restore();
}

function axes(options: PlotOptions): uPlot.Axis[] {
  const common: uPlot.Axis = {
    stroke: () => themeColour("--muted"),
    grid: { stroke: () => themeColour("--rule"), width: 1 },
    ticks: { show: false },
    font: "11px system-ui, sans-serif",
  };
  const whole = [1, 2, 5]
    .flatMap((m) => [0, 1, 2, 3, 4].map((e) => m * 10 ** e))
    .sort((a, b) => a - b);
  const y: uPlot.Axis = { ...common, size: 46, space: 26 };
  if (options.logarithmic) {
    y.values = (_, splits) =>
      splits.map((v) => (v !== null && /^1/.test(v.toExponential()) ? String(v) : ""));
  }
  return [{ ...common, size: 24, incrs: whole, space: 60 }, y];
}

// Dragging along the plot is scrubbing.
function scrubWith(u: uPlot, clock: Clock): void {
  const seek = (event: PointerEvent) => {
    clock.seek(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, "x"));
  };
  u.over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    u.over.setPointerCapture(event.pointerId);
    seek(event);
  });
  u.over.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) seek(event);
  });
}

export function addPlot(container: HTMLElement, options: PlotOptions): uPlot {
  const { clock, lines, unit, digits } = options;
  const values = lines.map(() => element("b"));
  const key = element(
    "p",
    { class: "key" },
    ...lines.map((line, k) => element("span", {}, swatch(line), ` ${line.label} `, values[k])),
  );
  const host = element("div", { class: "plot-host" });
  container.append(
    element(
      "figure",
      { class: "plot", "data-plot": options.title },
      element(
        "figcaption",
        {},
        element("h3", {}, options.title, " ", element("small", {}, unit)),
        key,
      ),
      host,
    ),
  );

  const count = lines[0].values.length;
  const perFrame = clock && count > clock.frames ? 2 : 1;
  const x = Array.from({ length: count }, (_, k) => (clock ? k / perFrame : k + 1));
  const tell = (index: number | null | undefined) => {
    const at = index ?? (clock ? Math.floor(clock.time * perFrame + 1e-9) : count - 1);
    lines.forEach((line, k) => {
      const value = line.values[at];
      values[k].textContent =
        value == null ? "–" : options.logarithmic ? value.toPrecision(3) : value.toFixed(digits);
    });
  };
  const u = new uPlot(
    {
      width: Math.max(200, host.clientWidth),
      height: kHeight,
      legend: { show: false },
      padding: [8, 12, 0, 0],
      cursor: {
        drag: { x: false, y: false },
        points: { size: 6 },
        y: false,
        ...(clock ? { sync: { key: sync.key } } : {}),
      },
      scales: {
        x: {
          time: false,
          range: (_, least, most) => (most > least ? [least, most] : [least - 0.5, least + 0.5]),
        },
        y: {
          range: (_, least, most) => options.range(least ?? 0, most ?? 1),
          ...(options.logarithmic ? { distr: 3 as const, log: 10 as const } : {}),
        },
      },
      axes: axes(options),
      series: [
        {},
        ...lines.map((line): uPlot.Series => ({
          stroke: () => colourOf(line.colour),
          width: line.width ?? 2,
          dash: line.dash,
          points: { show: count < 2 },
          spanGaps: false,
        })),
      ],
      hooks: {
        draw: [(self) => drawGuides(self, options)],
        setCursor: [(self) => tell(self.cursor.idx)],
      },
    },
    [x, ...lines.map((line) => line.values)] as uPlot.AlignedData,
    host,
  );

  tell(null);
  new ResizeObserver(() => {
    if (host.clientWidth > 0) u.setSize({ width: host.clientWidth, height: kHeight });
    place();
  }).observe(host);
  onThemeChange(() => u.redraw());
  const playhead = element("i", { class: "playhead" });
  const place = () => {
    if (clock) playhead.style.transform = `translateX(${u.valToPos(clock.time, "x")}px)`;
  };
  if (clock) {
    u.over.append(playhead);
    u.over.style.cursor = "crosshair";
    scrubWith(u, clock);
    clock.onChange(() => {
      place();
      if (u.cursor.idx == null) tell(null);
    });
    place();
  }
  return u;
}
