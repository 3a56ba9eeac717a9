// Charts of a scene that keeps changing. The server computes one chart at a time. A change that does not end a drag is
// drawn as a draft first, which takes about a tenth of the time. Drafts of scenes that were replaced
// while the server computed are never requested. A final chart, and any change after one was requested, aborts the chart that
// is being computed. Critical speeds, and then bands with the verdict, arrive before their chart. If a draft takes long,
// the critical speeds of the newest scene are requested separately.

import { sawOf } from "./scene.js";
import { chart, criticalSpeeds } from "./talk.js";

// If the pointer does not move for this time during a drag, the chart is computed at the accuracy of the scene, so that
// nothing is left to compute after the release.
const REST_MS = 150;

// Time budget of a draft, after which the critical speeds of the newest scene are requested beside it. Without a budget
// the critical speeds of the built-in saw come earlier (31 instead of 94 ms after a move), but its chart comes later
// (207 instead of 176 ms) and its verdict only with the chart.
const BUDGET_MS = 200;

export class Live {
  #count = 0;
  #computing = null;
  #next = null;
  // The chart that was shown last, and its request.
  #shown = null;
  #rest = 0;
  // The newest early results, and their request.
  #ahead = null;
  #isLookingAhead = false;

  // `result` shows what arrives; `onBusy(busy, draft)` is called when a chart begins and when none is computed any more.
  constructor(result, onBusy) {
    this.result = result;
    this.onBusy = onBusy;
  }

  get asked() {
    return this.#count > 0;
  }

  get isBusy() {
    return this.#computing !== null;
  }

  // Cancels the chart that is being computed and drops the next request.
  stop() {
    clearTimeout(this.#rest);
    this.#next = null;
    const running = this.#computing;
    if (!running) return;
    running.abort.abort();
    this.#proceed(running);
  }

  // Requests the chart of a scene. `stamp` is the time of the move that changed the scene, `released` the time at which
  // a drag ended.
  ask(scene, { draft, stamp = undefined, released = undefined }) {
    clearTimeout(this.#rest);
    const [text, saw] = [JSON.stringify(scene), sawOf(scene)];
    // The request takes over the moves of drafts that were never computed, because its chart contains them.
    const { stamps = [], counted = {} } = this.#next ?? {};
    if (stamp !== undefined) stamps.push(stamp);
    if (!draft && this.#adopted(saw, stamps, released)) return;
    const isFirst = !draft && released === undefined;
    this.#next = { text, saw, draft: draft || isFirst, isFirst, stamps, counted, released, number: ++this.#count };
    const running = this.#computing;
    if (running && (!draft || !running.draft)) {
      stamps.unshift(...running.stamps);
      running.abort.abort();
      this.#computing = null;
    }
    if (!this.#computing) this.#run(this.#next);
    else this.#lookAhead();
  }

  // Requests the critical speeds of the newest scene while a draft exceeds its budget, one request at a time.
  async #lookAhead() {
    if (this.#isLookingAhead) return;
    this.#isLookingAhead = true;
    let last = null;
    while (this.#next?.draft && this.#next !== last) {
      const left = this.#computing.asked + BUDGET_MS - performance.now();
      if (left > 0) await new Promise((resolve) => setTimeout(resolve, left));
      if (left > 0) continue;
      last = this.#next;
      // A refusal is ignored, because the chart reports it.
      const found = await criticalSpeeds(last.text).catch(() => null);
      if (found) this.#showAhead(found, last);
    }
    this.#isLookingAhead = false;
  }

  // Shows results before their chart, unless those of a newer scene are shown. If only the critical speeds of a newer
  // scene are known, they are shown with these bands.
  #showAhead(found, request) {
    if (request.number < (this.#shown?.request.number ?? 0)) return;
    const newer = this.#ahead && this.#ahead.request.number > request.number ? this.#ahead.found : null;
    if (newer && (newer.bands || !found.bands)) return;
    if (newer) {
      const ofBands = found.facts.filter((fact) => newer.facts.every(({ name }) => name !== fact.name));
      this.result.showAhead({ ...found, critical: newer.critical, facts: [...newer.facts, ...ofBands] }, request);
      return;
    }
    this.#ahead = { found, request };
    this.result.showAhead(found, request);
  }

  // Requests the final chart again, also if it is shown.
  again(scene) {
    this.#shown = null;
    this.ask(scene, { draft: false });
  }

  // Uses the final chart of this saw if it is being computed, because it was requested while the pointer rested, or if it
  // is shown, because only the name of the scene has changed or a change was taken back. Returns whether it is being computed or shown.
  #adopted(saw, stamps, released) {
    const [running, shown] = [this.#computing, this.#shown];
    if (running && (!running.draft || running.isFirst) && running.saw === saw) {
      running.stamps.push(...stamps);
      running.released = released;
      return true;
    }
    if (!shown || shown.request.draft || shown.request.saw !== saw) return false;
    this.stop();
    this.onBusy(false);
    shown.request.number = ++this.#count;
    this.result.show(shown.chart, { ...shown.request, stamps, released });
    return true;
  }

  async #run(request) {
    this.#next = null;
    this.#computing = request;
    request.abort = new AbortController();
    // Times of request and answer. The budget of a draft and the browser test use them.
    request.asked = performance.now();
    this.onBusy(true, request.draft);
    let found;
    try {
      found = await chart(request.text, request.draft, request.abort.signal, (ahead) => this.#showAhead(ahead, request));
      request.answered = performance.now();
      // The server computes the next chart while this one is drawn.
      this.#proceed(request);
    } catch (error) {
      this.#proceed(request);
      if (!request.abort.signal.aborted) this.result.refuse(error, request);
      return;
    }
    this.#show(found, request);
  }

  #proceed(request) {
    if (this.#computing !== request) return;
    this.#computing = null;
    if (this.#next) this.#run(this.#next);
    else this.onBusy(false, request.draft);
  }

  #show(found, request) {
    // A final chart is shown only if the scene has not changed since; a draft, if no newer chart is shown.
    const passed = request.draft ? request.number < (this.#shown?.request.number ?? 0) : request.number !== this.#count;
    if (passed) return;
    this.#shown = { chart: found, request };
    this.result.show(found, request);
    const ahead = this.#ahead;
    if (ahead && ahead.request.number > request.number) this.result.showAhead(ahead.found, ahead.request);
    if (!request.draft || this.#computing) return;
    const complete = () => this.#run({ ...request, draft: false, isFirst: false, stamps: [], number: ++this.#count });
    if (request.isFirst) complete();
    else this.#rest = setTimeout(complete, REST_MS);
  }
}
