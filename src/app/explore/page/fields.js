// Table of the numbers of a scene, which the program sends: names, usual ranges, and the units of the form.

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

/** @returns {{ unit: string, scale: number, digits: number, name: string }} */
export function unitOf(path) {
  const field = fieldOf(path);
  if (field) return { ...field[units], name: field.label };
  return { unit: "", scale: 1, digits: 12, name: path.split(".").at(-1).replaceAll("_", " ") };
}
