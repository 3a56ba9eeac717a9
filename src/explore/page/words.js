// Names, units and numbers as people read them.

// Ending of a key, unit shown, what a number of the scene is multiplied by to be shown in it.
/** @type {[string, string, number][]} */
const UNITS = [
  ["_n_s_3_2_per_m_3_2", "N (s/m)^1.5", 1],
  ["_n_per_m_3_2", "N/m^1.5", 1],
  ["_n_s_per_m3", "N s/m³", 1],
  ["_n_s_per_m", "N s/m", 1],
  ["_n_per_tooth", "N per tooth", 1],
  ["_kg_per_m3", "kg/m³", 1],
  ["_n_per_m", "MN/m", 1e-6],
  ["_w_per_m_k", "W/(m K)", 1],
  ["_per_k", "1/K", 1],
  ["_m_per_s", "m/s", 1],
  ["_per_s", "1/s", 1],
  ["_rpm", "rpm", 1],
  ["_deg_c", "°C", 1],
  ["_deg", "°", 1],
  ["_hz", "Hz", 1],
  ["_mpa", "MPa", 1],
  ["_pa", "MPa", 1e-6],
  ["_kg", "kg", 1],
  ["_k", "K", 1],
  ["_w", "W", 1],
  ["_n", "N", 1],
  ["_s", "s", 1],
  ["_m", "mm", 1e3],
];

// Lengths in inches instead of millimetres.
let inches = false;
export function useInches(on) {
  inches = on;
}

/** @returns {{ unit: string, scale: number, digits: number, name: string }} */
export function unitOf(key) {
  if (key === "youngs_modulus_pa") return { unit: "GPa", scale: 1e-9, digits: 12, name: "Young's modulus" };
  if (key === "rpm") return { unit: "rpm", scale: 1, digits: 12, name: "speed" };
  const found = UNITS.find(([ending]) => key.endsWith(ending));
  if (!found) return { unit: "", scale: 1, digits: 12, name: key.replaceAll("_", " ") };
  const [ending, metric, usual] = found;
  // A metric number has no end in inches.
  /** @type {[string, number, number]} */
  const [unit, scale, digits] = inches && ending === "_m" ? ["in", 1 / 0.0254, 6] : [metric, usual, 12];
  return { unit, scale, digits, name: key.slice(0, -ending.length).replaceAll("_", " ") };
}

// Twelve digits: what is typed comes back as typed, whatever the unit.
export const tidy = (value) => Number(value.toPrecision(12));

const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const GROUPED = /^([+-]?[1-9]\d{0,2})[.,](\d{3})$/;

// The numbers that a text may mean, with a decimal comma or a true minus. Before three digits a mark is decimal or
// separates thousands: then there are two, the one with the decimal mark first.
export function readings(text) {
  const plain = text.trim().replace("−", "-");
  const point = plain.replace(",", ".");
  if (!DECIMAL.test(point) || !Number.isFinite(Number(point))) return [];
  const grouped = GROUPED.exec(plain);
  return grouped ? [Number(point), Number(grouped[1] + grouped[2])] : [Number(point)];
}

// The number that a text means; null where it is none or may be one of two. The decimal mark is certain where only
// the number with it is usual.
export function numberOf(text, isUsual = (/** @type {number} */ _) => true) {
  const [decimal, grouped] = readings(text);
  const isCertain = grouped === undefined || (isUsual(decimal) && !isUsual(grouped));
  return decimal !== undefined && isCertain ? decimal : null;
}

// What to type instead of a text that may be one of two numbers.
export function whichOf(text) {
  const [decimal, grouped] = readings(text);
  return grouped === undefined ? null : `“${text.trim()}” may be ${grouped} or ${decimal}; write one of these`;
}

export function shown(value, digits = 6) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-4)) {
    return value.toExponential(Math.min(3, digits)).replace(/\.?0+e/, "e").replace("e+", "e");
  }
  return String(Number(value.toPrecision(digits)));
}

// A part of the scene, by its key.
export const partName = (key) => (key === "runup" ? "run-up" : key.replaceAll("_", " "));

// Number and name of a branch, the same wherever it is met.
export const numbered = (branch, name) => (branch ? `${branch}: ${name}` : name);

// What a Krein sign says.
export const krein = (sign) => (sign > 0 ? "+1" : sign < 0 ? "−1 (reflected)" : "0 (none)");
