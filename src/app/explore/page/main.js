// Connects the modules of the page: each change of the scene requests a chart, which is shown when it arrives.

import { Blade } from "./blade.js";
import { Charts } from "./charts.js";
import { describe, useInches } from "./fields.js";
import { Form } from "./form.js";
import { Files } from "./files.js";
import { Kept } from "./kept.js";
import { publish } from "./marks.js";
import { Live } from "./live.js";
import { facts, outline, verdict } from "./outline.js";
import { imageOf } from "./pairs.js";
import { isAsking, putIn } from "./parts.js";
import { Pinned } from "./pinned.js";
import { Pointed } from "./pointed.js";
import { Ruler } from "./ruler.js";
import { SceneState } from "./scene.js";
import { LOST, Refused, influence, progress, start, stayConnected } from "./talk.js";
import { Tasks } from "./tasks.js";
import { Times } from "./times.js";
import { dock } from "./dock.js";
import { write } from "./dom.js";
import { Waiting } from "./waiting.js";
import { shown } from "./words.js";

/** @returns {any} */
const by = (id) => document.getElementById(id);
/** @returns {any} */
const first = (selector) => document.querySelector(selector);
const begun = await start();
describe(begun.fields);
let colours = publish(begun.colours);
let latest = null;
let refusedKey = null;
const kept = new Kept(begun.scene);

// Read by the browser test: times, and the state of the page.
/** @type {any} */
const seen = (/** @type {any} */ (window).sawflutter = new Times());

const state = new SceneState(begun.scene, (scene, { draft, structure, stamp, released }) => {
  live.ask(scene, { draft, stamp, released });
  watchAge();
  weighing?.abort();
  by("fields").classList.add("unweighed");
  if (structure) form.build();
  form.refresh(draft);
  ruler.refresh();
  blade.draw(scene, refusedKey);
  if (draft) return;
  pointed.hint();
  buttons();
  files.changed(scene);
  tasks.changed();
});
const blade = new Blade(by("drawing"), state, { onSelect: (path) => select(path), onAdd: addPad });
const pointed = new Pointed({
  canvas: by("motion"), words: by("mode"), film: by("film"), mark: blade.mark, colours: () => colours, scene: () => state.scene,
  nameOf: (file) => files.nameOf(file),
});
const files = new Files(state, kept, begun, {
  say, onReplaced: () => pinned.reset(), onBusy: (what) => (what ? waiting.begin(what) : waiting.end()), shown: chartOfScene,
});
const ruler = new Ruler(by("ruler"), state);
const form = new Form(by("fields"), begun, state, say);
const charts = new Charts(by("campbell"), by("growth"), colours, { onHover: (point) => pointed.show(latest.chart, point), onZoom });
const pinned = new Pinned(by("beside"), by("pinned"), charts, () => {
  if (!pinned.isNamed) by("side").checked = false;
  compare();
  buttons();
});
const tasks = new Tasks(by("tabs"), by("panels"), by("panel-chart"), state, begun, {
  onScene: (scene) => state.replace(scene),
  inWords: (refusal) => form.inWords(refusal),
  nameOf: (file) => files.nameOf(file),
});
const live = new Live({ onChart, onAhead, onRefused, onBusy });
const waiting = new Waiting(by("waiting"), { onStop, onAgain: () => live.again(state.scene), ask: progress });
seen.state = state;
// Returns whether the painted chart is that of the present scene at the accuracy of the scene.
seen.settled = () => !isAsking() && seen.painted === JSON.stringify(state.scene) && !document.body.classList.contains("stale");
// Returns whether the painted chart, which may be a draft, is that of the present scene.
seen.follows = () => seen.newest === JSON.stringify(state.scene);
seen.report = () => latest.report;
seen.speeds = () => charts.speeds;
seen.nameOf = (file) => files.nameOf(file);
seen.open = (file) => files.open(file);

// Waits for the chart of the scene and returns its identifier, or null if no chart of the scene is being computed.
async function chartOfScene() {
  while (live.isBusy && !seen.settled()) await new Promise((resolve) => setTimeout(resolve, STEP_MS));
  return seen.settled() ? latest.chart : null;
}

// Adds a pad at a position on the blade, and its partner if pads are changed in pairs.
async function addPad(place) {
  adding(false);
  const before = (made) => {
    const pad = Object.assign(made.guides.at(-1), place);
    const partner = imageOf(pad, state.pairs);
    if (partner) made.guides.push(partner);
  };
  try {
    await putIn(state, "guides[]", { before });
    select(`guides[${state.scene.guides.length - (state.pairs ? 2 : 1)}]`);
  } catch (error) {
    say(form.inWords(error));
  }
}

// Sets whether the next click on the blade adds a pad.
function adding(on) {
  blade.isAdding = on;
  by("add").setAttribute("aria-pressed", String(on));
}

// Marks a pad, the cut or the probe in the drawing and its fields in the form.
function select(path) {
  blade.select(path);
  form.select(path);
}

function onZoom(speeds) {
  by("zoomed").hidden = speeds === null;
  if (speeds) by("stretch").textContent = `${Math.round(speeds[0])} to ${Math.round(speeds[1])} rpm of the sweep`;
  pinned.zoomed(speeds);
}

// A chart of an earlier scene is marked as such if it is shown for longer than BLINK_MS.
const BLINK_MS = 400;
const STEP_MS = 20;
let shownText = null;
let ageing = null;
function watchAge() {
  ageing ??= setTimeout(() => {
    ageing = null;
    if (shownText === JSON.stringify(state.scene) || shownText === null) return;
    document.body.classList.add("earlier-scene");
    by("computed").textContent = "Chart and verdict are of the scene before the last change.";
  }, BLINK_MS);
}

function onChart(chart, request) {
  const read = performance.now();
  clearTimeout(ageing);
  ageing = null;
  shownText = request.text;
  document.body.classList.remove("earlier-scene");
  if (request.text !== JSON.stringify(state.scene)) watchAge();
  latest = chart;
  refusedKey = null;
  pinned.begin(chart);
  form.refuse(null);
  say("");
  document.body.classList.remove("stale");
  // The axes are kept until the chart after the release.
  pinned.hold(request.draft || state.isMoving);
  compare();
  if (!request.draft) weigh(chart);
  blade.draw(state.scene, null);
  if (charts.pointed || pointed.isOn) pointed.show(chart.chart, charts.pointed);
  seen.chart(request, chart.milliseconds, read, performance.now());
}

// Shows the critical speeds of a scene, and the bands with the verdict once they are known, before its chart.
function onAhead(found, request) {
  if (!latest) return;
  charts.moveAhead(found);
  const now = latest.told.facts.map((fact) => {
    const ahead = found.facts.find(({ name }) => name === fact.name);
    return { ...(ahead ?? fact), isAhead: ahead !== undefined };
  });
  facts(by("facts"), now, pinned.facts);
  ruler.show(latest.told.ruler, charts.items);
  // The numbers that decide the same answer remain until those of the chart.
  if (found.verdict && found.verdict.answer !== latest.told.verdict.answer) verdict(by("verdict"), found.verdict);
  seen.early(request, found);
}

// Requests the influence of the numbers of the form on the speeds of a chart, and shows it in the form.
let weighing = null;
async function weigh(chart) {
  weighing?.abort();
  weighing = new AbortController();
  try {
    const found = await influence(chart.chart, weighing.signal);
    if (weighing.signal.aborted || latest !== chart) return;
    form.influence(found);
    by("fields").classList.remove("unweighed");
  } catch (error) {
    // A failure is not reported, because the chart does not depend on the influence. The fields then show none.
    if (error.name !== "AbortError") form.influence([]);
  }
}

// Shows the latest chart and the saws that it is compared with.
function compare() {
  pinned.showWith(latest, by("side").checked && pinned.isNamed);
  tell();
}

// Shows an error that belongs to no field.
function say(text) {
  write(by("fault"), text);
}

function onRefused(error, request) {
  const answers = error instanceof Refused;
  if (!answers && request.draft) return;
  if (latest) compare();
  refusedKey = error.key ?? null;
  const told = form.refuse(error);
  say(told ? "" : answers ? error.message : LOST);
  // The shown chart and verdict are those of an earlier scene.
  document.body.classList.add("stale");
  blade.draw(state.scene, refusedKey);
}

function onBusy(busy, draft) {
  if (busy) waiting.begin(draft ? "draft" : "computing");
  else waiting.end();
}

function onStop() {
  live.stop();
  files.stop();
  if (seen.settled()) return false;
  // Early results of the chart that was stopped are removed.
  if (latest) compare();
  say("Chart and verdict are of the scene before the last change.");
  document.body.classList.add("stale");
  return true;
}

function tell() {
  const { report, told, milliseconds } = latest;
  verdict(by("verdict"), told.verdict);
  ruler.show(told.ruler, charts.items);
  facts(by("facts"), told.facts, pinned.facts);
  pinned.tell(told.facts);
  const parts = told.outline.filter(({ block }) => !("remark" in block));
  if (by("why").open) by("why").lastElementChild.replaceChildren(...outline(parts));
  const accuracy = report.accuracy;
  by("computed").textContent = `${accuracy.name} accuracy, ${accuracy.degrees_of_freedom} functions, `
    + `estimated error ${shown(100 * accuracy.estimated_relative_error, 2)} %, computed in ${Math.round(milliseconds)} ms`;
  list(by("unusual"), report.unusual_numbers);
  list(by("warnings"), report.warnings);
  by("campbell").setAttribute("aria-label", `Campbell diagram. ${told.verdict.word}: ${told.verdict.line}. Arrow keys walk along the branches, plus and minus magnify, 0 shows all speeds.`);
}

function list(place, sentences) {
  place.replaceChildren(...sentences.map((sentence) => Object.assign(document.createElement("li"), { textContent: sentence })));
}

function buttons() {
  const name = state.scene.name || "unnamed saw";
  write(by("name"), name);
  document.title = `${name} – sawflutter`;
  const focused = /** @type {any} */ (document.activeElement);
  by("undo").disabled = !state.canUndo;
  by("redo").disabled = !state.canRedo;
  // If the button that was pressed is disabled now, the other one gets the focus.
  if (focused.disabled) [by("undo"), by("redo")].find((button) => !button.disabled)?.focus();
  const source = state.scene.measured?.source;
  by("points").hidden = source === undefined;
  by("source").textContent = source ?? "";
  by("source").title = source ?? "";
  const { target } = files;
  by("write").hidden = target === null;
  by("write").textContent = target ? `Save to ${target.name}` : "";
  by("write").title = by("write").textContent;
  by("write").disabled = !target?.differs;
  const copy = first("[data-save='scene.json']");
  copy.textContent = target ? "Save a copy" : "Save saw";
  copy.classList.toggle("main", target === null);
  by("pin").disabled = pinned.isFull;
  by("sides").hidden = !pinned.isNamed;
}

function pin() {
  const name = prompt("Name of the reference", state.scene.name ?? "reference");
  if (name === null) return;
  pinned.pin(latest, name.trim() || "reference");
  compare();
  buttons();
}

const INCHES = "sawflutter inches";
// Shows lengths in inches or millimetres; the scene does not change.
function measure(on) {
  by("inches").checked = on;
  useInches(on);
  form.build();
  tasks.changed();
  try {
    localStorage.setItem(INCHES, on ? "1" : "");
  } catch {
    // Without the storage of the browser, the choice lasts until the page is closed.
  }
}

// Returns whether an element contains a text that is not in the scene. The browser's own undo then applies to the text.
function isBeingTyped(element) {
  if (!element.matches("input[type=text], textarea")) return false;
  return !by("fields").contains(element) || element.value !== element.defaultValue;
}

// Closes a menu when an entry is chosen, when the pointer or the focus moves elsewhere, and on Escape. Checkboxes and
// the button that copies the link leave it open.
function menu(place) {
  const close = () => (place.open = false);
  place.addEventListener("click", (event) => event.target.closest("button") && event.target.id !== "link" && close());
  place.addEventListener("change", (event) => event.target.type !== "checkbox" && close());
  place.addEventListener("focusout", (event) => event.relatedTarget && !place.contains(event.relatedTarget) && close());
  addEventListener("pointerdown", (event) => !place.contains(event.target) && close());
  place.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    close();
    place.querySelector("summary").focus();
  });
}

function wire() {
  by("fields").addEventListener("focusin", (event) => select(form.partOf(event.target)));
  by("undo").addEventListener("click", () => state.undo());
  by("redo").addEventListener("click", () => state.redo());
  by("pin").addEventListener("click", pin);
  by("add").addEventListener("click", () => adding(!blade.isAdding));
  addEventListener("keydown", (event) => event.key === "Escape" && adding(false));
  by("pairs").addEventListener("change", (event) => (state.pairs = event.target.value));
  by("link").addEventListener("click", () => files.copyLink(by("link")));
  by("all").addEventListener("click", () => charts.zoom(null));
  by("over").addEventListener("click", () => {
    by("restored").hidden = true;
    files.startOver();
  });
  by("why").addEventListener("toggle", () => latest && tell());
  by("side").addEventListener("change", compare);
  by("inches").addEventListener("change", (event) => measure(event.target.checked));
  by("measured").addEventListener("change", (event) => charts.showMeasured(event.target.checked));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (!file) return;
    // The handle is requested at once, because the dropped items are only available during the event.
    const handle = /** @type {any} */ (event.dataTransfer.items[0]).getAsFileSystemHandle?.() ?? Promise.resolve(null);
    handle.catch(() => null).then((found) => files.open(file, found));
  });
  addEventListener("beforeunload", (event) => {
    if (!files.isSaved && !kept.works) event.preventDefault();
  });
  by("write").addEventListener("click", async () => {
    await files.write();
    buttons();
  });
  by("open").addEventListener("click", async (event) => {
    if (!("showOpenFilePicker" in globalThis)) return;
    // This dialog, unlike that of the input element, gives a handle by which the page can save to the file.
    event.preventDefault();
    const [handle] = await /** @type {any} */ (globalThis).showOpenFilePicker().catch(() => []);
    if (handle) await files.open(await handle.getFile(), handle);
  });
  by("open").addEventListener("change", async (event) => {
    if (event.target.files[0]) await files.open(event.target.files[0]);
    // An empty value allows the user to choose the same file again.
    event.target.value = "";
  });
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-save]"))) {
    button.addEventListener("click", () => files.save(button.dataset.save));
  }
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || isBeingTyped(event.target)) return;
    const undo = event.key === "z" && !event.shiftKey;
    const redo = event.key === "y" || (event.key.toLowerCase() === "z" && event.shiftKey);
    if (undo) state.undo();
    if (redo) state.redo();
    if (undo || redo) event.preventDefault();
  });
  // The colour scheme may change while the page is printed, so the medium is stored.
  let onPaper = false;
  const recolour = (printed = onPaper) => {
    onPaper = printed;
    colours = publish(begun.colours, onPaper);
    charts.setColours(colours);
    pinned.setColours(colours);
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => recolour());
  addEventListener("beforeprint", () => recolour(true));
  addEventListener("afterprint", () => recolour(false));
  by("print").addEventListener("click", () => print());
  menu(document.querySelector(".menu"));
  dock(by("campbell"));
  stayConnected((lost) => {
    // A program that was started again does not have the earlier charts.
    if (!lost && !by("lost").hidden) {
      form.readAgain();
      live.again(state.scene);
    }
    by("lost").hidden = !lost;
  });
}

await document.fonts.load("12px Inter");
wire();
files.offerExamples(by("examples"));
measure(localStorage.getItem(INCHES) === "1");
buttons();
document.body.classList.remove("loading");
blade.draw(state.scene, null);
pointed.hint();
await files.restore(by("restored"));
if (!live.asked) live.ask(state.scene, { draft: false });
