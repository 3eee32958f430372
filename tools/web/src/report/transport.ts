// The bar under the players: play, step, speed, loop, views, heat map, tags, and the scrub bar with
// what happens when.

import { element, fitCanvas } from "../shared/dom";
import { heatScale } from "../shared/legend";
import { words } from "../shared/names";
import { onThemeChange, themeColour } from "../shared/theme";
import { views, type View } from "../shared/viewer";
import type { Clock } from "./clock";
import { variants, variantTitle, type AllSeries, type Report } from "./data";
import { broken, missesOf, timeOf } from "./misses";
import type { Players } from "./players";

const kThumb = 12; // px, as in the style sheet
const kRow = 9; // px per variant in the track
const kLeastMark = 2; // px, of an instant in the track

function button(label: string, title: string, act: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title, "aria-label": title }, label);
  made.addEventListener("click", act);
  return made;
}

function checkbox(label: string, title: string, on: boolean, act: (on: boolean) => void) {
  const box = element("input", { type: "checkbox" });
  box.checked = on;
  box.addEventListener("change", () => act(box.checked));
  return { box, label: element("label", { title }, box, ` ${label}`) };
}

function select(
  title: string,
  options: [string, string][],
  value: string,
  act: (v: string) => void,
) {
  const made = element("select", { title, "aria-label": title });
  for (const [key, text] of options) made.append(element("option", { value: key }, text));
  made.value = value;
  made.addEventListener("change", () => act(made.value));
  return made;
}

export class Transport {
  readonly heat: HTMLInputElement;
  private readonly range: HTMLInputElement;
  private readonly play: HTMLButtonElement;
  private readonly track = element("canvas", { class: "track", "aria-hidden": "true" });
  private readonly counter = element("output", { class: "counter" });
  private readonly tags: HTMLButtonElement[];
  private pinnedTag: number | null = null;

  constructor(
    container: HTMLElement,
    private readonly report: Report,
    private readonly series: AllSeries,
    private readonly clock: Clock,
    private readonly players: Players,
  ) {
    this.range = element("input", {
      type: "range",
      min: "0",
      max: String(clock.frames - 1),
      step: "1",
      value: "0",
      "aria-label": "frame",
      class: "scrub",
    });
    this.range.addEventListener("input", () => clock.seek(Number(this.range.value)));
    this.play = button("Play", "play or pause (space)", () => clock.toggle());
    this.play.className = "play";
    const heat = checkbox(
      "GLI heat map",
      "colour each limb by how much it is wound round the other body",
      false,
      (on) => {
        players.heatMap = on;
        legend.hidden = !on;
        players.refresh();
      },
    );
    this.heat = heat.box;
    const legend = this.makeLegend();
    heat.label.className = "needs-players";
    this.tags = report.tangles.map((_, k) => this.makeTag(k));
    container.append(
      this.makeScrub(),
      element(
        "div",
        { class: "controls" },
        ...this.makeControls(),
        heat.label,
        legend,
        ...(this.tags.length > 0 ? [element("span", { class: "tags" }, ...this.tags)] : []),
      ),
    );
    clock.onChange(() => this.refresh());
    onThemeChange(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.track);
    this.refresh();
  }

  private makeControls(): HTMLElement[] {
    const { clock, players } = this;
    const speeds: [string, string][] = [
      ["0.1", "0.1x"],
      ["0.25", "0.25x"],
      ["0.5", "0.5x"],
      ["1", "1x"],
      ["2", "2x"],
    ];
    const group = (...items: HTMLElement[]) => element("span", { class: "group" }, ...items);
    const playing = group(
      select("speed", speeds, "1", (v) => (clock.speed = Number(v))),
      checkbox("loop", "start again at the end", clock.loop, (on) => (clock.loop = on)).label,
    );
    const names = Object.keys(views).map((v) => [v, v] as [string, string]);
    const camera = group(
      select("view; drag to orbit, Ctrl + wheel to zoom", names, "three-quarter", (v) =>
        players.view?.look(v as View),
      ),
      button("+", "closer (Ctrl + wheel)", () => players.view?.zoom(0.8)),
      button("−", "further (Ctrl + wheel)", () => players.view?.zoom(1.25)),
      checkbox("follow", "the camera goes with the pair", true, (on) => {
        players.following = on;
        players.refresh();
      }).label,
    );
    camera.classList.add("needs-players");
    return [playing, camera];
  }

  private makeLegend(): HTMLElement {
    const legend = element(
      "span",
      { class: "legend", title: "sum of |GLI| over the other body's segments" },
      ...heatScale(),
    );
    legend.hidden = true;
    return legend;
  }

  // Pointing at a tag shows it on the bodies; clicking keeps it shown.
  private makeTag(k: number): HTMLButtonElement {
    const { a, b } = this.report.tangles[k];
    const chip = button(
      `tag ${k + 1}`,
      `a: ${words(a[0])} to ${words(a[1])}, tangled with b: ${words(b[0])} to ${words(b[1])}`,
      () => {
        this.pinnedTag = this.pinnedTag === k ? null : k;
        this.showTag(this.pinnedTag);
      },
    );
    chip.classList.add("tag");
    for (const event of ["mouseenter", "focus"])
      chip.addEventListener(event, () => this.showTag(k));
    for (const event of ["mouseleave", "blur"])
      chip.addEventListener(event, () => this.showTag(null));
    return chip;
  }

  showTag(tag: number | null): void {
    this.players.showTag(tag ?? this.pinnedTag);
    this.tags.forEach((chip, k) => {
      chip.setAttribute("aria-pressed", String(k === this.pinnedTag));
      chip.classList.toggle("shown", k === (tag ?? this.pinnedTag));
    });
  }

  private makeScrub(): HTMLElement {
    const labels = element("span", { class: "track-labels", "aria-hidden": "true" });
    for (const v of variants) {
      if (this.series[v]) labels.append(element("span", {}, variantTitle[v].toLowerCase()));
    }
    if (this.report.proof) labels.append(element("span", {}, "proof"));
    const scrub = element(
      "span",
      {
        class: "scrub-box",
        title:
          "dark: a tangle is lost, in a frame or between two; lower half: another limit is passed; " +
          "✕: a limb passes through a limb; proof: dark where something is not proved between two " +
          "frames; ▾: where a requirement is missed by most",
      },
      this.track,
      this.range,
      ...this.makeMisses(),
    );
    const rows = variants.filter((v) => this.series[v]).length + (this.report.proof ? 1 : 0);
    scrub.style.setProperty("--rows", String(rows));
    const keys = element(
      "span",
      { class: "group" },
      button("‹", "one frame back (left arrow)", () => this.clock.step(-1)),
      this.play,
      button("›", "one frame on (right arrow)", () => this.clock.step(1)),
    );
    return element("div", { class: "scrubber" }, keys, labels, scrub, this.counter);
  }

  // Where requirements are missed by most; clicking goes there, between two frames, too.
  private makeMisses(): HTMLElement[] {
    return missesOf(this.report, this.series.result).map(({ time, text }) => {
      const mark = button("▾", text, () => this.clock.show(time));
      mark.className = "miss";
      const part = time / Math.max(1, this.clock.frames - 1);
      mark.style.left = `calc(${kThumb / 2}px + (100% - ${kThumb}px) * ${part})`;
      return mark;
    });
  }

  private refresh(): void {
    const { frame, frames, fps, playing, between, time } = this.clock;
    this.range.value = String(frame);
    this.range.setAttribute("aria-valuetext", `frame ${frame} of ${frames}`);
    const seconds = ((between ? time : frame) / fps).toFixed(2);
    const where = between ? `between ${frame} and ${frame + 1}` : `frame ${frame}`;
    this.counter.textContent = `${where} / ${frames - 1} · ${seconds} s`;
    this.play.textContent = playing ? "Pause" : "Play";
  }

  // One row per variant: where a tangle is lost or another limit passed, and where a limb passes
  // through a limb.
  private draw(): void {
    const context = fitCanvas(this.track);
    const width = this.track.clientWidth - kThumb;
    const frames = this.clock.frames;
    const x = (t: number) => kThumb / 2 + (width * t) / Math.max(1, frames - 1);
    const cell = width / Math.max(1, frames - 1);
    variants
      .filter((v) => this.series[v])
      .forEach((variant, row) => {
        const series = this.series[variant]!;
        const top = row * kRow;
        context.fillStyle = themeColour("--held");
        context.fillRect(x(0), top + 1, width, kRow - 2);
        context.fillStyle = themeColour("--bad");
        broken(this.report, series).forEach(({ lost, passed }, k) => {
          if (!lost && !passed) return;
          const half = Math.max(cell / 4, kLeastMark / 2);
          const left = Math.max(x(0), x(timeOf(k)) - half);
          const right = Math.min(x(timeOf(k)) + half, x(frames - 1));
          const height = kRow - 2;
          context.fillRect(
            left,
            top + 1 + (lost ? 0 : height / 2),
            Math.max(right - left + 0.3, 1),
            lost ? height : height / 2,
          );
        });
        context.strokeStyle = themeColour("--ink");
        context.lineWidth = 1.6;
        for (const { frame } of series.pass_throughs) {
          const [cx, cy, r] = [x(frame + 0.5), top + kRow / 2, 3.2];
          context.beginPath();
          context.moveTo(cx - r, cy - r);
          context.lineTo(cx + r, cy + r);
          context.moveTo(cx - r, cy + r);
          context.lineTo(cx + r, cy - r);
          context.stroke();
        }
      });
    const { proof } = this.report;
    if (!proof) return;
    const top = variants.filter((v) => this.series[v]).length * kRow + 1;
    context.fillStyle = themeColour("--held");
    context.fillRect(x(0), top, width, kRow - 2);
    context.fillStyle = themeColour("--bad");
    for (const k of proof.open) context.fillRect(x(k), top, cell + 0.3, kRow - 2);
  }
}
