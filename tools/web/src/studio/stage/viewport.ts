// The stage: one canvas behind the main view and three side views, and one over them for handles.
// Draws only when something changed.

import { Scene, Vector3, WebGLRenderer, type Fog, type LineBasicMaterial } from "three";
import { findNode, pathSigns } from "../../shared/body";
import { element } from "../../shared/dom";
import { gliTable, heat } from "../../shared/gli";
import { limbColours } from "../../shared/limb_colours";
import { figureNames, type FigureName, type PerFigure } from "../../shared/names";
import { drawsInSoftware, pixelRatio, shadowMaterial, surround } from "../../shared/surroundings";
import { onThemeChange, themeColour } from "../../shared/theme";
import { FigureMesh } from "./figure_mesh";
import type { Store } from "../state/store";
import { View, type ViewName } from "./view";

export class Viewport {
  readonly scene = new Scene();
  readonly views: View[];
  readonly main: View;
  readonly photo = element("img", { class: "photo", alt: "", draggable: "false" });
  private readonly renderer: WebGLRenderer;
  private readonly canvas = element("canvas", { class: "viewer", "aria-hidden": "true" });
  private readonly overlay = element("canvas", { class: "overlay", "aria-hidden": "true" });
  private readonly meshes: Partial<PerFigure<FigureMesh>> = {};
  private readonly surroundings = surround(this.scene);
  private readonly shadow = shadowMaterial();
  private drawOver: (context: CanvasRenderingContext2D, view: View) => void = () => {};
  private drawings: (() => void)[] = [];
  private onlyInMain: { visible: boolean }[] = [];
  private scheduled = false;
  private size = "";
  private readonly slow: boolean;

  // Throws where the browser has no WebGL.
  constructor(
    private readonly container: HTMLElement,
    private readonly store: Store,
  ) {
    const context = this.canvas.getContext("webgl2", { alpha: true, antialias: false });
    if (!context) throw new Error("no WebGL");
    this.slow = drawsInSoftware(context);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    // Smooth edges need two pixels drawn per CSS pixel, a dense screen has them anyway.
    this.renderer.setPixelRatio(pixelRatio(context));
    this.renderer.setScissorTest(true);
    const behind = element("div", { class: "behind" }, this.photo);
    container.append(behind, this.canvas);
    const views = element("div", { class: "views" });
    const column = element("div", { class: "column" });
    const redraw = () => this.invalidate();
    this.main = new View("main", views, redraw);
    views.append(column);
    this.views = [
      this.main,
      ...(["front", "side", "top"] as ViewName[]).map((name) => new View(name, column, redraw)),
    ];
    container.append(views, this.overlay);
    new ResizeObserver(redraw).observe(this.main.element);
    this.surroundings.floor.visible = false; // the stage has its colour
    (this.surroundings.grid.material as LineBasicMaterial).transparent = true;
    this.dress();
    onThemeChange(() => {
      this.dress();
      this.refresh();
    });
    store.onChange(() => this.refresh());
  }

  // What is drawn over each view, and what is done before each drawing.
  onDraw(over: typeof this.drawOver, before: () => void): void {
    this.drawOver = over;
    this.drawings.push(before);
  }
  showOnlyInMain(thing: { visible: boolean }): void {
    this.onlyInMain.push(thing);
  }

  private dress(): void {
    this.surroundings.dress();
    this.scene.background = null;
    this.shadow.color.set(themeColour("--stage-shadow"));
  }

  // The figures as the store has them.
  refresh(): void {
    const { state, body, ui } = this.store;
    if (!state) return;
    for (const figure of figureNames) {
      let mesh = this.meshes[figure];
      if (!mesh) {
        mesh = this.meshes[figure] = new FigureMesh(body[figure], this.shadow, this.slow ? 10 : 20);
        this.scene.add(mesh.group);
      }
      mesh.resize(body[figure]);
      mesh.pose(state.figures[figure]);
      mesh.group.visible = ui.shown[figure] !== "hidden";
    }
    this.paint();
    const column = this.container.querySelector<HTMLElement>(".column")!;
    column.hidden = !ui.sideViews;
    this.invalidate();
  }

  // Plain, by heat, or with what is lit in colour and the rest dim.
  private paint(): void {
    const { state, ui } = this.store;
    const flat = (figure: FigureName) => state.figures[figure].nodes.flat();
    const values = ui.heat ? heat(gliTable(flat("a"), flat("b"))) : null;
    figureNames.forEach((figure, f) => {
      const path = ui.lit?.[figure];
      const signs = path && pathSigns(findNode(path[0]), findNode(path[1]));
      const off = (s: number) =>
        signs ? signs[s] === 0 : ui.litPair !== null && ui.litPair[f] !== s;
      this.meshes[figure]!.paint(limbColours(figure, values && values[f], off, 0.85));
    });
  }

  viewAt(target: EventTarget | null): View | undefined {
    const holder = (target as HTMLElement | null)?.closest?.(".view");
    return this.views.find((view) => view.element === holder);
  }

  // Frames what is selected, or both figures.
  frameAll(points: Vector3[]): void {
    const centre = points.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(points.length);
    const radius = Math.max(0.35, ...points.map((p) => p.distanceTo(centre)));
    for (const view of this.views) {
      if (view !== this.main || !this.store.ui.locked) view.frame(centre, radius * 1.12);
    }
  }

  invalidate(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.draw();
    });
  }

  private draw(): void {
    const [width, height] = [this.container.clientWidth, this.container.clientHeight];
    if (width === 0 || height === 0 || !this.store.state) return;
    if (`${width} ${height}` !== this.size) {
      this.size = `${width} ${height}`;
      this.renderer.setSize(width, height, false);
    }
    for (const before of this.drawings) before();
    const frame = this.container.getBoundingClientRect();
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.overlay.width !== w || this.overlay.height !== h)
      [this.overlay.width, this.overlay.height] = [w, h];
    const context = this.overlay.getContext("2d", { willReadFrequently: this.slow })!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    for (const view of this.views) {
      const box = view.element.getBoundingClientRect();
      if (box.width === 0 || box.height === 0) continue;
      this.render(
        view,
        box.left - frame.left,
        height - (box.bottom - frame.top),
        box.width,
        box.height,
      );
      context.save();
      context.beginPath();
      context.rect(box.left - frame.left, box.top - frame.top, box.width, box.height);
      context.clip();
      context.translate(-frame.left, -frame.top); // the overlay speaks in pixels of the page
      this.drawOver(context, view);
      context.restore();
    }
  }

  private render(view: View, x: number, y: number, width: number, height: number): void {
    const { renderer, scene } = this;
    view.fit(width, height);
    const main = view === this.main;
    const picture = main && !this.photo.hidden;
    const { grid } = this.surroundings;
    this.surroundings.centre(view.controls.target.x, view.controls.target.z);
    grid.visible = view.name === "main" || view.name === "top";
    const lines = grid.material as LineBasicMaterial;
    lines.opacity = picture ? 0.3 : 1;
    for (const figure of figureNames) {
      const ghost = this.store.ui.shown[figure] === "ghost";
      this.meshes[figure]?.appear(picture ? this.store.ui.solid : 1, ghost);
      this.meshes[figure]?.castShadow(!picture && !ghost);
    }
    const distance = view.camera.position.distanceTo(view.controls.target);
    const fog = scene.fog as Fog;
    [fog.near, fog.far] = main ? [distance + 1.5, distance + 9] : [50, 60];
    const shown = this.onlyInMain.map((thing) => thing.visible);
    if (!main) for (const thing of this.onlyInMain) thing.visible = false;
    renderer.setViewport(x, y, width, height);
    renderer.setScissor(x, y, width, height);
    renderer.setClearColor(themeColour("--stage"), picture ? 0 : 1);
    renderer.clear();
    renderer.render(scene, view.camera);
    this.onlyInMain.forEach((thing, k) => (thing.visible = shown[k]));
  }

  // A small picture of the main view without handles, PNG in base64.
  thumbnail(width: number, height: number): string {
    const out = element("canvas", { width: String(width), height: String(height) });
    const context = out.getContext("2d")!;
    const box = this.main.element.getBoundingClientRect();
    const frame = this.container.getBoundingClientRect();
    const shown = this.onlyInMain.map((thing) => thing.visible);
    for (const thing of this.onlyInMain) thing.visible = false;
    this.draw();
    this.onlyInMain.forEach((thing, k) => (thing.visible = shown[k]));
    this.invalidate();
    const scale = this.canvas.width / frame.width;
    const part = Math.min(box.width / width, box.height / height);
    const [w, h] = [part * width, part * height];
    const [x, y] = [
      box.left - frame.left + (box.width - w) / 2,
      box.top - frame.top + (box.height - h) / 2,
    ];
    context.fillStyle = themeColour("--stage");
    context.fillRect(0, 0, width, height);
    context.imageSmoothingQuality = "high";
    context.drawImage(this.canvas, x * scale, y * scale, w * scale, h * scale, 0, 0, width, height);
    return out.toDataURL("image/png").split(",")[1];
  }
}
