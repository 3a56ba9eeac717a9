// Runs the program in a worker, which answers one request after the other.

// Shortest time between two messages about the stage.
const PAUSE_MS = 100;

let program = null;
let told = 0;

const textAt = (pointer, length) => new TextDecoder().decode(new Uint8Array(program.memory.buffer, pointer, length));

const page = {
  milliseconds: () => performance.now(),
  line: (pointer, length) => postMessage({ line: textAt(pointer, length) }),
  stage: (pointer, length) => {
    const now = performance.now();
    if (now - told < PAUSE_MS) return;
    told = now;
    postMessage({ stage: textAt(pointer, length) });
  },
};

function begin(module, first) {
  // A library imports functions of the browser that this program does not call. They are replaced by one that throws.
  const unused = () => {
    throw new Error("the program has asked for what it does not use");
  };
  const imports = { page };
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] ??= unused;
  }
  program = new WebAssembly.Instance(module, imports).exports;
  program.begin(first);
}

function answer(question) {
  const request = new TextEncoder().encode(JSON.stringify(question));
  const room = program.reserve(request.length);
  new Uint8Array(program.memory.buffer, room, request.length).set(request);
  const status = program.answer();
  if (status === 0) throw new Error("the request cannot be read");
  const content = new Uint8Array(program.memory.buffer, program.content(), program.content_length()).slice();
  return { status, media: textAt(program.media_type(), program.media_type_length()), content };
}

onmessage = ({ data }) => {
  try {
    if (data.module) begin(data.module, data.first);
    else postMessage({ answer: answer(data.question) });
  } catch (error) {
    postMessage({ failure: String(error) });
  }
};
