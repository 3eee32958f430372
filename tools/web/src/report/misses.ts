// Where limits are passed: in the frames, and at the instants between them.

import { figureNames } from "../shared/names";
import type { Requirement } from "../shared/requirement";
import { limitOf, type Instants, type Report, type Series } from "./data";

// A frame's value, the worst of the instants up to the next frame, the next frame's value, ...
export function interleaved<T>(at: T[], between: T[]): T[] {
  return at.flatMap((value, t) => (t < between.length ? [value, between[t]] : [value]));
}

// The time (frames) of an instant of such a curve.
export const timeOf = (index: number) => index / 2;

// A curve and what it must stay above or below.
interface Judged {
  curve: (s: Instants) => number[];
  sign: number; // 1: must stay below, -1: must stay above
  limit: number; // in the curve's unit
}

function judgedBy(r: Requirement): Judged | null {
  const item = r.item ?? 0;
  if (r.kind === "tangle") return { curve: (s) => s.tangles[item], sign: -1, limit: r.limit };
  const limit = 100 * r.limit; // m, cm
  if (r.kind === "penetration") return { curve: (s) => s.penetration_cm, sign: 1, limit };
  if (r.kind === "hold") return { curve: (s) => s.hold_cm[item], sign: 1, limit };
  if (r.kind === "floor" && r.figure) {
    const figure = r.figure;
    return { curve: (s) => s.floor_cm[figure], sign: 1, limit };
  }
  return null;
}

export interface Miss {
  time: number; // frames; a half: between two
  text: string;
}

function when(time: number): string {
  const frame = Math.floor(time);
  return time === frame ? `in frame ${frame}` : `between frames ${frame} and ${frame + 1}`;
}

// Each requirement that is missed, where it is missed by most; those of one instant together.
export function missesOf(report: Report, series: Series): Miss[] {
  const misses = new Map<number, string[]>();
  for (const r of report.requirements) {
    if (r.met) continue;
    const judged = judgedBy(r);
    let time = r.frame;
    if (r.kind === "pass_throughs" && time !== null) time += 0.5;
    if (judged) {
      const values = interleaved(judged.curve(series), judged.curve(series.between));
      const worst = values.reduce(
        (best, v, k) => (judged.sign * v > judged.sign * values[best] ? k : best),
        0,
      );
      time = timeOf(worst);
    }
    if (time === null || time < 0) continue;
    misses.set(time, [...(misses.get(time) ?? []), `${r.name}: worst ${when(time)}`]);
  }
  return [...misses].map(([time, texts]) => ({ time, text: texts.join("; ") }));
}

// Per instant (frame, between, frame, ...): whether a tangle is lost, or another limit is passed.
export function broken(report: Report, series: Series): { lost: boolean; passed: boolean }[] {
  const samples = interleaved(series.penetration_cm, series.between.penetration_cm);
  const tags = series.tangles.map((_, k) => ({
    values: interleaved(series.tangles[k], series.between.tangles[k]),
    limit: limitOf(report, "tangle", 0.5, k),
  }));
  const holds = series.hold_cm.map((_, k) => ({
    values: interleaved(series.hold_cm[k], series.between.hold_cm[k]),
    limit: 100 * limitOf(report, "hold", 0.02, k),
  }));
  const floors = figureNames.map((f) => ({
    values: interleaved(series.floor_cm[f], series.between.floor_cm[f]),
    limit: 100 * limitOf(report, "floor", 0.01),
  }));
  const depth = { values: samples, limit: 100 * limitOf(report, "penetration", 0.02) };
  return samples.map((_, k) => ({
    lost: tags.some(({ values, limit }) => values[k] <= limit),
    passed: [depth, ...holds, ...floors].some(({ values, limit }) => values[k] > limit),
  }));
}
