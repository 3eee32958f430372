// For tests and for curious people at the console.

import type { FigureName } from "../../shared/names";
import type { Op, State } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Store, Ui } from "../state/store";
import type { ViewName } from "../stage/view";
import type { Viewport } from "../stage/viewport";

interface StudioHandle {
  readonly session: string;
  readonly requests: number;
  readonly ui: Ui;
  state(): State;
  // Where a node is on the page (CSS px), in a view.
  project(figure: FigureName, node: string, view?: ViewName): { x: number; y: number } | null;
  // Operations, as the controls send them: one step of the history. True where the server took it.
  do(...ops: Op[]): Promise<boolean>;
  // When no request is under way and the page shows what came.
  idle(): Promise<void>;
}
declare global {
  interface Window {
    retargetStudio: StudioHandle;
  }
}

export function exposeHook(store: Store, sender: Sender, viewport: Viewport): void {
  window.retargetStudio = {
    get session() {
      return store.session;
    },
    get requests() {
      return sender.requests;
    },
    get ui() {
      return store.ui;
    },
    state: () => store.state,
    do: (...ops) => sender.do(...ops),
    project(figure, node, name = "main") {
      const view = viewport.views.find((v) => v.name === name)!;
      return view.project(store.place({ figure, node: store.findNode(figure, node) }));
    },
    async idle() {
      await sender.idle();
      // One picture for the store, one for the stage.
      for (let k = 0; k < 2; ++k) await new Promise((drawn) => requestAnimationFrame(drawn));
    },
  };
}
