// Saws that later changes are compared with: their lines in the chart, their numbers in a table, and the chart of the
// last one beside the present one.

import { Charts } from "./charts.js";
import { drawn, node } from "./dom.js";
import { told } from "./outline.js";
import { nameOf } from "./fields.js";
import { clone, differences, get } from "./scene.js";

// Dashes of the lines of pinned saws. There are no more, because the chart would be hard to read.
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3]];
// Largest number of differences in the name of a saw.
const MOST_NAMED = 2;
const KEPT = "sawflutter pins";

export class Pinned {
  // First chart of the page or of another saw that was opened. Numbers are compared with it while no saw is pinned.
  #begun = null;
  // Scene of the first chart of the saw that was opened, from which pinned saws differ.
  #opened = null;
  // Pinned saws, each with its name, its chart and the dashes of its lines. They survive a reload.
  #saws = JSON.parse(sessionStorage.getItem(KEPT) ?? "[]");
  #charts = null;

  // `present` are the charts of the present saw; `onUnpin()` is called after a saw is unpinned.
  constructor(place, list, present, onUnpin) {
    this.place = place;
    this.list = list;
    this.present = present;
    this.onUnpin = onUnpin;
    this.campbell = node("div", { role: "img", className: "campbell" });
    this.growth = node("div", { role: "img", "aria-label": "Growth rates of the pinned saw" });
    this.title = node("h2");
    place.append(this.title, this.campbell, this.growth);
  }

  begin(chart) {
    this.#begun ??= clone(chart);
    this.#opened ??= this.#begun.report.scene;
  }

  // Forgets the first chart when another saw is opened, so that its numbers are not compared with those of the earlier
  // saw. Pinned saws remain.
  reset() {
    if (!this.isNamed) this.#begun = null;
    this.#opened = null;
  }

  pin(chart) {
    const isFree = (dash) => this.#saws.every((saw) => String(saw.dash) !== String(dash));
    const name = this.#nameOf(chart.report.scene);
    const same = this.#saws.filter((saw) => saw.name === name || saw.name.startsWith(`${name} (`)).length;
    this.#saws.push({ name: same > 0 ? `${name} (${same + 1})` : name, chart: clone(chart), dash: DASHES.find(isFree) });
    this.#keep();
  }

  // Returns a name that says in what a saw differs from the one that was opened.
  #nameOf(scene) {
    const paths = differences(this.#opened, scene).filter((path) => !/^(name|notes|accuracy|tolerance)/.test(path));
    const words = paths.slice(0, MOST_NAMED).map((path) => nameOf(path, get(scene, path)));
    if (paths.length > MOST_NAMED) words.push("…");
    return words.join(", ") || scene.name || "as opened";
  }

  #keep() {
    try {
      sessionStorage.setItem(KEPT, JSON.stringify(this.#saws));
    } catch {
      // The storage of the browser is full or switched off: the saws are lost with the page.
    }
  }

  get isFull() {
    return this.#saws.length >= DASHES.length;
  }

  get isNamed() {
    return this.#saws.length > 0;
  }

  // Chart that numbers are compared with.
  get #last() {
    return this.#saws.at(-1)?.chart ?? this.#begun;
  }

  // The numbers of this chart; none before the first chart of another saw.
  get facts() {
    return this.#last?.told.facts ?? [];
  }

  #unpin(saw) {
    this.#saws = this.#saws.filter((other) => other !== saw);
    if (!this.isNamed) this.#begun = saw.chart;
    this.#keep();
    this.onUnpin();
  }

  tell(facts) {
    const hadFocus = this.list.contains(document.activeElement);
    this.list.hidden = !this.isNamed;
    const cells = (all) => all.map(({ value }) => node("td", { textContent: told(value) }));
    const rows = this.#saws.map((saw) => {
      const out = node("button", { type: "button", textContent: "×", title: "Unpin", "aria-label": `Unpin ${saw.name}`, onclick: () => this.#unpin(saw) });
      return node("tr", {}, node("th", { scope: "row" }, out, " ", sample(saw.dash), " ", node("span", { textContent: saw.name })), ...cells(saw.chart.told.facts));
    });
    const heads = ["Saw", ...facts.map(({ name }) => name)].map((textContent) => node("th", { scope: "col", textContent }));
    const now = node("tr", {}, node("th", { scope: "row", textContent: "as it is now" }), ...cells(facts));
    this.list.replaceChildren(node("table", {}, node("thead", {}, node("tr", {}, ...heads)), node("tbody", {}, ...rows, now)));
    if (hadFocus) this.list.querySelector("button")?.focus();
  }

  // Shows the lines of all pinned saws in the present chart or, if `beside`, the last pinned saw beside it.
  showWith(chart, beside) {
    this.place.hidden = !beside;
    this.place.parentElement.classList.toggle("two", beside);
    this.present.shareAxes(beside ? this.#last : null);
    const differs = (saw) => JSON.stringify(saw.chart.report.scene) !== JSON.stringify(chart.report.scene);
    // Side by side, the present chart has the lines of the present saw only.
    this.present.show(chart, beside ? [] : this.#saws.filter(differs));
    if (!beside) return;
    this.#charts ??= new Charts(this.campbell, this.growth, this.present.colours, {
      onHover: () => {},
      onZoom: (speeds) => this.present.zoom(speeds),
    });
    const { name } = this.#saws.at(-1);
    this.title.textContent = name;
    this.campbell.ariaLabel = `Campbell diagram of ${name}`;
    this.#charts.resize();
    this.#charts.shareAxes(chart, this.present.stretch);
    this.#charts.show(this.#last, []);
  }

  zoomed(speeds) {
    this.#charts?.zoomed(speeds);
  }

  // Keeps the axes of all charts, or lets them follow the charts again.
  hold(on) {
    for (const charts of [this.present, this.#charts]) charts?.hold(on);
  }

  setColours(colours) {
    this.#charts?.setColours(colours);
  }
}

function sample(dash) {
  return drawn("svg", { width: 30, height: 8, "aria-hidden": "true" }, drawn("line", { x2: 30, y1: 4, y2: 4, "stroke-dasharray": dash.join(" ") }));
}
