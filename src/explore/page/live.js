// Charts of a scene that keeps changing. The server computes one at a time: sketches that were
// passed while it computed are never asked for; a final chart, and any change after one was asked
// for, aborts what runs, and the server stops computing it. Critical speeds are known long before a
// sketch: those of the newest scene are asked for beside it.

import { chart, criticalSpeeds } from "./talk.js";

// A hand that rests so long while it holds something is shown the chart at its own accuracy: after
// the release nothing is left to compute.
const REST_MS = 150;

export class Live {
  #count = 0;
  #computing = null;
  #next = null;
  // The newest that was shown.
  #shown = null;
  #rest = 0;
  // The newest sketch whose critical speeds were not asked for yet.
  #ahead = null;
  #isAhead = false;

  constructor({ onChart, onCritical, onRefused, onBusy }) {
    this.onChart = onChart;
    this.onCritical = onCritical;
    this.onRefused = onRefused;
    this.onBusy = onBusy;
  }

  // Whether anything was asked for yet.
  get asked() {
    return this.#count > 0;
  }

  // Whether a chart is being computed.
  get isBusy() {
    return this.#computing !== null;
  }

  // Nothing is computed until it is asked for again.
  stop() {
    clearTimeout(this.#rest);
    this.#next = this.#ahead = null;
    const running = this.#computing;
    if (!running) return;
    running.abort.abort();
    this.#proceed(running);
  }

  // `stamp` is when the hand moved, `released` when it let go.
  ask(scene, { draft, stamp = undefined, released = undefined }) {
    clearTimeout(this.#rest);
    const text = JSON.stringify(scene);
    // Every move waits for the chart that has it in, also those that were passed.
    const stamps = this.#next?.stamps ?? [];
    if (stamp !== undefined) stamps.push(stamp);
    if (!draft && this.#adopted(text, stamps, released)) return;
    this.#next = { text, draft, stamps, released, number: ++this.#count };
    this.#ahead = draft ? { text, number: this.#count, stamps: [...(this.#ahead?.stamps ?? []), ...(stamp === undefined ? [] : [stamp])] } : null;
    const running = this.#computing;
    if (running && (!draft || !running.draft)) {
      stamps.unshift(...running.stamps);
      running.abort.abort();
      this.#computing = null;
    }
    if (!this.#computing) this.#run(this.#next);
    this.#lookAhead();
  }

  // One request at a time, each for the newest scene.
  async #lookAhead() {
    if (this.#isAhead) return;
    this.#isAhead = true;
    while (this.#ahead) {
      const asked = this.#ahead;
      this.#ahead = null;
      // What is refused, the chart says.
      const found = await criticalSpeeds(asked.text).catch(() => null);
      const isPassed = asked.number <= (this.#shown?.request.number ?? 0);
      if (found) this.onCritical(found, { ...asked, isPassed });
    }
    this.#isAhead = false;
  }

  // Asks for the final chart anew, also where it is shown.
  again(scene) {
    this.#shown = null;
    this.ask(scene, { draft: false });
  }

  // Whether the final chart of this scene was begun or shown while the hand rested.
  #adopted(text, stamps, released) {
    const [running, shown] = [this.#computing, this.#shown];
    if (running && !running.draft && running.text === text) {
      running.stamps.push(...stamps);
      running.released = released;
      return true;
    }
    const isNewest = shown && shown.request.number === this.#count;
    if (!isNewest || shown.request.draft || shown.request.text !== text) return false;
    this.onChart(shown.chart, { ...shown.request, stamps, released });
    return true;
  }

  async #run(request) {
    this.#next = null;
    this.#computing = request;
    request.abort = new AbortController();
    // For the test in a browser, as when it was answered.
    request.asked = performance.now();
    this.onBusy(true, request.draft);
    let found;
    try {
      const answer = await chart(request.text, request.draft, request.abort.signal);
      request.answered = performance.now();
      // The server is free: it computes the next one while this one is read and drawn.
      this.#proceed(request);
      found = await answer.json();
    } catch (error) {
      this.#proceed(request);
      if (!request.abort.signal.aborted) this.onRefused(error, request);
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
    // A final chart is of the scene as it is, or it is not shown.
    const passed = request.draft ? request.number < (this.#shown?.request.number ?? 0) : request.number !== this.#count;
    if (passed) return;
    this.#shown = { chart: found, request };
    this.onChart(found, request);
    if (!request.draft || this.#computing) return;
    this.#rest = setTimeout(() => this.#run({ ...request, draft: false, stamps: [], number: ++this.#count }), REST_MS);
  }
}
