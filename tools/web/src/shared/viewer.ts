// Several stages side by side, seen by one camera: one canvas behind all, one part of it per stage.
// Draws only when something changed and somebody can see it.

import { PerspectiveCamera, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { FigureScene } from "./figure_scene";
import { pixelRatio, surround, type Surroundings } from "./surroundings";
import { onThemeChange, themeColour } from "./theme";

interface Stage {
  figures: FigureScene;
  element: HTMLElement; // where on the page
  surroundings: Surroundings;
}

function dress({ figures, surroundings }: Stage): void {
  surroundings.dress();
  figures.shadowColour(themeColour("--stage-shadow"));
}

export const views = {
  "three-quarter": [0.72, 0.3, 1],
  front: [0, 0.12, 1],
  side: [1, 0.12, 0],
  back: [0, 0.12, -1],
  above: [0.02, 1, 0.25],
} as const;
export type View = keyof typeof views;

export class Viewer {
  private readonly renderer: WebGLRenderer;
  private readonly camera = new PerspectiveCamera(30, 1, 0.05, 60);
  private readonly controls: OrbitControls;
  private readonly stages: Stage[] = [];
  private size = "";
  private scheduled = false;
  private visible = true;
  private beforeDraw: () => void = () => {};

  // Throws where the browser has no WebGL.
  constructor(private readonly container: HTMLElement) {
    const canvas = document.createElement("canvas");
    canvas.className = "viewer";
    canvas.setAttribute("aria-hidden", "true");
    // The buffer is kept so that the page can be printed.
    const context = canvas.getContext("webgl2", { preserveDrawingBuffer: true });
    if (!context) throw new Error("no WebGL");
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setPixelRatio(pixelRatio(context));
    container.prepend(canvas);
    this.renderer.setScissorTest(true);
    this.controls = new OrbitControls(this.camera, container);
    this.controls.maxPolarAngle = Math.PI * 0.52;
    this.controls.minDistance = 0.6;
    this.controls.maxDistance = 14;
    this.controls.addEventListener("change", () => this.invalidate());
    // A plain wheel scrolls the page; with Ctrl, or by pinching, it zooms.
    container.addEventListener(
      "wheel",
      (event) => {
        this.controls.enableZoom = event.ctrlKey || event.metaKey;
      },
      { capture: true, passive: true },
    );
    container.style.touchAction = "pan-y pinch-zoom";
    this.look("three-quarter");
    new ResizeObserver(() => this.invalidate()).observe(container);
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      if (this.visible) this.invalidate();
    }).observe(container);
    onThemeChange(() => {
      this.stages.forEach(dress);
      this.drawNow();
    });
  }

  // Called before each drawing.
  onDraw(listener: () => void): void {
    this.beforeDraw = listener;
  }

  add(figures: FigureScene, element: HTMLElement): void {
    const stage = { figures, element, surroundings: surround(figures.scene) };
    dress(stage);
    this.stages.push(stage);
    this.invalidate();
  }

  // Looks at the pair from a named side.
  look(view: View): void {
    const direction = new Vector3(...views[view]).normalize();
    this.controls.target.setY(0.84);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, 4.75);
    this.controls.update();
    this.invalidate();
  }

  // Moves camera and target along the floor so that the target stands over (x, z).
  follow(x: number, z: number): void {
    const shift = new Vector3(x - this.controls.target.x, 0, z - this.controls.target.z);
    if (shift.lengthSq() < 1e-12) return;
    this.controls.target.add(shift);
    this.camera.position.add(shift);
    this.controls.update();
  }

  zoom(factor: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    arm.clampLength(this.controls.minDistance, this.controls.maxDistance);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.invalidate();
  }

  invalidate(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      if (this.visible) this.drawNow();
    });
  }

  drawNow(): void {
    const { renderer, container, camera } = this;
    const [width, height] = [container.clientWidth, container.clientHeight];
    if (width === 0 || height === 0) return;
    this.beforeDraw();
    if (`${width} ${height}` !== this.size) {
      this.size = `${width} ${height}`;
      renderer.setSize(width, height, false); // the style sheet says how large it is shown
    }
    renderer.setClearColor(0x000000, 0);
    renderer.setScissor(0, 0, width, height);
    renderer.clear();
    const frame = container.getBoundingClientRect();
    const { target } = this.controls;
    for (const { figures, element, surroundings } of this.stages) {
      const box = element.getBoundingClientRect();
      const [w, h] = [box.width, box.height];
      if (w === 0 || h === 0) continue;
      const bottom = height - (box.bottom - frame.top);
      renderer.setViewport(box.left - frame.left, bottom, w, h);
      renderer.setScissor(box.left - frame.left, bottom, w, h);
      // Two people and a little floor fit whatever the shape of the panel.
      camera.aspect = w / h;
      camera.fov = w / h < 1 ? 30 / Math.max(0.5, w / h) : 30;
      camera.updateProjectionMatrix();
      surroundings.centre(target.x, target.z);
      renderer.render(figures.scene, camera);
    }
  }
}
