// The toolbar's pictures: 20 x 20, drawn with strokes in the colour of the text.

const kPaths = {
  pose: "M4 3l11 6-5 1.2L7.5 15z M12 12l4 4",
  rotate: "M15.5 7A6.5 6.5 0 1 0 16.5 11 M16 3v4.5h-4.5",
  move: "M10 2v16 M2 10h16 M7.5 4.5L10 2l2.5 2.5 M7.5 15.5L10 18l2.5-2.5 M4.5 7.5L2 10l2.5 2.5 M15.5 7.5L18 10l-2.5 2.5",
  pin: "M7 3h6l-1 5 3 3H5l3-3z M10 11v6",
  hold: "M8.5 11.5l3-3 M9.5 6.5l2-2a3 3 0 0 1 4.2 4.2l-2 2 M10.5 13.5l-2 2a3 3 0 0 1-4.2-4.2l2-2",
  "photo-pin": "M3 4.5h14v11H3z M3 13l4-4 3 3 M13.5 6.5v6 M11.5 10.5l2 2 2-2",
  world:
    "M10 2.5a7.5 7.5 0 1 0 0 15a7.5 7.5 0 1 0 0-15z M2.5 10h15 M10 2.5c4 4 4 11 0 15 M10 2.5c-4 4-4 11 0 15",
  settle: "M3 16.5h14 M10 3v9 M6.5 9L10 12.5 13.5 9",
  mirror: "M10 2.5v15 M7 6L3 14h4z M13 6l4 8h-4z",
  heat: "M10 2.5c1 3 4.5 4.5 4.5 9a4.5 4.5 0 0 1-9 0c0-2 1-3 2-4 .5 1.5 1 2 1.5 2 .5-2 0-4 1-7z",
  views: "M2.5 3.5h9v13h-9z M13.5 3.5h4v3.5h-4z M13.5 8.25h4v3.5h-4z M13.5 13h4v3.5h-4z",
  frame: "M3 7V3h4 M13 3h4v4 M17 13v4h-4 M7 17H3v-4 M10 7.5a2.5 2.5 0 1 0 0 5a2.5 2.5 0 1 0 0-5z",
  ghost: "M4.5 17V9a5.5 5.5 0 0 1 11 0v8l-2.2-2-1.6 2-1.7-2-1.7 2-1.6-2z M8 8.5v.8 M12 8.5v.8",
  undo: "M7 4L3.5 7.5 7 11 M3.5 7.5h8a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l3.5 3.5L13 11 M16.5 7.5h-8a4.5 4.5 0 0 0 0 9H12",
  sun: "M10 6.5a3.5 3.5 0 1 0 0 7a3.5 3.5 0 1 0 0-7z M10 2v1.5 M10 16.5V18 M2 10h1.5 M16.5 10H18 M4.3 4.3l1.1 1.1 M14.6 14.6l1.1 1.1 M4.3 15.7l1.1-1.1 M14.6 5.4l1.1-1.1",
  moon: "M16 12.5A7 7 0 1 1 7.5 4a5.5 5.5 0 0 0 8.5 8.5z",
} as const;
export type IconName = keyof typeof kPaths;

export function icon(name: IconName): SVGSVGElement {
  const kSvg = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(kSvg, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", kPaths[name]);
  svg.append(path);
  return svg;
}
