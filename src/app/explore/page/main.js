// Connects the modules of the page: each change of the scene requests a chart, which is shown when it arrives.

import { LOST, PLACE } from "./backend.js";
import { Blade } from "./blade.js";
import { Charts } from "./charts.js";
import { publish } from "./colours.js";
import { describe } from "./fields.js";
import { Form } from "./form.js";
import { offerExamples, welcome } from "./gallery.js";
import { Files } from "./files.js";
import { Kept } from "./kept.js";
import { Live } from "./live.js";
import { facts, outline, verdict } from "./outline.js";
import { imageOf } from "./pairs.js";
import { isAsking, putIn } from "./parts.js";
import { Pinned } from "./pinned.js";
import { Pointed } from "./pointed.js";
import { Ruler } from "./ruler.js";
import { SceneState, sawOf } from "./scene.js";
import { Refused, influence, progress, start, stayConnected } from "./talk.js";
import { Tasks } from "./tasks.js";
import { Times } from "./times.js";
import { dock } from "./dock.js";
import { explain, learn, write } from "./dom.js";
import { toolbar } from "./toolbar.js";
import { Waiting } from "./waiting.js";
import { shown } from "./words.js";

/** @returns {any} */
const by = (id) => document.getElementById(id);
const begun = await start();
describe(begun.fields);
learn(begun.glossary);
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
  by("fields").classList.toggle("earlier", sawOf(scene) !== shownSaw);
  if (structure) form.build();
  form.refresh(draft);
  ruler.refresh();
  blade.draw(scene, refusedKey);
  if (draft) return;
  pointed.hint();
  tools.refresh();
  files.changed(scene);
  tasks.changed();
});
const blade = new Blade(by("drawing"), state, { onSelect: (path) => select(path), onAdd: addPad });
const pointed = new Pointed({
  canvas: by("motion"), words: by("mode"), film: by("film"), mark: blade.mark, colours: () => colours, scene: () => state.scene,
  nameOf: (file) => files.nameOf(file),
});
const files = new Files(state, kept, begun, {
  say, onReplaced: () => pinned.reset(), onChanged: conflict, onBusy: (what) => (what ? waiting.begin(what) : waiting.end()), shown: chartOfScene,
});
const ruler = new Ruler(by("ruler"), state);
const form = new Form(by("fields"), begun, state, say);
const charts = new Charts(by("campbell"), by("growth"), colours, { onHover: (point) => pointed.show(latest.chart, point), onZoom });
const pinned = new Pinned(by("beside"), by("pinned"), charts, () => {
  if (!pinned.isNamed) by("side").checked = false;
  compare();
  tools.refresh();
});
const tasks = new Tasks(by("tabs"), by("panels"), state, begun, {
  onTab: (part) => select(part),
  onScene: (scene) => state.replace(scene),
  inWords: (refusal) => form.inWords(refusal),
  nameOf: (file) => files.nameOf(file),
  colours: () => colours,
});
const tools = toolbar({ state, files, kept, pinned, charts, blade, form, tasks, pin, compare, select, adding });
const live = new Live({ onChart, onAhead, onRefused, onBusy });
const waiting = new Waiting(by("waiting"), { onStop, onAgain: () => live.again(state.scene), ask: progress });
seen.state = state;
// Returns whether the painted chart is that of the present scene at the accuracy of the scene.
seen.settled = () => !isAsking() && seen.painted === sawOf(state.scene) && !seen.isEarlier();
// Returns whether the painted chart, which may be a draft, is that of the present scene.
seen.follows = () => seen.newest === sawOf(state.scene);
// Returns whether the page shows that its chart is one of an earlier scene.
seen.isEarlier = () => by("result").classList.contains("earlier");
seen.report = () => latest.report;
seen.speeds = () => charts.speeds;
seen.nameOf = (file) => files.nameOf(file);
seen.open = (file) => files.open(file);
seen.reveal = (path) => form.reveal(path);

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

// Offers to load or to overwrite the file of the saw, which another program has changed.
function conflict(name) {
  by("conflict").hidden = false;
  by("conflict").firstElementChild.textContent = `Another program has changed ${name}.`;
}

function onZoom(speeds) {
  by("zoomed").hidden = speeds === null;
  if (speeds) by("stretch").textContent = `${Math.round(speeds[0])} to ${Math.round(speeds[1])} rpm of the sweep`;
  pinned.zoomed(speeds);
}

// A chart of an earlier scene is marked as such if it is shown for longer than BLINK_MS, or if no other one will come.
const BLINK_MS = 400;
const STEP_MS = 20;
const EARLIER = "Chart and verdict are of the scene before the last change.";
let shownSaw = null;
let ageing = null;
function watchAge() {
  ageing ??= setTimeout(age, BLINK_MS);
}

function age() {
  if (shownSaw === null || shownSaw === sawOf(state.scene)) return rejuvenate();
  by("result").classList.add("earlier");
  by("computed").textContent = EARLIER;
  return undefined;
}

function rejuvenate() {
  clearTimeout(ageing);
  ageing = null;
  by("result").classList.remove("earlier");
}

function onChart(chart, request) {
  const read = performance.now();
  shownSaw = request.saw;
  rejuvenate();
  if (request.saw !== sawOf(state.scene)) watchAge();
  latest = chart;
  refusedKey = null;
  pinned.begin(chart);
  form.refuse(null);
  say("");
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
    by("fields").classList.remove("earlier");
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
  age();
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
  say(EARLIER);
  age();
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
    + `estimated error ${shown(100 * accuracy.estimated_relative_error, 2)} %, computed in ${Math.round(milliseconds)} ms${PLACE}`;
  list(by("unusual"), report.unusual_numbers);
  list(by("warnings"), report.warnings);
  by("campbell").setAttribute("aria-label", `Campbell diagram. ${told.verdict.word}: ${told.verdict.line}. Arrow keys walk along the branches, plus and minus magnify, 0 shows all speeds.`);
}

function list(place, sentences) {
  place.replaceChildren(...sentences.map((sentence) => Object.assign(document.createElement("li"), { textContent: sentence })));
}

function pin() {
  pinned.pin(latest);
  compare();
  tools.refresh();
}

// Colours the page for the screen or for paper. The scheme may change while the page is printed, so the medium is stored.
let onPaper = false;
function recolour(printed = onPaper) {
  onPaper = printed;
  colours = publish(begun.colours, onPaper);
  charts.setColours(colours);
  pinned.setColours(colours);
  tasks.changed();
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => recolour());
addEventListener("beforeprint", () => recolour(true));
addEventListener("afterprint", () => recolour(false));
// The blade that moves makes way for the one whose parts can be dragged.
by("drawing").addEventListener("pointerenter", () => charts.point(null));
by("why").addEventListener("toggle", () => latest && tell());
dock(by("campbell"));
stayConnected((lost) => {
  // A program that was started again does not have the earlier charts.
  if (!lost && !by("lost").hidden) {
    for (const place of document.querySelectorAll("#fault, .fault")) if (place.textContent === LOST) place.textContent = "";
    form.readAgain();
    live.again(state.scene);
  }
  by("lost").hidden = !lost;
});
explain(by("key"));
await document.fonts.load("12px Inter");
offerExamples(by("examples"), begun.examples, (example) => files.choose(example));
tools.measure();
tools.refresh();
document.body.classList.remove("loading");
blade.draw(state.scene, null);
pointed.hint();
if (!(await files.restore(by("restored"))) && !begun.file) {
  blade.isHinting = welcome(by("welcome"), begun.examples, { choose: (example) => files.choose(example), open: () => by("open").click() });
}
if (!live.asked) live.ask(state.scene, { draft: false });
