// The bricks of the booklet in three dimensions, step by step. Plain WebGL 2, nothing from elsewhere.
(function () {
  "use strict";
  const box = document.getElementById("viewer");
  const data = JSON.parse(document.getElementById("bricks").textContent);
  const canvas = box.querySelector("canvas");
  const slider = box.querySelector("input[type=range]");
  const output = box.querySelector("output");
  const pale = box.querySelector("input[type=checkbox]");
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) {
    canvas.outerHTML = '<p class="sorry">This browser shows no WebGL 2 pictures: follow the pages below.</p>';
    return;
  }

  function decoded(text, kind) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new kind(bytes.buffer);
  }
  const boxes = decoded(data.boxes, Float32Array); // x y z, studs across, studs deep, plates, brick
  const studs = decoded(data.studs, Float32Array); // x y z, brick
  const colour = decoded(data.colour, Uint8Array); // red, green, blue of each brick
  const placed = decoded(data.placed, Uint16Array);
  const removed = decoded(data.removed, Uint16Array);
  const owner = decoded(data.owner, Uint16Array);
  const ramps = decoded(data.ramps, Float32Array); // as boxes, levels of bottom and top at both ends, axis
  const brickOf = decoded(data.brick, Uint32Array); // of each box, then of each stud, then of each ramp
  const BOX = 6, STUD = 3, RAMP = 11;
  const nBoxes = boxes.length / BOX, nStuds = studs.length / STUD, nRamps = ramps.length / RAMP;
  const nBricks = placed.length;

  // what is on the table of a step: 0 nothing, 1 there before, 2 new
  const END = data.table.length; // a place of the slider more: the finished model
  function states(step) {
    const table = data.table[step], state = new Uint8Array(nBricks);
    if (step === END) return state.map((_, brick) => (removed[brick] > END && placed[brick] < END ? 2 : 0));
    for (let brick = 0; brick < nBricks; brick++) {
      let came = placed[brick], at = owner[brick];
      if (came > step || removed[brick] < step) continue;
      while (at !== table && at !== 0) {
        came = Math.max(came, data.joined[at]);
        at = data.parent[at];
      }
      if (at !== table || came > step) continue;
      state[brick] = came === step || removed[brick] === step ? 2 : 1;
    }
    return state;
  }

  const vertex = `#version 300 es
    in vec3 corner; in vec3 normal; in vec3 place; in vec3 size; in vec4 tone; in vec4 lean; in float axis;
    uniform mat4 camera;
    out vec3 local; out vec3 extent; out vec3 way; out vec4 paint; out vec3 bare;
    void main() {
      // falls along x or along y, or has sides that run aslant along x
      bool aside = axis > 1.5, deep = axis > 0.5 && !aside;
      float t = deep ? corner.y : corner.x, run = deep ? size.y : size.x, whole = aside ? size.y : size.z;
      float low = mix(lean.x, lean.y, t) * whole, high = mix(lean.z, lean.w, t) * whole;
      float across = aside ? normal.y : normal.z;
      float rise = (across > 0.5 ? lean.w - lean.z : lean.y - lean.x) * whole / run;
      vec3 tipped = across * (aside ? vec3(-rise, 1.0, 0.0) : vec3(deep ? 0.0 : -rise, deep ? -rise : 0.0, 1.0));
      way = abs(across) > 0.5 && abs(rise) > 0.0 ? tipped : normal;
      paint = tone;
      // no lines across what leans: a curve has many pieces
      bare = !aside && lean.z == lean.w ? vec3(0.0) : deep ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
      extent = aside ? vec3(size.x, high - low, size.z) : vec3(size.xy, high - low);
      local = corner * extent;
      gl_Position = camera * vec4(place + local + (aside ? vec3(0.0, low, 0.0) : vec3(0.0, 0.0, low)), 1.0);
    }`;
  const fragment = `#version 300 es
    precision highp float;
    in vec3 local; in vec3 extent; in vec3 way; in vec4 paint; in vec3 bare;
    uniform float lined; out vec4 colour;
    void main() {
      vec3 n = normalize(way);
      float light = 0.62 + 0.30 * max(dot(n, normalize(vec3(-0.4, -0.7, 0.9))), 0.0) + 0.10 * max(n.z, 0.0);
      vec3 base = paint.rgb * light;
      if (lined > 0.5) {
        vec3 gap = min(local, extent - local) + (step(0.5, abs(way)) + bare) * 1000.0;
        float near = min(gap.x, min(gap.y, gap.z));
        float wide = max(fwidth(near), 0.02);
        float edge = 1.0 - smoothstep(0.12, 0.12 + 1.2 * wide, near);
        float dark = dot(paint.rgb, vec3(0.21, 0.72, 0.07)) < 0.25 ? 0.62 : 0.08;
        base = mix(base, vec3(dark), edge * mix(0.28, 0.85, paint.a));
      }
      colour = vec4(base, 1.0);
    }`;
  function shader(kind, text) {
    const made = gl.createShader(kind);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
    return made;
  }
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const attribute = (name) => gl.getAttribLocation(program, name);

  function cube() {
    const out = [];
    for (let axis = 0; axis < 3; axis++)
      for (const side of [0, 1]) {
        const u = (axis + 1) % 3, v = (axis + 2) % 3;
        const around = side ? [[0, 0], [1, 0], [1, 1], [0, 1]] : [[0, 0], [0, 1], [1, 1], [1, 0]];
        for (const k of [0, 1, 2, 0, 2, 3]) {
          const point = [0, 0, 0], normal = [0, 0, 0];
          point[axis] = side; point[u] = around[k][0]; point[v] = around[k][1];
          normal[axis] = side ? 1 : -1;
          out.push(...point, ...normal);
        }
      }
    return new Float32Array(out);
  }
  function cylinder(n) {
    const out = [], at = (k) => [Math.cos((2 * Math.PI * k) / n), Math.sin((2 * Math.PI * k) / n)];
    for (let k = 0; k < n; k++) {
      const a = at(k), b = at(k + 1);
      for (const [p, z] of [[a, 0], [b, 0], [b, 1], [a, 0], [b, 1], [a, 1]]) out.push(p[0], p[1], z, p[0], p[1], 0);
      for (const [x, y] of [[0, 0], a, b]) out.push(x, y, 1, 0, 0, 1);
    }
    return new Float32Array(out);
  }
  function model(vertices, leaning) {
    const stride = leaning ? 60 : 40;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
    for (const [name, offset] of [["corner", 0], ["normal", 12]]) {
      gl.enableVertexAttribArray(attribute(name));
      gl.vertexAttribPointer(attribute(name), 3, gl.FLOAT, false, 24, offset);
    }
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const each = [["place", 3, 0], ["size", 3, 12], ["tone", 4, 24]];
    if (leaning) each.push(["lean", 4, 40], ["axis", 1, 56]);
    for (const [name, count, offset] of each) {
      gl.enableVertexAttribArray(attribute(name));
      gl.vertexAttribPointer(attribute(name), count, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(attribute(name), 1);
    }
    return { array, buffer, corners: vertices.length / 6, count: 0, size: stride / 4 };
  }
  const cubes = model(cube(), false), knobs = model(cylinder(16), false), slopes = model(cube(), true);
  // what does not lean
  gl.vertexAttrib4f(attribute("lean"), 0, 0, 1, 1);
  gl.vertexAttrib1f(attribute("axis"), 0);

  function tone(brick, state, out, at) {
    const white = state === 1 && pale.checked ? 0.6 : 0;
    for (let k = 0; k < 3; k++) out[at + k] = (colour[3 * brick + k] / 255) * (1 - white) + white;
    out[at + 3] = white ? 0 : 1;
  }
  const GAP = 0.08;
  let low = [0, 0, 0], high = [1, 1, 1];
  function show(step) {
    const state = states(step);
    const first = new Float32Array(nBoxes * 10), second = new Float32Array(nStuds * 10);
    let n = 0;
    for (let row = 0; row < nBoxes; row++) {
      const brick = brickOf[row];
      if (!state[brick]) continue;
      const b = boxes.subarray(BOX * row, BOX * row + BOX), at = 10 * n++;
      first.set([8 * b[0] + GAP, 8 * b[1] + GAP, 3.2 * b[2], 8 * b[3] - 2 * GAP, 8 * b[4] - 2 * GAP, 3.2 * b[5] - 0.02], at);
      tone(brick, state[brick], first, at + 6);
    }
    let m = 0;
    for (let row = 0; row < nStuds; row++) {
      const brick = brickOf[nBoxes + row];
      if (!state[brick]) continue;
      const s = studs.subarray(STUD * row, STUD * row + STUD), at = 10 * m++;
      second.set([8 * s[0] + 4, 8 * s[1] + 4, 3.2 * s[2], 2.4, 2.4, 1.7], at);
      tone(brick, state[brick], second, at + 6);
    }
    const third = new Float32Array(nRamps * 15);
    let k = 0;
    for (let row = 0; row < nRamps; row++) {
      const brick = brickOf[nBoxes + nStuds + row];
      if (!state[brick]) continue;
      const r = ramps.subarray(RAMP * row, RAMP * row + RAMP), at = 15 * k++, y = r[10] === 1;
      // gaps at the sides alone: the pieces of a part touch each other
      const gx = y ? GAP : 0, gy = y ? 0 : GAP;
      third.set([8 * r[0] + gx, 8 * r[1] + gy, 3.2 * r[2], 8 * r[3] - 2 * gx, 8 * r[4] - 2 * gy, 3.2 * r[5] - 0.02], at);
      tone(brick, state[brick], third, at + 6);
      third.set(r.subarray(6, 11), at + 10);
    }
    for (const [kind, array, count] of [[cubes, first, n], [knobs, second, m], [slopes, third, k]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, kind.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, array.subarray(0, kind.size * count), gl.DYNAMIC_DRAW);
      kind.count = count;
    }
    measure(step === END ? 0 : data.table[step]);
    const name = data.names[data.table[step]];
    output.textContent = step === END ? "Finished" : "Step " + (step + 1) + " of " + END + (name ? ", " + name : "");
    draw();
  }

  // the extent of all that is ever on a table, so that nothing jumps while it grows
  const extents = {};
  function measure(table) {
    if (!extents[table]) {
      const least = [1e9, 1e9, 1e9], most = [-1e9, -1e9, -1e9];
      const reach = (brick, b) => {
        let at = owner[brick];
        while (at !== table && at !== 0) at = data.parent[at];
        if (at !== table) return;
        for (let k = 0; k < 3; k++) {
          const unit = k < 2 ? 8 : 3.2;
          least[k] = Math.min(least[k], unit * b[k]);
          most[k] = Math.max(most[k], unit * (b[k] + b[k + 3]));
        }
      };
      for (let row = 0; row < nBoxes; row++) reach(brickOf[row], boxes.subarray(BOX * row, BOX * row + BOX));
      for (let row = 0; row < nRamps; row++)
        reach(brickOf[nBoxes + nStuds + row], ramps.subarray(RAMP * row, RAMP * row + RAMP));
      extents[table] = [least, most];
    }
    [low, high] = extents[table];
  }

  let turn = 0.75, tilt = 0.55, zoom = 1, shift = [0, 0];
  function camera(aspect) {
    const middle = low.map((value, k) => (value + high[k]) / 2);
    const radius = Math.hypot(...low.map((value, k) => high[k] - value)) / 2 + 8;
    const far = (radius / Math.sin(0.3) / Math.min(1, aspect)) * zoom;
    const c = Math.cos(turn), s = Math.sin(turn), ct = Math.cos(tilt), st = Math.sin(tilt);
    const right = [c, s, 0], up = [-s * st, c * st, ct];
    const back = [s * ct, -c * ct, st];
    const eye = middle.map((v, k) => v + far * back[k] + shift[0] * right[k] + shift[1] * up[k]);
    const dot = (a) => a[0] * eye[0] + a[1] * eye[1] + a[2] * eye[2];
    const f = 1 / Math.tan(0.3), near = Math.max(far - 3 * radius, far * 0.02), end = far + 3 * radius;
    const p = (end + near) / (near - end), q = (2 * end * near) / (near - end);
    const row = (a, k) => [k * a[0], k * a[1], k * a[2], -k * dot(a)];
    const x = row(right, f / aspect), y = row(up, f), z = row(back, 1);
    const out = new Float32Array(16);
    for (let k = 0; k < 4; k++) {
      out[4 * k] = x[k]; out[4 * k + 1] = y[k];
      out[4 * k + 2] = p * z[k] + (k === 3 ? q : 0);
      out[4 * k + 3] = -z[k];
    }
    return out;
  }
  function draw() {
    const wide = Math.round(canvas.clientWidth * devicePixelRatio), tall = Math.round(canvas.clientHeight * devicePixelRatio);
    if (canvas.width !== wide || canvas.height !== tall) { canvas.width = wide; canvas.height = tall; }
    gl.viewport(0, 0, wide, tall);
    gl.clearColor(0.957, 0.973, 0.988, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.uniformMatrix4fv(uniform("camera"), false, camera(wide / Math.max(tall, 1)));
    for (const [kind, lined] of [[cubes, 1], [slopes, 1], [knobs, 0]]) {
      gl.uniform1f(uniform("lined"), lined);
      gl.bindVertexArray(kind.array);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, kind.corners, kind.count);
    }
  }

  // hands: one finger or the left button turns, two fingers or another button move, wheel and pinch zoom
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1];
    if (pointers.size === 2) {
      const [a, b] = [...pointers.values()], old = Math.hypot(a[0] - b[0], a[1] - b[1]);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
      const [c, d] = [...pointers.values()];
      zoom = Math.min(4, Math.max(0.1, (zoom * old) / Math.max(1, Math.hypot(c[0] - d[0], c[1] - d[1]))));
      draw();
      return;
    }
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (event.buttons === 1 && !event.shiftKey) {
      turn -= dx * 0.008;
      tilt = Math.min(1.55, Math.max(-1.55, tilt + dy * 0.008));
    } else {
      const size = (Math.hypot(...low.map((value, k) => high[k] - value)) * zoom) / canvas.clientHeight;
      shift = [shift[0] - dx * size, shift[1] + dy * size];
    }
    draw();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom = Math.min(4, Math.max(0.1, zoom * Math.exp(event.deltaY * 0.001)));
    draw();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { turn = 0.75; tilt = 0.55; zoom = 1; shift = [0, 0]; draw(); });

  let playing = 0;
  const play = box.querySelector("[data-do=play]");
  function go(step) {
    slider.value = Math.min(END + 1, Math.max(1, step));
    show(slider.value - 1);
  }
  function stop() { clearInterval(playing); playing = 0; play.textContent = "Play"; }
  slider.max = END + 1;
  slider.addEventListener("input", () => { stop(); show(slider.value - 1); });
  pale.addEventListener("change", () => show(slider.value - 1));
  box.querySelector("[data-do=back]").addEventListener("click", () => { stop(); go(+slider.value - 1); });
  box.querySelector("[data-do=next]").addEventListener("click", () => { stop(); go(+slider.value + 1); });
  play.addEventListener("click", () => {
    if (playing) { stop(); return; }
    if (+slider.value > END) go(1);
    play.textContent = "Stop";
    playing = setInterval(() => { if (+slider.value > END) stop(); else go(+slider.value + 1); }, 700);
  });
  box.querySelector("[data-do=page]").addEventListener("click", () => {
    const page = document.getElementById(+slider.value > END ? "finished" : "step-" + data.page[slider.value - 1]);
    if (page) page.scrollIntoView();
  });
  document.addEventListener("keydown", (event) => {
    if (event.target === slider) return;
    if (event.key === "ArrowRight") { stop(); go(+slider.value + 1); }
    if (event.key === "ArrowLeft") { stop(); go(+slider.value - 1); }
  });
  addEventListener("resize", draw);
  const wanted = /^#3d-(\d+)$/.exec(location.hash);
  go(wanted ? +wanted[1] : END + 1);
  if (wanted) box.scrollIntoView();
})();
