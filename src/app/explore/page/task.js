// Computations besides the chart, such as the cut, a run-up or a fit. Each has the summary that the program prints, its
// figures, and its report to save.

import { LOST } from "./backend.js";
import { download, explain, node } from "./dom.js";
import { Figure } from "./figure.js";
import { INPUTS } from "./inputs.js";
import { SawMap } from "./map.js";
import { outline } from "./outline.js";
import { lacks, putIn } from "./parts.js";
import { get, sawOf } from "./scene.js";
import { Refused, task } from "./talk.js";
import { partName } from "./words.js";

// Longest time of a computation that starts without being asked for.
const CHEAP_MS = 3000;

// Tasks with `isBegun` may be cheap: they start when their tab is opened and when the scene changes.
const TASKS = [
  { name: "cut", isBegun: true, title: "Cut", part: "cut", what: "The blade before, during and after the cut: history at the probe, verdicts over speed and force." },
  { name: "runup", isBegun: true, title: "Run-up", part: "runup", what: "The blade run up under a lateral force: deflection at the probe, and what each band of instability adds." },
  { name: "washboard", isBegun: true, title: "Washboard", part: "cut.washboarding", what: "Whether a vibration grows from tooth to tooth on the surface that the one before has left, over speed and cutting stiffness." },
  { name: "response", isBegun: true, title: "Response", what: "Amplitude over the speed at the probe, for the causes in the scene: its side force, constant or oscillating, run-out, flatness, imbalance. Without any, a side force of 1 N." },
  { name: "gap", isBegun: true, title: "Gap", what: "Guides with a gap: critical speeds and flutter over the amplitude, and the deflection at the cut over gap and side force.", remedy: ["guides[0].gap_m", "Let pad 1 lift off"] },
  { name: "fit", title: "Fit", what: "Radius and stiffness of every guide from the measured frequencies of the scene; drop a table (rpm, then frequencies in Hz) on the page.", took: "Take the fitted saw" },
  { name: "place", title: "Place", what: "Radius, angle and stiffness of the first guide for the largest flutter speed.", took: "Take the best saw" },
  { name: "size", title: "Size", what: "How thick, how stiff, how fast? The values of a number with which the saw keeps its limits at its operating speed.", took: "Take this saw" },
  { name: "study", title: "Tolerances", what: "Random saws within tolerances: how their critical and flutter speeds spread." },
  { name: "map", title: "Map", what: "Stable and unstable areas over one number and the speed, or over two numbers at the operating speed, within usual bounds: a radius anywhere on the blade, a stiffness within a factor of thirty, an angle within 60°, other numbers within 20 %." },
];

const button = (textContent, onclick) => node("button", { type: "button", textContent, onclick });
const pictureOf = (svg) => URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));

export class Task {
  #abort = null;
  // Saw that was computed last, also without an answer.
  #tried = null;
  #isCheap = true;
  // Outline and figures of the answer, and the map if it is one.
  #outline = [];
  #figures = [];
  #map = null;

  // `answers` marks the answer when it is one of an earlier scene. `onScene(scene)` takes over a resulting saw,
  // `inWords(refusal)` returns the text of a refusal, `nameOf(file)` the name of a saved file, and `colours()` the
  // colours of the page.
  constructor(group, name, state, { needs, tolerances }, answers, { onScene, inWords, nameOf, colours }) {
    this.entry = TASKS.find((entry) => entry.name === name);
    this.state = state;
    this.needs = needs;
    this.answers = answers;
    this.onScene = onScene;
    this.inWords = inWords;
    this.nameOf = nameOf;
    this.colours = colours;
    const { title, what } = this.entry;
    const inputs = node("div", { className: "inputs" });
    this.inputs = INPUTS[name] && new INPUTS[name](inputs, tolerances);
    this.missing = node("p", { className: "remark" });
    this.start = button("Compute", () => this.#run());
    this.stop = Object.assign(button("Stop", () => this.#abort?.abort()), { hidden: true });
    this.bar = node("progress", { hidden: true, "aria-label": `Progress of ${title}` });
    this.so_far = node("span", { className: "remark", role: "status" });
    this.fault = node("p", { className: "fault", role: "alert" });
    this.answer = node("div", { className: "answer" });
    this.card = node("div");
    group.append(node("section", { id: `panel-${name}`, "aria-label": title }, node("h2", { textContent: title }),
      explain(node("p", { className: "remark", textContent: what })), this.missing, inputs,
      node("p", { className: "start" }, this.start, " ", this.stop, " ", this.bar, " ", this.so_far), this.fault, this.answer));
  }

  // Updates the task for the present scene: missing parts, inputs, and the place of the saw in a map.
  refresh() {
    const { scene } = this.state;
    const isOpen = this.#offer(scene) && this.entry.isBegun && this.#isCheap && this.stop.hidden;
    this.#tellOutline();
    this.inputs?.refresh(scene);
    if (isOpen && this.#tried !== sawOf(scene)) this.#run(CHEAP_MS);
  }

  // Says what the scene lacks for the task, and returns whether it lacks nothing.
  #offer(scene) {
    const { name, part, remedy } = this.entry;
    const isPartMissing = part !== undefined && !get(scene, part);
    const missing = part === undefined ? lacks(this.needs, name, scene) : isPartMissing ? lacks(this.needs, part, scene) : "";
    const hadFocus = this.missing.contains(document.activeElement);
    this.missing.replaceChildren(missing);
    if (isPartMissing && missing === "") {
      const words = partName(part.split(".").at(-1));
      this.missing.append(`The scene has no ${words} yet. `, button(`Put ${words} in`, () => this.#putIn(part)));
    }
    if (missing !== "" && remedy && scene.guides?.length > 0) {
      this.missing.append(" ", button(remedy[1], () => this.#putIn(remedy[0])));
    }
    this.start.disabled = isPartMissing || missing !== "";
    if (hadFocus) (this.missing.querySelector("button") ?? this.start).focus();
    return !this.start.disabled;
  }

  #putIn(part) {
    return putIn(this.state, part).catch((error) => (this.fault.textContent = this.inWords(error)));
  }

  // Computes the answer, and stops after `most_ms`.
  async #run(most_ms = Infinity) {
    this.#abort?.abort();
    const abort = (this.#abort = new AbortController());
    this.#busy(true);
    this.fault.textContent = "";
    const { scene } = this.state;
    const saw = (this.#tried = sawOf(scene));
    try {
      const text = JSON.stringify({ scene, ...this.inputs?.asked });
      const listeners = {
        onProgress: (told) => this.#tell(told),
        onFigures: (figures) => this.#grow(figures, saw),
      };
      // The tasks of all tabs of the browser run one at a time, because tasks that wait at the server would occupy the
      // few connections that a browser opens to it.
      const answer = await navigator.locks.request("sawflutter task", { signal: abort.signal }, () => {
        this.so_far.textContent = "computing …";
        const late = most_ms < Infinity ? setTimeout(() => abort.abort(), most_ms) : 0;
        this.#isCheap = false;
        const begun = performance.now();
        return task(this.entry.name, text, abort.signal, listeners).finally(() => {
          clearTimeout(late);
          this.#isCheap = performance.now() - begun < CHEAP_MS;
        });
      });
      this.#show(answer, JSON.parse(text).scene);
    } catch (error) {
      if (error instanceof Refused) this.fault.textContent = this.inWords(error);
      else if (error.name !== "AbortError") this.fault.textContent = LOST;
    }
    if (this.#abort === abort) this.#busy(false);
    this.refresh();
  }

  #busy(on) {
    const hadFocus = document.activeElement === this.stop;
    this.stop.hidden = !on;
    if (hadFocus && !on) this.start.focus();
    this.bar.hidden = !on;
    this.bar.removeAttribute("value");
    // A partial answer that remains visible is labelled as ended early.
    const isPart = this.answer.querySelector(".so-far") !== null;
    this.so_far.textContent = on ? "waits for another computation …" : isPart ? `ended early, ${this.so_far.textContent}` : "";
  }

  #tell({ what, done, of, best_rpm }) {
    this.bar.max = of;
    this.bar.value = done;
    const best = best_rpm > 0 ? `, best so far ${Math.round(best_rpm)} rpm` : "";
    this.so_far.textContent = `${what}: ${done} of ${of}${best}`;
  }

  #grow([[, svg]], saw) {
    const picture = this.answer.querySelector(".so-far img") ?? node("img", { alt: `${this.entry.title}, as far as it is computed` });
    if (!picture.isConnected) this.#replace(node("figure", { className: "so-far" }, picture));
    URL.revokeObjectURL(picture.src);
    picture.src = pictureOf(svg);
    this.answers.show(this.answer, (scene) => sawOf(scene) === saw);
  }

  #replace(...parts) {
    for (const picture of this.answer.querySelectorAll("img")) URL.revokeObjectURL(picture.src);
    this.answer.replaceChildren(node("p", { className: "remark outdated", textContent: "Computed for an earlier scene." }), ...parts);
  }

  #show({ summary, outline: parts, report, figures, scene }, asked) {
    const { name, title, took } = this.entry;
    const saveReport = () => download(this.nameOf(`${name}.json`), new Blob([`${JSON.stringify(report, null, 2)}\n`], { type: "application/json" }));
    const tools = node("div", { className: "tools" }, ...(scene ? [button(took, () => this.onScene(scene))] : []), button("Save report", saveReport));
    const map = (this.#map = name === "map" ? new SawMap(report) : null);
    this.#figures = [];
    const pictures = figures.map(([file, svg, chart]) => {
      const words = file.replace(".svg", "").replaceAll("-", " ");
      const figure = chart && new Figure(chart, words, this.colours, map && ((place) => this.state.change((made) => map.take(made, place))));
      if (figure) this.#figures.push(figure);
      const picture = figure?.place ?? node("img", { src: pictureOf(svg), alt: `${words}; the words have its numbers` });
      const save = button(`Save ${file}`, () => download(this.nameOf(file), new Blob([svg], { type: "image/svg+xml" })));
      return node("figure", {}, picture, save);
    });
    this.#outline = parts;
    const text = node("pre", { textContent: summary, tabIndex: 0, role: "region", "aria-label": `${title} in words` });
    const keyOf = (one) => (map ? map.keyOf(one) : sawOf(one));
    this.#replace(tools, this.card, ...pictures, node("details", {}, node("summary", { textContent: "Text" }), text));
    this.answers.show(this.answer, (present) => keyOf(present) === keyOf(asked));
    this.#tellOutline();
  }

  #tellOutline() {
    this.card.replaceChildren(...outline(this.#outline));
    for (const figure of this.#figures) figure.draw(this.#map?.placeOf(this.state.scene));
  }
}
