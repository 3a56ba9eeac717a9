// What the chart says, in words and tables.

import { node } from "./dom.js";
import { numbered, shown } from "./words.js";

// The answer of the program and its reasons, in its own words.
export function verdict(place, { answer, lines }) {
  place.className = answer ?? "";
  const [headline, ...reasons] = lines;
  if (place.textContent.trim() === lines.join(" ")) return;
  place.replaceChildren(
    node("strong", { textContent: headline }), " ",
    node("span", { className: "reasons" }, ...reasons.flatMap((reason) => [node("span", { textContent: reason }), " "])));
}

// The numbers that a change is judged by, against those of another saw.
export function facts(place, now, before) {
  const told = ({ words, unit }) => `${words} ${unit}`.trimEnd();
  place.replaceChildren(...now.map((fact) => {
    const other = before.find(({ name }) => name === fact.name);
    const changed = other !== undefined && told(other) !== told(fact);
    const text = changed ? `${other.words} → ${told(fact)}` : told(fact);
    return node("div", { className: changed ? "fact changed" : "fact" }, node("dt", { textContent: fact.name }), node("dd", { textContent: text }));
  }));
}

function table(caption, heads, rows) {
  const cell = (tag) => (text) => node(tag, { textContent: text, ...(tag === "th" ? { scope: "col" } : {}) });
  return node("table", {},
    node("caption", { textContent: caption }),
    node("thead", {}, node("tr", {}, ...heads.map(cell("th")))),
    node("tbody", {}, ...rows.map((row) => node("tr", {}, ...row.map(cell("td"))))));
}

// The chart for those who do not see it, and for who wants the numbers.
export function tables(place, report) {
  const speeds = report.critical_speeds.map((c) => [c.rpm.toFixed(1), c.name, c.branch ?? "–"]);
  const bands = report.instabilities.map((band) => [
    band.kind, band.from_rpm.toFixed(1), `${band.to_rpm.toFixed(1)}${band.closed || band.to_rpm < report.campbell.to_rpm ? "" : " …"}`,
    band.peak_growth_per_s.toPrecision(3), band.frequency_hz.toFixed(2), band.name ?? "–", band.branches.join(", "),
  ]);
  const overdamped = report.overdamped_modes_at_rest;
  const damped = report.modes_at_rest.some((m) => typeof m.damping_ratio === "number");
  const rest = report.modes_at_rest.slice(0, 12).map((m) => [
    m.frequency_hz.toFixed(2), ...(damped ? [shown(m.damping_ratio, 3)] : []), numbered(m.branch, m.name),
  ]);
  const both = [
    table(`Critical speeds${report.critical_speeds_without_damping ? " of the saw without its damping" : ""}`, ["rpm", "wave", "branch"], speeds),
    table("Bands of instability", ["kind", "from rpm", "to rpm", "growth 1/s", "Hz", "waves", "branches"], bands),
    table(`Modes at rest${overdamped ? `; ${overdamped} others decay without oscillating` : ""}`, ["Hz", ...(damped ? ["ζ"] : []), "mode"], rest),
  ];
  place.replaceChildren(...both);
}
