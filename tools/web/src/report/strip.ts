// Tracking error as a strip: a row per joint, a column per frame, darker where the joint was turned
// further from its capture.

import { cssOf, ramp, sequential } from "../shared/colours";
import { element, fitCanvas } from "../shared/dom";
import { colourScale } from "../shared/legend";
import { figureNames, words, type FigureName } from "../shared/names";
import { isDark, onThemeChange, themeColour } from "../shared/theme";
import type { Clock } from "./clock";
import { variantTitle, type AllSeries } from "./data";

const kRow = 13; // px
const kNames = 92; // px for the joints' names
const kRight = 6; // px
type Edited = "baseline" | "result";

// The end of the colour scale: a round number of degrees that leaves little out.
function roundUp(most: number): number {
  return [2, 5, 10, 15, 20, 30, 45, 60, 90, 180].find((x) => x >= most) ?? 180;
}

export class TrackingStrip {
  private shown: Edited = "result";
  private readonly canvases: {
    figure: FigureName;
    canvas: HTMLCanvasElement;
    playhead: HTMLElement;
  }[];
  private readonly note = element("small");
  private readonly scale = element("span", { class: "legend" });

  constructor(
    container: HTMLElement,
    private readonly series: AllSeries,
    private readonly clock: Clock,
  ) {
    this.canvases = figureNames.map((figure) => ({
      figure,
      canvas: element("canvas", { role: "img", "aria-label": `tracking error of ${figure}` }),
      playhead: element("i", { class: "playhead" }),
    }));
    const strips = this.canvases.map(({ figure, canvas, playhead }) =>
      element(
        "div",
        { class: "strip" },
        element("h4", { class: `figure-${figure}` }, figure),
        canvas,
        playhead,
      ),
    );
    container.append(
      element(
        "figure",
        { class: "plot wide", "data-plot": "Tracking error" },
        element(
          "figcaption",
          {},
          element(
            "h3",
            {},
            "Tracking error ",
            element("small", {}, "degrees from the source, by joint and frame"),
          ),
          element("p", { class: "key" }, this.choice(), this.scale, this.note),
        ),
        element("div", { class: "strips" }, ...strips),
      ),
    );
    for (const strip of this.canvases) this.watch(strip);
    clock.onChange(() => this.placePlayheads());
    onThemeChange(() => this.draw());
    this.draw();
  }

  private get tracking() {
    return this.series[this.shown]!.tracking_deg!;
  }

  private choice(): HTMLElement {
    const group = element("span", {
      class: "group",
      role: "radiogroup",
      "aria-label": "tracking error of",
    });
    for (const variant of ["baseline", "result"] as const) {
      if (!this.series[variant]?.tracking_deg) continue;
      const radio = element("input", { type: "radio", name: "tracking" });
      radio.checked = variant === this.shown;
      radio.addEventListener("change", () => {
        this.shown = variant;
        this.draw();
      });
      group.append(element("label", {}, radio, ` ${variantTitle[variant].toLowerCase()}`));
    }
    return group;
  }

  private watch({ figure, canvas }: { figure: FigureName; canvas: HTMLCanvasElement }): void {
    const { joints } = this.tracking[figure];
    canvas.style.height = `${joints.length * kRow}px`;
    new ResizeObserver(() => this.draw()).observe(canvas);
    const at = (event: PointerEvent) => {
      const box = canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - kNames) / (box.width - kNames - kRight);
      const frame = Math.min(
        this.clock.frames - 1,
        Math.max(0, Math.floor(part * this.clock.frames)),
      );
      const joint = Math.min(
        joints.length - 1,
        Math.max(0, Math.floor((event.clientY - box.top) / kRow)),
      );
      return { frame, joint };
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.clock.seek(at(event).frame);
    });
    canvas.addEventListener("pointermove", (event) => {
      const { frame, joint } = at(event);
      if (event.buttons & 1) this.clock.seek(frame);
      const value = this.tracking[figure].values[joint]?.[frame] ?? 0;
      this.note.textContent = `${figure} ${words(joints[joint])}, frame ${frame}: ${value.toFixed(1)}°`;
    });
    canvas.addEventListener("pointerleave", () => (this.note.textContent = ""));
  }

  private draw(): void {
    const stops = isDark() ? sequential.dark : sequential.light;
    const all = (["baseline", "result"] as const).flatMap((v) => {
      const tracking = this.series[v]?.tracking_deg;
      return tracking ? [...tracking.a.values, ...tracking.b.values] : [];
    });
    const most = roundUp(all.reduce((m, row) => row.reduce((n, x) => Math.max(n, x), m), 0));
    this.scale.replaceChildren(...colourScale("0°", stops.map(cssOf), `${most}°`));
    for (const { figure, canvas } of this.canvases) {
      const { joints, values } = this.tracking[figure];
      const context = fitCanvas(canvas);
      const width = canvas.clientWidth - kNames - kRight;
      context.imageSmoothingEnabled = false;
      context.drawImage(this.picture(values, most), kNames, 0, width, joints.length * kRow);
      context.fillStyle = themeColour("--muted");
      context.font = "11px system-ui, sans-serif";
      context.textAlign = "right";
      context.textBaseline = "middle";
      joints.forEach((name, k) =>
        context.fillText(words(name), kNames - 6, (k + 0.5) * kRow, kNames - 8),
      );
    }
    this.placePlayheads();
  }

  // One pixel per joint and frame.
  private picture(values: number[][], most: number): HTMLCanvasElement {
    const stops = isDark() ? sequential.dark : sequential.light;
    const canvas = element("canvas");
    canvas.width = this.clock.frames;
    canvas.height = values.length;
    const context = canvas.getContext("2d")!;
    const pixels = context.createImageData(canvas.width, canvas.height);
    values.forEach((row, joint) =>
      row.forEach((value, t) => {
        const [r, g, b] = ramp(stops, value / most);
        pixels.data.set([255 * r, 255 * g, 255 * b, 255], 4 * (joint * canvas.width + t));
      }),
    );
    context.putImageData(pixels, 0, 0);
    return canvas;
  }

  private placePlayheads(): void {
    for (const { canvas, playhead } of this.canvases) {
      const width = canvas.clientWidth - kNames - kRight;
      const x = kNames + (width * (this.clock.time + 0.5)) / this.clock.frames;
      playhead.style.transform = `translateX(${canvas.offsetLeft + x}px)`;
    }
  }
}
