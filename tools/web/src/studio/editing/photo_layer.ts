// The photograph behind the main view.

import { address } from "../state/api";
import type { Actions } from "./actions";
import type { Store } from "../state/store";

export class PhotoLayer {
  private source = "";

  constructor(
    private readonly actions: Actions,
    private readonly store: Store,
  ) {
    this.image.hidden = true;
    this.image.addEventListener("load", () => actions.viewport.invalidate());
    store.onChange(() => this.refresh());
  }

  private get image(): HTMLImageElement {
    return this.actions.viewport.photo;
  }

  private refresh(): void {
    const { session } = this.store;
    const { photo } = this.actions;
    this.image.hidden = !photo;
    if (!photo) return;
    const source = address("/api/photo", {
      session,
      v: `${this.store.photoVersion}-${photo.file}`,
    });
    if (source !== this.source) {
      this.source = source;
      this.image.src = source;
    }
    this.image.style.opacity = String(photo.opacity);
    this.place();
  }

  // In heights of the main view, so that it stays with the figures whatever the window's size.
  place(): void {
    const { photo } = this.actions;
    if (!photo) return;
    const { clientHeight, clientWidth } = this.actions.viewport.main.element;
    const { style } = this.image;
    style.height = `${clientHeight * photo.scale}px`;
    style.left = `${clientWidth / 2 + clientHeight * photo.offset[0]}px`;
    style.top = `${clientHeight / 2 - clientHeight * photo.offset[1]}px`;
  }
}
