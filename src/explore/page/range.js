// Range of a slider: the part of the usual range around the first value of the field. If a value outside is typed, the
// slider is at its end, and its range does not change.

export class Range {
  // Number of steps of a slider.
  static NOTCHES = 400;

  // `usual` is the range of the values of all saws. If the scene has no value, the geometric mean of `usual` takes its
  // place, or zero if `usual` is unknown or not positive.
  constructor(key, known, usual, scene) {
    const [least, most] = usual ?? [-Infinity, Infinity];
    const value = known ?? (least > 0 ? Math.sqrt(least * most) : 0);
    // A slider over several decades is logarithmic.
    this.log = value > 0 && least > 0 && most / least > 3000;
    const [from, to] = this.#around(key, value, scene);
    this.from = Math.max(from, this.log ? Math.log(least) : least);
    this.to = Math.min(to, this.log ? Math.log(most) : most);
    if (!(this.from < this.to)) [this.from, this.to] = [from, to];
  }

  #around(key, value, scene) {
    if (this.log) return [Math.log(value) - Math.log(100), Math.log(value) + Math.log(100)];
    if (key === "poisson_ratio") return [0, 0.49];
    if (key.endsWith("angle_deg")) return [-180, 180];
    if (key === "radius_m") return [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
    if (key.endsWith("rpm")) return [0, Math.max(2 * value, 4000)];
    if (value > 0) return [0.25 * value, 2 * value];
    if (value < 0) return [2 * value, -2 * value];
    return [0, key.endsWith("_m") ? 0.5 : key.endsWith("_s") ? 0.01 : key.endsWith("_per_m") ? 1000 : 10];
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
