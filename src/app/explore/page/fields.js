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

// Returns the first field that satisfies a condition; undefined if none does.
export const findField = (condition) => [...table.values()].find(condition);

// Returns the field whose path ends with a key that has a unit; undefined if none does.
export const keyOf = (key) => findField(({ path }) => key.includes("_") && path.replace(/\[\]$/, "").endsWith(`.${key}`));

// Returns the unit of the form of a field, and the factor to it.
export const unitOfField = (field) => field[units];

// Returns the paths of the numbers of scenes whose path or name has these words.
export function named(words) {
  const isNamed = ({ path, name, label }) => `${path} ${path.replaceAll("_", " ")} ${name} ${label}`.toLowerCase().includes(words);
  return [...table.values()].filter(isNamed).map(({ path }) => path);
}

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

// Returns a name that is clear without the form around it.
export function fullName(path) {
  const index = [...path.matchAll(/\[(\d+)\]/g)].map(([, at]) => Number(at) + 1);
  const name = fieldOf(path)?.name ?? unitOf(path).name;
  return path.startsWith("guides") ? placeOf(path) : [name, ...index].join(" ");
}

// Returns a number with its unit in the form.
export function worded(path, value, digits = 6) {
  const { unit, scale } = unitOf(path);
  return `${shown(value * scale, digits)} ${unit}`.trim();
}

export function nameOf(path, value) {
  const words = typeof value === "number" ? worded(path, value, 4) : value === undefined ? "none" : typeof value === "object" ? "" : value;
  return `${placeOf(path)} ${words}`.trim();
}

/** @returns {{ unit: string, scale: number, digits: number, name: string }} */
export function unitOf(path) {
  const field = fieldOf(path);
  if (field) return { ...field[units], name: field.label };
  return { unit: "", scale: 1, digits: 12, name: path.split(".").at(-1).replaceAll("_", " ") };
}
