// The result for the scene, as it arrives: critical speeds and bands before their chart, the chart with verdict, numbers and
// warnings, the influences of the numbers, or a refusal.

import { LOST, PLACE } from "./backend.js";
import { by, node } from "./dom.js";
import { facts, outline, verdict } from "./outline.js";
import { inForm } from "./phrases.js";
import { sawOf } from "./scene.js";
import { Refused, influence } from "./talk.js";
import { shown } from "./words.js";

// A chart of an earlier scene is marked if it stays for longer than this.
const BLINK_MS = 400;

const list = (id, sentences) => by(id).replaceChildren(...sentences.map((text) => node("li", { textContent: inForm(text) })));

export class Result {
  // Chart that was shown last, as the program sends it, or null.
  latest = null;
  // Why the present scene is refused; empty if it is not.
  refusal = "";
  #weighing = null;

  // `page` has the parts of the page that show the result, and `say(text)`, which shows an error that belongs to no field.
  constructor(page) {
    this.page = page;
    by("why").addEventListener("toggle", () => this.latest && this.#tell());
  }

  show(chart, request) {
    const { answers, blade, charts, pinned, pointed, state, times } = this.page;
    const read = performance.now();
    this.latest = chart;
    answers.show(by("result"), (scene) => sawOf(scene) === request.saw, BLINK_MS);
    if (!request.draft) pinned.begin(chart);
    this.#accept();
    // The axes are kept until the chart after the release.
    pinned.hold((request.draft && !request.isFirst) || state.isMoving);
    this.compare();
    if (!request.draft) this.#weigh(chart, request.saw);
    blade.draw(state.scene, null);
    if (charts.pointed || pointed.isOn) pointed.show(chart.chart, charts.pointed);
    times.chart(request, chart.milliseconds, read, performance.now());
  }

  // Shows the critical speeds of a scene, and the bands with the verdict once they are known, before its chart.
  showAhead(found, request) {
    if (!this.latest) return;
    const { charts, pinned, ruler, times } = this.page;
    const { told } = this.latest;
    charts.moveAhead(found);
    const now = told.facts.map((fact) => {
      const ahead = found.facts.find(({ name }) => name === fact.name);
      return { ...(ahead ?? fact), isAhead: ahead !== undefined };
    });
    facts(by("facts"), now, pinned.facts);
    ruler.show(told.ruler, charts.items);
    if (found.verdict) verdict(by("verdict"), { ...found.verdict, isAhead: true });
    times.early(request, found);
  }

  refuse(error, request) {
    const { blade, form, say, state } = this.page;
    const answers = error instanceof Refused;
    if (!answers && request.draft && !request.isFirst) return;
    const isAtField = form.refuse(error);
    if (answers) list("unusual", error.unusual);
    const reason = answers ? form.inWords(error) : LOST;
    say(isAtField ? "" : reason);
    this.refusal = answers ? reason : "";
    this.#say("Not computed", reason);
    this.end();
    blade.draw(state.scene, error.key ?? null);
  }

  // Cancels what is computed from the chart of an earlier scene. Unless the scene keeps changing, its refusal and early
  // results are those of an earlier one, too.
  begin(draft) {
    this.#weighing?.abort();
    if (draft) return;
    this.#accept();
    for (const ahead of by("result").querySelectorAll(".ahead")) ahead.classList.remove("ahead");
  }

  // Removes the refusal of an earlier scene.
  #accept() {
    this.refusal = "";
    this.#say("Computing …");
    this.page.form.refuse(null);
    this.page.say("");
  }

  // Says that the chart of the scene will not come because the user has stopped it.
  halt() {
    this.end();
    this.#say("Not computed", "stopped");
  }

  // The words in the place of the verdict while the chart is one of an earlier scene.
  #say(word, line = "") {
    verdict(by("instead"), { word, line });
  }

  // Shows the latest chart, without early results of one that will not come.
  end() {
    if (this.latest) this.compare();
    this.page.answers.end(by("result"));
  }

  compare() {
    const { pinned } = this.page;
    pinned.showWith(this.latest, by("side").checked && pinned.isNamed);
    this.#tell();
  }

  // Requests the influence of the numbers of the form on the speeds of a chart, and shows it in the form.
  async #weigh(chart, saw) {
    this.#weighing?.abort();
    const { signal } = (this.#weighing = new AbortController());
    try {
      const found = await influence(chart.chart, signal);
      if (signal.aborted || this.latest !== chart) return;
      this.page.form.influence(found);
      this.page.answers.show(by("fields"), (scene) => sawOf(scene) === saw);
    } catch (error) {
      // A failure is not reported, because the chart does not depend on the influence. The fields then show none.
      if (error.name !== "AbortError") this.page.form.influence([]);
    }
  }

  #tell() {
    const { charts, pinned, ruler } = this.page;
    const { report: { accuracy, unusual_numbers, warnings }, told, milliseconds } = this.latest;
    verdict(by("verdict"), told.verdict);
    ruler.show(told.ruler, charts.items);
    facts(by("facts"), told.facts, pinned.facts);
    pinned.tell(told.facts);
    const parts = told.outline.filter(({ block }) => !("remark" in block));
    if (by("why").open) by("why").lastElementChild.replaceChildren(...outline(parts));
    by("computed").textContent = `${accuracy.name} accuracy, ${accuracy.degrees_of_freedom} functions, `
      + `estimated error ${shown(100 * accuracy.estimated_relative_error, 2)} %, computed in ${Math.round(milliseconds)} ms${PLACE}`;
    list("unusual", unusual_numbers);
    list("warnings", warnings);
    by("campbell").setAttribute("aria-label", `Campbell diagram. ${told.verdict.word}: ${told.verdict.line}. Arrow keys walk along the branches, plus and minus magnify, 0 shows all speeds.`);
  }
}
