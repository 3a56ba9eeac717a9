// Draws the blade to scale with its pads, cut and probe, which are moved with the pointer or the keyboard.

import { drawn } from "./dom.js";
import { turned } from "./pairs.js";
import { get, set } from "./scene.js";
import { atPad, besideBlade, circle, ground, outline, overhangs, polar, radians, reachOf, signs, viewOf } from "./shapes.js";
import { shown, tidy } from "./words.js";

const STEP_M = 0.001;
const STEP_DEG = 1;
const LEAST_SIDE_M = 0.002;
const STEPS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

// Positions are rounded to 0.1 mm and 0.1°. Angles are between −180° and 180°.
const metres = (value) => tidy(Math.round(value * 1e4) / 1e4);
const degrees = (value) => tidy(turned(value));
const placeAt = (x, y) => ({ radius_m: Math.hypot(x, y), angle_deg: (Math.atan2(y, x) * 180) / Math.PI });
const isPad = (path) => path.startsWith("guides");
const numberOf = (path) => Number(path.match(/\d+/)[0]) + 1;

function placeOf(scene, path) {
  const part = get(scene, path) ?? { angle_deg: 90 };
  return { radius_m: part.radius_m ?? 0.5 * scene.blade.outer_diameter_m, angle_deg: part.angle_deg ?? 0 };
}

// Moves a part. Its centre stays on the blade, and that of the cut at the rim.
function move(scene, path, { radius_m, angle_deg }) {
  const [a, b] = [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
  if (path !== "cut") set(scene, `${path}.radius_m`, Math.min(Math.max(metres(radius_m), a), b));
  set(scene, `${path}.angle_deg`, degrees(angle_deg));
}

function resize(pad, long, wide) {
  pad.radial_length_m = metres(Math.max(long, LEAST_SIDE_M));
  pad.tangential_length_m = metres(Math.max(wide, LEAST_SIDE_M));
}

// What holds or damps a pad beside its spring, in words.
function held(pad) {
  const words = Object.entries({ arm: "on an arm", film: "with a film", controller: "with a controller" });
  return words.map(([key, told]) => (pad[key] ? `, ${told}` : "")).join("");
}

function name(group, text) {
  group.setAttribute("aria-label", text);
  group.querySelector("title").textContent = text;
}

function setAll(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
}

export class Blade {
  // `onSelect(path)` is called when a part gets the focus or is clicked, `onAdd({ radius_m, angle_deg })` when a click adds
  // a pad.
  constructor(svg, state, { onSelect, onAdd }) {
    this.svg = svg;
    this.state = state;
    this.onSelect = onSelect;
    svg.addEventListener("click", (event) => {
      const { radius_m, angle_deg } = placeAt(...this.#at(event));
      const { inner_diameter_m, outer_diameter_m } = state.scene.blade;
      const isOnBlade = 0.5 * inner_diameter_m <= radius_m && radius_m <= 0.5 * outer_diameter_m;
      if (this.isAdding && isOnBlade) onAdd({ radius_m: metres(radius_m), angle_deg: degrees(angle_deg) });
    });
    svg.addEventListener("pointerdown", () => (this.isHinting = false));
    this.ground = drawn("g", {});
    this.ground.addEventListener("click", (event) => {
      const isPlate = /** @type {any} */ (event.target).matches(".plate");
      if (!this.isAdding) onSelect(isPlate ? "blade" : "mount");
    });
    this.things = drawn("g", {});
    this.mark = drawn("g", { class: "turns" });
    // Hatching of the parts of pads that are beside the blade. The model takes the pads without them.
    this.pads = drawn("clipPath", { id: "pads-of-the-saw" });
    this.hatching = drawn("pattern", { id: "hatching", patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, drawn("path", { class: "hatch" }));
    this.beside = drawn("path", { class: "beside", "clip-path": "url(#pads-of-the-saw)", fill: "url(#hatching)", "fill-rule": "evenodd" });
    this.uncounted = drawn("text", { class: "uncounted" });
    this.uncounted.textContent = "Only the part of a pad on the blade counts.";
    svg.append(drawn("defs", {}, this.pads, this.hatching), this.ground, this.things, this.beside, this.uncounted, this.mark);
    // A finger needs a larger handle.
    this.isCoarse = matchMedia("(pointer: coarse)");
    // The width is stored, because reading it at every move would force a layout each time.
    this.width = svg.clientWidth || 400;
    new ResizeObserver(() => {
      this.width = svg.clientWidth || 400;
      this.draw(state.scene);
    }).observe(svg);
  }

  // True while a click on the blade adds a pad.
  get isAdding() {
    return this.svg.classList.contains("adding");
  }

  set isAdding(on) {
    this.svg.classList.toggle("adding", on);
  }

  // Whether a hint says that the first pad can be dragged, until the first touch.
  set isHinting(on) {
    this.svg.classList.toggle("hinting", on);
  }

  select(path) {
    this.selected = path;
    for (const group of this.things.children) group.classList.toggle("selected", group.dataset.path === path);
  }

  // Draws a scene. The part of a refused quantity is marked.
  draw(scene, refusedKey = this.refusedKey) {
    const reach = reachOf(scene);
    this.refusedKey = refusedKey;
    if (!(reach > 0)) return;
    this.pixel = (2 * reach) / this.width;
    const seen = JSON.stringify([this.pixel, scene.blade, scene.mount]);
    if (seen !== this.drawn) this.#drawGround(scene, reach);
    this.drawn = seen;
    // Pads are drawn last, on top of cut and probe, because they are dragged most often.
    const paths = [...(scene.cut ? ["cut"] : []), "probe", ...(scene.guides ?? []).map((_, i) => `guides[${i}]`)];
    for (const group of [...this.things.children]) if (!paths.includes(group.dataset.path)) group.remove();
    for (const path of paths) {
      // Groups are kept, because replacing one would end its drag.
      const group = this.things.querySelector(`[data-path="${path}"]`) ?? this.#add(path);
      group.classList.toggle("selected", path === this.selected);
      group.classList.toggle("refused", refusedKey?.startsWith(path) ?? false);
      if (isPad(path)) this.#drawPad(group, get(scene, path), numberOf(path));
      else if (path === "cut") this.#drawCut(group, scene);
      else this.#drawProbe(group, placeOf(scene, path));
    }
    this.#hatch(scene, reach);
  }

  #hatch({ blade, guides = [] }, reach) {
    const over = guides.filter((pad) => pad.radial_length_m > 0 && overhangs(pad, blade));
    const px = this.pixel;
    this.pads.replaceChildren(...over.map((pad) => drawn("path", { d: outline(pad.radial_length_m, pad.tangential_length_m, pad.shape), transform: atPad(pad) })));
    setAll(this.hatching, { width: 6 * px, height: 6 * px });
    setAll(this.hatching.firstElementChild, { d: `M0 ${3 * px}H${6 * px}`, "stroke-width": 2 * px });
    this.beside.setAttribute("d", besideBlade(blade, reach));
    setAll(this.uncounted, { y: reach - 4 * px, "font-size": 13 * px, "stroke-width": 4 * px });
    for (const part of [this.beside, this.uncounted]) part.style.display = over.length > 0 ? "" : "none";
  }

  #drawGround(scene, reach) {
    this.svg.setAttribute("viewBox", viewOf(reach));
    const [a, b] = [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
    const px = this.pixel;
    // An arrow shows the direction of rotation.
    const r = b * 0.5 + a * 0.5;
    const [[x, y], [u, v]] = [polar(r, 205), polar(r, 250)];
    const [p, q, t] = [polar(r, 257), polar(r - 5 * px, 248), polar(r + 5 * px, 248)];
    const arrows = { rotation: `M${x} ${y}A${r} ${r} 0 0 0 ${u} ${v}`, "rotation-head": `M${p}L${q}L${t}Z`, axis: `M${-6 * px} 0H${6 * px}M0 ${-6 * px}V${6 * px}` };
    this.ground.replaceChildren(...ground(scene), ...Object.entries(arrows).map(([kind, d]) => drawn("path", { class: kind, d })));
    this.mark.replaceChildren(drawn("circle", { class: "mark", cx: b * 0.93, cy: 0, r: 4 * px }));
  }

  #add(path) {
    const body = drawn("path", { class: "body" });
    const group = drawn("g", { class: isPad(path) ? "pad" : path, tabindex: 0, role: "button", "data-path": path }, drawn("title", {}), body);
    group.addEventListener("keydown", (event) => this.#key(event, path));
    group.addEventListener("keyup", (event) => this.state.settle(event.timeStamp));
    group.addEventListener("focus", () => this.onSelect(path));
    this.#hold(body, path, (scene, [x, y], [u, v]) => move(scene, path, placeAt(x - u, y - v)));
    if (isPad(path)) {
      const handle = drawn("rect", { class: "handle" });
      group.append(handle, drawn("text", { class: "number" }), drawn("text", { class: "hint" }), drawn("path", { class: "sign" }));
      this.#hold(handle, path, (scene, [x, y]) => {
        const pad = get(scene, path);
        const [cos, sin] = [Math.cos(radians(pad.angle_deg)), Math.sin(radians(pad.angle_deg))];
        resize(pad, 2 * Math.abs(x * cos + y * sin - pad.radius_m), 2 * Math.abs(y * cos - x * sin));
      });
    }
    this.things.append(group);
    return group;
  }

  #drawPad(group, pad, number) {
    const px = this.pixel;
    // A point spring has no extent. Its symbol is a circle that is large enough to be touched.
    const point = pad.radial_length_m === 0;
    const [long, wide] = point ? [12 * px, 12 * px] : [pad.radial_length_m, pad.tangential_length_m];
    group.setAttribute("transform", atPad(pad));
    const [, body, handle, text, hint, sign] = group.children;
    sign.setAttribute("d", signs(pad, long, wide, px));
    body.setAttribute("d", outline(long, wide, point ? "round" : pad.shape));
    // The handle leaves most of a small pad free for moving it, but is always large enough to be touched.
    const [most, least] = this.isCoarse.matches ? [24, 12] : [11, 6];
    const size = Math.max(Math.min(most * px, 0.45 * Math.min(long, wide)), least * px);
    setAll(handle, { x: long / 2 - size / 2, y: -wide / 2 - size / 2, width: size, height: size });
    handle.style.display = point ? "none" : "";
    // The number is upright. It is placed beside a small pad, which it would cover otherwise.
    const aside = Math.min(long, wide) < 22 * px ? long / 2 + 9 * px : 0;
    setAll(text, { transform: `translate(${aside} 0) rotate(${pad.angle_deg})`, "font-size": 13 * px });
    text.textContent = String(number);
    setAll(hint, { transform: `rotate(${pad.angle_deg}) translate(0 ${-0.5 * Math.hypot(long, wide)})`, "font-size": 14 * px, "stroke-width": 4 * px });
    hint.textContent = number === 1 ? "drag me" : "";
    name(group, `Pad ${number}: radius ${shown(pad.radius_m * 1e3, 4)} mm, angle ${shown(pad.angle_deg, 4)}°, `
      + `${shown(pad.radial_length_m * 1e3, 4)} by ${shown(pad.tangential_length_m * 1e3, 4)} mm${held(pad)}. `
      + "Arrow keys move it, with Shift they change its size.");
  }

  #drawCut(group, { blade, cut }) {
    const b = 0.5 * blade.outer_diameter_m;
    const teeth = Math.max(blade.teeth ?? 1, 1);
    const pitch = (Math.PI * 2 * b) / teeth;
    const count = cut.teeth_in_cut ?? (cut.depth_m ?? pitch) / pitch;
    const half = Math.min((180 * count) / teeth, 90);
    const angle = cut.angle_deg ?? 0;
    const [r, w] = [b * 1.035, 6 * this.pixel];
    const [from, to, back, end] = [polar(r, angle - half), polar(r, angle + half), polar(r + w, angle + half), polar(r + w, angle - half)];
    group.querySelector(".body").setAttribute("d", `M${from}A${r} ${r} 0 0 0 ${to}L${back}A${r + w} ${r + w} 0 0 1 ${end}Z`);
    name(group, `Cut at ${shown(angle, 4)}°. Arrow keys move it along the rim.`);
  }

  #drawProbe(group, { radius_m, angle_deg }) {
    const px = this.pixel;
    group.setAttribute("transform", `translate(${polar(radius_m, angle_deg)})`);
    group.querySelector(".body").setAttribute("d", `${circle(7 * px)}M${-11 * px} 0H${11 * px}M0 ${-11 * px}V${11 * px}`);
    name(group, `Probe: radius ${shown(radius_m * 1e3, 4)} mm, angle ${shown(angle_deg, 4)}°. Arrow keys move it.`);
  }

  // Returns the place of the pointer in metres from the centre.
  /** @returns {[number, number]} */
  #at({ clientX, clientY }) {
    const { left, top, width, height } = this.svg.getBoundingClientRect();
    const reach = reachOf(this.state.scene);
    return [(((clientX - left) / width) * 2 - 1) * reach, -(((clientY - top) / height) * 2 - 1) * reach];
  }

  // Lets a part be dragged: `edit(scene, pointer, grip)` changes it, where the grip is the vector from the centre of the
  // part to the place where it was touched.
  #hold(target, path, edit) {
    target.addEventListener("pointerdown", (event) => {
      if (this.isAdding || event.button !== 0) return;
      event.preventDefault();
      target.parentNode.focus();
      target.setPointerCapture(event.pointerId);
      const { radius_m, angle_deg } = placeOf(this.state.scene, path);
      const [[x, y], [u, v]] = [this.#at(event), polar(radius_m, angle_deg)];
      const grip = [x - u, y + v];
      // The window receives the events, because a browser may end the pointer capture before the drag ends.
      const during = new AbortController();
      const on = (kind, then) => addEventListener(kind, (later) => later.pointerId === event.pointerId && then(later), { signal: during.signal });
      const end = ({ timeStamp }) => {
        during.abort();
        this.state.settle(timeStamp);
      };
      on("pointermove", (moved) => this.state.change((scene) => edit(scene, this.#at(moved), grip), { draft: true, stamp: moved.timeStamp }));
      on("pointerup", end);
      on("pointercancel", end);
      addEventListener("keydown", ({ key }) => {
        if (key !== "Escape") return;
        during.abort();
        this.state.cancel();
      }, { signal: during.signal });
    });
  }

  #key(event, path) {
    if (!(event.key in STEPS)) return;
    const [along, out] = STEPS[event.key];
    event.preventDefault();
    const edit = (scene) => {
      const pad = isPad(path) && event.shiftKey ? get(scene, path) : null;
      const { radius_m, angle_deg } = placeOf(scene, path);
      const turn = path === "cut" ? along + out : along;
      if (pad) resize(pad, pad.radial_length_m + out * 2 * STEP_M, pad.tangential_length_m - along * 2 * STEP_M);
      else move(scene, path, { radius_m: radius_m + out * STEP_M, angle_deg: angle_deg + turn * STEP_DEG });
    };
    this.state.change(edit, { draft: true, stamp: event.timeStamp, run: path });
  }
}
