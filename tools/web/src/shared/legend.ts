// Legends of colour scales.

import { cssOf, heatStops, kHeatFull, ramp } from "./colours";
import { element, type Child } from "./dom";

// A strip of the colours with the values at both ends. Equally spaced CSS colours.
export function colourScale(least: string, colours: string[], most: string): Child[] {
  const style = `background:linear-gradient(90deg,${colours.join(",")})`;
  return [least, element("i", { style }), most];
}

export function heatScale(): Child[] {
  const colours = [0, 1, 2, 3, 4].map((k) => cssOf(ramp(heatStops.a, k / 4)));
  return colourScale("0", colours, `${kHeatFull} turns`);
}
