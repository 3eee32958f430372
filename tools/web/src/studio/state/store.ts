// What the page shows: the server's state as it came last, and what only the page knows. Everybody
// reads it; the state changes by replies of the server alone.

import type { FigureName, PerFigure } from "../../shared/names";
import type { Body, Reply, Result, Start, State, Tangle, Vec } from "./protocol";

export interface Pick {
  figure: FigureName;
  node: number;
}
export type Tool = "pose" | "rotate" | "move" | "pin" | "hold" | "photo-pin" | "photo-move";
export type Shown = "shown" | "ghost" | "hidden";
export type PanelName = "figures" | "holds" | "tangles" | "photo" | "library" | "try";

export interface Ui {
  tool: Tool;
  selected: Pick | null;
  figure: FigureName; // whose card is open
  joint: number; // link of `figure`
  hovered: Pick | null;
  worldAxes: boolean;
  turning: boolean; // the move tool turns instead
  shown: PerFigure<Shown>;
  heat: boolean;
  solid: number; // opacity of the figures over a photo
  sideViews: boolean;
  lit: Tangle | null; // paths lit on the bodies
  litPair: [number, number] | null; // segments of a and b
  holdFrom: Pick | null;
  holdEdited: number | null; // the hold whose ends are picked anew
  litHold: number | null;
  panel: PanelName;
  locked: boolean; // photo and camera stay
  dragTarget: Vec | null;
  dragging: boolean;
}

export interface Message {
  text: string;
  kind: "info" | "good" | "bad";
}

export class Store {
  body!: Body;
  state!: State;
  result: Result | null = null;
  session = "";
  start: Start = {};
  message: Message = { text: "", kind: "info" };
  connected = true;
  photoVersion = 0; // so that the browser asks for the picture anew
  ui: Ui = {
    tool: "pose",
    selected: null,
    figure: "a",
    joint: 0,
    hovered: null,
    worldAxes: false,
    turning: false,
    shown: { a: "shown", b: "shown" },
    heat: false,
    solid: 0.85,
    sideViews: true,
    lit: null,
    litPair: null,
    holdFrom: null,
    holdEdited: null,
    litHold: null,
    panel: "figures",
    locked: false,
    dragTarget: null,
    dragging: false,
  };
  private readonly listeners: (() => void)[] = [];
  private scheduled = false;

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  // At most once a picture.
  changed(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      for (const listener of this.listeners) listener();
    });
  }

  set(change: Partial<Ui>): void {
    Object.assign(this.ui, change);
    this.changed();
  }

  say(text: string, kind: Message["kind"] = "info"): void {
    this.message = { text, kind };
    this.changed();
  }

  // A reply while a drag is under way leaves out what was not asked anew.
  take(reply: Reply): void {
    if (reply.body) this.body = reply.body;
    if (reply.session) this.session = reply.session;
    if (reply.start) this.start = reply.start;
    const queries = { ...this.state?.queries, ...reply.state.queries };
    this.state = { ...reply.state, queries };
    if (reply.result !== undefined) this.result = reply.result;
    this.changed();
  }

  nodeName({ figure, node }: Pick): string {
    return this.body[figure].nodes[node].name;
  }
  place({ figure, node }: Pick): Vec {
    return this.state.figures[figure].nodes[node];
  }
  jointCentre(figure: FigureName, link: number): Vec {
    return this.state.figures[figure].centres[link];
  }

  // The joint that a node stands for: the one at its place, else the one that carries it.
  jointOf({ figure, node }: Pick): number {
    const { nodes, links } = this.body[figure];
    for (let n = node; n >= 0; n = nodes[n].parent) {
      const own = links.findIndex((link) => link.name === nodes[n].name);
      if (own >= 0) return own;
      const at = links.findIndex((link) => link.node === nodes[n].name);
      if (at >= 0) return at;
    }
    return 0;
  }

  select(selected: Pick | null): void {
    if (!selected) return this.set({ selected });
    this.set({ selected, figure: selected.figure, joint: this.jointOf(selected) });
  }

  pinOf(pick: Pick): number {
    const name = this.nodeName(pick);
    return this.state.pins.findIndex((p) => p.figure === pick.figure && p.node === name);
  }

  findNode(figure: FigureName, name: string): number {
    return this.body[figure].nodes.findIndex((node) => node.name === name);
  }
}
