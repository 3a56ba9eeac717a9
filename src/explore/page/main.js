// Puts the page together: a change of the scene asks for a chart, a chart is shown.

import { Blade } from "./blade.js";
import { Charts } from "./charts.js";
import { Form } from "./form.js";
import { publish } from "./marks.js";
import { Motion } from "./motion.js";
import { SceneState, clone } from "./scene.js";
import { Refused, Live, mode, saved, start, stayConnected } from "./talk.js";
import { facts, tables, verdict } from "./verdict.js";
import { krein, numbered, shown } from "./words.js";

const by = (id) => document.getElementById(id);
const begun = await start();
let colours = publish(begun.colours);
let latest = null;
let pinned = null;
let refusedKey = null;

// For the test in a browser: times from a move to its painted chart, and what is shown.
const seen = (window.sawflutter = { latencies: { draft: [], scene: [] }, computed: [], painted: null });

const state = new SceneState(begun.scene, (scene, { draft, structure, stamp }) => {
  if (structure) form.build();
  form.refresh();
  blade.draw(scene, refusedKey);
  buttons();
  live.ask(scene, { draft, stamp });
});
const blade = new Blade(by("drawing"), state);
const motion = new Motion(by("motion"), blade.mark, () => motionColours());
const form = new Form(by("fields"), begun.schema, state);
const charts = new Charts(by("campbell"), by("growth"), colours, { onHover });
const live = new Live({ onChart, onRefused, onBusy });
seen.state = state;
// Whether the chart that is painted is that of the scene, at its own accuracy.
seen.settled = () => seen.painted === JSON.stringify(state.scene);
seen.report = () => latest.report;
seen.speeds = () => charts.speeds;

function motionColours() {
  const numbers = (text) => text.match(/\d+/g).map(Number);
  return [numbers(colours.backward), numbers(colours.forward), colours.dark ? [44, 49, 57] : [247, 248, 249]];
}

function onChart(chart, request) {
  latest = chart;
  refusedKey = null;
  pinned ??= clone(chart.report);
  form.refuse(null, "");
  by("fault").textContent = "";
  charts.show(chart.report, pinnedDiffers() ? pinned : null);
  tell();
  blade.draw(state.scene, null);
  if (charts.pointed || asked) onHover(charts.pointed);
  painted(() => {
    const now = performance.now();
    const kind = request.draft ? "draft" : "scene";
    seen.latencies[kind].push(...request.stamps.map((stamp) => now - stamp));
    seen.computed.push([kind, chart.milliseconds]);
    seen.painted = request.draft ? null : request.text;
  });
}

// After the frame in which the chart is drawn.
function painted(then) {
  const channel = new MessageChannel();
  channel.port1.onmessage = then;
  requestAnimationFrame(() => channel.port2.postMessage(null));
}

function onRefused(error, request) {
  refusedKey = error.key ?? null;
  const told = form.refuse(refusedKey, error.message);
  by("fault").textContent = told ? `${error.message} (the last good chart stays)` : error.message;
  blade.draw(state.scene, refusedKey);
  if (!(error instanceof Refused) && !request.draft) by("fault").textContent = "The program does not answer any more; start it again.";
}

let ticking = 0;
function onBusy(busy, draft) {
  clearInterval(ticking);
  const begun = performance.now();
  const tell = () => {
    const seconds = Math.round((performance.now() - begun) / 1000);
    by("busy").textContent = `${draft ? "draft" : "computing"} …${seconds > 0 ? ` ${seconds} s` : ""}`;
  };
  by("busy").textContent = "";
  if (busy) {
    tell();
    ticking = setInterval(tell, 1000);
  }
  document.body.classList.toggle("busy", busy && !draft);
}

const pinnedDiffers = () => JSON.stringify(pinned.scene) !== JSON.stringify(latest.report.scene);

function tell() {
  const { report, milliseconds } = latest;
  verdict(by("verdict"), report);
  facts(by("facts"), report, pinned);
  tables(by("tables"), report);
  const accuracy = report.accuracy;
  by("accuracy").textContent = `${accuracy.name} accuracy, ${accuracy.degrees_of_freedom} functions, `
    + `estimated error ${shown(100 * accuracy.estimated_relative_error, 2)} %, computed in ${Math.round(milliseconds)} ms`;
  by("warnings").replaceChildren(...report.warnings.map((warning) => Object.assign(document.createElement("li"), { textContent: warning })));
  by("campbell").setAttribute("aria-label", `Campbell diagram. ${by("verdict").textContent}. Arrow keys walk along the branches.`);
}

const MEANING = {
  forward: "It runs with the rotation, ahead of the dot.",
  backward: "It runs against the rotation.",
  reflected: "It is carried along in space but falls behind the dot: on the blade it runs backward.",
  standing: "It does not travel.",
};
let asked = null;
async function onHover(found) {
  asked?.abort();
  asked = null;
  if (!found) {
    motion.hide();
    document.body.classList.remove("moving");
    by("mode").textContent = by("mode").dataset.empty;
    return;
  }
  const { branch, i } = found;
  asked = new AbortController();
  try {
    const shape = await mode(latest.chart, branch.rpm[i], branch.frequency_hz[i], asked.signal);
    const slower = motion.show(shape, Blade.reach(state.scene));
    document.body.classList.add("moving");
    const growth = Math.abs(shape.growth_per_s) > 1e-3 ? `, ${shape.growth_per_s > 0 ? "grows" : "decays"} at ${shown(Math.abs(shape.growth_per_s), 3)} 1/s` : "";
    const name = Object.assign(document.createElement("strong"), { textContent: numbered(branch.branch, branch.name), className: shape.direction });
    by("mode").replaceChildren(name, ` at ${Math.round(shape.rpm)} rpm: ${shown(shape.frequency_hz, 4)} Hz in space, `
      + `${shown(shape.body_frequency_hz, 4)} Hz on the blade, nodal diameters there ${shape.name}, Krein sign ${krein(shape.krein_sign)}${growth}. `
      + `${MEANING[shape.direction]} Shown ${shown(slower, 2)} times slower; the dot turns with the blade.`);
  } catch (error) {
    if (error.name !== "AbortError") by("mode").textContent = error.message;
  }
}

function buttons() {
  by("undo").disabled = !state.canUndo;
  by("redo").disabled = !state.canRedo;
  const measured = state.scene.measured;
  by("measured").checked = measured !== undefined;
  const source = (measured ?? begun.measured)?.source ?? "Measured";
  by("source").textContent = source.length > 36 ? `${source.slice(0, 35)}…` : source;
}

function switchMeasured(on) {
  if (!on) begun.measured = state.scene.measured ?? begun.measured;
  state.change((scene) => {
    if (on) scene.measured = clone(begun.measured);
    else delete scene.measured;
  });
}

async function save(name) {
  try {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await saved(name, state.scene));
    link.download = name;
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  } catch (error) {
    by("fault").textContent = error.message;
  }
}

async function open(file) {
  try {
    const scene = JSON.parse(await file.text());
    state.change((current) => {
      for (const key of Object.keys(current)) delete current[key];
      Object.assign(current, scene);
    }, { structure: true });
  } catch (error) {
    by("fault").textContent = `${file.name} is not JSON: ${error.message}`;
  }
}

function wire() {
  by("undo").addEventListener("click", () => state.undo());
  by("redo").addEventListener("click", () => state.redo());
  by("pin").addEventListener("click", () => {
    pinned = clone(latest.report);
    charts.show(latest.report, null);
    tell();
  });
  by("measured").addEventListener("change", (event) => switchMeasured(event.target.checked));
  by("open").addEventListener("change", (event) => event.target.files[0] && open(event.target.files[0]));
  for (const button of document.querySelectorAll("[data-save]")) {
    button.addEventListener("click", () => save(button.dataset.save));
  }
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.target.matches("input[type=text], textarea")) return;
    const undo = event.key === "z" && !event.shiftKey;
    const redo = event.key === "y" || (event.key.toLowerCase() === "z" && event.shiftKey);
    if (undo) state.undo();
    if (redo) state.redo();
    if (undo || redo) event.preventDefault();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    colours = publish(begun.colours);
    charts.setColours(colours);
  });
  stayConnected((lost) => {
    by("lost").hidden = lost === null;
  });
}

await document.fonts.load("12px Inter");
wire();
form.build();
blade.draw(state.scene, null);
buttons();
live.ask(state.scene, { draft: false });
