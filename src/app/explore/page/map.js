// The map that is shown: the numbers along its axes, each with its range.

import { clone, get, sawOf, set } from "./scene.js";

export class SawMap {
  #axes;

  constructor({ x, y, to_rpm }) {
    this.#axes = [x, y ?? { path: "operating_rpm", values: [0, to_rpm] }].map(({ path, values }) => {
      const [of, back] = values[0] > 0 && values.at(-1) >= 10 * values[0] ? [Math.log, Math.exp] : [Number, Number];
      const [least, most] = [values[0], values.at(-1)].map(of);
      return { path, at: (share) => back(least + share * (most - least)), share: (value) => (of(value) - least) / (most - least) };
    });
  }

  // Returns the place of a saw as shares of the axes.
  placeOf(scene) {
    return this.#axes.map(({ path, share }) => share(get(scene, path)));
  }

  // Sets the numbers of a scene to those at a place.
  take(scene, place) {
    this.#axes.forEach(({ path, at }, k) => set(scene, path, Number(at(place[k]).toPrecision(4))));
  }

  // Returns the saw without the numbers along the axes, because the map has all of their values.
  keyOf(scene) {
    const made = clone(scene);
    for (const { path } of this.#axes) set(made, path, 0);
    return sawOf(made);
  }
}
