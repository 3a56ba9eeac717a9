// Names and numbers as people read them.

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
