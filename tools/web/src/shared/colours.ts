// Colours that stay apart for every kind of colour vision (Okabe and Ito 2008).

import type { PerFigure } from "./names";

export const okabeIto = {
  black: "#000000",
  orange: "#E69F00",
  sky: "#56B4E9",
  green: "#009E73",
  yellow: "#F0E442",
  blue: "#0072B2",
  vermilion: "#D55E00",
  purple: "#CC79A7",
};

export const figureColour: PerFigure<string> = { a: okabeIto.blue, b: okabeIto.orange };

export type Rgb = [number, number, number]; // sRGB, components in [0, 1]

export function rgbOf(hex: string): Rgb {
  const value = parseInt(hex.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

export function mix(a: Rgb, b: Rgb, t: number): Rgb {
  return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
}

export function cssOf([r, g, b]: Rgb): string {
  return `rgb(${Math.round(255 * r)},${Math.round(255 * g)},${Math.round(255 * b)})`;
}

// A colour of the ramp `stops` at t in [0, 1].
export function ramp(stops: Rgb[], t: number): Rgb {
  const x = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const k = Math.min(Math.floor(x), stops.length - 2);
  return mix(stops[k], stops[k + 1], x - k);
}

// Heat on the limbs: from a pale tint of the figure's own colour to one crimson, ever darker.
export const kHeatFull = 0.5; // turns at the dark end
export const heatStops: PerFigure<Rgb[]> = {
  a: ["#B4CEDF", "#E79AAE", "#D6336C", "#8E0B4A"].map(rgbOf),
  b: ["#EBDCB2", "#F0A79A", "#D6336C", "#8E0B4A"].map(rgbOf),
};

// Small to large on paper and on a dark screen, monotone in lightness.
export const sequential = {
  light: ["#F3F5F7", "#BFD4E6", "#6AA0CB", "#2A6496", "#0B2E52"].map(rgbOf),
  dark: ["#1B2128", "#1F4468", "#2F78AE", "#7FB6DD", "#E8F3FB"].map(rgbOf),
};
