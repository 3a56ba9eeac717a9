// Animates a mode on the blade in slow motion, as seen from space: w(r, θ, t) = Re Σ (c(r) cos nθ + s(r) sin nθ)
// e^{iωt}, in relief or, without WebGL2 and for users who want less motion, as colours of a flat blade. A mark turns with
// the blade, equally slowed down. A forward wave overtakes the mark; a reflected one falls behind it, although it runs in
// the direction of rotation in space.

import { Relief } from "./relief.js";

const SIZE = 180;
// Shortest times in which one oscillation and one turn of the blade are shown.
const PERIOD_S = 2.4;
const LEAST_TURN_S = 4;

export class Motion {
  #frame = 0;
  #field = null;

  constructor(canvas, mark, colours) {
    this.canvas = canvas;
    this.mark = mark;
    this.colours = colours;
    canvas.width = SIZE;
    canvas.height = SIZE;
    this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const gl = this.still ? null : canvas.getContext("webgl2", { preserveDrawingBuffer: true });
    this.relief = gl && new Relief(gl);
    document.body.classList.toggle("in-relief", this.relief !== null);
  }

  // Starts the animation of a mode of a saw. `reach` is half the width of the drawing in metres. Returns the factor by
  // which the motion is slowed down.
  show(mode, scene, reach) {
    this.hide();
    this.#field = sampled(mode, reach);
    this.canvas.hidden = false;
    if (this.relief) {
      this.canvas.width = this.canvas.height = Math.round(this.canvas.clientWidth * devicePixelRatio) || SIZE;
      this.relief.begin(mode, this.#field.largest, scene, reach);
    }
    const turn = mode.rpm > 0 ? 60 / mode.rpm : Infinity;
    const period = mode.frequency_hz > 0 ? 1 / mode.frequency_hz : Infinity;
    const slower = Math.max(period < Infinity ? PERIOD_S / period : 0, turn < Infinity ? LEAST_TURN_S / turn : 0, 1);
    const begun = performance.now();
    const draw = (now) => {
      const t = (now - begun) / 1000 / slower;
      const phase = 2 * Math.PI * mode.frequency_hz * t;
      if (this.relief) this.relief.draw(phase, (2 * Math.PI * t) / turn, this.colours());
      else this.#draw(phase);
      // The blade turns counterclockwise in the drawing, against the positive angle of SVG.
      this.mark?.setAttribute("transform", `rotate(${(-360 * t) / turn || 0})`);
      if (!this.still) this.#frame = requestAnimationFrame(draw);
    };
    draw(begun);
    return slower;
  }

  hide() {
    cancelAnimationFrame(this.#frame);
    this.canvas.hidden = true;
    this.mark?.removeAttribute("transform");
  }

  // Records the animation for twice PERIOD_S: two oscillations, or fewer if the slowdown follows from the time of a
  // turn.
  async film() {
    const chunks = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(30));
    recorder.ondataavailable = (event) => chunks.push(event.data);
    const ended = new Promise((resolve) => (recorder.onstop = resolve));
    recorder.start();
    setTimeout(() => recorder.stop(), 2000 * PERIOD_S);
    await ended;
    return new Blob(chunks, { type: recorder.mimeType });
  }

  #draw(phase) {
    const { re, im, inside } = this.#field;
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(SIZE, SIZE);
    const [cos, sin] = [Math.cos(phase), Math.sin(phase)];
    const { up, down, rest } = this.colours();
    for (let k = 0; k < inside.length; k++) {
      if (!inside[k]) continue;
      const w = re[k] * cos - im[k] * sin;
      const [share, to] = w > 0 ? [w, up] : [-w, down];
      for (let c = 0; c < 3; c++) image.data[4 * k + c] = rest[c] + (to[c] - rest[c]) * share;
      image.data[4 * k + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }
}

// Samples the real and imaginary part of the deflection at every pixel, scaled to a largest magnitude of one.
function sampled({ radius_m, harmonics }, reach) {
  const count = SIZE * SIZE;
  const field = { re: new Float64Array(count), im: new Float64Array(count), inside: new Uint8Array(count) };
  const [inner, outer] = [radius_m[0], radius_m.at(-1)];
  let largest = 0;
  for (let k = 0; k < count; k++) {
    const x = ((((k % SIZE) + 0.5) / SIZE) * 2 - 1) * reach;
    const y = -((((Math.floor(k / SIZE)) + 0.5) / SIZE) * 2 - 1) * reach;
    const r = Math.hypot(x, y);
    if (r < inner || r > outer) continue;
    field.inside[k] = 1;
    const place = ((r - inner) / (outer - inner)) * (radius_m.length - 1);
    const i = Math.min(Math.floor(place), radius_m.length - 2);
    const share = place - i;
    const theta = Math.atan2(y, x);
    for (const { nodal_diameters: n, cosine, sine } of harmonics) {
      const [c, s] = [Math.cos(n * theta), Math.sin(n * theta)];
      const at = (list) => list[i] * (1 - share) + list[i + 1] * share;
      field.re[k] += at(cosine.re) * c + at(sine.re) * s;
      field.im[k] += at(cosine.im) * c + at(sine.im) * s;
    }
    largest = Math.max(largest, Math.hypot(field.re[k], field.im[k]));
  }
  for (let k = 0; k < count; k++) {
    field.re[k] /= largest || 1;
    field.im[k] /= largest || 1;
  }
  return { ...field, largest };
}
