// Answers the requests of the page without a server, by workers of this browser that run the program as WebAssembly.

// Tasks take minutes and do not depend on charts, so that they have a separate worker.
const CHARTS = "charts";
const TASKS = "tasks";
// Critical speeds have a separate worker, because a chart may take long.
const CRITICAL = "critical";
// Requests that take no time have a separate worker, so that they do not wait for any of the others.
const QUICK = "quick";
const IS_QUICK = /^(start|read|measured|part|numbers)$/;
// The charts of a terminated worker are lost. The identifiers of the next worker start this much higher, so that none
// is used twice.
const NUMBERS = 1_000_000;

const compiled = fetch("page/sawflutter.wasm").then((answer) => answer.arrayBuffer()).then((bytes) => WebAssembly.compile(bytes));

// A worker and the requests that wait for it.
class Queue {
  #worker = null;
  #begun = 0;
  #waiting = [];
  #running = null;
  // Progress of the running request, or null.
  stage = null;

  // Answers one request after the other. If the running request is aborted, its worker is terminated.
  ask(question, signal) {
    return new Promise((resolve, reject) => {
      const job = { question, resolve, reject, lines: null };
      if (/^(task|chart)\//.test(question.path)) this.#stream(job);
      signal?.addEventListener("abort", () => this.#takeBack(job, signal.reason));
      if (signal?.aborted) this.#fail(job, signal.reason);
      else this.#waiting.push(job);
      this.#next();
    });
  }

  // Answers with a stream, because the progress of a task and early results of a chart arrive before the result.
  #stream(job) {
    const start = (controller) => (job.lines = controller);
    job.resolve(new Response(new ReadableStream({ start })));
  }

  #fail(job, reason) {
    if (job.lines) job.lines.error(reason);
    else job.reject(reason);
  }

  #takeBack(job, reason) {
    const waits = this.#waiting.indexOf(job);
    if (waits >= 0) this.#waiting.splice(waits, 1);
    else if (this.#running !== job) return;
    else this.#end();
    this.#fail(job, reason);
    this.#next();
  }

  #end() {
    this.#worker?.terminate();
    [this.#worker, this.#running, this.stage] = [null, null, null];
  }

  async #next() {
    if (this.#running || this.#waiting.length === 0) return;
    const job = (this.#running = this.#waiting.shift());
    const module = await compiled.catch((error) => this.#fail(job, error));
    if (this.#running !== job || !module) return;
    if (!this.#worker) this.#begin(module);
    this.#worker.postMessage({ question: job.question });
  }

  #begin(module) {
    this.#worker = new Worker("page/worker.js");
    this.#worker.onmessage = ({ data }) => this.#told(data);
    this.#worker.postMessage({ module, first: 1 + NUMBERS * this.#begun++ });
  }

  #told({ stage, line, answer, failure }) {
    const job = this.#running;
    if (stage) this.stage = JSON.parse(stage);
    if (!job) return;
    if (line) job.lines?.enqueue(new TextEncoder().encode(`${line}\n`));
    if (!answer && failure === undefined) return;
    [this.#running, this.stage] = [null, null];
    if (failure !== undefined) {
      // After a failure, the next request gets a new worker.
      this.#end();
      this.#fail(job, new Error(failure));
    } else if (job.lines) {
      job.lines.enqueue(answer.content);
      job.lines.enqueue(new TextEncoder().encode("\n"));
      job.lines.close();
    } else {
      job.resolve(new Response(answer.content, { status: answer.status, headers: { "content-type": answer.media } }));
    }
    this.#next();
  }
}

const queues = { [CHARTS]: new Queue(), [TASKS]: new Queue(), [CRITICAL]: new Queue(), [QUICK]: new Queue() };

function queueOf(path) {
  if (path.startsWith("task/")) return queues[TASKS];
  if (path === CRITICAL) return queues[CRITICAL];
  return queues[IS_QUICK.test(path) ? QUICK : CHARTS];
}

export async function ask(path, options = undefined) {
  const { body = "", signal = undefined, headers = {} } = options ?? {};
  if (path === "alive") return new Response(null, { status: 204 });
  if (path === "progress") return Response.json(queues[CHARTS].stage);
  const header = (name) => String(headers[`sawflutter-${name}`] ?? "");
  const question = { path, page: header("page"), chart: header("chart"), units: header("units") || "metric", body };
  return queueOf(path).ask(question, signal);
}

// Words after the time of a computation, and for one that has no answer.
export const PLACE = " in this browser";
export const LOST = "This browser has ended the computation. Save the scene and load the page again.";

// There is no server that has to know when the page is closed.
export const leave = () => true;
