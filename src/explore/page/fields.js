// The program's table of the numbers of a scene: names, usual ranges, and the units in which they are shown.

let table = new Map();
// Lengths are in inches or in millimetres; other numbers are metric.
let units = "metric";

export function describe(fields) {
  table = new Map(fields.map((field) => [field.path, field]));
}

export function useInches(on) {
  units = on ? "inches" : "metric";
}

export const unitsNow = () => units;

// The entry of a number, or of the numbers of a list.
export function fieldOf(path) {
  const general = path.replace(/\[\d+\]/g, "[]");
  return table.get(general) ?? table.get(`${general}[]`);
}

/** @returns {{ unit: string, scale: number, digits: number, name: string }} */
export function unitOf(path) {
  const field = fieldOf(path);
  if (field) return { ...field[units], name: field.label };
  return { unit: "", scale: 1, digits: 12, name: path.split(".").at(-1).replaceAll("_", " ") };
}
