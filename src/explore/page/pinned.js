// The saw that later changes are held against, and its chart beside the present one.

import { Charts } from "./charts.js";
import { node } from "./dom.js";
import { clone } from "./scene.js";

export class Pinned {
  // Before anything was pinned by hand, numbers are held against the saw that the page began with.
  #chart = null;
  name = "";
  #charts = null;

  // `present` are the charts of the saw as it is.
  constructor(place, present) {
    this.place = place;
    this.present = present;
    this.campbell = node("div", { role: "img", className: "campbell" });
    this.growth = node("div", { role: "img", ariaLabel: "Growth rates of the pinned saw" });
    this.title = node("h2");
    place.append(this.title, this.campbell, this.growth);
  }

  begin(chart) {
    this.#chart ??= clone(chart);
  }

  // Another saw is held against itself, where none was pinned by hand.
  reset() {
    if (!this.isNamed) this.#chart = null;
  }

  pin(chart, name) {
    this.#chart = clone(chart);
    this.name = name;
  }

  // The numbers that changes are held against.
  get facts() {
    return this.#chart.told.facts;
  }

  get isNamed() {
    return this.name !== "";
  }

  #differs(report) {
    return JSON.stringify(this.#chart.report.scene) !== JSON.stringify(report.scene);
  }

  // Both saws on the same axes, or the present one alone.
  showWith(chart, beside) {
    this.place.hidden = !beside;
    this.place.parentElement.classList.toggle("two", beside);
    this.present.shareAxes(beside ? this.#chart : null);
    // Side by side nothing lies over each other.
    this.present.show(chart, !beside && this.isNamed && this.#differs(chart.report) ? this.#chart : null);
    if (!beside) return;
    this.#charts ??= new Charts(this.campbell, this.growth, this.present.colours, {
      onHover: () => {},
      onZoom: (speeds) => this.present.zoom(speeds),
    });
    this.title.textContent = this.name;
    this.campbell.ariaLabel = `Campbell diagram of ${this.name}`;
    this.#charts.resize();
    this.#charts.shareAxes(chart, this.present.stretch);
    this.#charts.show(this.#chart, null);
  }

  zoomed(speeds) {
    this.#charts?.zoomed(speeds);
  }

  setColours(colours) {
    this.#charts?.setColours(colours);
  }
}
