// The report page: reads what the page holds, and wires its parts to one clock.

import "uplot/dist/uPlot.min.css";
import "../shared/theme.css";
import "./report.css";
import { byId } from "../shared/dom";
import { Clock } from "./clock";
import { readReport, readSeries, type Variant } from "./data";
import { Players } from "./players";
import { addCost, addPlots } from "./plots";
import { keepInView } from "./stage";
import { TrackingStrip } from "./strip";
import { enliven, openForPrint } from "./tables";
import { Transport } from "./transport";

// For tests and for curious people at the console.
interface ReportHandle {
  frame: number;
  ready: boolean; // players, plots and tables show what they hold
  readyMs: number; // since the page began to load
  seek(frame: number): void;
  playerNodePosition(which: Variant, node: string): [number, number, number];
  playerTagGli(which: Variant, tag: number): number;
}
declare global {
  interface Window {
    retargetReport: ReportHandle;
  }
}

function onKey(event: KeyboardEvent, clock: Clock): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target as HTMLElement;
  const types = target instanceof HTMLInputElement ? target.type : "";
  const usesArrows = target instanceof HTMLSelectElement || types === "radio" || types === "range";
  const usesSpace =
    target instanceof HTMLSelectElement ||
    types === "checkbox" ||
    types === "radio" ||
    target.closest("button, summary") !== null;
  const step = event.shiftKey ? 10 : 1;
  if (event.key === " " && !usesSpace) clock.toggle();
  else if (event.key === "ArrowLeft" && !usesArrows) clock.step(-step);
  else if (event.key === "ArrowRight" && !usesArrows) clock.step(step);
  else return;
  event.preventDefault();
}

async function start(): Promise<void> {
  const report = readReport();
  const series = readSeries();
  const clock = new Clock(series.frames, series.fps);
  let ready = false;
  let readyMs = 0;
  byId("stage-space").hidden = false;
  const players = new Players(byId("panels"), report, series, clock);
  window.retargetReport = {
    get frame() {
      return clock.frame;
    },
    get ready() {
      return ready;
    },
    get readyMs() {
      return readyMs;
    },
    seek: (frame) => clock.seek(frame),
    playerNodePosition: (which, node) => players.nodePosition(which, node),
    playerTagGli: (which, tag) => players.tagGli(which, tag),
  };
  const transport = new Transport(byId("transport"), report, series, clock, players);
  addPlots(byId("plots"), report, series, clock);
  if (series.result.tracking_deg) new TrackingStrip(byId("wide-plots"), series, clock);
  addCost(byId("wide-plots"), report);
  enliven(clock, transport);
  keepInView(() => players.view?.drawNow());
  openForPrint();
  addEventListener("keydown", (event) => onKey(event, clock));
  // Plots and tables can be used while the players, which take longer, are made.
  await new Promise((painted) => setTimeout(painted));
  await players.load();
  players.view?.drawNow();
  readyMs = performance.now();
  ready = true;
}

void start();
