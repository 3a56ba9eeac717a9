// What the chart says, in words and tables.

import { node } from "./dom.js";

// The answer of the program and its reasons, in its own words.
export function verdict(place, { answer, lines }) {
  place.className = answer ?? "";
  const [headline, ...reasons] = lines;
  if (place.textContent.trim() === lines.join(" ")) return;
  place.replaceChildren(
    node("strong", { textContent: headline }), " ",
    node("span", { className: "reasons" }, ...reasons.flatMap((reason) => [node("span", { textContent: reason }), " "])));
}

// The answer alone, before its reasons are known. The reasons of an equal answer stay.
export function headline(place, { answer, lines }) {
  if (place.querySelector("strong")?.textContent !== lines[0]) verdict(place, { answer, lines });
}

// The numbers that a change is judged by, against those of another saw.
export function facts(place, now, before) {
  const told = ({ words, unit }) => `${words} ${unit}`.trimEnd();
  place.replaceChildren(...now.map((fact) => {
    const other = before.find(({ name }) => name === fact.name);
    const changed = other !== undefined && told(other) !== told(fact);
    const text = changed ? `${other.words} → ${told(fact)}` : told(fact);
    const className = ["fact", changed && "changed", fact.isAhead && "ahead"].filter(Boolean).join(" ");
    return node("div", { className }, node("dt", { textContent: fact.name }), node("dd", { textContent: text }));
  }));
}

function table({ caption, heads, rows }) {
  const cell = (tag) => (text) => node(tag, { textContent: text, ...(tag === "th" ? { scope: "col" } : {}) });
  return node("table", {},
    node("caption", { textContent: caption }),
    node("thead", {}, node("tr", {}, ...heads.map(cell("th")))),
    node("tbody", {}, ...rows.map((row) => node("tr", {}, ...row.map(cell("td"))))));
}

// The chart for those who do not see it, and for who wants the numbers.
export const tables = (place, all) => place.replaceChildren(...all.map(table));
