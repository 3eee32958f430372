// Panel "Try it": two clips solved by the template as it stands, watched, stopped, read.

import { element } from "../../shared/dom";
import { figureNames } from "../../shared/names";
import { get, post, trying } from "../state/api";
import { RunView } from "./run_view";
import type { Store } from "../state/store";
import { button, note, row, section, select } from "../controls/widgets";

interface Clip {
  id: string;
  name: string;
  frames?: number;
  error?: string; // why it cannot be used
}
const kStarts: [string, string][] = [
  ["", "simulated, as without the studio"],
  ["template", "from the template (quicker)"],
  ["best", "the better of both"],
];

export class TryPanel {
  readonly element = element("div", { class: "panel" });
  private readonly solve = button(
    "Solve",
    "run retarget on the two clips with this template",
    () => void this.begin(),
    "primary",
  );
  private readonly stop = button(
    "Stop",
    "stop the run; the best result so far is kept where there is one",
    () => void this.end(),
  );
  private readonly clips = {
    a: select("the clip of figure a", [], () => {}),
    b: select("the clip of figure b", [], () => {}),
  };
  private readonly frames = element("input", {
    type: "text",
    placeholder: "all",
    title: "frames of the clips, such as 0:240; empty: all",
    "aria-label": "frames, such as 0:240",
  });
  private readonly begins = select("where the solve starts (solve.start)", kStarts, () => {});
  private readonly noClips = note(
    "No clips found. Start the studio with --clip-a A --clip-b B, " +
      "or put .bvh, .glb or .vrm files into the library's folder.",
  );
  private readonly run = new RunView();
  private readonly result = section("Run", this.run.element);
  private job: string | null = null;

  constructor(private readonly store: Store) {
    const field = (label: string, input: HTMLElement) =>
      element("label", { class: "field inline" }, label, input);
    this.result.hidden = true;
    this.stop.disabled = true;
    this.element.append(
      section(
        "Clips",
        this.noClips,
        field("a", this.clips.a.element),
        field("b", this.clips.b.element),
        field("Frames", this.frames),
        field("Start", this.begins.element),
        row(this.solve, this.stop),
      ),
      this.result,
    );
  }

  private trying(act: () => Promise<void>): Promise<void> {
    return trying((text, kind) => this.store.say(text, kind), act);
  }

  load(): Promise<void> {
    return this.trying(() => this.fill());
  }

  // Those that the studio was started with, else what is named like a figure.
  private async fill(): Promise<void> {
    const { files } = await get<{ files: Clip[] }>("/api/clips");
    const said = ({ name, frames, error }: Clip) =>
      error ? `${name}: ${error}` : frames ? `${name} (${frames} frames)` : name;
    const options = files.map((clip) => [clip.id, said(clip)] as [string, string]);
    for (const figure of figureNames) {
      const named =
        files.find(({ id }) => id === `start/${figure}`) ??
        files.find(({ name }) => new RegExp(`(^|[/ ])${figure}\\.`).test(name)) ??
        files[0];
      this.clips[figure].set(this.clips[figure].element.value || named?.id || "", options);
    }
    this.noClips.hidden = files.length > 0;
    this.solve.disabled = files.length === 0 || this.job !== null;
  }

  private begin(): Promise<void> {
    const frames = this.frames.value.trim();
    const start = this.begins.element.value;
    return this.trying(async () => {
      const { job } = await post<{ job: string }>("/api/solve", {
        session: this.store.session,
        clip_a: this.clips.a.element.value,
        clip_b: this.clips.b.element.value,
        ...(frames ? { frames } : {}),
        ...(start ? { settings: { "solve.start": start } } : {}),
      });
      this.busy(job);
      this.result.hidden = false;
      this.run.watch(job, () => this.busy(null));
    });
  }

  private busy(job: string | null): void {
    this.job = job;
    this.solve.disabled = job !== null;
    this.stop.disabled = job === null;
  }

  // Asked twice it ends at once.
  private end(): Promise<void> {
    return this.trying(async () => {
      await post("/api/solve/stop", { job: this.job });
      this.run.tell({ stage: "stopping" });
    });
  }
}
