// Converts names and numbers to text, and text to numbers.

// Rounds to twelve digits, so that a typed number is shown as typed after its unit was converted.
export const tidy = (value) => Number(value.toPrecision(12));

const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const GROUPED = /^([+-]?[1-9]\d{0,2})[.,](\d{3})$/;

// Returns the numbers that a text may mean; it may have a decimal comma or the minus sign U+2212. A mark before three
// digits is decimal or separates thousands: then there are two numbers, the one with the decimal mark first.
export function readings(text) {
  const plain = text.trim().replace("−", "-");
  const point = plain.replace(",", ".");
  if (!DECIMAL.test(point) || !Number.isFinite(Number(point))) return [];
  const grouped = GROUPED.exec(plain);
  return grouped ? [Number(point), Number(grouped[1] + grouped[2])] : [Number(point)];
}

// Returns the number that a text means, or null if it is not a number or may be one of two. The one with the decimal
// mark is taken if it is a usual value and the other one is not.
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

// Returns the name of a part of the scene with this key.
export const partName = (key) => (key === "runup" ? "run-up" : key.replaceAll("_", " "));

// Returns number and name of a branch, as the program writes them.
export const numbered = (branch, name) => (branch ? `${branch}: ${name}` : name);

// Returns a Krein sign as text.
export const krein = (sign) => (sign > 0 ? "+1" : sign < 0 ? "−1 (reflected)" : "0 (none)");
