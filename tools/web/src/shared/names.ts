// Names of the two figures, and names as words.

export type FigureName = "a" | "b";
export const figureNames: FigureName[] = ["a", "b"];
export type PerFigure<T> = Record<FigureName, T>;

// "left_elbow" -> "left elbow"
export const words = (name: string) => name.replace(/_/g, " ");
