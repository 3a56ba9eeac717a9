// Shows the mode at the highlighted point as a text and as an animation on the blade, and saves it as a video.

import { download, node, write } from "./dom.js";
import { Motion } from "./motion.js";
import { reachOf } from "./shapes.js";
import { mode } from "./talk.js";
import { krein, numbered, shown } from "./words.js";

const MEANING = {
  forward: "It runs with the rotation, ahead of the dot.",
  backward: "It runs against the rotation.",
  reflected: "It is carried along in space but falls behind the dot: on the blade it runs backward.",
  standing: "It does not travel.",
};
const NEGLIGIBLE_PER_S = 1e-3;

export class Pointed {
  #asked = null;
  // Mode that was shown last.
  #filmed = null;

  // `colours()` returns the present colours of the page, `scene()` the present scene.
  constructor({ canvas, words, film, mark, colours, scene, nameOf }) {
    this.words = words;
    this.film = film;
    this.scene = scene;
    this.nameOf = nameOf;
    const numbers = (text) => text.match(/\d+/g).map(Number);
    this.motion = new Motion(canvas, mark, () => {
      const { backward, forward, ink, dark } = colours();
      return { up: numbers(backward), down: numbers(forward), ink: numbers(ink), rest: dark ? [62, 68, 78] : [232, 234, 238], pad: dark ? [76, 194, 204] : [13, 118, 128] };
    });
    film.addEventListener("click", () => this.#save());
  }

  // Whether a mode is shown or requested.
  get isOn() {
    return this.#asked !== null;
  }

  // Shows the mode at `point`, a branch and the index of one of its speeds in the chart, or hides it if there is no
  // point.
  async show(chart, point) {
    this.#asked?.abort();
    this.#asked = null;
    if (!point) return this.#hide();
    const { branch, i } = point;
    this.#asked = new AbortController();
    try {
      const shape = await mode(chart, branch.rpm[i], branch.frequency_hz[i], this.#asked.signal);
      const slower = this.motion.show(shape, this.scene(), reachOf(this.scene()));
      document.body.classList.add("moving");
      this.#filmed = shape;
      this.film.disabled = this.motion.still || !globalThis.MediaRecorder;
      this.#tell(branch, shape, slower);
    } catch (error) {
      if (error.name !== "AbortError") this.words.textContent = error.message;
    }
    return undefined;
  }

  #hide() {
    this.motion.hide();
    document.body.classList.remove("moving");
    this.hint();
  }

  // Explains, while no mode is shown, how to show one and what can be dragged.
  hint() {
    if (this.isOn) return;
    const { guides, cut } = this.scene();
    const parts = [guides?.length && "the pads", cut && "the cut", "the probe"].filter(Boolean);
    const drag = [parts.slice(0, -1).join(", "), parts.at(-1)].filter(Boolean).join(" and ");
    write(this.words, `Point at a branch of the diagram to see its mode move here. Drag ${drag}.`);
  }

  #tell(branch, shape, slower) {
    const rate = shape.growth_per_s;
    const growth = Math.abs(rate) > NEGLIGIBLE_PER_S ? `, ${rate > 0 ? "grows" : "decays"} at ${shown(Math.abs(rate), 3)} 1/s` : "";
    const name = node("strong", { textContent: numbered(branch.branch, branch.name), className: shape.direction });
    this.words.replaceChildren(name, ` at ${Math.round(shape.rpm)} rpm: ${shown(shape.frequency_hz, 4)} Hz in space, `
      + `${shown(shape.body_frequency_hz, 4)} Hz on the blade, shape there ${shape.name}, Krein sign ${krein(shape.krein_sign)}${growth}. `
      + `${MEANING[shape.direction]} Shown ${shown(slower, 2)} times slower; the dot turns with the blade.`);
  }

  async #save() {
    this.film.disabled = true;
    this.motion.show(this.#filmed, this.scene(), reachOf(this.scene()));
    download(this.nameOf("mode.webm"), await this.motion.film());
    this.motion.hide();
    this.film.disabled = false;
  }
}
