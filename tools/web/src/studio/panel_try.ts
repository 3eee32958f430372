// Panel "Try it": two clips solved by the template as it stands, watched, stopped, read.

import { element, fitCanvas } from "../shared/dom";
import { themeColour } from "../shared/theme";
import { address, get, post, trying } from "./api";
import type { Requirement } from "./protocol";
import type { Store } from "./store";
import { button, list, note, row, section, select } from "./widgets";

interface Clip {
  id: string;
  name: string;
  frames?: number;
  error?: string; // why it cannot be used
}
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
  report: boolean;
}
const kFiles = ["scene.glb", "source.glb", "baseline.glb", "report.json", "config.yaml"];

export class TryPanel {
  readonly element = element("div", { class: "panel" });
  readonly solve = button("Solve", "run retarget on the two clips with this template", () => void this.begin(), "primary");
  private readonly stop = button("Stop", "stop the run; the best result so far is kept where there is one", () => void this.end());
  private readonly clips = { a: select("the clip of figure a", [], () => {}), b: select("the clip of figure b", [], () => {}) };
  private readonly frames = element("input", { type: "text", placeholder: "all", title: "frames of the clips, such as 0:240; empty: all", "aria-label": "frames, such as 0:240" });
  private readonly begins = select("where the solve starts (solve.start)", [["", "start: simulated"], ["template", "start: template (quicker)"], ["best", "start: best of both"]], () => {});
  private readonly noClips = note("No clips found. Start the studio with --clip-a A --clip-b B, or put .bvh, .glb or .vrm files into the library's folder.");
  private readonly progress = element("div", { class: "progress", hidden: "" }, element("b", {}), element("span", {}), element("canvas", { class: "curve", title: "cost of the iterations (logarithmic)" }));
  private readonly log = element("pre", { class: "log", tabindex: "0", "aria-label": "what the run says" });
  private readonly outcome = element("div", { class: "outcome", hidden: "" });
  private readonly result: HTMLDetailsElement;
  private job: string | null = null;
  private events: EventSource | null = null;
  private costs: number[] = [];
  private readonly say = (text: string, kind: "bad") => this.store.say(text, kind);

  constructor(private readonly store: Store) {
    const field = (label: string, input: HTMLElement) => element("label", { class: "field inline" }, label, input);
    this.result = section("Run", this.progress, this.outcome, this.log);
    this.result.hidden = true;
    this.stop.disabled = true;
    this.element.append(section("Clips", this.noClips, field("a", this.clips.a.element), field("b", this.clips.b.element),
      field("Frames", this.frames), field("Start", this.begins.element), row(this.solve, this.stop)), this.result);
  }

  load(): Promise<void> {
    return trying(this.say, () => this.fill());
  }

  private async fill(): Promise<void> {
    const { files } = await get<{ files: Clip[] }>("/api/clips");
    const said = ({ name, frames, error }: Clip) =>
      error ? `${name}: ${error}` : frames ? `${name} (${frames} frames)` : name;
    const options = files.map((clip) => [clip.id, said(clip)] as [string, string]);
    const pick = (figure: "a" | "b", k: number) => {
      const now = this.clips[figure].element.value;
      const likely = files.find(({ id }) => id === `start/${figure}`) ?? files.find(({ name }) => new RegExp(`(^|[/ ])${figure}\\.`).test(name)) ?? files[k];
      this.clips[figure].set(now || likely?.id || "", options);
    };
    pick("a", 0);
    pick("b", Math.min(1, files.length - 1));
    this.noClips.hidden = files.length > 0;
    this.solve.disabled = files.length === 0 || this.job !== null;
  }

  private async begin(): Promise<void> {
    const frames = this.frames.value.trim();
    const start = this.begins.element.value;
    await trying(this.say, async () => {
      const { job } = await post<{ job: string }>("/api/solve", {
        session: this.store.session, clip_a: this.clips.a.element.value, clip_b: this.clips.b.element.value,
        ...(frames ? { frames } : {}), ...(start ? { settings: { "solve.start": start } } : {}),
      });
      this.watch(job);
    });
  }

  private watch(job: string): void {
    this.job = job;
    this.costs = [];
    this.solve.disabled = true;
    this.stop.disabled = false;
    this.result.hidden = this.progress.hidden = false;
    this.outcome.hidden = true;
    this.log.textContent = "";
    this.tell({ stage: "starting" });
    const events = (this.events = new EventSource(address("/api/solve/events", { job })));
    const on = <T>(name: string, act: (data: T) => void) =>
      events.addEventListener(name, (event) => act(JSON.parse((event as MessageEvent<string>).data) as T));
    on<Progress>("progress", (progress) => this.tell(progress));
    on<{ line: string }>("log", ({ line }) => {
      this.log.append(`${line}\n`);
      this.log.scrollTop = this.log.scrollHeight;
    });
    on<Done>("done", (done) => this.finish(job, done));
    on<{ error: string; stopped?: boolean }>("failed", ({ error, stopped }) => this.fail(error, stopped));
    events.onerror = () => {
      if (events.readyState === EventSource.CLOSED && this.job === job) this.fail("The run's events have ended.");
    };
  }

  private tell({ stage, iteration, cost, seconds }: Progress): void {
    const [title, numbers] = [this.progress.querySelector("b")!, this.progress.querySelector("span")!];
    if (stage) title.textContent = stage;
    const said = [];
    if (iteration !== undefined) said.push(`iteration ${iteration}`);
    if (cost !== undefined) said.push(`cost ${cost.toPrecision(4)}`);
    if (seconds !== undefined) said.push(`${seconds.toFixed(1)} s`);
    numbers.textContent = said.join(" · ");
    if (cost !== undefined && cost > 0) this.costs.push(cost);
    this.draw();
  }

  private draw(): void {
    const canvas = this.progress.querySelector("canvas")!;
    if (canvas.offsetParent === null) return;
    const context = fitCanvas(canvas);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const logs = this.costs.map(Math.log10);
    const [low, high] = [Math.min(...logs), Math.max(...logs)];
    context.strokeStyle = themeColour("--accent");
    context.lineWidth = 1.5;
    context.beginPath();
    logs.forEach((value, k) => {
      const x = 2 + ((width - 4) * k) / Math.max(1, logs.length - 1);
      const y = 4 + (height - 8) * (1 - (value - low) / Math.max(1e-9, high - low));
      if (k === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    context.stroke();
  }

  private async end(): Promise<void> {
    if (!this.job) return;
    this.stop.disabled = true;
    await trying(this.say, async () => {
      await post("/api/solve/stop", { job: this.job });
      this.tell({ stage: "stopping" });
    });
  }

  private over(): void {
    this.events?.close();
    this.events = null;
    this.job = null;
    this.solve.disabled = false;
    this.stop.disabled = true;
    this.outcome.hidden = false;
  }
  private fail(error: string, stopped = false): void {
    this.over();
    this.progress.querySelector("b")!.textContent = stopped ? "stopped" : "failed";
    this.outcome.replaceChildren(element("p", { class: "bad" }, error));
  }

  private finish(job: string, { exit_code, verdict, requirements, report }: Done): void {
    this.over();
    this.progress.querySelector("b")!.textContent = exit_code === 130 ? "stopped" : "done";
    const table = element("table", {});
    list(table, requirements ?? [], (r) => r, (r) => element("tr", { class: r.met ? "" : "missed", title: r.where },
      element("td", { class: r.met ? "good" : "bad" }, r.met ? "✓" : "✕"), element("td", {}, r.name),
      element("td", { class: "number" }, `${Number(r.value.toPrecision(3))} ${r.unit}`)));
    const files = kFiles.map((name) => element("a", { href: address("/api/solve/file", { job, name }), download: name }, name));
    this.outcome.replaceChildren(
      element("p", { class: exit_code === 0 ? "good" : "bad" }, verdict),
      ...(report ? [row(button("Open the report", "players, curves and tables of this run", () => this.open(job), "primary"))] : []),
      table, element("p", { class: "files" }, ...files));
  }

  // Over the page, not instead of it.
  private open(job: string): void {
    const url = address("/api/solve/report", { job });
    const frame = element("iframe", { src: url, title: "report of the run" });
    const away = element("a", { href: url, target: "_blank", rel: "noopener" }, "in a tab of its own");
    const dialog = element("dialog", { class: "report", "aria-label": "Report" },
      element("div", { class: "row" }, element("h2", {}, "Report"), away, button("Close", "back to the studio (Escape)", () => dialog.close())), frame);
    document.body.append(dialog);
    dialog.addEventListener("close", () => dialog.remove());
    dialog.showModal();
  }
}
