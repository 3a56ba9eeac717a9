// Draws the Campbell diagram and the growth rates as the program describes them: panels by panel.js, items by marks.js.

import { nearest, samePoint, walked } from "./branches.js";
import { hand } from "./hand.js";
import { Painter } from "./marks.js";
import { plot, splitsOf } from "./panel.js";
import { readOut } from "./readout.js";

// Smallest range of speeds that can be magnified, as a share of the sweep.
const LEAST_STRETCH = 1e-3;
// Largest number of rows of band labels, and the height of a row in pixels.
const ROWS = 2;
const ROW_PX = 14;
// Height in pixels above the chart: header, answer, ruler, numbers and tabs.
const ABOVE_PX = 340;

export class Charts {
  // Chart of the present saw, with its figure and its report, as the program sends it.
  #chart = null;
  // Pinned saws whose lines are drawn too, each with its chart and its dashes.
  #others = [];
  // Chart that is shown beside this one on the same axes, or null.
  #other = null;
  width = 600;
  // Highlighted point of the present chart, or null: a branch and the index of one of its speeds.
  pointed = null;
  #zoom = null;
  // Early items of a saw whose chart is still being computed: critical speeds, and bands or null. Null once the chart
  // is shown.
  #ahead = null;
  // Charts whose axes are kept during a drag, or null.
  #held = null;

  constructor(campbellPlace, growthPlace, colours, { onHover, onZoom }) {
    this.colours = colours;
    this.onHover = onHover;
    this.onZoom = onZoom;
    this.measured = true;
    const narrow = () => this.width < 480;
    const room = () => (narrow() ? 20 : this.width < 700 ? 108 : 150);
    this.campbell = plot(campbellPlace, {
      height: 380, label: "Frequency in space [Hz]", room: () => room(), xLabel: null,
      yRange: () => this.#range(0, "y"),
      draw: (u) => this.#drawCampbell(u, narrow()),
    });
    this.growth = plot(growthPlace, {
      height: 170, label: "Re λ [1/s]", splits: (_, __, least, most) => splitsOf(this.#isRooted, least, most), room: () => room(), xLabel: "Rotation speed [rpm]",
      tick: (value) => (this.#isRooted ? value * Math.abs(value) : value), yRange: () => this.#growthRange(),
      draw: (u) => this.#drawGrowth(u),
    });
    this.setColours(colours);
    this.places = [campbellPlace, growthPlace];
    campbellPlace.append(readOut(this.campbell.chart.over, (event) => this.#seen(event)));
    this.#follow(campbellPlace);
    for (const { chart } of [this.campbell, this.growth]) this.#zoomTogether(chart);
    new ResizeObserver(() => this.resize()).observe(campbellPlace);
    // The height of the window does not change that of the place.
    addEventListener("resize", () => this.resize());
    this.resize();
  }

  setColours(colours) {
    this.colours = colours;
    this.campbell.setColours(colours);
    this.growth.setColours(colours);
  }

  resize() {
    const width = this.places[0].clientWidth;
    if (width === 0) return;
    this.width = width;
    // Both panels are in the first screen: together as high as it is below the answer, within limits.
    const isNarrow = matchMedia("(max-width: 1000px)").matches;
    const free = isNarrow ? 0.6 * innerHeight : innerHeight - ABOVE_PX - document.getElementById("welcome").offsetHeight;
    // The height of a phone changes while it scrolls, and that of its charts does not.
    const low = isNarrow ? 170 : Math.round(Math.min(Math.max(0.36 * free, 130), 190));
    this.campbell.chart.setSize({ width, height: width < 480 ? 240 : Math.round(Math.min(Math.max(free - low, 210), 470)) });
    this.growth.chart.setSize({ width, height: low });
  }

  showMeasured(on) {
    this.measured = on;
    this.redraw();
  }

  show(chart, others) {
    this.#chart = chart;
    this.#others = others;
    this.#ahead = null;
    this.pointed &&= samePoint(this.report, this.pointed);
    this.redraw();
  }

  // Moves the lines of the critical speeds, and the bands if they are known, before the chart is complete.
  moveAhead({ critical, bands }) {
    this.#ahead = { critical, bands };
    this.redraw();
  }

  // Returns the items of a panel, early ones if its chart is still being computed.
  #items(number) {
    const { items } = this.#chart.figure.panels[number];
    if (!this.#ahead) return items;
    const { critical, bands } = this.#ahead;
    const isReplaced = ({ item, role }) => role === "critical" || (bands && item === "band");
    return [...(bands ?? []), ...items.filter((item) => !isReplaced(item)), ...critical];
  }

  get items() {
    return this.#items(0);
  }

  get report() {
    return this.#chart?.report ?? null;
  }

  // Keeps the axes during a drag, so that the user sees the lines move and not the axes; or lets them follow the chart
  // again.
  hold(on) {
    this.#held = on && this.#chart ? this.#onAxes : null;
  }

  // Sets the other chart on these axes and the magnified range. The caller shows a chart afterwards, which draws both.
  shareAxes(other, stretch = this.#zoom) {
    this.#other = other;
    this.#zoom = stretch;
  }

  // All charts that the axes are for.
  get #onAxes() {
    return this.#held ?? [this.#chart, this.#other].filter((chart) => chart !== null);
  }

  #panels(number) {
    return this.#onAxes.map(({ figure }) => figure.panels[number]);
  }

  #range(number, side) {
    const ranges = this.#panels(number).map((panel) => panel[side].range);
    return ranges.length > 0 ? [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, most]) => most))] : [0, 1];
  }

  // Whether growth rates have a square-root scale, which the program chooses if one band grows much faster than
  // another.
  get #isRooted() {
    return this.#panels(1).some(({ y }) => y.spread === "signed_root");
  }

  get #rows() {
    return Math.min(this.#panels(1)[0].items.filter(({ item }) => item === "band").length, ROWS);
  }

  // Returns the range of the axis of growth rates, with room for the labels of bands.
  #growthRange() {
    const [least, most] = this.#range(1, "y").map(this.#height);
    const room = this.#chart ? (this.#rows * ROW_PX * devicePixelRatio) / this.growth.chart.bbox.height : 0;
    return [least, least + (most - least) / (1 - Math.min(room, 0.5))];
  }

  // Position of a growth rate on its axis: on a root scale, its signed square root.
  #height = (rate) => (this.#isRooted ? Math.sign(rate) * Math.sqrt(Math.abs(rate)) : rate);

  // First and last speed [rpm] that are shown.
  get speeds() {
    return this.#zoom ?? this.#range(0, "x");
  }

  // Magnified range of speeds [rpm], or null.
  get stretch() {
    return this.#zoom;
  }

  redraw() {
    if (!this.#chart) return;
    for (const part of [this.campbell, this.growth]) part.setRange(this.speeds);
  }

  // Connects both panels: the hand in one magnifies and shifts both, and a double click shows all speeds.
  #zoomTogether(chart) {
    hand(chart.over, {
      magnify: (factor, px) => this.#chart !== null && this.#magnify(factor, chart.posToVal(px, "x")),
      shift: (px) => {
        if (!this.#zoom) return;
        const [[from, to], [from_rpm, to_rpm]] = [this.#zoom, this.#range(0, "x")];
        const wanted = chart.posToVal(0, "x") - chart.posToVal(px, "x");
        const by = Math.min(Math.max(wanted, from_rpm - from), to_rpm - to);
        this.zoom([from + by, to + by]);
      },
      tap: ({ offsetX, offsetY }) => chart === this.campbell.chart && this.report && this.point(nearest(this.report, chart, [offsetX, offsetY])),
    });
    chart.over.addEventListener("dblclick", () => this.zoom(null));
  }

  // Shows a range of speeds, limited to the sweep, or all speeds if it is null. A range that is too small is ignored.
  // Returns whether the range has changed.
  zoom(speeds) {
    const [from_rpm, to_rpm] = this.#range(0, "x");
    const ends = speeds && [Math.max(speeds[0], from_rpm), Math.min(speeds[1], to_rpm)];
    const wanted = ends && (ends[0] > from_rpm || ends[1] < to_rpm) ? ends : null;
    const least = LEAST_STRETCH * (to_rpm - from_rpm);
    if ((wanted && wanted[1] - wanted[0] < least) || String(wanted) === String(this.#zoom)) return false;
    this.zoomed(wanted);
    this.onZoom(this.#zoom);
    return true;
  }

  // Applies the range that the user chose in the other chart, without a call of `onZoom`.
  zoomed(speeds) {
    this.#zoom = speeds;
    this.redraw();
  }

  // Scales the shown range about a speed: by default about the highlighted point, or the middle if there is none.
  #magnify(factor, about = this.#looked) {
    const [from, to] = this.speeds;
    return this.zoom([about + factor * (from - about), about + factor * (to - about)]);
  }

  get #looked() {
    const [from, to] = this.speeds;
    return this.pointed && this.#isShown(this.pointed) ? this.pointed.branch.rpm[this.pointed.i] : 0.5 * (from + to);
  }

  #isShown({ branch, i }) {
    const { x, y } = this.campbell.chart.scales;
    const [rpm, hz] = [branch.rpm[i], branch.frequency_hz[i]];
    return x.min <= rpm && rpm <= x.max && y.min <= hz && hz <= y.max;
  }

  // Moves the highlighted point along its branch or to another one, within the picture.
  #walk(step) {
    const { width, height } = this.campbell.chart.over.getBoundingClientRect();
    const from = this.pointed && this.#isShown(this.pointed) ? this.pointed : null;
    const to = from ? walked(this.report, from, step) : nearest(this.report, this.campbell.chart, [width / 2, height / 2], Infinity);
    if (this.#isShown(to)) this.point(to);
  }

  #painter(u, height = (/** @type {number} */ value) => value) {
    const [x, y] = [(value) => u.valToPos(value, "x", true), (value) => u.valToPos(height(value), "y", true)];
    return new Painter(u.ctx, { x, y, box: u.bbox, scale: devicePixelRatio, colours: this.colours });
  }

  get #alarms() {
    return this.#chart.told.verdict.answer === "no";
  }

  #drawCampbell(u, narrow) {
    if (!this.#chart) return;
    const [painter, items] = [this.#painter(u), this.#items(0)];
    painter.within(() => {
      painter.bands(items);
      painter.uprights(items, this.#alarms);
      for (const { chart, dash } of this.#others) {
        const lowest = chart.report.critical_speeds[0];
        if (lowest) painter.upright(lowest.rpm, this.colours.standing, 1, dash.length > 0 ? dash : [1, 3]);
        painter.lines(chart.figure.panels[0].items, { ghost: dash });
      }
      painter.lines(items, { highlighted: this.pointed?.branch.branch });
      const source = this.measured ? null : this.report.scene.measured?.source;
      painter.points(items.filter(({ name }) => name !== source));
      if (this.pointed) painter.ring(this.pointed.branch.rpm[this.pointed.i], this.pointed.branch.frequency_hz[this.pointed.i], 6);
    });
    painter.labelUprights(items);
    if (!narrow && !this.#zoom) painter.labelEnds(items);
  }

  #drawGrowth(u) {
    if (!this.#chart) return;
    const [painter, items, { note }] = [this.#painter(u, this.#height), this.#items(1), this.#chart.figure.panels[1]];
    painter.within(() => {
      painter.bands(items);
      painter.uprights(items, this.#alarms);
      painter.lines(items);
      painter.points(items);
    });
    painter.labelBands(items, this.#rows, ROW_PX);
    if (note) painter.note(note);
  }

  // Returns the diagram as it is read out under the pointer.
  #seen({ offsetX, offsetY }) {
    const { chart } = this.campbell;
    const axis = (side) => ({ at: (value) => chart.valToPos(value, side), of: (pixel) => chart.posToVal(pixel, side) });
    return this.#chart && { panel: { ...this.#chart.figure.panels[0], items: this.items }, axes: { x: axis("x"), y: axis("y") }, pixels: [offsetX, offsetY] };
  }

  // Highlights the branch nearest to the pointer, or the one that is chosen with the arrow keys.
  #follow(element) {
    const over = this.campbell.chart.over;
    over.addEventListener("pointermove", (event) => {
      if (event.buttons === 0 && event.pointerType !== "touch") this.point(this.report && nearest(this.report, this.campbell.chart, [event.offsetX, event.offsetY]));
    });
    over.addEventListener("pointerleave", ({ pointerType }) => {
      // A finger leaves the mode that it has tapped.
      if (pointerType !== "touch") this.point(null);
    });
    element.addEventListener("blur", () => this.point(null));
    element.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (event.key === "Escape") this.point(null);
      const factor = { "+": 0.5, "=": 0.5, "-": 2, 0: Infinity }[event.key];
      if (factor && this.report && !event.ctrlKey && !event.metaKey) {
        event.preventDefault();
        if (factor === Infinity) this.zoom(null);
        else this.#magnify(factor);
      }
      if (!step || !this.report) return;
      event.preventDefault();
      this.#walk(step);
    });
  }

  point(found) {
    if (found?.branch === this.pointed?.branch && found?.i === this.pointed?.i) return;
    this.pointed = found;
    this.campbell.chart.redraw(false, false);
    this.onHover(found);
  }
}
