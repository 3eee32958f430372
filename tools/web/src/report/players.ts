// Three players side by side: source, simulated baseline, result.

import { findNode, pathSigns } from "../shared/body";
import { element } from "../shared/dom";
import { FigureScene } from "../shared/figure_scene";
import { gliTable, heat, kTangled, pathGli } from "../shared/gli";
import { limbColours } from "../shared/limb_colours";
import { figureNames } from "../shared/names";
import { onThemeChange } from "../shared/theme";
import { Viewer } from "../shared/viewer";
import type { Clock } from "./clock";
import {
  readScene,
  variantMeaning,
  variants,
  variantTitle,
  type AllSeries,
  type Report,
  type Series,
  type Variant,
} from "./data";
import { Marks } from "./marks";

interface Player {
  variant: Variant;
  panel: HTMLElement;
  readout: HTMLElement;
  series: Series | null;
  figures: FigureScene | null;
  marks: Marks | null;
}

interface Tag {
  a: Int8Array; // signs over the segments
  b: Int8Array;
  sign: number;
}

export class Players {
  heatMap = false;
  following = true;
  private shownTag: number | null = null;
  private players: Player[] = [];
  private viewer: Viewer | null = null;
  private path: [number, number][] = [];
  private readonly tags: Tag[];

  constructor(
    private readonly container: HTMLElement,
    private readonly report: Report,
    private readonly series: AllSeries,
    private readonly clock: Clock,
  ) {
    this.tags = report.tangles.map(({ a, b, template_gli }) => ({
      a: pathSigns(findNode(a[0]), findNode(a[1])),
      b: pathSigns(findNode(b[0]), findNode(b[1])),
      sign: template_gli < 0 ? -1 : 1,
    }));
    for (const variant of variants) this.players.push(this.makePanel(variant));
    clock.onChange(() => this.refresh());
    onThemeChange(() => this.refresh());
  }

  private makePanel(variant: Variant): Player {
    const readout = element("p", { class: "readout" });
    const title = element(
      "h2",
      {},
      variantTitle[variant],
      " ",
      element("small", {}, variantMeaning[variant]),
    );
    const panel = element("div", { class: "panel", "data-variant": variant }, title, readout);
    this.container.append(panel);
    return { variant, panel, readout, series: this.series[variant], figures: null, marks: null };
  }

  private say(player: Player, sentence: string): void {
    player.panel.classList.add("empty");
    player.panel.append(element("p", { class: "absent" }, sentence));
  }

  // Loads the scenes. Without WebGL the page says so and goes on.
  async load(): Promise<void> {
    try {
      this.viewer = new Viewer(this.container);
    } catch {
      document.documentElement.classList.add("no-webgl");
      this.container.prepend(
        element(
          "p",
          { class: "absent" },
          "This browser offers no WebGL, so there are no players here. Plots and tables below are " +
            "complete, and scene.glb opens in any glTF viewer.",
        ),
      );
      this.refresh();
      return;
    }
    this.viewer.onDraw(() => this.pose());
    for (const player of this.players) {
      const bytes = readScene(player.variant);
      if (!bytes || !player.series) {
        this.say(
          player,
          this.report.simulation?.message ?? "This run has no simulated baseline to compare with.",
        );
        continue;
      }
      player.figures = await FigureScene.load(bytes);
      player.marks = new Marks(player.figures, player.series, this.report);
      this.viewer.add(player.figures, player.panel);
    }
    this.path = this.players.find((p) => p.variant === "result")?.figures?.path() ?? [];
    this.refresh();
  }

  get view(): Viewer | null {
    return this.viewer;
  }

  showTag(tag: number | null): void {
    if (tag === this.shownTag) return;
    this.shownTag = tag;
    this.refresh();
  }

  refresh(): void {
    for (const player of this.players) this.writeReadout(player);
    this.viewer?.invalidate();
  }

  // What one must know of this frame, in words.
  private writeReadout({ readout, series }: Player): void {
    readout.replaceChildren();
    if (!series) return;
    const t = this.clock.frame;
    const { tangles, penetration_cm } = this.clock.between ? series.between : series;
    const lost = tangles.flatMap((tag, k) => (tag[t] > kTangled ? [] : [k]));
    const item = (text: string, bad: boolean) =>
      readout.append(element("span", { class: bad ? "bad" : "good" }, text));
    if (tangles.length > 0) {
      item(
        lost.length === 0
          ? "tangled"
          : `lost: ${lost.map((k) => `tag ${k + 1} (${tangles[k][t].toFixed(2)})`).join(", ")}`,
        lost.length > 0,
      );
    }
    const depth = penetration_cm[t];
    if (depth > 0.05) item(`${depth.toFixed(1)} cm inside`, depth > 2);
    const passed = series.pass_throughs.find((p) => Math.abs(p.frame - t) <= 2);
    if (passed) item("limb passes through", true);
  }

  // The scene graphs as they should be now; called before each drawing.
  private pose(): void {
    const time = this.clock.time;
    const frame = this.clock.frame;
    if (this.following && this.path.length > 0) {
      const [x, z] = this.path[Math.min(frame, this.path.length - 1)];
      const [nx, nz] = this.path[Math.min(frame + 1, this.path.length - 1)];
      const part = time - frame;
      this.viewer?.follow(x + (nx - x) * part, z + (nz - z) * part);
    }
    for (const { figures, marks } of this.players) {
      if (!figures) continue;
      figures.pose(time / this.clock.fps);
      marks?.update(frame, this.clock.between);
      this.paint(figures);
    }
  }

  private paint(figures: FigureScene): void {
    const values = this.heatMap
      ? heat(gliTable(figures.positions("a"), figures.positions("b")))
      : null;
    const tag = this.shownTag === null ? null : this.tags[this.shownTag];
    figureNames.forEach((figure, f) => {
      const off = (s: number) => tag !== null && tag[figure][s] === 0;
      figures.paint(figure, limbColours(figure, values && values[f], off, 0.9));
    });
  }

  private playerOf(variant: Variant): FigureScene {
    const figures = this.players.find((p) => p.variant === variant)?.figures;
    if (!figures) throw new Error(`there is no player of ${variant}`);
    this.pose();
    return figures;
  }

  nodePosition(variant: Variant, name: string): [number, number, number] {
    return this.playerOf(variant).nodePosition(name);
  }

  // s GLI of a tag as the player stands now, from its own nodes.
  tagGli(variant: Variant, tag: number): number {
    const figures = this.playerOf(variant);
    const { a, b, sign } = this.tags[tag];
    return sign * pathGli(gliTable(figures.positions("a"), figures.positions("b")), a, b);
  }
}
