// All requests to the program.

import { ask, leave } from "./backend.js";
import { unitsNow } from "./fields.js";

export class Refused extends Error {
  // `key` is the path of the quantity that causes the refusal, or null. `told` is the message in the unit of its field,
  // or null. `unusual` are sentences about other numbers of the scene, which may be the cause.
  constructor({ key, message, told = null, unusual = [] }) {
    super(message);
    this.key = key;
    this.told = told;
    this.unusual = unusual;
  }
}

// The file of the program has been changed by another one, and has this text now.
export class Changed extends Error {
  constructor(text) {
    super("another program has changed the file");
    this.text = text;
  }
}

// Name of this page, under which the server keeps its charts.
const page = crypto.randomUUID();

async function post(path, body, signal, shown = "") {
  const headers = { "sawflutter-page": page, "sawflutter-chart": shown, "sawflutter-units": unitsNow() };
  const answer = await ask(path, { method: "POST", body, signal, headers });
  if (answer.ok) return answer;
  if (answer.status === 422) throw new Refused(await answer.json());
  const text = await answer.text();
  if (answer.status === 409) throw new Changed(text);
  throw new Refused({ key: null, message: text || `the server answered ${answer.status}` });
}

const json = async (answer) => (await answer).json();

export const start = () => json(ask("start"));
export const mode = (shown, rpm, frequency_hz, signal) => json(post("mode", JSON.stringify({ chart: shown, rpm, frequency_hz }), signal));

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
  return lastLine(answer, ({ figure }) => figure !== undefined, ({ ahead }) => onAhead(ahead));
}

// The critical speeds of a scene alone, with the accuracy of a draft.
export const criticalSpeeds = (text) => json(post("critical", text));
// The progress of the chart that is being computed, or null.
export const progress = () => json(ask("progress", { headers: { "sawflutter-page": page } }));
// The scene that a text describes, as the program reads it.
export const read = (text) => json(post("read", text));
// The scene of a request with one more part.
export const part = (asked) => json(post("part", JSON.stringify(asked)));
// The numbers that the texts of a field mean, in the unit of its key.
export const numbers = (path, texts) => json(post("numbers", JSON.stringify({ path, texts })));
// The `measured` block of a scene for a table of measured frequencies, whose encoding the program determines.
export const measured = (name, buffer) => json(post("measured", JSON.stringify({ name, bytes: [...new Uint8Array(buffer)] })));
// The influence of the scene's numbers on the speeds of a chart.
export const influence = (shown, signal) => json(post("influence", JSON.stringify(shown), signal));
// Saves the scene to the file that the program was started with.
export const write = (scene) => post("file", JSON.stringify(scene));
// The file that the command line would write for this scene. `shown` is the identifier of the scene's chart, or null.
export const saved = async (name, scene, shown, signal) => (await post(`save/${name}`, JSON.stringify(scene), signal, shown ?? "")).blob();

// Computes a task and returns its answer. `onProgress({ what, done, of, best_rpm })` and `onFigures([[name, svg]])` are called in
// the meantime.
export async function task(name, text, signal, { onProgress, onFigures }) {
  const answer = await post(`task/${name}`, text, signal);
  const onLine = (told) => (told.so_far ? onFigures(told.so_far) : onProgress(told));
  return lastLine(answer, ({ summary }) => summary !== undefined, onLine);
}

// Interval of the messages that the page is open.
const BEAT_MS = 2000;

// Informs the server that the page is open, and when it is closed. `onLost(lost)` is called with whether the server
// failed to answer.
export function stayConnected(onLost) {
  const beat = () => ask("alive", { method: "POST", body: page }).then((answer) => onLost(!answer.ok), () => onLost(true));
  beat();
  setInterval(beat, BEAT_MS);
  addEventListener("pagehide", () => leave(page));
  addEventListener("pageshow", (event) => event.persisted && beat());
}
