// Draws a moving mode as a tilted blade with exaggerated bending, by WebGL2: one grid over radius and angle, whose
// deflection w(r, θ, t) = Re Σ (c(r) cos nθ + s(r) sin nθ) e^{iωt} the graphics card takes from a texture.

const RINGS = 16;
const STEPS = 480;
const TILT_DEG = 52;
// Largest deflection, and half the height of a pad, as shares of half the width of the picture.
const BENDING = 0.2;
const PAD = 0.07;

const VERTEX = `#version 300 es
precision highp float;
uniform highp sampler2D shape;  // A row for each harmonic, a column for each radius: Re c, Im c, Re s, Im s.
uniform int orders[32];
uniform int count;
uniform vec2 rim;               // Inner and outer radius.
uniform vec2 phase;             // cos and sin of ωt.
uniform float scale, turn, teeth, depth, tilt;
uniform bool isBlade;
in vec3 at;                     // Share of the radius and angle of a point of the blade, or a point of a pad.
out float w;
out vec2 polar;
out vec3 place;
float deflection(float share, float angle) {
  float place = share * float(textureSize(shape, 0).x - 1);
  int i = min(int(place), textureSize(shape, 0).x - 2);
  vec2 sum = vec2(0);
  for (int k = 0; k < count; k++) {
    vec4 here = mix(texelFetch(shape, ivec2(i, k), 0), texelFetch(shape, ivec2(i + 1, k), 0), place - float(i));
    float n = float(orders[k]) * angle;
    sum += here.xy * cos(n) + here.zw * sin(n);
  }
  return (sum.x * phase.x - sum.y * phase.y) * scale;
}
vec3 placed(float share, float angle) {
  w = deflection(share, angle);
  float tooth = teeth > 2.0 ? fract((angle - turn) * teeth / 6.2831853) : 1.0;
  float gullet = depth * (tooth < 0.62 ? 1.0 - tooth / 0.62 : 1.0) * step(2.5, teeth);
  float r = mix(rim.x, rim.y, share) - gullet * step(0.999, share);
  return vec3(r * cos(angle), r * sin(angle), ${BENDING} * w);
}
void main() {
  vec3 p = at;
  if (isBlade) {
    p = placed(at.x, at.y);
    polar = vec2(at.x, mod(at.y - turn, 6.2831853));
  }
  place = p;
  float c = cos(tilt), s = sin(tilt);
  gl_Position = vec4(p.x, p.y * c + p.z * s, p.y * s - p.z * c, 1.12);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 up, down, rest, ink, pad;
uniform bool isBlade;
in float w;
in vec2 polar;
in vec3 place;
out vec4 colour;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float light = 0.6 + 0.4 * abs(dot(normal, normalize(vec3(0.4, -0.6, 0.7))));
  colour = vec4(pad * light, 1) * 0.8;
  if (!isBlade) return;
  vec3 own = mix(rest, w > 0.0 ? up : down, min(abs(w), 1.0));
  // A mark turns with the blade.
  float off = min(polar.y, 6.2831853 - polar.y);
  colour = vec4(abs(polar.x - 0.9) < 0.03 && off < 0.04 ? ink : own * light, 1);
}`;

// Points of the grid, and the triangles between them.
function grid() {
  const points = [];
  const corners = [];
  for (let i = 0; i <= RINGS; i++) for (let j = 0; j <= STEPS; j++) points.push(i / RINGS, (2 * Math.PI * j) / STEPS, 0);
  const at = (i, j) => i * (STEPS + 1) + j;
  for (let i = 0; i < RINGS; i++) for (let j = 0; j < STEPS; j++) corners.push(at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
  return { points, corners };
}

// A block for each pad on either side of the blade, in shares of `reach`.
function blocks(guides, reach) {
  const faces = [0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 3, 6, 3, 7, 6, 0, 2, 4, 2, 6, 4, 1, 3, 5, 3, 7, 5];
  const made = { points: [], corners: [] };
  for (const { radius_m, angle_deg, radial_length_m, tangential_length_m } of guides) for (const side of [-1, 1]) {
    const first = made.points.length / 3;
    const [c, s] = [Math.cos((angle_deg * Math.PI) / 180), Math.sin((angle_deg * Math.PI) / 180)];
    for (const [i, j, k] of [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => [corner & 1, corner & 2, corner & 4])) {
      const u = radius_m + (i ? 0.5 : -0.5) * Math.max(radial_length_m, 0.04 * reach);
      const v = (j ? 0.5 : -0.5) * Math.max(tangential_length_m, 0.04 * reach);
      made.points.push((u * c - v * s) / reach, (u * s + v * c) / reach, side * (BENDING * 0.4 + (k ? PAD : 0)));
    }
    made.corners.push(...faces.map((corner) => first + corner));
  }
  return made;
}

export class Relief {
  #blade;
  #pads = null;
  #isNew = true;

  // `gl` is the context of a canvas.
  constructor(gl) {
    this.gl = gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.place = (name) => gl.getUniformLocation(program, name);
    this.point = gl.getAttribLocation(program, "at");
    this.#blade = this.#mesh(grid());
  }

  #mesh({ points, corners }) {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(this.point);
    gl.vertexAttribPointer(this.point, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(corners), gl.STATIC_DRAW);
    return { array, count: corners.length };
  }

  // Takes a mode of a saw; `largest` is its largest deflection.
  begin({ radius_m, harmonics }, largest, scene, reach) {
    const { gl } = this;
    const values = harmonics.flatMap(({ cosine, sine }) => radius_m.flatMap((_, i) => [cosine.re[i], cosine.im[i], sine.re[i], sine.im[i]]));
    if (this.#isNew) gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    this.#isNew = false;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, radius_m.length, harmonics.length, 0, gl.RGBA, gl.FLOAT, new Float32Array(values));
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    gl.uniform1iv(this.place("orders"), harmonics.map(({ nodal_diameters }) => nodal_diameters).slice(0, 32));
    gl.uniform1i(this.place("count"), Math.min(harmonics.length, 32));
    gl.uniform2f(this.place("rim"), radius_m[0] / reach, radius_m.at(-1) / reach);
    const teeth = scene.blade.teeth ?? 0;
    gl.uniform1f(this.place("teeth"), teeth <= 120 ? teeth : 0);
    gl.uniform1f(this.place("depth"), Math.min(0.03, 2.5 / Math.max(teeth, 1)) * (radius_m.at(-1) / reach));
    gl.uniform1f(this.place("scale"), 1 / (largest || 1));
    gl.uniform1f(this.place("tilt"), (TILT_DEG * Math.PI) / 180);
    this.#pads = this.#mesh(blocks(scene.guides ?? [], reach));
  }

  // Draws the mode at a phase of its oscillation, with the blade turned by an angle. Colours are lists from 0 to 255.
  draw(phase, turn, colours) {
    const { gl } = this;
    gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const name of ["up", "down", "rest", "ink", "pad"]) gl.uniform3fv(this.place(name), colours[name].map((channel) => channel / 255));
    gl.uniform2f(this.place("phase"), Math.cos(phase), Math.sin(phase));
    gl.uniform1f(this.place("turn"), turn);
    for (const mesh of [this.#blade, this.#pads]) {
      gl.uniform1i(this.place("isBlade"), Number(mesh === this.#blade));
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    }
  }
}
