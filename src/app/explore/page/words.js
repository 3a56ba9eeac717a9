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

export const numbered = (branch, name) => (branch ? `${branch}: ${name}` : name);

export const krein = (sign) => (sign > 0 ? "+1" : sign < 0 ? "−1 (reflected)" : "0 (none)");
