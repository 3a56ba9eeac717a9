// Draws the blade to scale with its pads, cut and probe, which are moved with the pointer or the keyboard.

import { turned } from "./pairs.js";
import { shown, tidy } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";
const STEP_M = 0.001;
const STEP_DEG = 1;
const LEAST_SIDE_M = 0.002;

function element(name, attributes, parent) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

// Positions are rounded to 0.1 mm and 0.1°. Angles are between −180° and 180°.
const metres = (value) => tidy(Math.round(value * 1e4) / 1e4);
const degrees = (value) => tidy(turned(value));
const radians = (value) => (value * Math.PI) / 180;

export class Blade {
  // `onSelect(path)` is called when a pad, the cut or the probe gets the focus, `onAdd({ radius_m, angle_deg })` when a
  // click adds a pad.
  constructor(svg, state, { onSelect, onAdd }) {
    this.svg = svg;
    this.state = state;
    this.onSelect = onSelect;
    svg.addEventListener("click", (event) => {
      const place = this.isAdding && this.#onBlade(event);
      if (place) onAdd(place);
    });
    svg.addEventListener("pointerdown", () => (this.isHinting = false));
    this.ground = element("g", {}, svg);
    this.ground.addEventListener("click", ({ target }) => !this.isAdding && onSelect(target.matches(".plate") ? "blade" : "mount"));
    this.things = element("g", {}, svg);
    this.mark = element("g", { class: "turns" }, svg);
    // The width is stored, because reading it at every move would force a layout each time.
    this.width = svg.clientWidth || 400;
    new ResizeObserver(() => {
      this.width = svg.clientWidth || 400;
      this.draw(state.scene, this.refusedKey);
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

  // Returns the position of the pointer on the blade, or null if it is not on the blade.
  #onBlade(event) {
    const { scene } = this.state;
    const [x, y] = this.#place(event);
    const radius = Math.hypot(x, y);
    const isOn = 0.5 * scene.blade.inner_diameter_m <= radius && radius <= 0.5 * scene.blade.outer_diameter_m;
    return isOn ? { radius_m: metres(radius), angle_deg: degrees((Math.atan2(y, x) * 180) / Math.PI) } : null;
  }

  // Returns half the width of the drawing in metres: the radius of the blade and a margin of 12 %.
  static reach(scene) {
    return 0.5 * scene.blade.outer_diameter_m * 1.12;
  }

  // Marks the pad, cut or probe with this path, and unmarks all others.
  select(path) {
    this.selected = path;
    for (const group of this.things.children) group.classList.toggle("selected", group.dataset.path === path);
  }

  draw(scene, refusedKey) {
    const reach = Blade.reach(scene);
    this.refusedKey = refusedKey;
    if (!(reach > 0)) return;
    this.pixel = (2 * reach) / this.width;
    const seen = JSON.stringify([this.pixel, scene.blade, scene.mount]);
    if (seen !== this.drawn) this.#drawGround(scene, reach);
    this.drawn = seen;
    // Pads are drawn last, on top of cut and probe, because they are dragged most often.
    const wanted = [
      ...(scene.cut ? [["cut", "cut", scene.cut]] : []),
      ["probe", "probe", scene.probe ?? { angle_deg: 90 }],
      ...(scene.guides ?? []).map((guide, i) => ["pad", `guides[${i}]`, guide]),
    ];
    this.#match(wanted);
    for (const [kind, path, part] of wanted) {
      const group = this.things.querySelector(`[data-path="${path}"]`);
      group.classList.toggle("selected", path === this.selected);
      group.classList.toggle("refused", refusedKey?.startsWith(path) ?? false);
      this[`_${kind}`](group, part, scene);
    }
  }

  #drawGround(scene, reach) {
    this.svg.setAttribute("viewBox", `${-reach} ${-reach} ${2 * reach} ${2 * reach}`);
    const [a, b] = [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
    const px = this.pixel;
    const parts = ground(scene).map(([name, d]) => `<path class="${name}" fill-rule="evenodd" d="${d}"/>`);
    // An arrow shows the direction of rotation.
    const r = b * 0.5 + a * 0.5;
    const [x, y] = polar(r, 205);
    const [u, v] = polar(r, 250);
    parts.push(`<path class="rotation" d="M${x} ${y}A${r} ${r} 0 0 0 ${u} ${v}"/>`);
    const [p, q, t] = [polar(r, 257), polar(r - 5 * px, 248), polar(r + 5 * px, 248)];
    parts.push(`<path class="rotation-head" d="M${p}L${q}L${t}Z"/>`);
    parts.push(`<path class="axis" d="M${-6 * px} 0H${6 * px}M0 ${-6 * px}V${6 * px}"/>`);
    this.ground.innerHTML = parts.join("");
    this.mark.innerHTML = `<circle class="mark" cx="${b * 0.93}" cy="0" r="${4 * px}"/>`;
  }

  // Makes a group for each new part and removes those of other parts. Existing groups are kept, because replacing a
  // group would end its drag.
  #match(wanted) {
    const paths = wanted.map(([, path]) => path);
    for (const group of [...this.things.children]) {
      if (!paths.includes(group.dataset.path)) group.remove();
    }
    for (const [kind, path] of wanted) {
      if (this.things.querySelector(`[data-path="${path}"]`)) continue;
      const group = element("g", { class: kind, tabindex: "0", role: "button", "data-path": path }, this.things);
      group.addEventListener("keydown", (event) => this.#key(event, kind, path));
      group.addEventListener("focus", () => this.onSelect(path));
      group.addEventListener("keyup", (event) => this.state.settle(event.timeStamp));
      element("title", {}, group);
      element("path", { class: "body" }, group);
      this.#hold(group.querySelector(".body"), kind, path, "move");
      if (kind === "pad") {
        element("rect", { class: "handle" }, group);
        this.#hold(group.querySelector(".handle"), kind, path, "resize");
        element("text", { class: "number" }, group);
        element("text", { class: "hint" }, group);
      }
    }
  }

  _pad(group, pad) {
    const px = this.pixel;
    const [x, y] = polar(pad.radius_m, pad.angle_deg);
    // A point spring has no extent. Its symbol is a circle that is large enough to be touched.
    const point = pad.radial_length_m === 0;
    const [long, wide] = point ? [12 * px, 12 * px] : [pad.radial_length_m, pad.tangential_length_m];
    group.setAttribute("transform", `translate(${x} ${y}) rotate(${-pad.angle_deg})`);
    const [h, v] = [long / 2, wide / 2];
    group.querySelector(".body").setAttribute("d", outline({ radial_length_m: long, tangential_length_m: wide, shape: point ? "round" : pad.shape }));
    const handle = group.querySelector(".handle");
    // The handle leaves most of a small pad free for moving it, but is always large enough to be touched.
    const size = Math.max(Math.min(11 * px, 0.45 * Math.min(long, wide)), 6 * px);
    Object.entries({ x: h - size / 2, y: -v - size / 2, width: size, height: size }).forEach(([k, n]) => handle.setAttribute(k, n));
    handle.style.display = point ? "none" : "";
    const number = Number(group.dataset.path.match(/\d+/)[0]) + 1;
    // The number is upright. It is placed beside a small pad, which it would cover otherwise.
    const text = group.querySelector(".number");
    const aside = Math.min(long, wide) < 22 * px ? h + 9 * px : 0;
    text.setAttribute("transform", `translate(${aside} 0) rotate(${pad.angle_deg})`);
    text.setAttribute("font-size", 13 * px);
    text.textContent = number;
    const hint = group.querySelector(".hint");
    hint.setAttribute("transform", `rotate(${pad.angle_deg}) translate(0 ${-0.5 * Math.hypot(long, wide)})`);
    hint.setAttribute("font-size", 14 * px);
    hint.setAttribute("stroke-width", 4 * px);
    hint.textContent = number === 1 ? "drag me" : "";
    this.#name(group, `Pad ${number}: radius ${shown(pad.radius_m * 1e3, 4)} mm, angle ${shown(pad.angle_deg, 4)}°, `
      + `${shown(pad.radial_length_m * 1e3, 4)} by ${shown(pad.tangential_length_m * 1e3, 4)} mm. `
      + "Arrow keys move it, with Shift they change its size.");
  }

  _cut(group, cut, scene) {
    const b = 0.5 * scene.blade.outer_diameter_m;
    const teeth = scene.blade.teeth ?? 1;
    const pitch = (Math.PI * 2 * b) / Math.max(teeth, 1);
    const count = cut.teeth_in_cut ?? (cut.depth_m ?? pitch) / pitch;
    const half = Math.min((180 * count) / Math.max(teeth, 1), 90);
    const angle = cut.angle_deg ?? 0;
    const [r, w] = [b * 1.035, 6 * this.pixel];
    const [x, y] = polar(r, angle - half);
    const [u, v] = polar(r, angle + half);
    const [p, q] = [polar(r + w, angle + half), polar(r + w, angle - half)];
    group.querySelector(".body").setAttribute("d", `M${x} ${y}A${r} ${r} 0 0 0 ${u} ${v}L${p}A${r + w} ${r + w} 0 0 1 ${q}Z`);
    this.#name(group, `Cut at ${shown(angle, 4)}°. Arrow keys move it along the rim.`);
  }

  _probe(group, probe, scene) {
    const r = probe.radius_m ?? 0.5 * scene.blade.outer_diameter_m;
    const [x, y] = polar(r, probe.angle_deg);
    const px = this.pixel;
    group.setAttribute("transform", `translate(${x} ${y})`);
    group.querySelector(".body").setAttribute("d", `${circle(7 * px)}M${-11 * px} 0H${11 * px}M0 ${-11 * px}V${11 * px}`);
    this.#name(group, `Probe: radius ${shown(r * 1e3, 4)} mm, angle ${shown(probe.angle_deg, 4)}°. Arrow keys move it.`);
  }

  #name(group, text) {
    group.setAttribute("aria-label", text);
    group.querySelector("title").textContent = text;
  }

  /** @returns {[number, number]} */
  #place(event) {
    const box = this.svg.getBoundingClientRect();
    const reach = Blade.reach(this.state.scene);
    const x = (((event.clientX - box.left) / box.width) * 2 - 1) * reach;
    const y = -(((event.clientY - box.top) / box.height) * 2 - 1) * reach;
    return [x, y];
  }

  #hold(target, kind, path, action) {
    target.addEventListener("pointerdown", (event) => {
      if (this.isAdding || event.button !== 0) return;
      event.preventDefault();
      target.parentNode.focus();
      target.setPointerCapture(event.pointerId);
      const grip = this.#grip(kind, path, this.#place(event));
      const own = (then) => (later) => later.pointerId === event.pointerId && then(later);
      const move = own((moved) => {
        const edit = (scene) => this.#drag(scene, kind, path, action, this.#place(moved), grip);
        this.state.change(edit, { draft: true, stamp: moved.timeStamp });
      });
      // The window receives the events, because a browser may end the pointer capture before the drag ends.
      const during = new AbortController();
      const end = own((ended) => {
        during.abort();
        this.state.settle(ended.timeStamp);
      });
      const { signal } = during;
      addEventListener("pointermove", move, { signal });
      addEventListener("pointerup", end, { signal });
      addEventListener("pointercancel", end, { signal });
      addEventListener("keydown", ({ key }) => {
        if (key !== "Escape") return;
        during.abort();
        this.state.cancel();
      }, { signal });
    });
  }

  // Returns the vector from the centre of a pad to the pointer in metres; zero for the cut and the probe.
  #grip(kind, path, [x, y]) {
    if (kind !== "pad") return [0, 0];
    const pad = this.state.scene.guides[Number(path.match(/\d+/)[0])];
    const angle = radians(pad.angle_deg);
    return [x - pad.radius_m * Math.cos(angle), y - pad.radius_m * Math.sin(angle)];
  }

  #drag(scene, kind, path, action, [x, y], grip) {
    const angleOf = (u, v) => degrees((Math.atan2(v, u) * 180) / Math.PI);
    if (kind === "cut") {
      scene.cut.angle_deg = angleOf(x, y);
    } else if (kind === "probe") {
      scene.probe = { radius_m: within(Math.hypot(x, y), scene), angle_deg: angleOf(x, y) };
    } else {
      const pad = scene.guides[Number(path.match(/\d+/)[0])];
      if (action === "resize") {
        const angle = radians(pad.angle_deg);
        const along = x * Math.cos(angle) + y * Math.sin(angle) - pad.radius_m;
        const across = -x * Math.sin(angle) + y * Math.cos(angle);
        pad.radial_length_m = metres(Math.max(2 * Math.abs(along), LEAST_SIDE_M));
        pad.tangential_length_m = metres(Math.max(2 * Math.abs(across), LEAST_SIDE_M));
      } else {
        const [u, v] = [x - grip[0], y - grip[1]];
        pad.radius_m = within(Math.hypot(u, v), scene);
        pad.angle_deg = angleOf(u, v);
      }
    }
  }

  #key(event, kind, path) {
    const [along, out] = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [];
    if (along === undefined) return;
    event.preventDefault();
    const edit = (scene) => {
      if (kind === "cut") scene.cut.angle_deg = degrees((scene.cut.angle_deg ?? 0) + (along + out) * STEP_DEG);
      else if (kind === "probe") {
        const probe = (scene.probe ??= { angle_deg: 90 });
        probe.angle_deg = degrees(probe.angle_deg + along * STEP_DEG);
        if (out !== 0) probe.radius_m = within((probe.radius_m ?? 0.5 * scene.blade.outer_diameter_m) + out * STEP_M, scene);
      } else {
        const pad = scene.guides[Number(path.match(/\d+/)[0])];
        const larger = (side, by) => metres(Math.max(side + by * 2 * STEP_M, LEAST_SIDE_M));
        if (event.shiftKey) {
          pad.radial_length_m = larger(pad.radial_length_m, out);
          pad.tangential_length_m = larger(pad.tangential_length_m, -along);
        } else {
          pad.angle_deg = degrees(pad.angle_deg + along * STEP_DEG);
          pad.radius_m = within(pad.radius_m + out * STEP_M, scene);
        }
      }
    };
    this.state.change(edit, { draft: true, stamp: event.timeStamp, run: path });
  }
}

// Rounds a radius and limits it to the blade, so that the centre of a part stays on it.
function within(radius, scene) {
  const [a, b] = [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
  return Math.min(Math.max(metres(radius), a), b);
}

// Coordinates in the drawing, where y points down. The angle is counted counterclockwise from the right, in the
// direction of rotation.
function polar(r, angle_deg) {
  return [r * Math.cos(radians(angle_deg)), -r * Math.sin(radians(angle_deg))];
}

function circle(r) {
  return ellipse(r, r);
}

function ellipse(a, b) {
  return `M${-a} 0A${a} ${b} 0 1 0 ${a} 0A${a} ${b} 0 1 0 ${-a} 0Z`;
}

// Returns the parts of the blade that do not move by hand, each with its class and its path.
function ground({ blade, mount }) {
  const [a, b] = [0.5 * blade.inner_diameter_m, 0.5 * blade.outer_diameter_m];
  const collar = mount.kind === "collar" ? [["collar", circle(0.5 * mount.diameter_m) + circle(a)]] : [];
  return [["plate", toothed(b, blade.teeth ?? 0) + circle(a)], ["bore", circle(a)], ...collar];
}

// Path of a pad about its centre.
function outline({ radial_length_m, tangential_length_m, shape }) {
  const [h, v] = [radial_length_m / 2, tangential_length_m / 2];
  return shape === "round" ? ellipse(h, v) : `M${-h} ${-v}H${h}V${v}H${-h}Z`;
}

// Returns a small picture of a saw.
export function thumbnail(scene) {
  const reach = Blade.reach(scene);
  const picture = element("svg", { class: "thumbnail", "aria-hidden": "true", viewBox: `${-reach} ${-reach} ${2 * reach} ${2 * reach}` });
  for (const [name, d] of ground(scene)) element("path", { class: name, d, "fill-rule": "evenodd" }, picture);
  for (const pad of scene.guides ?? []) {
    const [x, y] = polar(pad.radius_m, pad.angle_deg);
    const least = (length) => Math.max(length, 0.1 * reach);
    const d = outline({ ...pad, radial_length_m: least(pad.radial_length_m), tangential_length_m: least(pad.tangential_length_m) });
    element("path", { class: "body", d, transform: `translate(${x} ${y}) rotate(${-pad.angle_deg})` }, element("g", { class: "pad" }, picture));
  }
  return picture;
}

// Path of the rim. The shape of its teeth is an illustration: the model has a circular rim.
function toothed(b, teeth) {
  if (teeth < 3 || teeth > 400) return circle(b);
  const pitch = 360 / teeth;
  const depth = Math.min(0.03 * b, 0.4 * ((2 * Math.PI * b) / teeth));
  let path = "";
  for (let k = 0; k < teeth; k++) {
    const [x, y] = polar(b - depth, k * pitch);
    const [u, v] = polar(b, k * pitch + 0.62 * pitch);
    const [p, q] = polar(b - depth, k * pitch + 0.7 * pitch);
    path += `${k === 0 ? "M" : "L"}${x} ${y}L${u} ${v}L${p} ${q}`;
  }
  return `${path}Z`;
}
