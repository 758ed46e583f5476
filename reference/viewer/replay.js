// The replay of a collision: for every element .replay of the page a canvas and its controls. The clip stands in the
// element as JSON; docs/design.md says what is in it. Only the replay that plays asks the browser for frames.
"use strict";
(() => {
const HELP = "Space plays and pauses; ← → step (ten with Shift); Home, End; I next impact; + − speed; " +
  "1 … 9 runs; C contacts; [ ] { } or dragging turn the view; R resets.";
const ICONS = { play: "M3 1l11 7-11 7z", pause: "M3 1h4v14H3zM9 1h4v14H9z", back: "M3 1h2v14H3zM14 1v14L7 8z",
  next: "M11 1h2v14h-2zM2 1l7 7-7 7z", impact: "M7 0h2v6h4l-5 6-5-6h4zM2 14h12v2H2z",
  reset: "M8 2a6 6 0 1 0 6 6h-2a4 4 0 1 1-4-4v3l5-4-5-4z" };
const MARGIN = 22, HELD = 15, SAME = 1.5; // px about the scene; frames an impact stays in sight; px that nobody sees
let playing = null; // at most one of a page

function add(parent, tag, attributes = {}, text = "") {
  const space = ["svg", "path"].includes(tag) ? "http://www.w3.org/2000/svg" : "http://www.w3.org/1999/xhtml";
  const element = parent.appendChild(document.createElementNS(space, tag));
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.textContent = text;
  return element;
}

// Vectors, and quaternions w x y z
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const unit = a => { const size = Math.hypot(...a) || 1; return a.map(part => part / size); };
const rotate = ([w, ...q], v) => {
  const once = cross(q, v);
  return plus(plus(v, once, 2 * w), cross(q, once), 2);
};

// Columns of `count` numbers: second differences, zigzag, seven bits a byte, runs of zeros. See packing.py.
function unpack(text, count, columns, step) {
  const bytes = atob(text);
  let at = 0;
  const next = () => {
    for (let value = 0, worth = 1; ; worth *= 128) {
      const byte = bytes.charCodeAt(at++);
      value += (byte & 127) * worth;
      if (byte < 128) return value;
    }
  };
  return Array.from({ length: columns }, () => {
    let value = 0, slope = 0, zeros = 0;
    return Float64Array.from({ length: count }, () => {
      let part = 0;
      if (zeros) zeros--; else if (!(part = next())) zeros = next();
      slope += part % 2 ? -(part + 1) / 2 : part / 2;
      return (value += slope) * step;
    });
  });
}

class Replay {
  constructor(element) {
    this.element = element;
    this.clip = JSON.parse(element.querySelector("script[type='application/json']").textContent);
    const { runs, step, turn } = this.clip;
    for (const run of runs) {
      run.at = unpack(run.positions, run.count, 3 * run.bodies.length, step);
      run.turned = unpack(run.turns, run.count, 4 * run.bodies.length, turn);
      run.net = unpack(run.points, run.count, 3 * run.mesh, step);
      run.impacts = run.touches.filter(touch => touch.length > 9);
    }
    this.longest = Math.max(1e-9, ...runs.flatMap(run => run.impacts.map(touch => Math.hypot(...touch.slice(9)))));
    this.frame = this.time = 0;
    this.contacts = true;
    this.build();
    this.reset();
    this.watch();
  }

  build() {
    const { clip, element } = this, names = clip.runs.map(run => run.title).join(", ");
    element.classList.add("live");
    const label = `${clip.title}. Replay of ${names}.`;
    this.canvas = add(element, "canvas", { role: "img", tabindex: 0, "aria-label": label });
    this.canvas.style.aspectRatio = 1 / clip.ratio;
    const bar = this.bar = add(element, "div", { class: "replay-bar", role: "group", "aria-label": "controls" });
    this.toggle = this.button("play", "Play", () => this.play(playing !== this));
    this.button("back", "One frame back", () => this.show(this.frame - 1));
    this.button("next", "One frame on", () => this.show(this.frame + 1));
    if (clip.runs.some(run => run.impacts.length)) this.button("impact", "Next impact", () => this.jump());
    this.scrub = add(bar, "input", { type: "range", min: 0, max: clip.count - 1, "aria-label": "time" });
    this.scrub.addEventListener("input", () => this.show(Number(this.scrub.value)));
    this.clock = add(bar, "span", { class: "replay-time" });
    this.speed = add(bar, "select", { "aria-label": "speed", title: "Speed, as a multiple of real time" });
    for (const [speed, label] of clip.speeds) add(this.speed, "option", { value: speed }, label);
    this.speed.selectedIndex = 2;
    this.button("reset", "Start and view as at first", () => this.reset());
    this.choices = add(element, "fieldset", { class: "replay-runs", "aria-label": "what is shown" });
    this.boxes = clip.runs.map((run, place) => this.choice(run, place));
    if (clip.runs.some(run => run.touches.length)) {
      this.contactBox = this.box(true, on => { this.contacts = on; });
      this.whose = add(this.contactBox.parentNode, "span", {}, "contacts");
    }
    const help = add(element, "details", { class: "replay-help" });
    add(help, "summary", {}, "Keys");
    add(help, "span", {}, HELP);
  }
  button(icon, label, action) {
    const made = add(this.bar, "button", { type: "button", title: label, "aria-label": label });
    add(add(made, "svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }), "path", { d: ICONS[icon] });
    made.addEventListener("click", action);
    return made;
  }
  box(checked, change) {
    const input = add(add(this.choices, "label"), "input", { type: "checkbox" });
    input.checked = checked;
    input.addEventListener("change", () => { change(input.checked); this.draw(); });
    return input;
  }
  choice(run, place) {
    const input = this.box(run.shown, on => { run.shown = on; }), label = input.parentNode;
    const line = { stroke: `var(--replay-${run.look})`, "stroke-width": 2.5, "stroke-dasharray": run.dash.join(" ") };
    const solid = { d: "M3 2h32v12H3z", fill: "var(--replay-body)", stroke: line.stroke, "stroke-width": 2 };
    const swatch = add(label, "svg", { viewBox: "0 0 38 16", "aria-hidden": "true" });
    add(swatch, "path", place ? { d: "M1 8h36", ...line } : solid);
    add(label, "span", {}, run.title);
    if (run.note) add(label, "small", { title: run.note }, "recorded");
    const end = run.count ? `ends at ${((run.count - 1) / this.clip.rate).toFixed(2)} s` : "no poses";
    if (run.count < this.clip.count) add(label, "small", {}, end);
    return input;
  }
  watch() {
    let from = null, moved = 0;
    const on = (name, action) => this.canvas.addEventListener(name, action);
    on("pointerdown", event => {
      [from, moved] = [event, 0];
      this.canvas.setPointerCapture(event.pointerId);
    });
    on("pointermove", event => {
      if (!from) return;
      const x = event.clientX - from.clientX, y = event.clientY - from.clientY;
      moved += Math.hypot(x, y);
      if (moved < 4) return;
      from = event;
      this.turn(-0.4 * x, 0.4 * y);
    });
    on("pointerup", () => { if (from && moved < 4) this.play(playing !== this); from = null; });
    on("pointercancel", () => { from = null; });
    this.element.addEventListener("keydown", event => this.key(event));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.size());
    new ResizeObserver(() => this.size()).observe(this.canvas);
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      if (this.visible) this.size(); else this.play(false);
    }).observe(this.canvas);
  }
  key(event) {
    const { target, key, shiftKey } = event, last = this.clip.count - 1, far = shiftKey ? 10 : 1;
    if (event.ctrlKey || event.metaKey || event.altKey || target.tagName === "SELECT") return;
    if (key === " " && (target.tagName === "BUTTON" || target.type === "checkbox")) return; // it has its meaning there
    const go = frame => { this.play(false); this.show(frame); }, options = this.speed.options.length;
    const faster = by => {
      this.speed.selectedIndex = Math.min(options - 1, Math.max(0, this.speed.selectedIndex + by));
    };
    const actions = {
      " ": () => this.play(playing !== this), arrowleft: () => go(this.frame - far), i: () => this.jump(),
      arrowright: () => go(this.frame + far), home: () => go(0), end: () => go(last), r: () => this.reset(),
      "+": () => faster(1), "=": () => faster(1), "-": () => faster(-1), "−": () => faster(-1),
      "[": () => this.turn(-10, 0), "]": () => this.turn(10, 0), "{": () => this.turn(0, -10),
      "}": () => this.turn(0, 10), c: () => this.contactBox?.click() };
    const action = actions[key.toLowerCase()] || (/^[1-9]$/.test(key) && (() => this.boxes[key - 1]?.click()));
    if (!action) return;
    event.preventDefault();
    action();
  }

  // Time
  show(frame) {
    const { count, rate } = this.clip;
    this.frame = Math.min(count - 1, Math.max(0, frame));
    if (Math.floor(this.time * rate + 1e-6) !== this.frame) this.time = this.frame / rate;
    const words = `${(this.frame / rate).toFixed(3)} s · frame ${this.frame} of ${count - 1}`;
    this.scrub.value = this.frame;
    this.scrub.setAttribute("aria-valuetext", words);
    this.clock.textContent = words;
    this.draw();
  }
  play(on) {
    if (on === (playing === this) || (on && this.visible === false)) return; // nobody would see it
    if (playing && on) playing.play(false);
    playing = on ? this : null;
    const label = on ? "Pause" : "Play";
    this.toggle.querySelector("path").setAttribute("d", ICONS[on ? "pause" : "play"]);
    this.toggle.title = label;
    this.toggle.setAttribute("aria-label", label);
    if (!on) return;
    const { count, rate } = this.clip;
    if (this.frame === count - 1) this.show(0);
    let before = null;
    const step = now => {
      if (playing !== this) return;
      if (before !== null) this.time += Math.min(0.25, (now - before) / 1000) * Number(this.speed.value);
      before = now;
      const frame = Math.floor(this.time * rate + 1e-6);
      if (frame !== this.frame) this.show(frame);
      if (this.frame === count - 1) this.play(false); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
  jump() {
    const impacts = this.clip.runs.find(run => run.shown && run.count)?.impacts || [];
    this.play(false);
    if (impacts.length) this.show((impacts.find(([first]) => first > this.frame) || impacts[0])[0]);
  }
  reset() {
    this.play(false);
    this.look(...this.clip.view);
    this.show(0);
  }

  // The view: a parallel projection, as in camera.py
  look(azimuth, pitch) {
    const a = azimuth * Math.PI / 180, p = pitch * Math.PI / 180;
    [this.azimuth, this.pitch] = [azimuth, pitch];
    this.right = [-Math.sin(a), Math.cos(a), 0];
    this.towards = [Math.cos(p) * Math.cos(a), Math.cos(p) * Math.sin(a), Math.sin(p)];
    this.up = cross(this.towards, this.right);
  }
  turn(azimuth, pitch) {
    this.look(this.azimuth + azimuth, Math.min(90, Math.max(-90, this.pitch + pitch)));
    this.draw();
  }
  fit() {
    const { low, high } = this.clip, room = [this.width - 2 * MARGIN, this.height - 2 * MARGIN];
    const ends = [this.right, this.up].map(axis => [0, 1].map(side => // the least and the most of the bounds' corners
      axis.reduce((sum, part, i) => sum + part * (part > 0 === !side ? low[i] : high[i]), 0)));
    this.scale = Math.max(1e-6, Math.min(...ends.map(([least, most], i) => room[i] / Math.max(most - least, 1e-9))));
    this.middle = ends.map(([least, most]) => (least + most) / 2);
  }
  project(point) {
    return [this.width / 2 + this.scale * (dot(point, this.right) - this.middle[0]),
      this.height / 2 - this.scale * (dot(point, this.up) - this.middle[1]), dot(point, this.towards)];
  }

  // Drawing
  size() {
    const { canvas } = this, dense = devicePixelRatio || 1, style = getComputedStyle(this.element);
    if (!this.visible || !canvas.clientWidth) return;
    [this.width, this.height] = [canvas.clientWidth, canvas.clientHeight];
    [canvas.width, canvas.height] = [Math.round(this.width * dense), Math.round(this.height * dense)];
    this.pen = canvas.getContext("2d");
    this.pen.setTransform(dense, 0, 0, dense, 0, 0);
    this.pen.lineJoin = this.pen.lineCap = "round";
    const names = ["page", "ink", "dim", "line", "body", "still", 0, 1, 2, 3, 4, 5, 6];
    this.colours = Object.fromEntries(names.map(name => [name, style.getPropertyValue(`--replay-${name}`).trim()]));
    this.draw();
  }
  draw() {
    if (!this.visible || !this.pen) return;
    const { pen, clip, colours } = this, { runs, solids } = clip, parts = [];
    this.painted = new Map(); // the parts of each run
    this.fit();
    pen.fillStyle = colours.page;
    pen.fillRect(0, 0, this.width, this.height);
    const moving = new Set(runs.flatMap(run => run.count ? run.bodies : []));
    for (const solid of solids) if (solid.plane) this.ground(solid);
    solids.forEach((solid, i) => {
      if (!moving.has(i)) parts.push(...this.parts(solid, solid.at, solid.turn, colours.dim, colours.still));
    });
    this.rest = [...parts]; // the bodies that do not move
    if (runs[0]?.shown) {
      this.ways(runs[0]);
      this.painted.set(runs[0], this.run(runs[0], colours.body));
      parts.push(...this.painted.get(runs[0]));
    }
    parts.sort((a, b) => a.depth - b.depth).forEach(part => this.paint(part)); // the furthest first
    if (runs[0]?.shown) this.starts(runs[0]);
    runs.forEach((run, place) => {
      if (!run.shown) return;
      pen.setLineDash(run.dash);
      if (place) this.painted.set(run, this.run(run)).get(run).forEach(part => this.paint(part));
      pen.setLineDash([]);
    });
    this.arrows(runs.find(run => run.shown && run.count));
    const named = runs.length > 1 ? runs.filter(run => run.shown && run.count) : [], groups = this.together(named);
    this.labels = []; // where they are
    for (const group of groups) this.name(group, groups.length);
  }
  place(run, columns, i) {
    const frame = Math.min(this.frame, run.count - 1);
    return [0, 1, 2].map(axis => columns[3 * i + axis][frame]);
  }
  run(run, fill) { // what it shows now, as parts to paint; without a fill its outline
    if (!run.count) return [];
    const colour = this.colours[run.look], found = [], frame = Math.min(this.frame, run.count - 1);
    run.bodies.forEach((solid, i) => {
      const turn = unit(run.turned.slice(4 * i, 4 * i + 4).map(column => column[frame]));
      found.push(...this.parts(this.clip.solids[solid], this.place(run, run.at, i), turn, colour, fill));
    });
    const points = Array.from({ length: run.mesh }, (_, i) => this.project(this.place(run, run.net, i)));
    for (const ends of points.length ? this.clip.springs : []) {
      const path = ends.map(end => points[end]);
      found.push({ path, open: true, stroke: colour, depth: (path[0][2] + path[1][2]) / 2 });
    }
    for (const disc of points) found.push({ disc, radius: 3, fill: fill && colour, stroke: colour, depth: disc[2] });
    for (const part of found) {
      part.faint = this.frame >= run.count;
      part.width = fill ? 1.5 : run.mesh ? Math.min(2, run.width) : run.width;
    }
    return found;
  }
  parts(solid, at, turn, stroke, fill) {
    if (solid.sphere) {
      const disc = this.project(at), radius = solid.sphere * this.scale;
      const marks = fill && radius > 8 ? this.circles(at, turn, solid.sphere) : [];
      return [{ disc, radius, fill, stroke, marks, depth: disc[2] }];
    }
    if (solid.capsule) {
      const axis = rotate(turn, [0, 0, solid.capsule[1]]), radius = solid.capsule[0] * this.scale;
      const [one, other] = [1, -1].map(side => this.project(plus(at, axis, side)));
      return [{ capsule: [one, other], radius, fill, stroke, depth: (one[2] + other[2]) / 2 }];
    }
    const points = (solid.points || []).map(point => plus(at, rotate(turn, point)));
    const places = points.map(point => this.project(point)), edges = new Map(), found = [];
    for (const face of solid.faces || []) {
      const [a, b, c] = face.map(i => points[i]), path = face.map(i => places[i]);
      const light = dot(unit(cross(plus(b, a, -1), plus(c, b, -1))), this.towards);
      if (light < 1e-3) continue;
      found.push({ path, light, fill, stroke, depth: path.reduce((sum, point) => sum + point[2], 0) / path.length });
      face.forEach((start, i) => {
        const end = face[(i + 1) % face.length];
        edges.set([start, end].sort().join(), [places[start], places[end]]);
      });
    }
    return fill ? found : [...edges.values()].map(path => ({ path, open: true, stroke, depth: 0 })); // each edge once
  }
  circles(at, turn, radius) { // the near halves of three great circles, by which one sees a ball turn
    return [0, 1, 2].map(axis => Array.from({ length: 41 }, (_, i) => {
      const angle = i * Math.PI / 20, flat = [radius * Math.cos(angle), radius * Math.sin(angle), 0];
      const spot = rotate(turn, [flat[axis], flat[(axis + 1) % 3], flat[(axis + 2) % 3]]);
      return dot(spot, this.towards) < 0 ? null : this.project(plus(at, spot));
    }));
  }
  paint({ disc, capsule, path, open, radius, fill, stroke, light, marks = [], faint, width = 1.5 }) {
    const { pen } = this, [[x, y], [u, v]] = capsule || [[], []], along = Math.atan2(v - y, u - x), right = Math.PI / 2;
    pen.globalAlpha = faint ? 0.45 : 1;
    pen.beginPath();
    if (disc) pen.arc(disc[0], disc[1], Math.max(radius, 1.5), 0, 4 * right);
    if (capsule) pen.arc(x, y, radius, along + right, along - right);
    if (capsule) pen.arc(u, v, radius, along - right, along + right);
    for (const point of path || []) pen.lineTo(point[0], point[1]);
    if (!open) pen.closePath();
    for (const colour of fill ? [fill, `rgba(0,0,0,${light ? 0.28 * (1 - light) : 0})`] : []) { // darker if turned away
      pen.fillStyle = colour;
      pen.fill();
    }
    [pen.strokeStyle, pen.lineWidth] = [stroke, width];
    pen.stroke();
    pen.lineWidth = 1;
    for (const mark of marks) this.line(mark);
    pen.globalAlpha = 1;
  }
  line(points) { // through all that are there
    this.pen.beginPath();
    points.forEach((point, i) => point && this.pen[points[i - 1] ? "lineTo" : "moveTo"](point[0], point[1]));
    this.pen.stroke();
  }
  ground({ plane: normal, at }) { // edge on all below a line; else a square piece with a grid
    const { pen, colours } = this, { low, high } = this.clip, facing = dot(normal, this.towards);
    const middle = plus([0, 0, 0], plus(low, high), 0.5);
    const foot = plus(middle, normal, dot(plus(at, middle, -1), normal)), edge = Math.abs(facing) < 0.03;
    const one = unit(cross(normal, edge ? this.towards : Math.abs(normal[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
    const other = cross(normal, one), reach = Math.max(...high.map((most, i) => most - low[i]));
    const half = edge ? (this.width + this.height) / this.scale : 0.65 * reach;
    const spot = (i, j) => this.project(plus(plus(foot, one, half * i), edge ? normal : other, half * j));
    pen.fillStyle = colours.still;
    pen.beginPath();
    for (const corner of edge ? [[-1, 0], [1, 0], [1, -1], [-1, -1]] : [[-1, -1], [1, -1], [1, 1], [-1, 1]])
      pen.lineTo(...spot(...corner).slice(0, 2));
    if (edge || facing > 0) pen.fill();
    [pen.strokeStyle, pen.lineWidth] = edge ? [colours.dim, 1.5] : [colours.line, 1];
    if (edge) this.line([spot(-1, 0), spot(1, 0)]);
    for (let i = -1; !edge && i <= 1; i += 0.25) {
      this.line([spot(i, -1), spot(i, 1)]);
      this.line([spot(-1, i), spot(1, i)]);
    }
  }
  ways(run) { // of the centres, so far
    const { pen } = this, length = Math.min(this.frame + 1, run.count);
    [pen.strokeStyle, pen.lineWidth, pen.globalAlpha] = [this.colours[run.look], 1, 0.4];
    run.bodies.forEach((_, i) => {
      const [x, y, z] = run.at.slice(3 * i, 3 * i + 3);
      this.line(Array.from({ length }, (_, k) => this.project([x[k], y[k], z[k]])));
    });
    pen.globalAlpha = 1;
  }
  starts(run) { // rings where the centres of balls began that hide their way, and dots where they are
    for (const i of run.covered) {
      const start = [0, 1, 2].map(axis => run.at[3 * i + axis][0]), spots = [start, this.place(run, run.at, i)];
      spots.forEach((at, k) => this.paint({ disc: this.project(at), radius: 5 - 3 * k, stroke: this.colours.ink }));
    }
  }
  mark(run) { // where its label goes, on the body furthest from the first run's; nothing where it has no body
    if (!run.bodies.length && !run.mesh) return null;
    return this.project(this.place(run, run.bodies.length ? run.at : run.net, run.marked));
  }
  together(runs) { // in groups whose outlines cannot be told apart here: their labels are joined by =
    const groups = [];
    for (const run of runs.filter(each => this.mark(each))) {
      const [x, y] = this.mark(run), near = ([u, v]) => Math.hypot(x - u, y - v) < SAME;
      const group = groups.find(([first]) => first.marked === run.marked && near(this.mark(first)));
      if (group) group.push(run); else groups.push([run]);
    }
    return groups;
  }
  name(group, count) { // its labels over the body, or under it where there is no room, clear of the others
    const [run] = group, label = group.map(each => each.tag).join(" = "), wide = 8 * label.length;
    const [x, y, least] = count > 1 ? this.beside(run) : this.around(run), above = y - least;
    const up = above > 22 + 16 * count || above > this.height - y - least ? -1 : 1;
    let down = y + up * (least + 24);
    const meets = ([u, v, w]) => Math.abs(x - u) < (wide + w) / 2 && Math.abs(down - v) < 16;
    while (this.labels.some(meets)) down += 16 * up;
    this.labels.push([x, down, wide]);
    this.text(label, x, down, group.length > 1 ? this.colours.ink : this.colours[run.look], "bold");
  }
  beside(run) { // the middle of the marked body, and how far it reaches at least
    const solid = this.clip.solids[run.bodies[run.marked]] || {}, [x, y] = this.mark(run);
    const reach = [0, 1, 2].map(axis => Math.max(0, ...(solid.points || []).map(point => point[axis])));
    const radius = solid.sphere || solid.capsule?.[0] || 0;
    return [x, y, this.scale * (radius || Math.min(...reach))];
  }
  around(run) { // the same of all that is shown: a single label would hide the bodies next to the marked one
    const parts = [...this.rest, ...this.painted.get(run)];
    const ends = parts.flatMap(({ disc, capsule, path, radius = 0 }) => (path || capsule || [disc])
      .flatMap(([x, y]) => [[x - radius, y - radius], [x + radius, y + radius]]));
    if (!ends.length) return this.beside(run);
    const [[left, right], [top, bottom]] = [0, 1].map(axis => [Math.min, Math.max].map(most =>
      ends.reduce((found, end) => most(found, end[axis]), ends[0][axis])));
    return [(left + right) / 2, (top + bottom) / 2, (bottom - top) / 2];
  }
  text(words, x, y, colour, weight = "") {
    const { pen } = this;
    pen.font = `${weight} 13px system-ui, sans-serif`;
    const wide = pen.measureText(words).width, left = Math.min(Math.max(x - wide / 2, 2), this.width - wide - 2);
    [pen.lineWidth, pen.strokeStyle, pen.fillStyle] = [4, this.colours.page, colour];
    pen.strokeText(words, left, Math.min(Math.max(y + 4, 14), this.height - 4));
    pen.fillText(words, left, Math.min(Math.max(y + 4, 14), this.height - 4));
  }
  arrows(run) { // of the first run in sight: contacts' normals, short; impacts' impulses, longer, and held for a while
    if (this.whose) this.whose.textContent = `contacts of ${run ? run.tag : "nobody"}`;
    if (!run || !this.contacts || this.frame >= run.count) return;
    for (const [first, last, solid, ...values] of run.touches) {
      const impulse = values.slice(6), size = Math.hypot(...impulse), gone = this.frame - last;
      if (this.frame < first || gone > (size ? HELD : 0)) continue;
      const from = size ? values : plus(this.place(run, run.at, run.bodies.indexOf(solid)), values);
      this.pen.globalAlpha = 1 - Math.max(0, gone) / (HELD + 1);
      const tip = size ? this.arrow(from, unit(impulse), 22 + 58 * size / this.longest, 3.5)
        : this.arrow(from, values.slice(3), 20, 1.5);
      if (size && tip) this.text(`${Number(size.toPrecision(3))} N s`, tip[0], tip[1] - 12, this.colours.ink);
    }
    this.pen.globalAlpha = 1;
  }
  arrow(from, direction, length, width) { // where its tip is; nothing where it points at the viewer
    const { pen } = this, u = dot(direction, this.right), v = -dot(direction, this.up), seen = Math.hypot(u, v);
    if (seen < 0.05) return null;
    const [x, y] = this.project(from), tip = [x + u * length, y + v * length];
    const k = Math.min(4 + 1.6 * width, length / 3);
    const barbs = [0.6, -0.6].map(side => [tip[0] - k * (u + side * v) / seen, tip[1] - k * (v - side * u) / seen]);
    for (const [colour, more] of [[this.colours.page, 3], [this.colours.ink, 0]]) {
      [pen.strokeStyle, pen.lineWidth] = [colour, width + more];
      this.line([[x, y], tip]);
      this.line([barbs[0], tip, barbs[1]]);
    }
    return tip;
  }
}

const all = document.querySelectorAll(".replay");
for (const element of all) element.replay = new Replay(element);
if (all.length === 1) { // alone it hears every key, and starts by itself where that is asked for and motion is welcome
  const { replay } = all[0], still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  document.body.addEventListener("keydown", event => event.target === document.body && replay.key(event));
  if ("autoplay" in all[0].dataset && !still) replay.play(true);
}
})();
