// Texts of the program in the names and units of the form: "guides[0].radius_m is 0.9 m" becomes "guide 1: radius is 900 mm".

import { fieldOf, findField, formUnit, fullName, keyOf, unitOfField } from "./fields.js";
import { shown } from "./words.js";

// Units of fields whose labels, such as "from" and "idle", are not clear without the form around them.
const UNCLEAR = ["rpm", "s", "1/s", "N per tooth"];
const BLOCK = /^(accuracy|blade|cut|damping|excitation|friction|guides|limits|membrane|mount|probe|response|runup|side_force|spline|sweep)[.[][\w.[\]]*$/;
const JOINS = ["to", "and", "or", "by", "×"];
const numberIn = (core) => (/^[-−]?\d+(\.\d+)?(e-?\d+)?$/.test(core) ? Number(core.replace("−", "-")) : null);

// Returns the field that a word names by its path or by the last part of it, with the name in the form; null if it names none.
function named(word) {
  if (!/[._]/.test(word)) return null;
  const own = fieldOf(word);
  if (own) return [own, fullName(word)];
  const field = keyOf(word);
  return field ? [field, UNCLEAR.includes(field.metric.unit) ? field.name : field.label] : null;
}

const nameOfBlock = (path) => path.replace(/guides\[(\d+)\]/, (_, k) => `guide ${Number(k) + 1}`).replace(/\[(\d+)\]/g, (_, k) => ` ${Number(k) + 1}`)
  .replace(/\.(?=.)/g, ": ").replaceAll("_", " ");

// Returns the unit of the form in the place of a unit, and the factor to it. Of several fields, the one that was named last decides.
function unitFor(unit, field) {
  const own = field?.si === unit ? field : findField(({ si }) => si === unit);
  return own ? unitOfField(own) : formUnit(unit);
}

export function inForm(text) {
  const words = text.split(" ").map((word) => /^([(“"`]*)(.*?)([)”"`,;:.]*)$/.exec(word).slice(1));
  let field = null;
  const twice = [];
  words.forEach((word, k) => {
    const [, core] = word;
    const found = named(core);
    const name = found?.[1] ?? (BLOCK.test(core) ? nameOfBlock(core) : null);
    if (found) [field] = found;
    // A path that is followed by its name would be named twice.
    if (found) twice.push([`${name} (${field.name})`, name]);
    if (name !== null) {
      words[k] = word.map((part) => part.replaceAll("`", ""));
      words[k][1] = name;
      return;
    }
    const { unit, scale } = core === "" ? { unit: core, scale: 1 } : unitFor(core, field);
    if (unit === core && scale === 1) return;
    // The numbers before a unit, as in "40 to 60 m", are in it.
    for (let at = k - 1; at >= 0 && numberIn(words[at][1]) !== null && (at === k - 1 || words[at][2] === ""); at -= 2) {
      const given = words[at][1];
      const digits = Math.max(given.replace(/e.*|\D/g, "").replace(/^0+/, "").length, 4);
      words[at][1] = shown(numberIn(given) * scale, digits).replace("-", "−");
      word[1] = unit;
      if (!JOINS.includes(words[at - 1]?.[1])) break;
    }
  });
  return twice.reduce((told, [both, one]) => told.replace(both, one), words.map((word) => word.join("")).join(" "));
}
