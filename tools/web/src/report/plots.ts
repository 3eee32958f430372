// Which plots the report shows, and of what.

import { kTangled } from "../shared/gli";
import { words } from "../shared/names";
import { addPlot, type Line } from "./plot";
import type { Clock } from "./clock";
import {
  largest,
  limitOf,
  variants,
  variantTitle,
  type AllSeries,
  type Instants,
  type Report,
  type Series,
} from "./data";
import { interleaved } from "./misses";

const kLook = {
  source: { colour: "--source", dash: [2, 3], width: 1.75 },
  baseline: { colour: "--baseline", dash: [7, 3], width: 1.75 },
  result: { colour: "--result", width: 2.25 },
};
const kTermColours = [
  "--ink",
  "#0072B2",
  "#D55E00",
  "#009E73",
  "#CC79A7",
  "#E69F00",
  "#56B4E9",
  "--muted",
];

// Frames and the instants between them.
const everyInstant =
  (values: (s: Instants) => number[]) =>
  (s: Series): number[] =>
    interleaved(values(s), values(s.between));

function linesOf(series: AllSeries, values: (s: Series) => number[]): Line[] {
  return variants
    .filter((v) => series[v])
    .map((v) => ({
      label: variantTitle[v].toLowerCase(),
      values: values(series[v]!),
      ...kLook[v],
    }));
}

// From zero to a little over the largest value and over the limit.
const fromZero =
  (limit: number) =>
  (_: number, most: number): [number, number] => [0, 1.15 * Math.max(most, limit)];

export function addPlots(
  container: HTMLElement,
  report: Report,
  series: AllSeries,
  clock: Clock,
): void {
  report.tangles.forEach(({ a, b }, k) => {
    addPlot(container, {
      title: `Tag ${k + 1}: s GLI`,
      unit: `turns; a ${words(a[0])} … ${words(a[1])} × b ${words(b[0])} … ${words(b[1])}`,
      lines: linesOf(
        series,
        everyInstant((s) => s.tangles[k]),
      ),
      digits: 2,
      limit: {
        value: limitOf(report, "tangle", kTangled, k),
        text: "lost below",
      },
      range: (least, most) => [Math.min(0, least * 1.1), Math.max(1.05, most * 1.05)],
      clock,
    });
  });
  const centimetres = (title: string, values: (s: Series) => number[], limit?: number) =>
    addPlot(container, {
      title,
      unit: "cm",
      lines: linesOf(series, values),
      digits: 2,
      limit: limit === undefined ? undefined : { value: limit, text: "allowed" },
      range: fromZero(limit ?? 0.5),
      clock,
    });
  const both = (s: { a: number[]; b: number[] }) => largest([s.a, s.b]);
  centimetres(
    "Penetration between the bodies",
    everyInstant((s) => s.penetration_cm),
    100 * limitOf(report, "penetration", 0.02),
  );
  if (series.result.hold_cm.length > 0) {
    centimetres(
      "Hold error",
      everyInstant((s) => largest(s.hold_cm)),
      100 * limitOf(report, "hold", 0.02),
    );
  }
  addPlot(container, {
    title: "Speed of planted feet",
    unit: "cm/s, larger of a and b",
    lines: linesOf(series, (s) => both(s.foot_speed_cm_s)),
    digits: 1,
    range: fromZero(1),
    clock,
  });
  centimetres(
    "Below the floor",
    everyInstant((s) => both(s.floor_cm)),
    100 * limitOf(report, "floor", 0.01),
  );
  centimetres("Penetration of a body with itself", (s) => both(s.self_penetration_cm));
}

// Cost per iteration: all of it, and its largest parts.
export function addCost(container: HTMLElement, report: Report): void {
  const { history } = report.solve;
  if (history.length === 0) return;
  const peak = new Map<string, number>();
  for (const { terms } of history) {
    for (const [term, cost] of Object.entries(terms ?? {})) {
      peak.set(term, Math.max(peak.get(term) ?? 0, cost));
    }
  }
  const parts = [...peak.keys()]
    .sort((x, y) => peak.get(y)! - peak.get(x)!)
    .slice(0, kTermColours.length - 1);
  const positive = (value?: number) => (value !== undefined && value > 0 ? value : null);
  const lines: Line[] = [
    {
      label: "total",
      values: history.map((h) => positive(h.cost)),
      colour: "--ink",
      width: 2.5,
    },
    ...parts.map((term, k) => ({
      label: words(term),
      values: history.map((h) => positive(h.terms?.[term])),
      colour: kTermColours[k + 1],
      dash: k % 2 === 1 ? [6, 3] : undefined,
      width: 1.75,
    })),
  ];
  const stages = history.flatMap((h, k) =>
    k > 0 && h.stage !== history[k - 1].stage ? [k + 0.5] : [],
  );
  addPlot(container, {
    title: "Cost by term",
    unit:
      stages.length > 0
        ? "per iteration, logarithmic; dotted: contact weights rise"
        : "per iteration, logarithmic",
    lines,
    digits: 2,
    range: (_, most) => {
      const floor = Math.max(Math.min(...history.map((h) => h.cost)) * 1e-3, 1e-6);
      return [
        10 ** Math.floor(Math.log10(floor)),
        10 ** Math.ceil(Math.log10(Math.max(most, 10 * floor))),
      ];
    },
    marks: stages,
    logarithmic: true,
  });
}
