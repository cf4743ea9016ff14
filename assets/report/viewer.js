// The 3-D view: instanced voxels, lines and points in plain WebGL 2, drawn on demand.

// scene: {voxels, cloud, region, candidates, views, truth, estimated, scans} as page.js collects it.
// Returns null where WebGL 2 is missing.
function createViewer(canvas, labelLayer, scene) {
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
  if (!gl) return null;
  const viewer = {
    gl, canvas, scene, labelLayer,
    layers: { surfaces: true, voxels: true, objects: true, looks: true, given: false, unobserved: false, points: false, candidates: true, views: true, truth: true, estimated: false },
    step: Math.max(0, scene.scans - 1), byScan: false, frame: 0,
    camera: null, lines: {},
    redraw() { if (!this.frame) this.frame = requestAnimationFrame(() => { this.frame = 0; drawScene(this); }); },
    retheme() { buildLines(this); this.redraw(); },
    reset() { this.camera = startCamera(scene, canvas.clientWidth / Math.max(1, canvas.clientHeight)); this.redraw(); },
  };
  viewer.programs = { voxel: program(gl, VOXEL_VERTEX), line: program(gl, LINE_VERTEX), point: program(gl, POINT_VERTEX), surface: program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT) };
  buildSurfaces(viewer);
  buildVoxels(viewer);
  buildCloud(viewer);
  buildLines(viewer);
  viewer.reset();
  attachControls(viewer);
  new ResizeObserver(() => viewer.redraw()).observe(canvas);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  return viewer;
}

function program(gl, vertex, fragment = PLAIN_FRAGMENT) {
  const made = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(made, i).name.replace("[0]", "");
    uniforms[name] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

function buffer(gl, target, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return made;
}

// A vertex array whose instances start at `first`: WebGL has no base instance.
function voxelArray(gl, cube, cells, shading, first) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, cube.vertices);
  for (const [slot, offset] of [[0, 0], [1, 12]]) {
    gl.enableVertexAttribArray(slot);
    gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 24, offset);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, cube.triangles);
  gl.bindBuffer(gl.ARRAY_BUFFER, cells);
  gl.enableVertexAttribArray(2);
  gl.vertexAttribIPointer(2, 4, gl.UNSIGNED_SHORT, 8, 8 * first);
  gl.vertexAttribDivisor(2, 1);
  gl.bindBuffer(gl.ARRAY_BUFFER, shading);
  gl.enableVertexAttribArray(3);
  gl.vertexAttribPointer(3, 4, gl.BYTE, true, 4, 4 * first);
  gl.vertexAttribDivisor(3, 1);
  gl.bindVertexArray(null);
  return array;
}

function buildVoxels(viewer) {
  const { gl, scene } = viewer;
  const cube = cubeCorner();
  const buffers = { vertices: buffer(gl, gl.ARRAY_BUFFER, cube.vertices), triangles: buffer(gl, gl.ELEMENT_ARRAY_BUFFER, cube.triangles) };
  const one = (data) => buffer(gl, gl.ARRAY_BUFFER, data);
  viewer.slab = voxelArray(gl, buffers, one(new Uint16Array(4)), one(new Int8Array([0, 0, 0, 127])), 0);
  if (!scene.voxels) return;
  const { packed, cells, kept } = scene.voxels;
  const cellBuffer = one(packed), shading = one(voxelShading(packed, cells));
  viewer.occupied = voxelArray(gl, buffers, cellBuffer, shading, 0);
  viewer.unobserved = voxelArray(gl, buffers, cellBuffer, shading, kept[0]);
  // Voxels are sorted by step, so that the map after a scan is a prefix.
  viewer.countAtStep = new Array(Math.max(1, scene.scans)).fill(0);
  for (let i = 0; i < kept[0]; ++i) {
    const step = Math.min(packed[4 * i + 3], viewer.countAtStep.length - 1);
    viewer.countAtStep[step] = i + 1;
  }
  for (let s = 1; s < viewer.countAtStep.length; ++s) viewer.countAtStep[s] = Math.max(viewer.countAtStep[s], viewer.countAtStep[s - 1]);
}

function buildCloud(viewer) {
  const { gl, scene } = viewer;
  if (!scene.cloud) return;
  viewer.cloudArray = gl.createVertexArray();
  gl.bindVertexArray(viewer.cloudArray);
  buffer(gl, gl.ARRAY_BUFFER, u16FromBase64(scene.cloud.data));
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, 6, 0);
  gl.bindVertexArray(null);
}

function themeColour(name, opacity = 1) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const value = parseInt(text.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255, opacity];
}

function buildLines(viewer) {
  const { gl, scene } = viewer;
  const lists = { ...flightLines(scene), frame: new LineList(), candidates: new LineList(), views: new LineList(), truth: new LineList(), estimated: new LineList() };
  const size = sceneBox(scene);
  const length_m = 0.14 * (scene.region ? Math.min(scene.region.max[0] - scene.region.min[0], scene.region.max[1] - scene.region.min[1]) : size.radius);
  if (scene.region) lists.frame.box(scene.region.min, scene.region.max, themeColour("--dim", 0.7), 1.2);
  if (!scene.surfaces) floorGrid(lists.frame, scene, size);
  for (const view of scene.candidates) lists.candidates.frustum(view, length_m, themeColour("--dim", 0.55), 1.1);
  for (const view of scene.views) {
    lists.views.frustum(view, 1.35 * length_m, themeColour("--view"), 2.2, view.step);
    lists.views.add([view.x, view.y, view.z], [view.x, view.y, size.floor], themeColour("--view", 0.35), 1.2, view.step);
  }
  const timed = (samples) => samples.map(([t, x, y, z]) => ({ p: [x, y, z + 0.005], step: stepAt(scene, t) }));
  lists.truth.route(timed(scene.truth), themeColour("--truth"), 2.6);
  lists.estimated.route(timed(scene.estimated), themeColour("--belief"), 2);
  for (const [name, list] of Object.entries(lists)) {
    const array = viewer.lines[name]?.array ?? gl.createVertexArray();
    if (viewer.lines[name]) gl.deleteBuffer(viewer.lines[name].data);
    gl.bindVertexArray(array);
    const data = buffer(gl, gl.ARRAY_BUFFER, new Float32Array(list.values));
    [[0, 3, 0], [1, 3, 12], [2, 4, 24], [3, 2, 40]].forEach(([slot, n, offset]) => {
      gl.enableVertexAttribArray(slot);
      gl.vertexAttribPointer(slot, n, gl.FLOAT, false, 48, offset);
      gl.vertexAttribDivisor(slot, 1);
    });
    gl.bindVertexArray(null);
    viewer.lines[name] = { array, data, count: list.count };
  }
}

// The scan that a time leads up to; 0 where the scans carry no times.
function stepAt(scene, time_s) {
  const index = scene.scanTimes.findIndex((t) => isNumber(t) && time_s <= t);
  return scene.scanTimes.some(isNumber) ? (index < 0 ? scene.scans - 1 : index) : 0;
}

function floorGrid(list, scene, size) {
  const step = ticks(0, 2 * size.radius, 8).step;
  const snap = (v, f) => f(v / step) * step;
  const [x0, x1] = [snap(size.min[0], Math.floor), snap(size.max[0], Math.ceil)];
  const [y0, y1] = [snap(size.min[1], Math.floor), snap(size.max[1], Math.ceil)];
  for (let x = x0; x <= x1 + 1e-9; x += step) list.add([x, y0, size.floor], [x, y1, size.floor], themeColour("--dim", 0.16), 1);
  for (let y = y0; y <= y1 + 1e-9; y += step) list.add([x0, y, size.floor], [x1, y, size.floor], themeColour("--dim", 0.16), 1);
}

function drawScene(viewer) {
  const { gl, canvas, scene } = viewer;
  const ratio = Math.min(2, devicePixelRatio || 1);
  const [w, h] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (!w || !h) return;
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  gl.viewport(0, 0, w, h);
  gl.clearColor(0, 0, 0, 0);
  gl.depthMask(true);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  const shot = cameraShot(viewer.camera, w / h);
  drawSolids(viewer, shot);
  if (viewer.layers.points && viewer.cloudArray) drawCloud(viewer, shot, ratio);
  gl.depthMask(false);
  drawLines(viewer, shot, [w, h], ratio);
  if (viewer.layers.unobserved && viewer.unobserved) drawVoxels(viewer, shot, viewer.unobserved, scene.voxels.kept[1], scene.voxels, themeColour("--s4", 0.16));
  gl.bindVertexArray(null);
  placeLabels(viewer, shot);
}

function drawSolids(viewer, shot) {
  const { scene } = viewer;
  if (viewer.layers.surfaces && viewer.surfaces) drawSurfaces(viewer, shot);
  if (scene.region && !scene.surfaces) {
    const { min, max } = scene.region;
    const slab = { min_m: [min[0], min[1], min[2] - 0.012], cell_size_m: [max[0] - min[0], max[1] - min[1], 0.012], cells: [1, 1, 1] };
    drawVoxels(viewer, shot, viewer.slab, 1, slab, themeColour("--grid"));
  }
  if (viewer.layers.voxels && viewer.occupied) {
    drawVoxels(viewer, shot, viewer.occupied, viewer.countAtStep[viewer.step], scene.voxels, [0, 0, 0, 0]);
  }
}

function drawVoxels(viewer, shot, array, count, grid, flat) {
  const { gl, programs: { voxel: { made, uniforms: u } } } = viewer;
  gl.useProgram(made);
  gl.uniformMatrix4fv(u.worldToClip, false, shot.worldToClip);
  gl.uniform3fv(u.eye, shot.eye);
  gl.uniform3fv(u.gridMin, grid.min_m);
  gl.uniform3fv(u.cellSize, grid.cell_size_m);
  gl.uniform3fv(u.toLight, shot.toLight);
  gl.uniform3fv(u.stops, (viewer.byScan ? SCAN_STOPS : HEIGHT_STOPS).flat().map((c) => c / 255));
  gl.uniform4fv(u.flatColour, flat);
  gl.uniform1f(u.cellsHigh, grid.cells[2]);
  gl.uniform1f(u.lastStep, viewer.scene.scans - 1);
  gl.uniform1i(u.byScan, viewer.byScan ? 1 : 0);
  gl.uniform1f(u.share, viewer.surfaces && viewer.layers.surfaces ? 0.3 : 1);  // the room shows between
  gl.bindVertexArray(array);
  gl.drawElementsInstanced(gl.TRIANGLES, 18, gl.UNSIGNED_SHORT, 0, count);
}

function drawCloud(viewer, shot, ratio) {
  const { gl, scene: { cloud }, programs: { point: { made, uniforms: u } } } = viewer;
  gl.useProgram(made);
  gl.uniformMatrix4fv(u.worldToClip, false, shot.worldToClip);
  gl.uniform3fv(u.cloudMin, cloud.min_m);
  gl.uniform3fv(u.cloudScale, cloud.scale_m);
  gl.uniform3fv(u.pointColour, themeColour("--text").slice(0, 3));
  gl.uniform1f(u.pixelRatio, ratio);
  gl.bindVertexArray(viewer.cloudArray);
  gl.drawArrays(gl.POINTS, 0, cloud.kept);
}

// Twice: plainly where nothing stands before them, faintly where something does.
function drawLines(viewer, shot, size, ratio) {
  const { gl, programs: { line: { made, uniforms: u } } } = viewer;
  gl.useProgram(made);
  gl.uniformMatrix4fv(u.worldToClip, false, shot.worldToClip);
  gl.uniform2fv(u.viewport, size);
  gl.uniform1f(u.shownStep, viewer.step);
  gl.uniform1f(u.pixelRatio, ratio);
  for (const [name, { array, count }] of Object.entries(viewer.lines)) {
    if (!count || viewer.layers[name] === false) continue;
    gl.bindVertexArray(array);
    for (const [test, opacity] of [[gl.LEQUAL, 1], [gl.GREATER, 0.14]]) {
      gl.depthFunc(test);
      gl.uniform1f(u.opacity, opacity);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    }
  }
  gl.depthFunc(gl.LEQUAL);
}
