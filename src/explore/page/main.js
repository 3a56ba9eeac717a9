// Puts the page together: a change of the scene asks for a chart, a chart is shown.

import { Blade } from "./blade.js";
import { Charts } from "./charts.js";
import { Form } from "./form.js";
import { Kept, carried, download, link, measured } from "./kept.js";
import { publish } from "./marks.js";
import { influences } from "./influence.js";
import { Live } from "./live.js";
import { Motion } from "./motion.js";
import { Pinned } from "./pinned.js";
import { SceneState, clone } from "./scene.js";
import { Refused, influence, mode, read, saved, start, stayConnected } from "./talk.js";
import { Tasks } from "./tasks.js";
import { facts, tables, verdict } from "./verdict.js";
import { write } from "./dom.js";
import { krein, numbered, shown, useInches } from "./words.js";

const by = (id) => document.getElementById(id);
const begun = await start();
let colours = publish(begun.colours);
let latest = null;
let refusedKey = null;
const kept = new Kept(begun.scene);
// The scene as it was last saved to a file, or as the program was started with.
let onDisk = JSON.stringify(begun.scene);

// For the test in a browser: times from a move, or from the release, to its painted chart, how long
// the page worked on a chart, and what is shown.
const seen = (window.sawflutter = { latencies: { draft: [], scene: [], release: [] }, computed: [], drawing: [], painted: null });

const state = new SceneState(begun.scene, (scene, { draft, structure, stamp, released }) => {
  live.ask(scene, { draft, stamp, released });
  watchAge();
  weighing?.abort();
  by("fields").classList.add("unweighed");
  if (structure) form.build();
  form.refresh(draft);
  blade.draw(scene, refusedKey);
  if (draft) return;
  buttons();
  kept.keep(scene);
  tasks.changed();
});
const blade = new Blade(by("drawing"), state);
const motion = new Motion(by("motion"), blade.mark, () => motionColours());
const form = new Form(by("fields"), begun.schema, new Map(begun.quantities.map((quantity) => [quantity.path, quantity])), state);
const charts = new Charts(by("campbell"), by("growth"), colours, { onHover, onZoom });
const pinned = new Pinned(by("beside"), charts);
const tasks = new Tasks(by("tabs"), by("panels"), by("panel-chart"), state, { onScene: replaceScene });
const live = new Live({ onChart, onRefused, onBusy });
seen.state = state;
// Whether the chart that is painted is that of the scene, at its own accuracy.
seen.settled = () => seen.painted === JSON.stringify(state.scene) && !document.body.classList.contains("stale");
seen.report = () => latest.report;
seen.speeds = () => charts.speeds;
seen.open = open;
// A browser that is driven cannot answer whether to leave.
seen.leave = () => (onDisk = JSON.stringify(state.scene));

function onZoom(speeds) {
  by("zoomed").hidden = speeds === null;
  if (speeds) by("stretch").textContent = `${Math.round(speeds[0])} to ${Math.round(speeds[1])} rpm of the sweep`;
  pinned.zoomed(speeds);
}

function motionColours() {
  const numbers = (text) => text.match(/\d+/g).map(Number);
  return [numbers(colours.backward), numbers(colours.forward), colours.dark ? [44, 49, 57] : [247, 248, 249]];
}

// A chart that is of an earlier scene for longer than a blink is shown as such.
const BLINK_MS = 400;
let shownText = null;
let ageing = null;
function watchAge() {
  ageing ??= setTimeout(() => {
    if (shownText === JSON.stringify(state.scene) || shownText === null) return;
    document.body.classList.add("earlier-scene");
    by("computed").textContent = "Chart and verdict are of the scene before the last change.";
  }, BLINK_MS);
}

function onChart(chart, request) {
  const begun = performance.now();
  clearTimeout(ageing);
  ageing = null;
  shownText = request.text;
  document.body.classList.remove("earlier-scene");
  if (request.text !== JSON.stringify(state.scene)) watchAge();
  latest = chart;
  refusedKey = null;
  pinned.begin(chart.report);
  form.refuse(null, "");
  say("");
  document.body.classList.remove("stale");
  compare();
  if (!request.draft) weigh(chart);
  blade.draw(state.scene, null);
  if (charts.pointed || asked) onHover(charts.pointed);
  seen.drawing.push(performance.now() - begun);
  painted(() => {
    const now = performance.now();
    const kind = request.draft ? "draft" : "scene";
    seen.latencies[kind].push(...request.stamps.map((stamp) => now - stamp));
    if (request.released !== undefined) seen.latencies.release.push(now - request.released);
    seen.computed.push([kind, chart.milliseconds]);
    seen.painted = request.draft ? null : request.text;
  });
}

// How the speeds of a chart move with the numbers of the form.
let weighing = null;
async function weigh(chart) {
  weighing?.abort();
  weighing = new AbortController();
  try {
    const found = await influence(chart.chart, weighing.signal);
    if (weighing.signal.aborted || latest !== chart) return;
    form.influence(influences(found, chart.report));
    by("fields").classList.remove("unweighed");
  } catch (error) {
    // No chart depends on it: where it fails, the fields are as they were.
    if (error.name !== "AbortError") form.influence([]);
  }
}

// The chart, and what is held against it.
function compare() {
  pinned.showWith(latest.report, by("side").checked && pinned.isNamed);
  tell();
}

// After the frame in which the chart is drawn.
function painted(then) {
  const channel = new MessageChannel();
  channel.port1.onmessage = then;
  requestAnimationFrame(() => channel.port2.postMessage(null));
}

// One line under the chart for what no field can say.
const say = (text) => write(by("fault"), text);

function onRefused(error, request) {
  const answers = error instanceof Refused;
  if (!answers && request.draft) return;
  refusedKey = error.key ?? null;
  const told = form.refuse(refusedKey, error.message, error.allowed);
  say(told ? "" : answers ? error.message : "The program does not answer any more. Save the scene, start the program again and open it there.");
  // Chart and verdict are of an earlier scene.
  document.body.classList.add("stale");
  blade.draw(state.scene, refusedKey);
}

let ticking = 0;
function onBusy(busy, draft) {
  clearInterval(ticking);
  const begun = performance.now();
  const tell = () => {
    const seconds = Math.round((performance.now() - begun) / 1000);
    write(by("busy"), `${draft ? "draft" : "computing"} …${seconds > 0 ? ` ${seconds} s` : ""}`);
  };
  if (busy) {
    tell();
    ticking = setInterval(tell, 1000);
  } else {
    write(by("busy"), "");
  }
}

function tell() {
  const { report, milliseconds } = latest;
  verdict(by("verdict"), report);
  facts(by("facts"), report, pinned.report);
  if (document.querySelector(".numbers").open) tables(by("tables"), report);
  const accuracy = report.accuracy;
  by("computed").textContent = `${accuracy.name} accuracy, ${accuracy.degrees_of_freedom} functions, `
    + `estimated error ${shown(100 * accuracy.estimated_relative_error, 2)} %, computed in ${Math.round(milliseconds)} ms`;
  by("warnings").replaceChildren(...report.warnings.map((warning) => Object.assign(document.createElement("li"), { textContent: warning })));
  by("campbell").setAttribute("aria-label", `Campbell diagram. ${by("verdict").textContent}. Arrow keys walk along the branches, plus and minus magnify, 0 shows all speeds.`);
}

const MEANING = {
  forward: "It runs with the rotation, ahead of the dot.",
  backward: "It runs against the rotation.",
  reflected: "It is carried along in space but falls behind the dot: on the blade it runs backward.",
  standing: "It does not travel.",
};
let asked = null;
// The mode that was pointed at last.
let filmed = null;
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
    filmed = shape;
    by("film").disabled = motion.still || !globalThis.MediaRecorder;
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
  const source = state.scene.measured?.source;
  by("points").hidden = source === undefined;
  by("source").textContent = source ?? "";
  by("source").title = source ?? "";
  by("unpin").hidden = !pinned.isNamed;
  by("unpin").textContent = `Unpin ${pinned.name}`;
  by("sides").hidden = by("unpin").hidden;
}

function pin() {
  const name = prompt("Name of the reference", state.scene.name ?? "reference");
  if (name !== null) hold(name.trim() || "reference");
}

// Holds later changes against the saw as it is now; without a name, until another one is pinned.
function hold(name) {
  pinned.pin(latest.report, name);
  compare();
  buttons();
}

const INCHES = "sawflutter inches";
// Lengths in inches or millimetres: the scene stays as it is.
function measure(on) {
  by("inches").checked = on;
  useInches(on);
  form.build();
  if (latest) weigh(latest);
  try {
    localStorage.setItem(INCHES, on ? "1" : "");
  } catch {
    // A browser that keeps nothing still shows them.
  }
}

async function film() {
  by("film").disabled = true;
  motion.show(filmed, Blade.reach(state.scene));
  download("mode.webm", await motion.film());
  motion.hide();
  by("film").disabled = false;
}

function offerExamples() {
  const list = by("examples");
  list.append(...begun.examples.map(({ name }, k) => Object.assign(document.createElement("option"), { value: k, textContent: name })));
  list.addEventListener("change", () => {
    const example = begun.examples[Number(list.value)];
    list.value = "";
    if (!example) return;
    onDisk = JSON.stringify(example);
    replaceScene(clone(example));
  });
}

async function save(name) {
  if (name === "scene.json") {
    // Without the server: it may have ended.
    download(name, new Blob([`${JSON.stringify(state.scene, null, 2)}\n`], { type: "application/json" }));
    onDisk = JSON.stringify(state.scene);
    return;
  }
  try {
    download(name, await saved(name, state.scene));
  } catch (error) {
    say(error.message);
  }
}

function replaceScene(scene) {
  state.change((current) => {
    for (const key of Object.keys(current)) delete current[key];
    Object.assign(current, scene);
  }, { structure: true });
}

// A scene, or a table of measured frequencies. What is neither leaves everything as it is.
async function open(file) {
  try {
    const text = await file.text();
    if (/\.(csv|tsv|txt)$/i.test(file.name)) {
      const points = measured(file.name, text);
      state.change((scene) => (scene.measured = points), { structure: true });
      return;
    }
    const scene = await read(text);
    onDisk = JSON.stringify(scene);
    replaceScene(scene);
  } catch (error) {
    say(`${file.name} was not opened, the scene is as it was: ${error.message}`);
  }
}

async function copyLink() {
  const address = await link(state.scene);
  if (address === null) {
    say("The scene is too long for an address; save it as a file instead.");
    return;
  }
  history.replaceState(null, "", address);
  try {
    await navigator.clipboard.writeText(address);
    by("link").textContent = "Link copied";
  } catch {
    by("link").textContent = "Link is in the address bar";
  }
  setTimeout(() => (by("link").textContent = "Link"), 3000);
}

// The scene of the address, or that of an earlier visit with unsaved edits.
async function restore() {
  try {
    const text = await carried();
    if (text !== null) return replaceScene(await read(text));
  } catch (error) {
    say(`The scene in the address cannot be read: ${error.message}`);
  }
  const earlier = kept.restored();
  if (earlier === null || JSON.stringify(earlier) === JSON.stringify(begun.scene)) return undefined;
  by("restored").hidden = false;
  return replaceScene(earlier);
}

function startOver() {
  kept.forget();
  by("restored").hidden = true;
  onDisk = JSON.stringify(begun.scene);
  replaceScene(clone(begun.scene));
}

function wire() {
  by("undo").addEventListener("click", () => state.undo());
  by("redo").addEventListener("click", () => state.redo());
  by("pin").addEventListener("click", pin);
  by("unpin").addEventListener("click", () => hold(""));
  by("link").addEventListener("click", copyLink);
  by("all").addEventListener("click", () => charts.zoom(null));
  by("over").addEventListener("click", startOver);
  document.querySelector(".numbers").addEventListener("toggle", () => latest && tell());
  by("side").addEventListener("change", compare);
  by("film").addEventListener("click", film);
  by("inches").addEventListener("change", (event) => measure(event.target.checked));
  by("measured").addEventListener("change", (event) => charts.showMeasured(event.target.checked));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer.files[0]) open(event.dataTransfer.files[0]);
  });
  addEventListener("beforeunload", (event) => {
    if (JSON.stringify(state.scene) !== onDisk) event.preventDefault();
  });
  by("open").addEventListener("change", async (event) => {
    if (event.target.files[0]) await open(event.target.files[0]);
    // The same file can be opened once more.
    event.target.value = "";
  });
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
    pinned.setColours(colours);
  });
  stayConnected((lost) => {
    by("lost").hidden = !lost;
  });
}

await document.fonts.load("12px Inter");
wire();
offerExamples();
measure(localStorage.getItem(INCHES) === "1");
blade.draw(state.scene, null);
buttons();
await restore();
if (!live.asked) live.ask(state.scene, { draft: false });
