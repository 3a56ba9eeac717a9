// Shows what is being computed. After a second, it also shows the time, the progress and a button that stops the
// computation, so that nothing appears and disappears during short computations.

import { node, write } from "./dom.js";

const MOMENT_MS = 1000;
const STEP_MS = 400;

export class Waiting {
  #begun = 0;
  #ticking = 0;
  #what = "";

  // `onStop()` stops the computation and returns whether the chart of the scene is missing, `onAgain()` starts it
  // again, and `ask()` returns its progress.
  constructor(place, { onStop, onAgain, ask }) {
    this.place = place;
    this.ask = ask;
    this.words = node("span", { id: "busy", role: "status" });
    this.bar = node("progress", { hidden: true, max: 1, "aria-label": "Share of this step that is done" });
    const end = () => {
      const isStopped = onStop();
      this.#show({ isStopped });
      // This button replaces the one that was pressed.
      if (isStopped) this.again.focus();
    };
    this.stop = node("button", { type: "button", id: "stop", textContent: "Stop", hidden: true, onclick: end });
    this.again = node("button", { type: "button", id: "again", textContent: "Compute", hidden: true, onclick: onAgain });
    place.append(this.words, this.bar, this.stop, this.again);
  }

  begin(what) {
    this.end();
    [this.#begun, this.#what] = [performance.now(), what];
    this.#show({});
    this.#ticking = setInterval(() => this.#tick(), STEP_MS);
  }

  end() {
    clearInterval(this.#ticking);
    this.#ticking = 0;
    this.#what = "";
    this.#show({});
  }

  async #tick() {
    const waited = performance.now() - this.#begun;
    if (waited < MOMENT_MS) return;
    const ticking = this.#ticking;
    const stage = await this.ask().catch(() => null);
    if (this.#ticking !== ticking || ticking === 0) return;
    this.#show({ stage, seconds: Math.round(waited / 1000) });
  }

  #show({ stage = null, seconds = 0, isStopped = false }) {
    const isStep = stage?.of > 0;
    const steps = isStep ? `, ${stage.what}: ${stage.done} of ${stage.of}` : stage ? `, ${stage.eigenproblems} eigenproblems` : "";
    write(this.words, isStopped ? "stopped" : this.#what && `${this.#what} …${seconds > 0 ? ` ${seconds} s` : ""}${steps}`);
    const hadFocus = document.activeElement === this.stop;
    this.stop.hidden = seconds === 0;
    this.again.hidden = !isStopped;
    this.bar.hidden = !isStep;
    if (isStep) this.bar.value = stage.done / stage.of;
    this.place.hidden = this.#what === "" && !isStopped;
    if (hadFocus && this.stop.hidden && !isStopped) document.getElementById("campbell").focus({ preventScroll: true });
  }
}
