// Panel "Photo": the picture behind the main view, and the camera that looks at it.

import { MathUtils, PerspectiveCamera, Vector3 } from "three";
import { element } from "../shared/dom";
import type { Actions } from "./actions";
import type { Camera, Photo, Vec } from "./protocol";
import type { Session } from "./session";
import type { PanelName, Store } from "./store";
import { directions, type Direction } from "./view";
import { button, check, list, note, number, row, section, slider } from "./widgets";

const kSaved = "retarget-studio-cameras";
const kView = "retarget-studio-view";
interface SavedCamera extends Camera {
  name: string;
}

export class PhotoPanel {
  readonly element = element("div", { class: "panel" });
  private readonly file = element("input", { type: "file", accept: "image/png,image/jpeg,image/webp", hidden: "" });
  private readonly controls: HTMLElement;
  private readonly opacity; private readonly scale; private readonly offset; private readonly fov;
  private readonly lock = check("Lock photo and camera (L)", "neither moves; the camera is stored in the template", (on) => this.setLock(on));
  private readonly cameras = element("ul", { class: "items" });
  private saved: SavedCamera[] = JSON.parse(localStorage.getItem(kSaved) ?? "[]") as SavedCamera[];

  constructor(private readonly store: Store, private readonly actions: Actions, private readonly session: Session) {
    const change = (part: Partial<Photo>, done: boolean) => {
      const photo = actions.photoPreview ?? store.state.photo;
      if (photo) actions.setPhoto({ ...photo, ...part }, done);
    };
    const both = (make: (v: number) => Partial<Photo>) => [(v: number) => change(make(v), false), (v: number) => change(make(v), true)] as const;
    this.opacity = slider("Opacity", "opacity of the photo (%)", 0, 1, 0.01, (v) => `${Math.round(100 * v)} %`, ...both((opacity) => ({ opacity })));
    this.scale = slider("Scale", "height of the photo against the view's (1: as high as the view)", 0.2, 4, 0.01, (v) => v.toFixed(2), ...both((scale) => ({ scale })));
    this.offset = [0, 1].map((axis) => number({ label: axis === 0 ? "X" : "Y", title: `offset of the photo, ${axis === 0 ? "right" : "up"} (heights of the view)`, step: 0.01, digits: 3,
      commit: (v) => {
        const offset = [...store.state.photo!.offset] as [number, number];
        offset[axis] = v;
        change({ offset }, true);
      } }));
    this.fov = slider("Field of view", "vertical field of view of the main camera (degrees)", 10, 100, 1, (v) => `${v}°`, (v) => this.setFov(v), (v) => this.setFov(v));
    this.file.addEventListener("change", () => {
      if (this.file.files?.[0]) void this.take(this.file.files[0]);
      this.file.value = "";
    });
    this.controls = element("div", { class: "stack" }, this.opacity.element, this.scale.element,
      element("div", { class: "triple two" }, element("span", {}, "Offset"), ...this.offset.map((f) => f.element)), this.lock.label,
      row(button("Move photo", "drag the photo in the main view", () => actions.tool("photo-move")),
        button("Pin to photo", "drag a joint to its point in the photo; its depth is left to the solver (O)", () => actions.tool("photo-pin"), "primary"),
        button("Remove", "no photo behind", () => void session.removePhoto())));
    const looks = (Object.keys(directions) as Direction[]).map((d) => button(d, `look from: ${d}`, () => actions.look(d)));
    this.element.append(this.file,
      section("Photo", element("button", { type: "button", class: "drop", title: "PNG, JPEG or WebP, up to 16 MB" }, "Drop a picture here, or choose a file…"), this.controls),
      section("Camera", this.fov.element, element("div", { class: "row looks" }, ...looks),
        row(button("Save camera", "keep this view in the list", () => this.saveCamera()), button("To template", "store this camera in the template", () => this.toTemplate())),
        this.cameras, note("Side views: V. Drag to pan them, wheel to zoom.")));
    this.element.querySelector<HTMLElement>(".drop")!.addEventListener("click", () => this.file.click());
    this.takeDrops();
    store.onChange(() => this.refresh());
  }

  private takeDrops(): void {
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      const file = event.dataTransfer?.files[0];
      if (!file) return;
      if (/\.ya?ml$/i.test(file.name)) void file.text().then((yaml) => this.session.load({ yaml }));
      else void this.take(file);
    });
  }
  private async take(file: File): Promise<void> {
    if (!(await this.session.photo(file))) return;
    this.store.set({ panel: "photo" });
    this.store.say("The photo is behind the main view. Turn the camera until the floor fits, then lock both (L).", "good");
  }

  // -- Camera ------------------------------------------------------------------------------------

  private get view() {
    return this.actions.viewport.main;
  }
  private get camera(): PerspectiveCamera {
    return this.view.camera as PerspectiveCamera;
  }
  now(): Camera {
    const round = (v: Vector3) => v.toArray().map((x) => Math.round(1e4 * x) / 1e4) as Vec;
    return { eye: round(this.camera.position), target: round(this.view.controls.target), fov_deg: this.camera.fov };
  }
  apply({ eye, target, fov_deg }: Camera): void {
    this.camera.fov = fov_deg;
    this.view.controls.target.set(...target);
    this.camera.position.set(...eye);
    this.view.controls.update();
    this.actions.viewport.invalidate();
    this.store.changed();
  }
  // The figures keep their size in the picture.
  private setFov(fov: number): void {
    const target = this.view.controls.target;
    const arm = this.camera.position.clone().sub(target);
    const half = (deg: number) => Math.tan(MathUtils.degToRad(deg) / 2);
    if (!this.store.ui.locked) this.camera.position.copy(target).addScaledVector(arm, half(this.camera.fov) / half(fov));
    this.camera.fov = fov;
    this.view.controls.update();
    this.actions.viewport.invalidate();
  }
  private toTemplate(): void {
    void this.actions.do({ op: "set_camera", camera: this.now() });
  }
  private saveCamera(): void {
    const name = `Camera ${this.saved.length + 1}`;
    this.keep([...this.saved, { name, ...this.now() }]);
  }
  private keep(cameras: SavedCamera[]): void {
    this.saved = cameras;
    localStorage.setItem(kSaved, JSON.stringify(cameras));
    this.store.changed();
  }
  setLock(on: boolean): void {
    this.store.set({ locked: on });
    this.view.controls.enabled = !on;
    if (on && JSON.stringify(this.now()) !== JSON.stringify(this.store.state.camera)) this.toTemplate();
  }

  // The view over a reload of the page.
  keepView(): void {
    addEventListener("pagehide", () => sessionStorage.setItem(kView, JSON.stringify(
      { camera: this.now(), locked: this.store.ui.locked, panel: this.store.ui.panel })));
    const kept = sessionStorage.getItem(kView);
    if (!kept || !this.session.resumed) return;
    const { camera, locked, panel } = JSON.parse(kept) as { camera: Camera; locked: boolean; panel: PanelName };
    this.apply(camera);
    this.view.controls.enabled = !locked;
    this.store.set({ locked, panel });
  }

  // Another template: its camera; locked where it has a photo too.
  loaded(): void {
    const { camera, photo } = this.store.state;
    this.store.set({ locked: false });
    this.view.controls.enabled = true;
    if (camera) this.apply(camera);
    else this.actions.frame(false);
    if (camera && photo) {
      this.store.set({ locked: true });
      this.view.controls.enabled = false;
    }
  }

  private refresh(): void {
    const { state, ui } = this.store;
    const photo = this.actions.photoPreview ?? state.photo;
    this.controls.hidden = !photo;
    if (photo) {
      this.opacity.set(photo.opacity);
      this.scale.set(photo.scale);
      this.offset.forEach((field, k) => field.set(photo.offset[k]));
    }
    this.lock.set(ui.locked);
    this.fov.set(Math.round(this.camera.fov));
    const own: SavedCamera[] = state.camera ? [{ name: "the template's", ...state.camera }] : [];
    list(this.cameras, [...own, ...this.saved], (c) => c, (camera, k) => element("li", { class: "line" },
      button(camera.name, "look through this camera", () => !this.store.ui.locked && this.apply(camera), "plain"),
      element("small", {}, `${Math.round(camera.fov_deg)}°`),
      k < own.length ? button("✕", "no camera in the template", () => void this.actions.do({ op: "set_camera", camera: null }))
        : button("✕", `forget ${camera.name}`, () => this.keep(this.saved.filter((_, j) => j !== k - own.length)))));
  }
}
