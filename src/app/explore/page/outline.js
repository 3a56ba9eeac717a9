// Shows texts of the program: the verdict of a chart, and outlines with sentences, facts and tables, also for users who do
// not see the chart.

import { explain, node } from "./dom.js";
import { keyOf, unitOf, unitOfField } from "./fields.js";
import { inForm } from "./phrases.js";
import { shown } from "./words.js";

// Returns the words of a value and their unit; for a number whose unit is another one in the form, three digits in that
// unit.
function inFormUnit({ words, unit = "", value, unit_of }) {
  const own = unit_of === undefined ? { unit, scale: 1 } : unitOf(unit_of);
  return { words: own.unit === unit ? words : shown(value * own.scale, 3).replace("-", "−"), unit: own.unit };
}

// Returns the words of a value with its unit, after those of an earlier value if they differ.
export function told(value, before = null) {
  const now = inFormUnit(value);
  const was = before === null ? now : inFormUnit(before);
  return `${was.words === now.words ? "" : `${was.words} → `}${now.words} ${now.unit}`.trimEnd();
}

// Shows the answer of the program in few words, and the numbers that decide it.
export function verdict(place, { answer = null, word, line, isAhead = false }) {
  place.className = [answer, isAhead && "ahead"].filter(Boolean).join(" ");
  const words = inForm(line);
  if (place.textContent === `${word} ${words}`) return;
  place.replaceChildren(node("strong", {}, node("span", { textContent: word })), " ", node("span", { textContent: words }));
  explain(place);
}

function term(name, text, className = "fact") {
  return node("div", { className }, explain(node("dt", { textContent: name })), node("dd", { textContent: text }));
}

export function facts(place, now, before) {
  place.replaceChildren(...now.map(({ name, value, isAhead }) => {
    const text = told(value, before.find((one) => one.name === name)?.value);
    const changed = text !== told(value);
    return term(name, text, ["fact", changed && "changed", isAhead && "ahead"].filter(Boolean).join(" "));
  }));
}

// Returns a table in the units of the form. A column that is named by the key of a number has numbers in the unit of scenes.
function ofForm({ title, columns, rows }) {
  const units = columns.map(({ name, unit }, k) => {
    const path = rows.map(({ cells }) => cells[k]?.unit_of).find(Boolean);
    if (path) return { name, unit: unitOf(path).unit, told: inFormUnit };
    const field = unit === "" ? keyOf(name) : undefined;
    if (!field) return { name: inForm(name), unit, told: ({ words }) => ({ words: inForm(words) }) };
    const own = unitOfField(field);
    return { name: field.label, unit: own.unit, told: ({ words }) => ({ words: Number.isNaN(Number(words)) ? words : shown(Number(words) * own.scale, 4) }) };
  });
  return {
    title: inForm(title),
    columns: columns.map((column, k) => ({ ...column, name: units[k].name, unit: units[k].unit })),
    rows: rows.map(({ cells, remark }) => ({ cells: cells.map((one, k) => units[k]?.told(one) ?? one), remark: remark && inForm(remark) })),
  };
}

function table(given) {
  const { title, columns, rows } = ofForm(given);
  const cell = (tag, span) => (text) => node(tag, { textContent: text, ...span, ...(tag === "th" ? { scope: "col" } : {}) });
  const heads = columns.map(({ group, name, unit }) => `${group} ${name} ${unit}`.trim().replace("  ", " "));
  const shownRow = ({ cells, remark }) => [
    node("tr", {}, ...cells.map(({ words }) => words).map(cell("td"))),
    ...(remark === null ? [] : [node("tr", {}, cell("td", { colSpan: columns.length })(remark))]),
  ];
  const whole = node("table", {},
    node("caption", { textContent: title }),
    node("thead", {}, node("tr", {}, ...heads.map(cell("th")))),
    node("tbody", {}, ...rows.flatMap(shownRow)));
  return node("div", { className: "table", tabIndex: 0, role: "region", "aria-label": title || heads.join(", ") }, whole);
}

const BLOCKS = {
  heading: (text) => node("p", { className: "remark", textContent: inForm(text) }),
  headline: (text) => node("p", {}, node("strong", { textContent: inForm(text) })),
  reason: (text) => node("p", { textContent: inForm(text) }),
  sentence: (text) => node("p", { textContent: inForm(text) }),
  remark: ({ word, text }) => node("p", { className: "warning", textContent: inForm(`${word}: ${text}`) }),
  facts: ({ title, facts: all }) => node("dl", { className: "numbers-of-answer", "aria-label": title }, ...all.map(({ name, value, before, remark }) => term(inForm(name), inForm(`${told(value, before)} ${remark}`.trimEnd())))),
  table,
};

// Returns the elements of an outline: warnings, the answer, the rest, and details in small letters.
export function outline(parts) {
  const rank = ({ block, is_detail }) => (is_detail ? 3 : "remark" in block ? 0 : "headline" in block || "heading" in block ? 1 : 2);
  return parts.toSorted((x, y) => rank(x) - rank(y)).map(({ block, is_detail }) => {
    const [[kind, content]] = Object.entries(block);
    const made = BLOCKS[kind](content);
    if (kind !== "table" && kind !== "facts") explain(made);
    made.classList.toggle("detail", is_detail);
    return made;
  });
}
