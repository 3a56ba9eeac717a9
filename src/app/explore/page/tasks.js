// Tasks besides the chart, such as the cut, a run-up or a fit, in tabs. Each has the summary that the program prints, its
// figures, and its report to save.

import { LOST } from "./backend.js";
import { download, explain, node } from "./dom.js";
import { placeOf, unitOf } from "./fields.js";
import { Figure } from "./figure.js";
import { outline } from "./outline.js";
import { lacks, putIn } from "./parts.js";
import { clone, get, sawOf, set } from "./scene.js";
import { Refused, task } from "./talk.js";
import { partName, shown, tidy } from "./words.js";

// Returns the paths of the numbers of a scene that have a usual tolerance, each with this tolerance in the unit of its
// key.
function usualTolerances(tolerances, scene) {
  const known = (path) => [path, get(scene, path)];
  return tolerances.flatMap(({ path, plus_minus, share }) => {
    const places = path.startsWith("guides[]") ? (scene.guides ?? []).map((_, i) => known(path.replace("[]", `[${i}]`))) : [known(path)];
    return places.filter(([, value]) => typeof value === "number")
      .map(([place, value]) => [place, tidy(Number((plus_minus + share * value).toPrecision(3)))]);
  });
}

// Returns the options for the axes of a map: the numbers that have a usual tolerance.
function axesOf(tolerances, scene) {
  return usualTolerances(tolerances, scene).map(([path]) => ({ value: path, textContent: placeOf(path) }));
}

// Returns the paths of the numbers along the axes of a map, each with its range.
function axesOfMap({ x, y, to_rpm }) {
  return [x, y ?? { path: "operating_rpm", values: [0, to_rpm] }].map(({ path, values }) => {
    const [of, back] = values[0] > 0 && values.at(-1) >= 10 * values[0] ? [Math.log, Math.exp] : [Number, Number];
    const [least, most] = [values[0], values.at(-1)].map(of);
    return { path, range: { at: (share) => back(least + share * (most - least)), share: (value) => (of(value) - least) / (most - least) } };
  });
}

// Longest time of a computation that starts without being asked for.
const CHEAP_MS = 3000;

// Tabs, each a question of a designer, with the part of the saw that decides it and its tasks. Tasks with `isBegun` may be
// cheap: they start when their tab is opened and when the scene changes.
const TABS = [
  { name: "chart", title: "Chart", tasks: [] },
  { name: "cut", title: "Cut", part: "cut", tasks: ["cut", "washboard"] },
  { name: "motion", title: "Run-up and response", part: "runup", tasks: ["runup", "response"] },
  { name: "guides", title: "Guides", part: "guides", tasks: ["gap", "fit", "place"] },
  { name: "spread", title: "Tolerances and map", part: "blade", tasks: ["study", "map"] },
];
const TASKS = [
  { name: "cut", isBegun: true, title: "Cut", part: "cut", what: "The blade before, during and after the cut: history at the probe, verdicts over speed and force." },
  { name: "runup", isBegun: true, title: "Run-up", part: "runup", what: "The blade run up under a lateral force: deflection at the probe, and what each band of instability adds." },
  { name: "washboard", isBegun: true, title: "Washboard", part: "cut.washboarding", what: "Whether a vibration grows from tooth to tooth on the surface that the one before has left, over speed and cutting stiffness." },
  { name: "response", isBegun: true, title: "Response", what: "Amplitude over the speed at the probe, for the causes in the scene: its side force, constant or oscillating, run-out, flatness, imbalance. Without any, a side force of 1 N." },
  { name: "gap", isBegun: true, title: "Gap", what: "Guides with a gap: critical speeds and flutter over the amplitude, and the deflection at the cut over gap and side force." },
  { name: "fit", title: "Fit", what: "Radius and stiffness of every guide from the measured frequencies of the scene; drop a table (rpm, then frequencies in Hz) on the page.", took: "Take the fitted saw" },
  { name: "place", title: "Place", what: "Radius, angle and stiffness of the first guide for the largest flutter speed.", took: "Take the best saw" },
  { name: "study", title: "Tolerances", what: "Random saws within tolerances: how their critical and flutter speeds spread." },
  { name: "map", title: "Map", what: "Stable and unstable areas over one number and the speed, or over two numbers at the operating speed, within usual bounds: a radius anywhere on the blade, a stiffness within a factor of thirty, an angle within 60°, other numbers within 20 %." },
];

export class Tasks {
  #groups = new Map();

  // Among `listeners`, `onTab(part)` is called with the part that decides the question of a tab, `onScene(scene)` takes
  // over a resulting saw, `inWords(refusal)` returns the text of a refusal,
  // `nameOf(file)` the name of a saved file, and `colours()` the colours of the page.
  constructor(tabs, panels, state, begun, listeners) {
    this.tabs = tabs;
    for (const { name, title, part, tasks } of TABS) {
      const tab = node("button", { type: "button", role: "tab", id: `tab-${name}`, textContent: title });
      tab.setAttribute("aria-controls", `group-${name}`);
      tab.addEventListener("click", () => {
        this.show(name);
        if (part) listeners.onTab(part);
      });
      tabs.append(tab);
      const group = panels.querySelector(`#group-${name}`) ?? node("div", { id: `group-${name}`, role: "tabpanel" });
      group.setAttribute("aria-labelledby", tab.id);
      panels.append(group);
      const own = tasks.map((one) => new Task(group, TASKS.find((entry) => entry.name === one), state, begun, listeners));
      this.#groups.set(name, { tab, group, tasks: own });
    }
    tabs.addEventListener("keydown", (event) => this.#walk(event));
    this.show("chart");
  }

  show(name) {
    for (const [own, { tab, group }] of this.#groups) {
      const chosen = own === name;
      group.hidden = !chosen;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      // On a narrow screen, the tabs are one row that is scrolled to the chosen tab.
      if (chosen) this.tabs.scrollLeft = tab.offsetLeft - 0.5 * (this.tabs.clientWidth - tab.clientWidth);
    }
    this.changed();
  }

  // Updates the visible tab after a change of the scene. An answer for an earlier scene is marked as such.
  changed() {
    for (const { group, tasks } of this.#groups.values()) if (!group.hidden) for (const one of tasks) one.refresh();
  }

  // The left and right arrow keys change the tab, as is usual for lists of tabs.
  #walk(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const all = [...this.tabs.children];
    const next = all[(all.indexOf(document.activeElement) + step + all.length) % all.length];
    next.focus();
    next.click();
    event.preventDefault();
  }
}

// One task: the inputs, the progress and the answer of a task.
class Task {
  #abort = null;
  #saw = null;
  // Saw that was computed last, also without an answer.
  #tried = null;
  #isCheap = true;
  // Fields for the tolerances of a study, each with its unit; empty for other tasks.
  tolerances = [];
  // Select elements for the axes of a map; empty for other tasks.
  axes = [];

  constructor(group, entry, state, { needs, tolerances }, { onScene, inWords, nameOf, colours }) {
    const panel = node("section", { id: `panel-${entry.name}`, ariaLabel: entry.title });
    group.append(panel);
    this.entry = entry;
    this.state = state;
    this.needs = needs;
    this.usual = tolerances;
    this.onScene = onScene;
    this.inWords = inWords;
    this.nameOf = nameOf;
    this.colours = colours;
    // Figures of the answer that are drawn from data, and the axes of a map.
    this.figures = [];
    this.mapped = [];
    this.inputs = node("div", { className: "inputs" });
    this.missing = node("p", { className: "remark" });
    this.start = node("button", { type: "button", textContent: "Compute" });
    this.stop = node("button", { type: "button", textContent: "Stop", hidden: true });
    this.bar = node("progress", { hidden: true });
    this.bar.setAttribute("aria-label", `Progress of ${entry.title}`);
    this.so_far = node("span", { className: "remark" });
    this.so_far.setAttribute("role", "status");
    this.fault = node("p", { className: "fault" });
    this.fault.setAttribute("role", "alert");
    this.old = node("p", { className: "remark", hidden: true, textContent: "Computed for an earlier scene." });
    this.answer = node("div", { className: "answer" });
    this.outline = [];
    this.card = node("div");
    this.start.addEventListener("click", () => this.#run());
    this.stop.addEventListener("click", () => this.#abort?.abort());
    const row = node("p", { className: "start" }, this.start, " ", this.stop, " ", this.bar, " ", this.so_far);
    const title = node("h2", { textContent: entry.title });
    panel.append(title, explain(node("p", { className: "remark", textContent: entry.what })), this.missing, this.inputs, row, this.fault, this.old, this.answer);
  }

  // Updates the task for the present scene: missing parts, inputs, and whether the answer is for an earlier scene.
  refresh() {
    const { name, part } = this.entry;
    const scene = this.state.scene;
    const isPartMissing = part !== undefined && !get(scene, part);
    const missing = part === undefined ? lacks(this.needs, name, scene) : isPartMissing ? lacks(this.needs, part, scene) : "";
    const hadFocus = this.missing.contains(document.activeElement);
    this.missing.replaceChildren(missing);
    if (isPartMissing && missing === "") {
      const words = partName(part.split(".").at(-1));
      const add = node("button", { type: "button", textContent: `Put ${words} in` });
      add.addEventListener("click", () => putIn(this.state, part).catch((error) => (this.fault.textContent = this.inWords(error))));
      this.missing.append(`The scene has no ${words} yet. `, add);
    }
    this.start.disabled = isPartMissing || missing !== "";
    if (hadFocus) (this.missing.querySelector("button") ?? this.start).focus();
    this.old.hidden = this.#saw === null || this.#keyOf(JSON.parse(this.#saw)) === this.#keyOf(scene);
    this.answer.classList.toggle("earlier", !this.old.hidden);
    this.#tellOutline();
    if (this.entry.name === "study") this.#offerTolerances(scene);
    if (this.entry.name === "map") this.#offerAxes(scene);
    if (this.entry.name === "place" && !this.inputs.hasChildNodes()) this.#offerGoals();
    const isOpen = this.entry.isBegun && this.#isCheap && !this.start.disabled && this.stop.hidden;
    if (isOpen && this.#tried !== sawOf(scene)) this.#run(CHEAP_MS);
  }

  #offerGoals() {
    this.goal = node("select", { id: "place-goal" }, node("option", { value: "", textContent: "largest flutter speed" }), node("option", { value: "window", textContent: "widest stable window around the operating speed" }));
    this.least = node("input", { id: "place-least", type: "text", placeholder: "none" });
    this.inputs.append(
      node("div", { className: "field" }, node("label", { htmlFor: "place-goal", textContent: "Goal" }), this.goal),
      node("div", { className: "field" }, node("label", { htmlFor: "place-least", textContent: "Lower limit of the first critical speed, rpm" }), this.least));
  }

  // Offers the numbers for the axes of a map. A chosen number is kept as long as the scene has it.
  #offerAxes(scene) {
    const numbers = axesOf(this.usual, scene);
    const isSame = this.axes[0]?.options.length === numbers.length && numbers.every(({ value }, k) => value === this.axes[0].options[k].value);
    if (isSame) return;
    const chosen = this.axes.map((axis) => axis.value);
    const choices = [numbers, [{ value: "", textContent: "rotation speed" }, ...numbers]];
    this.axes = choices.map((all, k) => node("select", { id: `map-axis-${k}` }, ...all.map((one) => node("option", one))));
    this.axes.forEach((axis, k) => (axis.value = choices[k].some(({ value }) => value === chosen[k]) ? chosen[k] : choices[k][0].value));
    this.inputs.replaceChildren(...this.axes.map((axis, k) =>
      node("div", { className: "field" }, node("label", { htmlFor: axis.id, textContent: ["Horizontal axis", "Vertical axis"][k] }), axis)));
  }

  // Makes a field for each number that has a usual tolerance. A typed tolerance is kept.
  #offerTolerances(scene) {
    const usual = usualTolerances(this.usual, scene).map(([path, width]) => ({ path, width, ...unitOf(path) }));
    const same = (one, k) => one.path === this.tolerances[k]?.path && one.unit === this.tolerances[k].unit;
    if (this.tolerances.length === usual.length && usual.every(same)) return;
    const typed = new Map(this.tolerances.map((one) => [one.path, one]));
    this.tolerances = usual.map(({ path, width, unit, scale }) => {
      const before = typed.get(path)?.input;
      const isTyped = before && before.value !== before.defaultValue;
      // A typed number keeps the unit in which it was typed.
      const ofOldUnit = isTyped && /[\d.,]$/.test(before.value.trim()) && typed.get(path).unit !== unit;
      const input = node("input", { id: `study:${path}`, type: "text", defaultValue: shown(tidy(width * scale)) });
      if (isTyped) input.value = ofOldUnit ? `${before.value} ${typed.get(path).unit}` : before.value;
      const label = node("label", { htmlFor: input.id, textContent: `± ${placeOf(path)}, ${unit}` });
      return { path, unit, input, field: node("div", { className: "field" }, label, input) };
    });
    this.inputs.replaceChildren(...this.tolerances.map(({ field }) => field));
  }

  #asked() {
    const scene = this.state.scene;
    if (this.entry.name === "place") {
      return { scene, window: this.goal.value === "window", min_critical: this.least.value };
    }
    if (this.entry.name === "map") return { scene, axes: this.axes.map((axis) => axis.value).filter((path) => path !== "") };
    if (this.entry.name !== "study") return { scene };
    return { scene, tolerances: this.tolerances.map(({ path, input }) => ({ path, plus_minus: input.value })) };
  }

  // Computes the answer, and stops after `most_ms`.
  async #run(most_ms = Infinity) {
    this.#abort?.abort();
    const abort = (this.#abort = new AbortController());
    this.#busy(true);
    this.fault.textContent = "";
    try {
      const asked = this.#asked();
      const saw = sawOf(asked.scene);
      this.#tried = saw;
      const listeners = {
        onProgress: (told) => this.#tell(told),
        onFigures: (figures) => {
          this.#saw = saw;
          this.#grow(figures);
        },
      };
      // The tasks of all tabs of the browser run one at a time, because tasks that wait at the server would occupy the
      // few connections that a browser opens to it.
      const answer = await navigator.locks.request("sawflutter task", { signal: abort.signal }, () => {
        this.so_far.textContent = "computing …";
        const late = most_ms < Infinity ? setTimeout(() => abort.abort(), most_ms) : 0;
        this.#isCheap = false;
        const begun = performance.now();
        return task(this.entry.name, asked, abort.signal, listeners).finally(() => {
          clearTimeout(late);
          this.#isCheap = performance.now() - begun < CHEAP_MS;
        });
      });
      this.#saw = saw;
      this.#show(answer);
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
    const isPart = this.answer.firstElementChild?.classList.contains("so-far") ?? false;
    this.so_far.textContent = on ? "waits for another computation …" : isPart ? `ended early, ${this.so_far.textContent}` : "";
  }

  // Shows an intermediate figure of the program.
  #grow(figures) {
    let place = this.answer.firstElementChild;
    if (!place?.classList.contains("so-far")) {
      place = node("figure", { className: "so-far" }, node("img"));
      this.#replace(place);
    }
    const picture = place.querySelector("img");
    URL.revokeObjectURL(picture.src);
    picture.src = pictureOf(figures[0][1]);
    picture.alt = `${this.entry.title}, as far as it is computed`;
  }

  #replace(...parts) {
    for (const picture of this.answer.querySelectorAll("img")) URL.revokeObjectURL(picture.src);
    this.answer.replaceChildren(...parts);
  }

  #tell({ what, done, of }) {
    this.bar.max = of;
    this.bar.value = done;
    this.so_far.textContent = `${what}: ${done} of ${of}`;
  }

  #show({ summary, outline: parts, report, figures, scene }) {
    const { name, took } = this.entry;
    const text = node("pre", { textContent: summary, tabIndex: 0 });
    text.setAttribute("role", "region");
    text.setAttribute("aria-label", `${this.entry.title} in words`);
    const save = node("button", { type: "button", textContent: "Save report" });
    save.addEventListener("click", () => download(this.nameOf(`${name}.json`), new Blob([`${JSON.stringify(report, null, 2)}\n`], { type: "application/json" })));
    const tools = node("div", { className: "tools" }, save);
    if (scene) {
      const take = node("button", { type: "button", textContent: took });
      take.addEventListener("click", () => this.onScene(scene));
      tools.prepend(take);
    }
    const click = this.entry.name === "map" ? (shares) => this.#take(shares) : null;
    if (click) this.mapped = axesOfMap(report);
    this.figures = [];
    const pictures = figures.map(([file, svg, chart]) => {
      const words = file.replace(".svg", "").replaceAll("-", " ");
      const figure = chart && new Figure(chart, words, this.colours, click);
      if (figure) this.figures.push(figure);
      const picture = figure?.place ?? node("img", { src: pictureOf(svg), alt: `${words}; the words have its numbers` });
      const link = node("button", { type: "button", textContent: `Save ${file}` });
      link.addEventListener("click", () => download(this.nameOf(file), new Blob([svg], { type: "image/svg+xml" })));
      return node("figure", {}, picture, link);
    });
    this.outline = parts;
    this.#replace(tools, this.card, ...pictures, node("details", {}, node("summary", { textContent: "Text" }), text));
    this.#tellOutline();
  }

  // Shows the answer in the units of the form and the colours of the page.
  #tellOutline() {
    this.card.replaceChildren(...outline(this.outline));
    const shares = this.mapped.map(({ path, range }) => range.share(get(this.state.scene, path)));
    for (const figure of this.figures) figure.draw(shares);
  }

  // Sets the numbers of a map to those at shares of its axes.
  #take(shares) {
    this.state.change((scene) => this.mapped.forEach(({ path, range }, k) => set(scene, path, Number(range.at(shares[k]).toPrecision(4)))));
  }

  // Returns the saw without the numbers along the axes of the map that is shown, which contains all of their values.
  #keyOf(scene) {
    const made = clone(scene);
    for (const { path } of this.mapped) set(made, path, 0);
    return sawOf(made);
  }
}

const pictureOf = (svg) => URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
