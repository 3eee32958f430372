// Colours of a figure's limbs: its own, or heat; limbs that are not meant now step back.

import { numSegments } from "./body";
import { figureColour, heatStops, kHeatFull, mix, ramp, rgbOf, type Rgb } from "./colours";
import type { FigureName } from "./names";
import { isDark } from "./theme";

// `turns`: heat of each segment, or null. `dimmed` limbs are mixed by `dimming`, in [0, 1], with
// the colour of the stage. [segments]
export function limbColours(
  figure: FigureName,
  turns: ArrayLike<number> | null,
  dimmed: (segment: number) => boolean,
  dimming: number,
): Rgb[] {
  const plain = rgbOf(figureColour[figure]);
  const dim = rgbOf(isDark() ? "#3A424C" : "#C9CFD6");
  return Array.from({ length: numSegments }, (_, s) => {
    const colour = turns ? ramp(heatStops[figure], turns[s] / kHeatFull) : plain;
    return dimmed(s) ? mix(colour, dim, dimming) : colour;
  });
}
