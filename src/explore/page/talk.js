// Everything that is asked of the program.

import { ask, leave } from "./backend.js";
import { unitsNow } from "./fields.js";

export class Refused extends Error {
  // `told` is the message in the unit of the field of the key, where it has one.
  constructor({ key, message, told = null }) {
    super(message);
    this.key = key;
    this.told = told;
  }
}

// The server keeps the charts of each page apart.
const page = crypto.randomUUID();

async function post(path, body, signal, shown = "") {
  const headers = { "sawflutter-page": page, "sawflutter-chart": shown, "sawflutter-units": unitsNow() };
  const answer = await ask(path, { method: "POST", body, signal, headers });
  if (answer.ok) return answer;
  if (answer.status === 422) throw new Refused(await answer.json());
  const text = await answer.text();
  throw new Refused({ key: null, message: text || `the server answered ${answer.status}` });
}

export async function start() {
  const answer = await ask("start");
  return answer.json();
}

export async function mode(shown, rpm, frequency_hz, signal) {
  const answer = await post("mode", JSON.stringify({ chart: shown, rpm, frequency_hz }), signal);
  return answer.json();
}

// Reads an answer that consists of lines of JSON. Each line is passed to `onLine` on arrival; the last one is the
// result or a refusal.
async function lastLine(answer, isLast, onLine) {
  const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("the answer ended early");
    text += value;
    const lines = text.split("\n");
    text = lines.pop();
    for (const line of lines) {
      const told = JSON.parse(line);
      if (told.refusal) throw new Refused(told.refusal);
      if (isLast(told)) return told;
      onLine(told);
    }
  }
}

// Computes the chart of a scene, as a draft or at the accuracy of the scene. `onAhead` receives the critical speeds and
// then the bands before the chart is complete.
export async function chart(text, draft, signal, onAhead) {
  const answer = await post(draft ? "chart/draft" : "chart/scene", text, signal);
  return lastLine(answer, ({ chart }) => chart !== undefined, ({ ahead }) => onAhead(ahead));
}

// Computes the critical speeds of a scene alone, with the accuracy of a draft.
export async function criticalSpeeds(text) {
  const answer = await post("critical", text);
  return answer.json();
}

// What the chart is at that is being computed; null where none is.
export async function progress() {
  const answer = await ask("progress", { headers: { "sawflutter-page": page } });
  return answer.json();
}

// The file that the command line would write for this scene, whose chart may be known.
export async function saved(name, scene, shown, signal) {
  const answer = await post(`save/${name}`, JSON.stringify(scene), signal, shown ?? "");
  return answer.blob();
}

// A scene as the program reads it, or a refusal.
export async function read(text) {
  const answer = await post("read", text);
  return answer.json();
}

// A scene with one more part.
export async function part(asked) {
  const answer = await post("part", JSON.stringify(asked));
  return answer.json();
}

// Saves the scene to the file that the program was started with.
export async function write(scene) {
  await post("file", JSON.stringify(scene));
}

// A table of measured frequencies as the program reads it, as the `measured` block of a scene.
export async function measured(name, table) {
  const answer = await post("measured", JSON.stringify({ name, table }));
  return answer.json();
}

// Influence of the scene's numbers on the speeds of a chart.
export async function influence(shown, signal) {
  const answer = await post("influence", JSON.stringify(shown), signal);
  return answer.json();
}

// A task: `onProgress({ what, done, of })` and `onFigures([[name, svg]])` as it goes on, then its answer.
export async function task(name, asked, signal, { onProgress, onFigures }) {
  const answer = await post(`task/${name}`, JSON.stringify(asked), signal);
  const onLine = (told) => (told.so_far ? onFigures(told.so_far) : onProgress(told));
  return lastLine(answer, ({ summary }) => summary !== undefined, onLine);
}

// Says so often that the page is there.
const BEAT_MS = 2000;

// Tells the server that the page is open, and when it is closed; `onLost(lost)` whether the
// server answers.
export function stayConnected(onLost) {
  const beat = () => ask("alive", { method: "POST", body: page }).then((answer) => onLost(!answer.ok), () => onLost(true));
  beat();
  setInterval(beat, BEAT_MS);
  addEventListener("pagehide", () => leave(page));
  addEventListener("pageshow", (event) => event.persisted && beat());
}
