// The Campbell diagram and the growth rates: panels by panel.js, marks by marks.js.

import { nearest, samePoint, walked } from "./branches.js";
import { drawGrowth } from "./growth.js";
import {
  bandColour, drawBands, drawBranches, drawMeasured, highestShown, labelEnds, verticalLine,
} from "./marks.js";
import { plot, roundGrowth } from "./panel.js";

// No shorter stretch of the sweep is shown.
const LEAST_STRETCH = 1e-3;

export class Charts {
  report = null;
  // Whether its saw can run at its speed, in the program's word.
  #answer = null;
  pinned = null;
  // Another report that is shown beside this one, on the same axes.
  #other = null;
  width = 600;
  // The point that is looked at, on the chart as it is now: a branch and the number of a speed.
  pointed = null;
  #zoom = null;

  constructor(campbellPlace, growthPlace, colours, { onHover, onZoom }) {
    this.colours = colours;
    this.onHover = onHover;
    this.onZoom = onZoom;
    this.measured = true;
    const narrow = () => this.width < 480;
    const room = () => (narrow() ? 20 : this.width < 700 ? 108 : 150);
    this.campbell = plot(campbellPlace, {
      height: 380, label: "Frequency in space [Hz]", room: () => room(), xLabel: null,
      yRange: () => [0, Math.max(...this.#shown.map(highestShown), 0) || 1],
      draw: (u) => this.#drawCampbell(u, narrow()),
    });
    this.growth = plot(growthPlace, {
      height: 170, label: "Re λ [1/s]", splits: roundGrowth, room: () => room(), xLabel: "Rotation speed [rpm]",
      yRange: () => this.#growthRange(),
      draw: (u) => this.#drawGrowth(u),
    });
    this.setColours(colours);
    this.places = [campbellPlace, growthPlace];
    this.#follow(campbellPlace);
    for (const { chart } of [this.campbell, this.growth]) this.#zoomTogether(chart);
    new ResizeObserver(() => this.resize()).observe(campbellPlace);
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
    const tall = Math.round(Math.min(Math.max(innerHeight * 0.46, 260), 470));
    this.campbell.chart.setSize({ width, height: width < 480 ? 270 : tall });
    this.growth.chart.setSize({ width, height: 165 });
  }

  // Shows or hides the measured points.
  showMeasured(on) {
    this.measured = on;
    this.redraw();
  }

  show(report, answer, pinned) {
    this.report = report;
    this.#answer = answer;
    this.pinned = pinned;
    this.pointed &&= samePoint(report, this.pointed);
    this.redraw();
  }

  // Drawn with the next report.
  shareAxes(other, stretch = this.#zoom) {
    this.#other = other;
    this.#zoom = stretch;
  }

  // Reports that the axes have room for.
  get #shown() {
    return [this.report, this.#other].filter((report) => report !== null);
  }

  // From the first to the last speed that is swept.
  get #sweep() {
    const sweeps = this.#shown.map(({ campbell }) => campbell);
    return [Math.min(...sweeps.map((s) => s.from_rpm)), Math.max(...sweeps.map((s) => s.to_rpm))];
  }

  // The speeds that are shown.
  get speeds() {
    return this.#zoom ?? this.#sweep;
  }

  // The stretch that is magnified, if one is.
  get stretch() {
    return this.#zoom;
  }

  redraw() {
    if (!this.report) return;
    for (const part of [this.campbell, this.growth]) part.setRange(this.speeds);
  }

  // Both panels show the same speeds: a stretch dragged out in one, all of them on a double click.
  #zoomTogether(chart) {
    const over = chart.over;
    let from = null;
    over.addEventListener("mousedown", (event) => (from = event.offsetX));
    over.addEventListener("mouseup", (event) => {
      const ends = [from, event.offsetX].map((px) => chart.posToVal(px, "x")).sort((x, y) => x - y);
      if (from !== null && Math.abs(event.offsetX - from) > 8) {
        this.zoom(ends);
      }
      from = null;
      chart.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    });
    over.addEventListener("dblclick", () => this.zoom(null));
  }

  // Shows a stretch of speeds within the sweep, or all of them.
  zoom(speeds) {
    const [from_rpm, to_rpm] = this.#sweep;
    const ends = speeds && [Math.max(speeds[0], from_rpm), Math.min(speeds[1], to_rpm)];
    const least = LEAST_STRETCH * (to_rpm - from_rpm);
    if (ends && ends[1] - ends[0] < least) return;
    this.zoomed(ends && (ends[0] > from_rpm || ends[1] < to_rpm) ? ends : null);
    this.onZoom(this.#zoom);
  }

  // The same where the other chart was zoomed.
  zoomed(speeds) {
    this.#zoom = speeds;
    this.redraw();
  }

  // Closer or farther about the point that is looked at, or the middle.
  #magnify(factor) {
    const [from, to] = this.speeds;
    const looked = this.pointed?.branch.rpm[this.pointed.i];
    const about = looked >= from && looked <= to ? looked : 0.5 * (from + to);
    this.zoom([about + factor * (from - about), about + factor * (to - about)]);
  }

  // How far the growth axis goes, on a root scale: divergence grows thirty times as fast as
  // the flutter beside it.
  #growthRange() {
    if (!this.report) return [0, 1];
    const damped = this.#shown.some(({ terms }) => terms.some((term) => term.includes("damping")));
    const peaks = this.#shown.flatMap(({ instabilities }) => instabilities.map((band) => band.peak_growth_per_s));
    const all = this.#shown.flatMap(({ campbell }) => campbell.branches.flatMap((b) => b.growth_per_s));
    const most = [...peaks, ...all].reduce((x, y) => Math.max(x, y), 1);
    const least = damped ? all.reduce((x, y) => Math.min(x, y), 0) : 0;
    return [Math.max(rooted(least), -rooted(most)), 1.08 * rooted(most)];
  }

  #drawCampbell(u, narrow) {
    if (!this.report) return;
    const { ctx, bbox: box } = u;
    const scale = devicePixelRatio;
    const x = (value) => u.valToPos(value, "x", true);
    const place = (rpm, hz) => [x(rpm), u.valToPos(hz, "y", true)];
    ctx.save();
    ctx.beginPath();
    ctx.rect(box.left, box.top, box.width, box.height);
    ctx.clip();
    drawBands(ctx, x, box, this.report, this.colours, scale);
    this.#drawSpeeds(ctx, x, box, scale);
    const top = u.scales.y.max;
    if (this.pinned) drawBranches(ctx, place, this.pinned, this.colours, { scale, top, ghost: true });
    drawBranches(ctx, place, this.report, this.colours, { scale, top, highlighted: this.pointed?.branch });
    if (this.measured && this.report.scene.measured) drawMeasured(ctx, place, this.report.scene.measured, this.colours, scale);
    this.#drawExcitation(ctx, place, scale);
    this.#dotCritical(ctx, place, scale);
    this.#drawSpot(ctx, place, scale);
    ctx.restore();
    if (!narrow && !this.#zoom) labelEnds(ctx, place, box, this.report, this.colours, scale);
  }

  #drawSpeeds(ctx, x, box, scale) {
    const { critical_speeds, operating } = this.report;
    for (const { rpm } of critical_speeds) verticalLine(ctx, x(rpm), box, this.colours.quiet, 0.8 * scale);
    if (this.pinned?.critical_speeds.length) {
      verticalLine(ctx, x(this.pinned.critical_speeds[0].rpm), box, this.colours.standing, scale, [1, 3]);
    }
    if (operating) {
      const colour = ["flutter", "divergence"].includes(this.#answer) ? this.colours.alarm : this.colours.ink;
      verticalLine(ctx, x(operating.rpm), box, colour, 1.6 * scale, []);
    }
  }

  // Lines at multiples of the speed, and rings where they cross branches.
  #drawExcitation(ctx, place, scale) {
    const { excitation, campbell } = this.report;
    if (!excitation) return;
    ctx.strokeStyle = this.colours.quiet;
    ctx.lineWidth = scale;
    for (const { order } of excitation.lines) {
      ctx.setLineDash([4 * scale, 4 * scale]);
      ctx.beginPath();
      ctx.moveTo(...place(campbell.from_rpm, (order * campbell.from_rpm) / 60));
      ctx.lineTo(...place(campbell.to_rpm, (order * campbell.to_rpm) / 60));
      ctx.stroke();
    }
    ctx.setLineDash([]);
    for (const { rpm, frequency_hz } of excitation.crossings) {
      ctx.beginPath();
      ctx.arc(...place(rpm, frequency_hz), 3 * scale, 0, 2 * Math.PI);
      ctx.stroke();
    }
  }

  #dotCritical(ctx, place, scale) {
    ctx.fillStyle = this.colours.ink;
    for (const { rpm } of this.report.critical_speeds) {
      const [x, y] = place(rpm, 0);
      ctx.beginPath();
      ctx.arc(x, y, 3.5 * scale, 0, 2 * Math.PI);
      ctx.fill();
    }
  }

  #drawSpot(ctx, place, scale) {
    if (!this.pointed) return;
    const { branch, i } = this.pointed;
    const [x, y] = place(branch.rpm[i], branch.frequency_hz[i]);
    ctx.strokeStyle = this.colours.ink;
    ctx.lineWidth = 2 * scale;
    ctx.beginPath();
    ctx.arc(x, y, 6 * scale, 0, 2 * Math.PI);
    ctx.stroke();
  }

  #drawGrowth(u) {
    if (!this.report) return;
    const { ctx, bbox: box } = u;
    const scale = devicePixelRatio;
    const x = (value) => u.valToPos(value, "x", true);
    const y = (value) => u.valToPos(rooted(value), "y", true);
    ctx.save();
    ctx.beginPath();
    ctx.rect(box.left, box.top, box.width, box.height);
    ctx.clip();
    drawBands(ctx, x, box, this.report, this.colours, scale);
    this.#drawSpeeds(ctx, x, box, scale);
    drawGrowth(ctx, x, y, this.report, this.colours, scale);
    for (const band of this.report.instabilities) {
      ctx.fillStyle = bandColour(this.colours, band.kind);
      ctx.beginPath();
      ctx.arc(x(band.peak_rpm), y(band.peak_growth_per_s), 2.75 * scale, 0, 2 * Math.PI);
      ctx.fill();
    }
    ctx.restore();
    if (this.report.instabilities.length === 0) {
      const words = "Stable at every speed of the sweep";
      const [left, middle] = [box.left + 10 * scale, box.top + box.height / 2];
      ctx.font = `${12 * scale}px Inter, sans-serif`;
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      ctx.fillStyle = this.colours.paper;
      ctx.fillRect(left - 4 * scale, middle - 9 * scale, ctx.measureText(words).width + 8 * scale, 18 * scale);
      ctx.fillStyle = this.colours.quiet;
      ctx.fillText(words, left, middle);
    }
  }

  // The branch next to the pointer, or the one that the arrow keys have come to.
  #follow(element) {
    const over = this.campbell.chart.over;
    over.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) this.#point(this.report && nearest(this.report, this.campbell.chart, [event.offsetX, event.offsetY]));
    });
    over.addEventListener("pointerleave", () => this.#point(null));
    element.addEventListener("blur", () => this.#point(null));
    element.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (event.key === "Escape") this.#point(null);
      const factor = { "+": 0.5, "=": 0.5, "-": 2, 0: Infinity }[event.key];
      if (factor && this.report && !event.ctrlKey && !event.metaKey) {
        event.preventDefault();
        if (factor === Infinity) this.zoom(null);
        else this.#magnify(factor);
      }
      if (!step || !this.report) return;
      event.preventDefault();
      this.#point(walked(this.report, this.pointed, step));
    });
  }

  #point(found) {
    if (found?.branch === this.pointed?.branch && found?.i === this.pointed?.i) return;
    this.pointed = found;
    this.campbell.chart.redraw(false, false);
    this.onHover(found);
  }
}

function rooted(value) {
  return Math.sign(value) * Math.sqrt(Math.abs(value));
}
