// What the page holds: report.json, the series by frame, and the scenes (docs/report.md).

import type { PerFigure } from "../shared/names";
import type { Requirement, RequirementKind } from "../shared/requirement";

export const variants = ["source", "baseline", "result"] as const;
export type Variant = (typeof variants)[number];
export const variantTitle: Record<Variant, string> = {
  source: "Source",
  baseline: "Simulated",
  result: "Result",
};
export const variantMeaning: Record<Variant, string> = {
  source: "the clips, placed, not edited",
  baseline: "forward simulation",
  result: "solved",
};

// What is measured in the frames, and at the instants between them.
export interface Instants {
  tangles: number[][]; // [tags][frames], s GLI, turns
  penetration_cm: number[];
  penetration_pair: (null | [string, string])[];
  floor_cm: PerFigure<number[]>;
  hold_cm: number[][]; // [holds][frames]
}

export interface Series extends Instants {
  between: Instants; // the worst from each frame to the next, one fewer
  self_penetration_cm: PerFigure<number[]>;
  foot_speed_cm_s: PerFigure<number[]>;
  tracking_deg: null | PerFigure<{ joints: string[]; values: number[][] }>; // [joints][frames]
  pass_throughs: { frame: number; a: string; b: string }[];
}

export interface AllSeries {
  fps: number;
  frames: number;
  source: Series;
  baseline: Series | null;
  result: Series;
}

// The part of report.json that the page computes with; the tables are in the page already.
export interface Report {
  tangles: { a: [string, string]; b: [string, string]; template_gli: number }[];
  bodies: PerFigure<{ radius: Record<string, number> }>;
  contacts: PerFigure<{ node: string; first: number; last: number }[]>;
  requirements: Requirement[];
  proof?: { sentence: string; open: number[] }; // open: key intervals, by the key before
  simulation?: null | { status: string; message: string };
  solve: {
    history: {
      stage: number;
      iteration: number;
      cost: number;
      terms?: Record<string, number>;
    }[];
  };
}

function textOf(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

function json<T>(id: string): T {
  const text = textOf(id);
  if (text === null) throw new Error(`the page holds no ${id}`);
  return JSON.parse(text) as T;
}

export const readReport = () => json<Report>("report");
export const readSeries = () => json<AllSeries>("series");

// The bytes of a scene, or null where the page has none.
export function readScene(variant: Variant): ArrayBuffer | null {
  const text = textOf(`${variant}-glb`);
  if (text === null || text.trim() === "") return null;
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes.buffer;
}

// The limit of the first requirement of that kind, and of that tag or hold where it is given.
export function limitOf(
  report: Report,
  kind: RequirementKind,
  otherwise: number,
  item?: number,
): number {
  const isAsked = (r: Requirement) => r.kind === kind && (item === undefined || r.item === item);
  return report.requirements.find(isAsked)?.limit ?? otherwise;
}

// Largest of several series, instant by instant.
export function largest(rows: number[][]): number[] {
  return (rows[0] ?? []).map((_, t) => rows.reduce((m, row) => Math.max(m, row[t] ?? 0), 0));
}
