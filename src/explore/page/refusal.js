// Why a number is refused: in the words and the unit of its field, with a range that is of use.

import { shown, tidy, unitOf, whichOf } from "./words.js";

// Units whose fields have names that need the rest of the form around them, such as "from" and "idle".
const SHORT = ["rpm", "s", "1/s", "N per tooth"];
const NUMBER = "[-−]?\\d+(?:\\.\\d+)?(?:e[-+]?\\d+)?";
const numberOf = (text) => Number(text.replace("−", "-"));
const pattern = (path) => path.replace(/\[\d+\]/g, "[]");
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// Words for refused numbers, by the table of quantities.
export class Refusals {
  constructor(quantities) {
    this.quantities = quantities;
  }

  // `allowed` is what the program says the number must be, in SI; null where it could not read one.
  told(path, { typed, whole }, allowed) {
    const key = path.split(".").at(-1);
    const { unit, scale, name } = unitOf(key);
    const quantity = this.quantities.get(pattern(path));
    const subject = capital(SHORT.includes(unit) ? quantity?.name ?? name : name);
    const inUnit = (value, digits) => shown(tidy(value * scale), digits);
    const of = unit && ` ${unit}`;
    const which = typeof typed === "string" ? whichOf(typed) : null;
    if (which) return `${which}${of && `, in${of}`}`;
    if (whole && !(Number.isSafeInteger(typed) && typed >= 0)) return `${subject} must be a whole number`;
    if (typeof typed !== "number") return `${subject} must be a number${unit && `, in ${unit}`}`;
    if (allowed === null) return null;
    const between = new RegExp(`^between (${NUMBER}) and (${NUMBER})$`).exec(allowed);
    if (between) {
      const [from, to] = between.slice(1).map((value) => inUnit(numberOf(value)));
      return `${subject} must be between ${from} and ${to}${of}`;
    }
    // A bound that only keeps numbers from overflowing, and what saws have.
    const bound = new RegExp(`^(above|at least|at most) (${NUMBER})(?:;|$)`).exec(allowed);
    if (!bound || !quantity) return `${subject} must be ${this.#converted(path, allowed, { unit, inUnit })}`;
    const usual = `; usual: ${quantity.usual.map((value) => inUnit(value, 3)).join(" to ")}${of}`;
    if (numberOf(bound[2]) === 0) return `${subject} must be ${bound[1]} 0${of}${usual}`;
    return `${subject} is too ${bound[1] === "at most" ? "large" : "small"}${usual}`;
  }

  // Numbers in the unit of the field, paths by their names.
  #converted(path, allowed, { unit, inUnit }) {
    const whole = path.slice(0, path.lastIndexOf(".") + 1);
    const named = allowed.replace(/(?<!the )\b[a-z]+(?:\[\d*\])?(?:[._][a-z_]+(?:\[\d*\])?)+/g, (word) => {
      const found = this.quantities.get(pattern(word)) ?? this.quantities.get(pattern(whole + word));
      return found ? `the ${found.name}` : word.replaceAll("_", " ");
    });
    // A number is of the field where it stands alone or has the SI unit of the key; one with a word
    // of its own behind it, as in "30 diameters", stays.
    const si = { mm: "m", in: "m", "MN/m": "N/m", MPa: "Pa", GPa: "Pa" }[unit] ?? unit;
    const escaped = si.replace(/[^\w]/g, "\\$&");
    const alone = `(?=$|[),;:.]| and\\b| to\\b| or\\b)`;
    const ending = si === "" ? alone : `(?:( ${escaped})(?![\\w/])|${alone})`;
    const plain = new RegExp(`(?<![\\w.])(${NUMBER})${ending}`, "g");
    let last = null;
    const told = named.replace(plain, (_, number, own) => {
      last = typeof own === "string";
      return `${inUnit(numberOf(number))}${last ? ` ${unit}` : ""}`;
    });
    if (last !== false || unit === "") return told;
    // The unit stands behind the last number, once.
    return told.replace(new RegExp(`(${NUMBER})(?=\\D*$)`), `$1 ${unit}`);
  }
}
