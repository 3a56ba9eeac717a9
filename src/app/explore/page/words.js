// Converts names and numbers to text.

// Rounds to twelve digits, so that a typed number is shown as typed after its unit was converted.
export const tidy = (value) => Number(value.toPrecision(12));

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

const power = (n) => (n === 0 ? "" : n === 1 ? " s" : ` s${[...String(n)].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).join("")}`);

// Returns a polynomial of s in words; its coefficients begin with that of the highest power.
function polynomial(coefficients) {
  const terms = coefficients.map((factor, k) => (factor === 0 ? "" : `${shown(factor)}${power(coefficients.length - 1 - k)}`));
  return terms.filter(Boolean).join(" + ") || "0";
}

// Returns the law of a controller in words.
export const lawOf = ({ numerator, denominator }) =>
  `The force against the deflection is (${polynomial(numerator)}) / (${polynomial(denominator)}) times it, in N and m, with s in 1/s. Coefficients begin with the highest power of s.`;

export const numbered = (branch, name) => (branch ? `${branch}: ${name}` : name);

export const krein = (sign) => (sign > 0 ? "+1" : sign < 0 ? "−1 (reflected)" : "0 (none)");
