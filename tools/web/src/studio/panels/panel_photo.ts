// Panel "Photo": the picture behind the main view, and the camera that looks at it.

import { element } from "../../shared/dom";
import type { Actions } from "../editing/actions";
import type { CameraSection } from "./camera_section";
import type { Photo } from "../state/protocol";
import type { Session } from "../editing/session";
import type { Store } from "../state/store";
import { button, check, number, row, section, slider, type NumberField } from "../controls/widgets";

export class PhotoPanel {
  readonly element = element("div", { class: "panel" });
  private readonly file = element("input", {
    type: "file",
    accept: "image/png,image/jpeg,image/webp",
    hidden: "",
  });
  private readonly controls: HTMLElement;
  private readonly opacity: ReturnType<typeof slider>;
  private readonly scale: ReturnType<typeof slider>;
  private readonly offset: NumberField[];
  private readonly solid: ReturnType<typeof slider>;
  private readonly lock: ReturnType<typeof check>;

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
    private readonly session: Session,
    private readonly camera: CameraSection,
  ) {
    const preview = (part: Partial<Photo>) => this.change(part, false);
    const commit = (part: Partial<Photo>) => this.change(part, true);
    this.opacity = slider(
      "Opacity",
      "opacity of the photo (%)",
      0,
      1,
      0.01,
      (v) => `${Math.round(100 * v)} %`,
      (opacity) => preview({ opacity }),
      (opacity) => commit({ opacity }),
    );
    this.scale = slider(
      "Scale",
      "height of the photo against the view's (1: as high as the view)",
      0.2,
      4,
      0.01,
      (v) => v.toFixed(2),
      (scale) => preview({ scale }),
      (scale) => commit({ scale }),
    );
    const setSolid = (solid: number) => store.set({ solid });
    this.solid = slider(
      "Figures",
      "opacity of the figures over the photo (%)",
      0.1,
      1,
      0.01,
      (v) => `${Math.round(100 * v)} %`,
      setSolid,
      setSolid,
    );
    this.offset = [0, 1].map((axis) => this.offsetField(axis));
    this.lock = check(
      "Lock photo and camera (L)",
      "neither moves; the camera is stored in the template",
      (on) => camera.setLock(on),
    );
    this.controls = element(
      "div",
      { class: "stack" },
      this.opacity.element,
      this.solid.element,
      this.scale.element,
      element(
        "div",
        { class: "triple two" },
        element("span", {}, "Offset"),
        ...this.offset.map((field) => field.element),
      ),
      this.lock.label,
      row(
        button("Move photo", "drag the photo in the main view", () => actions.tool("photo-move")),
        button(
          "Pin to photo",
          "drag a joint to its point in the photo; its depth is left to the solver (O)",
          () => actions.tool("photo-pin"),
          "primary",
        ),
        button("Remove", "no photo behind", () => void session.removePhoto()),
      ),
    );
    const drop = button(
      "Drop a picture here, or choose a file…",
      "PNG, JPEG or WebP, up to 16 MB",
      () => this.file.click(),
      "drop",
    );
    this.element.append(this.file, section("Photo", drop, this.controls), camera.element);
    this.takeFiles();
    store.onChange(() => this.refresh());
  }

  private offsetField(axis: number): NumberField {
    const [label, way] = axis === 0 ? ["X", "right"] : ["Y", "up"];
    return number({
      label,
      title: `offset of the photo, ${way} (heights of the view)`,
      step: 0.01,
      digits: 3,
      commit: (value) => {
        const offset = [...this.store.state.photo!.offset] as [number, number];
        offset[axis] = value;
        this.change({ offset }, true);
      },
    });
  }

  private change(part: Partial<Photo>, done: boolean): void {
    const { photo } = this.actions;
    if (photo) this.actions.setPhoto({ ...photo, ...part }, done);
  }

  // Pictures and templates, chosen or dropped anywhere on the page.
  private takeFiles(): void {
    this.file.addEventListener("change", () => {
      const chosen = this.file.files?.[0];
      this.file.value = "";
      if (chosen) void this.take(chosen);
    });
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
    this.store.say("Turn the camera until the floor fits the photo, then lock both (L).", "good");
  }

  private refresh(): void {
    const { photo } = this.actions;
    this.controls.hidden = !photo;
    this.lock.set(this.store.ui.locked);
    this.camera.refresh();
    if (!photo) return;
    this.opacity.set(photo.opacity);
    this.scale.set(photo.scale);
    this.solid.set(this.store.ui.solid);
    this.offset.forEach((field, axis) => field.set(photo.offset[axis]));
  }
}
