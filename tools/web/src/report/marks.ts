// Marks on a stage: discs under planted feet, and a ball where bodies overlap.

import { Group, Mesh, MeshBasicMaterial, RingGeometry, SphereGeometry } from "three";
import { findNode, parentOf } from "../shared/body";
import { middleOfClosest } from "../shared/closest";
import { okabeIto } from "../shared/colours";
import type { FigureScene } from "../shared/figure_scene";
import { figureNames, type FigureName } from "../shared/names";
import type { Report, Series } from "./data";

const kShownFrom = 0.05; // cm; less is numerical contact

interface Contact {
  first: number;
  last: number;
  figure: FigureName;
  node: number;
  disc: Mesh;
}

export class Marks {
  private readonly contacts: Contact[] = [];
  private readonly ball = new Group();

  constructor(
    private readonly figures: FigureScene,
    private readonly series: Series,
    report: Report,
  ) {
    const geometry = new RingGeometry(0.055, 0.085, 24).rotateX(-Math.PI / 2);
    const material = new MeshBasicMaterial({ color: okabeIto.green });
    for (const figure of figureNames) {
      for (const { node, first, last } of report.contacts[figure]) {
        const disc = new Mesh(geometry, material);
        this.contacts.push({ first, last, figure, node: findNode(node), disc });
        figures.scene.add(disc);
      }
    }
    // Seen through the bodies: the place is inside of them.
    const seen = (opacity: number) =>
      new MeshBasicMaterial({
        color: okabeIto.vermilion,
        transparent: true,
        opacity,
        depthTest: false,
      });
    this.ball.add(
      new Mesh(new SphereGeometry(1, 20, 12), seen(0.35)),
      new Mesh(new SphereGeometry(0.5, 20, 12), seen(0.95)),
    );
    figures.scene.add(this.ball);
  }

  // In a frame, or between it and the next.
  update(frame: number, between: boolean): void {
    for (const { first, last, figure, node, disc } of this.contacts) {
      disc.visible = frame >= first && frame <= last;
      if (!disc.visible) continue;
      const at = this.figures.point(figure, node);
      disc.position.set(at.x, 0.006, at.z);
    }
    const { penetration_pair, penetration_cm } = between ? this.series.between : this.series;
    const pair = penetration_pair[frame];
    const depth = penetration_cm[frame];
    this.ball.visible = pair != null && depth > kShownFrom;
    if (!pair || !this.ball.visible) return;
    const [a, b] = pair.map(findNode);
    const point = (figure: FigureName, node: number) => this.figures.point(figure, node);
    this.ball.position.copy(
      middleOfClosest(
        point("a", parentOf[a]),
        point("a", a),
        point("b", parentOf[b]),
        point("b", b),
      ),
    );
    this.ball.scale.setScalar(0.035 + 0.01 * Math.min(depth, 10));
  }
}
