// One run of the solver as it goes: its stage, the cost of its iterations, what it says, and the
// report in the end.

import { element, fitCanvas } from "../../shared/dom";
import { onThemeChange, themeColour } from "../../shared/theme";
import { address } from "../state/api";
import type { Requirement } from "../../shared/requirement";
import { show } from "../controls/dialogs";
import { button, list, row } from "../controls/widgets";
import { cm } from "../state/words";

interface Progress {
  stage?: string;
  iteration?: number;
  cost?: number;
  seconds?: number;
}
interface Done {
  exit_code: number;
  verdict: string;
  requirements: Requirement[];
  stopped: boolean;
  report: boolean;
}
const kFiles = ["scene.glb", "source.glb", "baseline.glb", "report.json", "config.yaml"];

export class RunView {
  readonly element: HTMLElement;
  private readonly stage = element("b", {});
  private readonly numbers = element("span", {});
  private readonly curve = element("canvas", {
    class: "curve",
    title: "cost of the iterations (logarithmic); the line breaks where a stage begins",
    role: "img",
    "aria-label": "cost",
  });
  private readonly log = element("pre", {
    class: "log",
    tabindex: "0",
    "aria-label": "what the run says",
  });
  private readonly outcome = element("div", { class: "outcome", hidden: "" });
  private costs: number[] = [];

  constructor() {
    this.element = element(
      "div",
      { class: "stack" },
      element("div", { class: "progress" }, this.stage, this.numbers, this.curve),
      this.outcome,
      this.log,
    );
    new ResizeObserver(() => this.draw()).observe(this.curve);
    onThemeChange(() => this.draw());
  }

  // Follows a job's events; `over` when it has ended.
  watch(job: string, over: () => void): void {
    this.costs = [];
    this.outcome.hidden = true;
    this.log.textContent = "";
    this.tell({ stage: "starting" });
    const events = new EventSource(address("/api/solve/events", { job }));
    const end = () => {
      events.close();
      this.outcome.hidden = false;
      over();
    };
    const on = <T>(name: string, act: (data: T) => void) =>
      events.addEventListener(name, (event) =>
        act(JSON.parse((event as MessageEvent<string>).data) as T),
      );
    on<Progress>("progress", (progress) => this.tell(progress));
    on<{ line: string }>("log", ({ line }) => {
      this.log.append(`${line}\n`);
      this.log.scrollTop = this.log.scrollHeight;
    });
    on<Done>("done", (done) => {
      end();
      this.finish(job, done);
    });
    const fail = (error: string, stopped: boolean) => {
      end();
      this.stage.textContent = stopped ? "stopped" : "failed";
      this.outcome.replaceChildren(element("p", { class: "bad" }, error));
    };
    on<{ error: string; stopped?: boolean }>("failed", ({ error, stopped }) =>
      fail(error, Boolean(stopped)),
    );
    events.onerror = () => {
      if (events.readyState === EventSource.CLOSED)
        fail("The server does not tell of this run any more.", false);
    };
  }

  tell({ stage, iteration, cost, seconds }: Progress): void {
    if (stage) this.stage.textContent = stage;
    const said: string[] = [];
    if (iteration !== undefined) said.push(`iteration ${iteration}`);
    if (cost !== undefined) said.push(`cost ${cost.toPrecision(4)}`);
    if (seconds !== undefined) said.push(`${seconds.toFixed(1)} s`);
    this.numbers.textContent = said.join(" · ");
    if (cost !== undefined && cost > 0) this.costs.push(cost);
    this.draw();
  }

  private draw(): void {
    if (this.curve.offsetParent === null) return;
    const context = fitCanvas(this.curve);
    const [width, height] = [this.curve.clientWidth, this.curve.clientHeight];
    const logs = this.costs.map(Math.log10);
    const [low, high] = [Math.min(...logs), Math.max(...logs)];
    context.strokeStyle = themeColour("--accent");
    context.lineWidth = 1.5;
    context.beginPath();
    logs.forEach((value, k) => {
      const x = 4 + ((width - 8) * k) / Math.max(1, logs.length - 1);
      const y = 5 + (height - 10) * (1 - (value - low) / Math.max(1e-9, high - low));
      if (k === 0 || value > logs[k - 1])
        context.moveTo(x, y); // a stage with other weights
      else context.lineTo(x, y);
    });
    context.stroke();
  }

  private finish(job: string, { exit_code, verdict, requirements, stopped, report }: Done): void {
    this.stage.textContent = stopped ? "stopped" : "done";
    const table = element("table", {});
    list(
      table,
      requirements ?? [],
      (r) => r,
      ({ name, value, unit, met, where }) =>
        element(
          "tr",
          { class: met ? "" : "missed", title: where },
          element("td", { class: met ? "good" : "bad" }, met ? "✓" : "✕"),
          element("td", {}, name),
          element("td", { class: "number" }, value === null ? "none" : measured(value, unit)),
        ),
    );
    const files = kFiles.map((name) =>
      element("a", { href: address("/api/solve/file", { job, name }), download: name }, name),
    );
    const open = button(
      "Open the report",
      "players, curves and tables of this run",
      () => openReport(address("/api/solve/report", { job })),
      "primary",
    );
    this.outcome.replaceChildren(
      element("p", { class: exit_code === 0 ? "good" : "bad" }, verdict),
      ...(report ? [row(open)] : []),
      table,
      element("p", { class: "files" }, ...files),
    );
  }
}

// Lengths in cm, as everywhere on the page.
const measured = (value: number, unit: string) =>
  unit === "m" ? cm(value) : `${Number(value.toPrecision(3))} ${unit}`;

// Over the page, not instead of it.
function openReport(url: string): void {
  const away = element(
    "a",
    { href: url, target: "_blank", rel: "noopener" },
    "in a tab of its own",
  );
  const close = button("Close", "back to the studio (Escape)", () => dialog.close());
  const dialog: HTMLDialogElement = element(
    "dialog",
    { class: "report", "aria-label": "Report" },
    element("div", { class: "row" }, element("h2", {}, "Report"), away, close),
    element("iframe", { src: url, title: "report of the run" }),
  );
  show(dialog);
}
