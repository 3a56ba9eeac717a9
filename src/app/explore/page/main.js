// Connects the modules of the page: each change of the scene requests a chart, which is shown when it arrives.

import { Answers } from "./answers.js";
import { LOST } from "./backend.js";
import { Blade } from "./blade.js";
import { Charts } from "./charts.js";
import { publish } from "./colours.js";
import { describe } from "./fields.js";
import { Files } from "./files.js";
import { Form } from "./form.js";
import { offerExamples, welcome } from "./gallery.js";
import { Kept } from "./kept.js";
import { Live } from "./live.js";
import { imageOf } from "./pairs.js";
import { isAsking, putIn } from "./parts.js";
import { Pinned } from "./pinned.js";
import { Pointed } from "./pointed.js";
import { Result } from "./result.js";
import { Ruler } from "./ruler.js";
import { SceneState, sawOf } from "./scene.js";
import { sheet } from "./sheet.js";
import { Tabs } from "./tabs.js";
import { progress, start, stayConnected } from "./talk.js";
import { Times } from "./times.js";
import { dock } from "./dock.js";
import { by, explain, learn, write } from "./dom.js";
import { toolbar } from "./toolbar.js";
import { Waiting } from "./waiting.js";

const begun = await start();
describe(begun.fields);
learn(begun.glossary);
let colours = publish(begun.colours);
const kept = new Kept(begun.scene);

const state = new SceneState(begun.scene, (scene, { draft, structure, stamp, released }) => {
  result.begin(draft);
  live.ask(scene, { draft, stamp, released });
  answers.refresh();
  if (structure) form.build();
  else form.refresh(draft);
  ruler.refresh();
  blade.draw(scene);
  if (draft) return;
  endWelcome();
  blade.isHinting = false;
  pointed.hint();
  tools.refresh();
  files.changed(scene);
  tabs.refresh();
});
const answers = new Answers(state);
const times = new Times();
const blade = new Blade(by("drawing"), state, { onSelect: select, onAdd: addPad });
const pointed = new Pointed({
  canvas: by("motion"), words: by("mode"), film: by("film"), mark: blade.mark, colours: () => colours, scene: () => state.scene,
  nameOf: (file) => files.nameOf(file),
});
const files = new Files(state, kept, begun, {
  say, notify, refusal: () => result.refusal, onReplaced: () => pinned.reset(), onChanged: conflict, onBusy: (what) => (what ? waiting.begin(what) : waiting.end()), shown: chartOfScene,
});
const ruler = new Ruler(by("ruler"), state);
const form = new Form(by("fields"), begun, state, say);
const charts = new Charts(by("campbell"), by("growth"), colours, { onHover: (point) => pointed.show(result.latest.chart, point), onZoom });
const pinned = new Pinned(by("beside"), by("pinned"), charts, () => {
  if (!pinned.isNamed) by("side").checked = false;
  result.compare();
  tools.refresh();
});
const result = new Result({ answers, blade, charts, form, pinned, pointed, ruler, say, state, times });
const tabs = new Tabs(by("tabs"), by("panels"), state, begun, answers, {
  onTab: select,
  onScene: (scene) => state.replace(scene),
  inWords: (refusal) => form.inWords(refusal),
  nameOf: (file) => files.nameOf(file),
  colours: () => colours,
});
const tools = toolbar({ state, files, kept, pinned, charts, blade, form, tabs, result, select, adding, endWelcome });
const live = new Live(result, (busy, draft) => (busy ? waiting.begin(draft ? "draft" : "computing") : waiting.end()));
const waiting = new Waiting(by("waiting"), { onStop, onAgain: again, ask: progress });

// Read by the browser test: times, and the state of the page.
const seen = Object.assign(times, {
  state,
  // Returns whether the painted chart is that of the present scene at the accuracy of the scene.
  settled: () => !isAsking() && times.painted === sawOf(state.scene) && !seen.isEarlier(),
  // Returns whether the painted chart, which may be a draft, is that of the present scene.
  follows: () => times.newest === sawOf(state.scene),
  // Returns whether the page shows that its chart is one of an earlier scene.
  isEarlier: () => by("result").classList.contains("earlier"),
  report: () => result.latest.report,
  speeds: () => charts.speeds,
  nameOf: (file) => files.nameOf(file),
  open: (file) => files.open(file),
  reveal: (path) => form.reveal(path),
});
Object.assign(globalThis, { sawflutter: seen });

// Waits for the chart of the scene and returns its identifier, or null if no chart of the scene is being computed.
async function chartOfScene() {
  while (live.isBusy && !seen.settled()) await new Promise((resolve) => setTimeout(resolve, 20));
  return seen.settled() ? result.latest.chart : null;
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

function adding(on) {
  blade.isAdding = on;
  by("add").setAttribute("aria-pressed", String(on));
}

function select(path) {
  blade.select(path);
  form.select(path);
}

function again() {
  result.begin(false);
  live.again(state.scene);
}

// Removes the cards of the first visit, and gives their room to the chart.
function endWelcome() {
  if (by("welcome").hidden) return;
  by("welcome").hidden = true;
  charts.resize();
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

function say(text) {
  write(by("fault"), text);
}

// Shows a message that stays until it is closed.
function notify(text) {
  by("notice").hidden = text === "";
  write(by("notice").firstElementChild, text);
}

function onStop() {
  live.stop();
  files.stop();
  if (seen.settled()) return false;
  result.halt();
  say(by("outdated").textContent);
  return true;
}

// Colours the page for the screen or for paper. The scheme may change while the page is printed, so the medium is stored.
let onPaper = false;
function recolour(printed = onPaper) {
  onPaper = printed;
  colours = publish(begun.colours, onPaper);
  charts.setColours(colours);
  pinned.setColours(colours);
  tabs.refresh();
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => recolour());
addEventListener("beforeprint", () => {
  sheet(by("printed"), state.scene, begun.version);
  recolour(true);
});
addEventListener("afterprint", () => recolour(false));
// The blade that moves makes way for the one whose parts can be dragged.
by("drawing").addEventListener("pointerenter", () => charts.point(null));
dock(by("answer"), by("campbell"));
stayConnected((lost) => {
  // A program that was started again does not have the earlier charts.
  if (!lost && !by("lost").hidden) {
    for (const place of document.querySelectorAll("#fault, .fault")) if (place.textContent === LOST) place.textContent = "";
    form.readAgain();
    again();
  }
  by("lost").hidden = !lost;
});
explain(by("key"));
await document.fonts.load("12px Inter");
offerExamples(by("examples"), begun.examples, (example) => files.choose(example));
tools.measure();
tools.refresh();
document.body.classList.remove("loading");
blade.draw(state.scene);
pointed.hint();
if (!(await files.restore(by("restored"))) && !begun.file) {
  blade.isHinting = welcome(by("welcome"), begun.examples, { end: endWelcome, choose: (example) => files.choose(example), open: () => by("open").click() });
  charts.resize();
}
if (!live.asked) live.ask(state.scene, { draft: false });
