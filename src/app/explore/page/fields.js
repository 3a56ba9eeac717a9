// Table of the numbers of a scene, which the program sends: names, usual ranges, and the units of the form.

import { shown } from "./words.js";

let table = new Map();
// "metric" or "inches"; only the units of lengths differ.
let units = "metric";

export function describe(fields) {
  table = new Map(fields.map((field) => [field.path, field]));
}

export function useInches(on) {
  units = on ? "inches" : "metric";
}

export const unitsNow = () => units;

// Returns the entry of a number or of a list of numbers; undefined if the table has none.
export function fieldOf(path) {
  const general = path.replace(/\[\d+\]/g, "[]");
  return table.get(general) ?? table.get(`${general}[]`);
}

const IN_INCHES = { mm: 1 / 25.4, m: 1 / 0.0254, "µm": 1 / 25_400 };

// Returns the unit of the form in which a number with this unit is shown, and the factor to it.
export function formUnit(unit) {
  const scale = units === "inches" ? IN_INCHES[unit] : undefined;
  return scale === undefined ? { unit, scale: 1 } : { unit: "in", scale };
}

export function placeOf(path) {
  const { name } = unitOf(path);
  return path.startsWith("guides") ? `guide ${Number(/\d+/.exec(path)[0]) + 1}: ${name}` : name;
}

export function nameOf(path, value) {
  const { unit, scale } = unitOf(path);
  const words = typeof value === "number" ? `${shown(value * scale, 4)} ${unit}` : value === undefined ? "none" : typeof value === "object" ? "" : value;
  return `${placeOf(path)} ${words}`.trim();
}

/** @returns {{ unit: string, scale: number, digits: number, name: string }} */
export function unitOf(path) {
  const field = fieldOf(path);
  if (field) return { ...field[units], name: field.label };
  return { unit: "", scale: 1, digits: 12, name: path.split(".").at(-1).replaceAll("_", " ") };
}
