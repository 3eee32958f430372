// The numbers by which the page judges, the same wherever it does.

import type { Hold, Vec } from "./protocol";

const kOpen = 0.01; // m
// m over the floor; as StandingNodes of model/body/template_posture.h
const kStands = 0.15;

// Whether the two points of a hold are apart.
export const isOpen = ({ error_m }: Hold) => error_m > kOpen;
// Whether a node there stands on the floor.
export const stands = (place: Vec) => place[1] < kStands;

// What a field for a stature offers.
export const statureRange = { unit: "m", step: 0.01, digits: 2, min: 0.5, max: 3 };
