// Shows the results of a chart as text and tables.

import { node } from "./dom.js";

// Shows the answer of the program and its reasons.
export function verdict(place, { answer, lines }) {
  place.className = answer ?? "";
  const [line, ...reasons] = lines;
  if (place.textContent.trim() === lines.join(" ")) return;
  place.replaceChildren(
    node("strong", { textContent: line }), " ",
    node("span", { className: "reasons" }, ...reasons.flatMap((reason) => [node("span", { textContent: reason }), " "])));
}

// Shows the answer before its reasons are known. If the answer is unchanged, the reasons remain.
export function headline(place, { answer, lines }) {
  if (place.querySelector("strong")?.textContent !== lines[0]) verdict(place, { answer, lines });
}

// Shows the main numbers of a saw, each with that of another saw if it differs.
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

function table({ title, columns, rows }) {
  const cell = (tag, span) => (text) => node(tag, { textContent: text, ...span, ...(tag === "th" ? { scope: "col" } : {}) });
  const heads = columns.map(({ group, name, unit }) => `${group} ${name} ${unit}`.trim().replace("  ", " "));
  const shown = ({ cells, remark }) => [
    node("tr", {}, ...cells.map(({ words }) => words).map(cell("td"))),
    ...(remark === null ? [] : [node("tr", {}, cell("td", { colSpan: columns.length })(remark))]),
  ];
  return node("table", {},
    node("caption", { textContent: title }),
    node("thead", {}, node("tr", {}, ...heads.map(cell("th")))),
    node("tbody", {}, ...rows.flatMap(shown)));
}

// Shows the numbers of a chart in tables, also for users who do not see the chart.
export const tables = (place, all) => place.replaceChildren(...all.map(table));
