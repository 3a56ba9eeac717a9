// Draws a chart of the program on a canvas, in the units of the form and in the colours of the page.

import { node } from "./dom.js";
import { formUnit } from "./fields.js";
import { Painter } from "./marks.js";
import { splitsOf } from "./panel.js";
import { readOut } from "./readout.js";
import { shown } from "./words.js";

const HEIGHT = 300;
const EDGE = { left: 60, right: 14, top: 20, bottom: 40 };
const LINE = 14;
// Room beside a panel for the names of curves and for the scale of its colours.
const NAMES = 120;
const SCALE = 74;
const LEAST_WIDTH = 520;
// Positions of values on an axis, and the values at positions.
const SPREADS = { linear: (v) => v, signed_root: (v) => Math.sign(v) * Math.sqrt(Math.abs(v)), logarithmic: (v) => Math.log10(Math.max(v, Number.MIN_VALUE)) };
const VALUES = { linear: (p) => p, signed_root: (p) => p * Math.abs(p), logarithmic: (p) => 10 ** p };

const known = (values) => values.filter((value) => value !== null);
const ends = (values) => [Math.min(...values), Math.max(...values)];

// Returns the first and the last value of an axis, which follow from its contents if the axis has none.
function rangeOf(panel, side) {
  if (panel[side].range) return panel[side].range;
  const lists = { x: ["x", "edges"], y: ["y", "low", "high", "heights"] }[side];
  const values = known(panel.items.flatMap((item) => lists.flatMap((list) => [item[list] ?? []].flat())));
  const [least, most] = values.length > 0 ? ends(values) : [0, 1];
  const room = 0.04 * (most - least || Math.abs(most) || 1);
  return [least - room, most + room];
}

// Returns the values with a tick, which are round in the unit of the form.
function ticksOf(spread, [least, most], scale) {
  if (spread === "logarithmic") {
    const decades = Array.from({ length: 12 }, (_, k) => 10 ** (Math.floor(Math.log10(least * scale)) + k));
    const round = most / least > 300 ? [1] : [1, 2, 5];
    return decades.flatMap((ten) => round.map((digit) => (digit * ten) / scale)).filter((tick) => least <= tick && tick <= most);
  }
  const [from, to] = [least, most].map((value) => SPREADS[spread](value * scale));
  const isRooted = spread === "signed_root";
  return splitsOf(isRooted, from, to).map((at) => (isRooted ? at * Math.abs(at) : at) / scale);
}

class Axis {
  constructor(panel, side, places) {
    const { name, unit, spread, ticks, names } = panel[side];
    const own = formUnit(unit);
    this.range = rangeOf(panel, side);
    this.spread = spread;
    this.places = names.length > 0 && side === "y" ? places.toReversed() : places;
    this.ticks = names.length > 0 ? ticks.map((value, k) => [value, names[k]])
      : (ticks.length > 0 ? ticks : ticksOf(spread, this.range, own.scale)).map((value) => [value, shown(value * own.scale, 4).replace("-", "−")]);
    this.title = own.unit ? `${name} [${own.unit}]` : name;
  }

  at = (value) => {
    const [[from, to], [first, last]] = [this.range.map(SPREADS[this.spread]), this.places];
    return first + ((SPREADS[this.spread](value) - from) / (to - from || 1)) * (last - first);
  };

  of(place) {
    const [[from, to], [first, last]] = [this.range.map(SPREADS[this.spread]), this.places];
    return VALUES[this.spread](from + ((place - first) / (last - first)) * (to - from));
  }
}

export class Figure {
  // The panels with their places and their axes, in pixels of the page.
  #panels = [];
  // Shares of the axes of the first panel at which it has a cross-hair; empty for none.
  #marked = [];

  // `colours()` returns the colours of the page. `onClick([x, y])` receives the shares of the axes of a panel at which it was
  // clicked; null if nothing happens then.
  constructor(chart, name, colours, onClick = null) {
    this.chart = chart;
    this.colours = colours;
    this.canvas = node("canvas", { role: "img", "aria-label": `${name}; the words have its numbers` });
    this.key = node("p", { className: "key" });
    const remark = node("p", { className: "remark", textContent: [chart.title, ...chart.facts].filter(Boolean).join(" · ") });
    const at = readOut(this.canvas, (event) => this.#seen(event));
    this.place = node("div", {}, remark, node("div", { className: "chart" }, this.canvas, at), this.key);
    if (onClick) {
      this.canvas.style.cursor = "pointer";
      this.canvas.addEventListener("click", (event) => {
        const { box, pixels: [x, y] } = this.#seen(event) ?? {};
        if (box) onClick([(x - box.left) / box.width, (box.top + box.height - y) / box.height]);
      });
    }
    new ResizeObserver(() => this.draw()).observe(this.place);
  }

  draw(marked = this.#marked) {
    this.#marked = marked;
    const width = this.place.clientWidth;
    if (width === 0) return;
    const { panels } = this.chart;
    const columns = width < LEAST_WIDTH ? 1 : Math.min(this.chart.columns, panels.length);
    const rows = Array.from({ length: Math.ceil(panels.length / columns) }, (_, row) => panels.slice(row * columns, (row + 1) * columns));
    const cell = width / columns;
    let top = 0;
    const boxes = rows.flatMap((row) => {
      const own = row.map((panel, column) => this.#box(panel, column * cell, top, cell));
      top = Math.max(...own.map((box) => box.top + box.height)) + EDGE.bottom;
      return own;
    });
    this.#size(width, top);
    this.#panels = panels.map((panel, k) => this.#panel(panel, boxes[k]));
    const colours = this.colours();
    this.key.replaceChildren(...this.chart.key.map(({ name, colour }) => {
      const sample = node("span", { className: "sample", textContent: name });
      sample.style.setProperty("--sample", colours[colour] ?? "");
      return sample;
    }));
  }

  #size(width, height) {
    Object.assign(this.canvas, { width: Math.round(width * devicePixelRatio), height: Math.round(height * devicePixelRatio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
  }

  // Place of a panel in pixels of the page.
  #box(panel, left, top, cell) {
    const beside = panel.items.some(({ colours }) => colours?.length > 1) ? SCALE : cell > LEAST_WIDTH && panel.items.some(({ end }) => end) ? NAMES : 0;
    const width = cell - EDGE.left - EDGE.right - beside;
    const above = EDGE.top + LINE * (Number(panel.title !== "") + panel.facts.length);
    const [x, y] = ["x", "y"].map((side) => rangeOf(panel, side));
    const height = panel.equal ? (width * (y[1] - y[0])) / (x[1] - x[0]) : HEIGHT * Math.min(panel.share, 1);
    return { left: left + EDGE.left, top: top + above, width, height: Math.min(height, 2 * HEIGHT) };
  }

  // Draws a panel at a place, and returns it with its axes.
  #panel(panel, box) {
    const [scale, colours, context] = [devicePixelRatio, this.colours(), this.canvas.getContext("2d")];
    const { left, top, width, height } = box;
    /** @type {any} */
    const axes = { x: new Axis(panel, "x", [left, left + width]), y: new Axis(panel, "y", [top + height, top]) };
    const { x, y } = axes;
    const pixels = (axis) => (value) => axis.at(value) * scale;
    const painter = new Painter(context, {
      x: pixels(x), y: pixels(y), box: { left: left * scale, top: top * scale, width: width * scale, height: height * scale }, scale, colours,
    });
    painter.axes(x, y, panel.y.name !== "");
    painter.within(() => {
      painter.bands(panel.items);
      painter.cells(panel.items, x.range, y.range);
      painter.areas(panel.items);
      painter.lines(panel.items);
      painter.uprights(panel.items, false);
      painter.points(panel.items);
      if (this.#marked.length > 0 && panel === this.chart.panels[0]) painter.cross(this.#marked);
    });
    painter.labelUprights(panel.items);
    painter.labelEnds(panel.items);
    painter.texts(panel.items);
    const heat = panel.items.find((item) => item.colours?.length > 1);
    if (heat) painter.scaleOf(heat, formUnit(heat.unit));
    [panel.title, ...panel.facts].filter(Boolean).forEach((line, k) => painter.heading(line, (top - EDGE.top + 2 - (panel.facts.length - k) * LINE) * scale));
    if (panel.note) painter.note(panel.note);
    return { panel, box, axes };
  }

  // Returns the panel under the pointer, or null.
  #seen({ offsetX, offsetY }) {
    const isIn = ({ box: { left, top, width, height } }) => left <= offsetX && offsetX <= left + width && top <= offsetY && offsetY <= top + height;
    const found = this.#panels.find(isIn);
    return found ? { ...found, pixels: [offsetX, offsetY] } : null;
  }
}
