// The part of a printed page beside the answer and the chart: the date, and the numbers of the saw in the units of the form.

import { node } from "./dom.js";
import { fullName, worded } from "./fields.js";

// Returns the paths of the numbers of a part of the scene, each with its number.
function numbersOf(part, path = "") {
  if (typeof part === "number") return [[path, part]];
  if (Object(part) !== part) return [];
  const inner = (key) => (Array.isArray(part) ? `${path}[${key}]` : path ? `${path}.${key}` : key);
  return Object.entries(part).flatMap(([key, value]) => numbersOf(value, inner(key)));
}

export function sheet(place, { measured: _points, ...saw }, version) {
  const date = new Date().toLocaleDateString(undefined, { dateStyle: "long" });
  const rows = numbersOf(saw).map(([path, value]) => node("div", { className: "fact" }, node("dt", { textContent: fullName(path) }), node("dd", { textContent: worded(path, value) })));
  place.replaceChildren(node("h2", { textContent: "Numbers of the saw" }), node("dl", {}, ...rows), node("p", { className: "remark", textContent: `Printed on ${date} with sawflutter ${version}.` }));
}
