// The main camera: field of view, named sides, saved cameras, the lock.

import { MathUtils, type PerspectiveCamera, type Vector3 } from "three";
import { element } from "../../shared/dom";
import type { Actions } from "../editing/actions";
import type { Camera, Vec } from "../state/protocol";
import type { PanelName, Store } from "../state/store";
import { directions, type Direction } from "../stage/view";
import { button, list, note, row, section, slider } from "../controls/widgets";

const kSaved = "retarget-studio-cameras";
const kView = "retarget-studio-view";
interface SavedCamera extends Camera {
  name: string;
}

export class CameraSection {
  readonly element: HTMLElement;
  private readonly fov: ReturnType<typeof slider>;
  private readonly cameras = element("ul", { class: "items" });
  private saved = JSON.parse(localStorage.getItem(kSaved) ?? "[]") as SavedCamera[];

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    const setFov = (v: number) => this.setFov(v);
    this.fov = slider(
      "Field of view",
      "vertical field of view of the main camera (degrees)",
      10,
      100,
      1,
      (v) => `${v}°`,
      setFov,
      setFov,
    );
    const looks = (Object.keys(directions) as Direction[]).map((direction) =>
      button(direction, `look from: ${direction}`, () => actions.look(direction)),
    );
    this.element = section(
      "Camera",
      this.fov.element,
      element("div", { class: "row looks" }, ...looks),
      row(
        button("Save camera", "keep this view in the list", () => this.save()),
        button("To template", "store this camera in the template", () => this.toTemplate()),
      ),
      this.cameras,
      note("Side views: V. Drag to pan them, wheel to zoom."),
    );
  }

  private get view() {
    return this.actions.viewport.main;
  }
  private get camera(): PerspectiveCamera {
    return this.view.camera as PerspectiveCamera;
  }

  private now(): Camera {
    const round = (v: Vector3) => v.toArray().map((x) => Math.round(1e4 * x) / 1e4) as Vec;
    const { controls } = this.view;
    return {
      eye: round(this.camera.position),
      target: round(controls.target),
      fov_deg: this.camera.fov,
    };
  }

  private apply({ eye, target, fov_deg }: Camera): void {
    this.camera.fov = fov_deg;
    this.view.controls.target.set(...target);
    this.camera.position.set(...eye);
    this.view.controls.update();
    this.actions.viewport.invalidate();
    this.store.changed();
  }

  // The figures keep their size in the picture.
  private setFov(fov: number): void {
    const { target } = this.view.controls;
    const arm = this.camera.position.clone().sub(target);
    const half = (deg: number) => Math.tan(MathUtils.degToRad(deg) / 2);
    const ratio = half(this.camera.fov) / half(fov);
    if (!this.store.ui.locked) this.camera.position.copy(target).addScaledVector(arm, ratio);
    this.camera.fov = fov;
    this.view.controls.update();
    this.actions.viewport.invalidate();
  }

  private toTemplate(): void {
    void this.actions.do({ op: "set_camera", camera: this.now() });
  }
  private save(): void {
    this.keep([...this.saved, { name: `Camera ${this.saved.length + 1}`, ...this.now() }]);
  }
  private keep(cameras: SavedCamera[]): void {
    this.saved = cameras;
    localStorage.setItem(kSaved, JSON.stringify(cameras));
    this.store.changed();
  }

  // Locked, camera and photo stay, and the template has the camera.
  setLock(on: boolean): void {
    this.store.set({ locked: on });
    this.view.controls.enabled = !on;
    const stored = JSON.stringify(this.store.state.camera) === JSON.stringify(this.now());
    if (on && !stored) this.toTemplate();
  }

  // Another template: its camera; locked where it has a photo too.
  loaded(): void {
    const { camera, photo } = this.store.state;
    const locked = camera !== null && photo !== null;
    this.store.set({ locked: false });
    if (camera) this.apply(camera);
    else this.actions.frame(false);
    this.store.set({ locked });
    this.view.controls.enabled = !locked;
  }

  // The view over a reload of the page.
  keepView(resumed: boolean): void {
    addEventListener("pagehide", () => {
      const { locked, panel } = this.store.ui;
      sessionStorage.setItem(kView, JSON.stringify({ camera: this.now(), locked, panel }));
    });
    const kept = sessionStorage.getItem(kView);
    if (!kept || !resumed) return;
    const { camera, locked, panel } = JSON.parse(kept) as {
      camera: Camera;
      locked: boolean;
      panel: PanelName;
    };
    this.apply(camera);
    this.view.controls.enabled = !locked;
    this.store.set({ locked, panel });
  }

  refresh(): void {
    const { camera } = this.store.state;
    this.fov.set(Math.round(this.camera.fov));
    const own: SavedCamera[] = camera ? [{ name: "the template's", ...camera }] : [];
    list(
      this.cameras,
      [...own, ...this.saved],
      (c) => c,
      (saved, k) => this.item(saved, k - own.length),
    );
  }

  // `index` in the list of saved ones; negative: the template's.
  private item(camera: SavedCamera, index: number): HTMLElement {
    const look = () => {
      if (!this.store.ui.locked) this.apply(camera);
    };
    const drop =
      index < 0
        ? button(
            "✕",
            "no camera in the template",
            () => void this.actions.do({ op: "set_camera", camera: null }),
          )
        : button("✕", `forget ${camera.name}`, () =>
            this.keep(this.saved.filter((_, k) => k !== index)),
          );
    return element(
      "li",
      { class: "line" },
      button(camera.name, "look through this camera", look, "plain"),
      element("small", {}, `${Math.round(camera.fov_deg)}°`),
      drop,
    );
  }
}
