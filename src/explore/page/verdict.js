// What the chart says, in words and tables.

import { node, write } from "./dom.js";
import { numbered, rpm, shown } from "./words.js";

const firstCritical = (report) => report.critical_speeds[0]?.rpm ?? null;

// Rise at which the first critical speed is that of operation, or the blade buckles before.
function toleratedRise({ membrane }) {
  const heat = membrane?.heat;
  if (!heat || heat.past_critical_when_cold) return null;
  return (heat.operating_limit ?? heat.buckling)?.rise_k ?? null;
}

export function verdict(place, report) {
  const { operating, flutter_speed_rpm, flutter_threshold_per_s, instabilities } = report;
  const band = operating && operating.inside_instability !== null ? instabilities[operating.inside_instability] : null;
  const good = operating && operating.within_limit === true && operating.verdict === "stable";
  place.className = operating ? (good ? "good" : "bad") : "";
  const share = operating?.of_lowest_critical;
  const rule = operating && share !== null
    ? `${Math.round(operating.rpm)} rpm is ${(100 * share).toFixed(1)} % of the lowest critical speed: `
      + `${operating.within_limit ? "within" : "beyond"} the ${100 * operating.limit} % rule`
    : "No operating speed to hold against the 85 % rule";
  const inside = band ? `, and inside a ${band.kind} band`
    : operating?.verdict === "outside_sweep" ? ", and outside the sweep"
      : typeof operating?.at_critical_rpm === "number" ? `, and at the critical speed ${rpm(operating.at_critical_rpm)}` : "";
  const flutter = flutter_speed_rpm === null
    ? `No flutter of ${flutter_threshold_per_s} 1/s or more up to ${Math.round(report.campbell.to_rpm)} rpm`
    : `Flutter (${flutter_threshold_per_s} 1/s or more) from ${Math.round(flutter_speed_rpm)} rpm`;
  write(place, `${good ? "✓ " : operating ? "✗ " : ""}${rule}${inside}. ${flutter}.`);
}

// The numbers that a change is judged by, against those of the pinned saw.
export function facts(place, report, pinned) {
  const rows = [
    ["First critical", firstCritical, rpm],
    ["Flutter speed", (r) => r.flutter_speed_rpm, rpm],
    ["First merging", (r) => r.first_merge_rpm, rpm],
    ["Fastest growth", (r) => r.instabilities.reduce((top, band) => Math.max(top, band.peak_growth_per_s), 0), (v) => `${shown(v, 3)} 1/s`],
    ["Of critical", (r) => r.operating?.of_lowest_critical ?? null, (v) => (v === null ? "–" : `${(100 * v).toFixed(1)} %`)],
  ];
  if (report.membrane?.heat) rows.push(["Tolerated rise", toleratedRise, (v) => (v === null ? "–" : `${shown(v, 3)} K`)]);
  place.replaceChildren(...rows.map(([name, value, words]) => {
    const [before, now] = [words(value(pinned)), words(value(report))];
    const changed = before !== now;
    const text = changed ? `${before.replace(/ (rpm|1\/s|%|K)$/, "")} → ${now}` : now;
    return node("div", { className: changed ? "fact changed" : "fact" }, node("dt", { textContent: name }), node("dd", { textContent: text }));
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
