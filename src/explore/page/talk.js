// Everything that is asked of the server.

export class Refused extends Error {
  constructor({ key, message }) {
    super(message);
    this.key = key;
  }
}

async function post(path, body, signal) {
  const answer = await fetch(path, { method: "POST", body, signal });
  if (answer.ok) return answer;
  if (answer.status === 422) throw new Refused(await answer.json());
  const text = await answer.text();
  throw new Refused({ key: null, message: text || `the server answered ${answer.status}` });
}

export async function start() {
  const answer = await fetch("start");
  return answer.json();
}

export async function mode(chart, rpm, frequency_hz, signal) {
  const answer = await post("mode", JSON.stringify({ chart, rpm, frequency_hz }), signal);
  return answer.json();
}

// The file that the command line would write for this scene.
export async function saved(name, scene) {
  const answer = await post(`save/${name}`, JSON.stringify(scene));
  return answer.blob();
}

// While this is open the server knows that the page is.
export function stayConnected(onLost) {
  const source = new EventSource("alive");
  source.onerror = () => onLost(source.readyState);
  source.onopen = () => onLost(null);
  addEventListener("pagehide", () => source.close());
}

// Charts of a scene that keeps changing. One request is under way at a time. Drafts that were
// passed while it ran are never asked for; a final chart, and any change after one was asked
// for, aborts what runs: the server stops computing it.
export class Live {
  #running = null;
  #next = null;

  constructor({ onChart, onRefused, onBusy }) {
    Object.assign(this, { onChart, onRefused, onBusy });
  }

  ask(scene, { draft, stamp }) {
    // Every move waits for the chart that has it in, also those that were passed.
    const stamps = this.#next?.stamps ?? [];
    if (stamp !== undefined) stamps.push(stamp);
    this.#next = { text: JSON.stringify(scene), draft, stamps };
    const running = this.#running;
    if (running && (!draft || !running.draft)) {
      stamps.unshift(...running.stamps);
      running.abort.abort();
      this.#running = null;
    }
    if (!this.#running) this.#run();
  }

  async #run() {
    const request = this.#next;
    this.#next = null;
    request.abort = new AbortController();
    this.#running = request;
    this.onBusy(true, request.draft);
    try {
      const path = request.draft ? "chart/draft" : "chart/scene";
      const answer = await post(path, request.text, request.abort.signal);
      const chart = await answer.json();
      if (this.#running === request) this.onChart(chart, request);
    } catch (error) {
      if (this.#running === request && error.name !== "AbortError") this.onRefused(error, request);
    }
    if (this.#running !== request) return;
    this.#running = null;
    this.onBusy(false, request.draft);
    if (this.#next) this.#run();
  }
}
