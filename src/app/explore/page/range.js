// Range of a slider: the part of the usual range around the first value of the field. If a value outside is typed, the
// slider is at its end, and its range does not change.

export class Range {
  static NOTCHES = 400;

  // `field` is the entry of the table of numbers, with kind and usual range. If the scene has no value, the geometric mean of
  // the usual range takes its place, or zero if the range is not positive.
  constructor(field, known, scene) {
    const [least, most] = field.usual;
    const middle = least > 0 ? Math.sqrt(least * most) : 0;
    const value = known ?? middle;
    // A slider over several decades is logarithmic.
    this.log = value > 0 && least > 0 && most / least > 3000;
    const [from, to] = this.#around(field, value, scene);
    this.from = Math.max(from, this.log ? Math.log(least) : least);
    this.to = Math.min(to, this.log ? Math.log(most) : most);
    if (!(this.from < this.to)) [this.from, this.to] = [from, to];
  }

  #around({ kind, usual: [least, most], metric }, value, scene) {
    if (this.log) return [Math.log(value) - Math.log(100), Math.log(value) + Math.log(100)];
    // Half a turn either way.
    if (kind === "angle") return [0.5 * least, 0.5 * most];
    if (kind.endsWith("radius")) return [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
    const speeds = [value, scene.operating_rpm ?? 0, scene.sweep?.to_rpm ?? 0];
    if (metric.unit === "rpm" && Math.max(...speeds) > 0) return [0, 2 * Math.max(...speeds)];
    if (value > 0) return [0.25 * value, 2 * value];
    if (value < 0) return [2 * value, -2 * value];
    return [0, least > 0 ? Math.sqrt(least * most) : most];
  }

  value(notch) {
    const at = this.from + (notch / Range.NOTCHES) * (this.to - this.from);
    return this.log ? Math.exp(at) : at;
  }

  notch(value) {
    const at = this.log ? Math.log(Math.max(value, Number.MIN_VALUE)) : value;
    const share = (at - this.from) / (this.to - this.from || 1);
    return Math.round(Math.min(Math.max(share, 0), 1) * Range.NOTCHES);
  }
}
