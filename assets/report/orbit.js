// The camera of the 3-D view, and the mouse, touch and keys that move it.

const FIELD_OF_VIEW_RAD = 0.62;

function sceneBox(scene) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  const add = (p) => p.forEach((v, i) => { if (isNumber(v)) { min[i] = Math.min(min[i], v); max[i] = Math.max(max[i], v); } });
  if (scene.region) { add(scene.region.min); add(scene.region.max); }
  if (scene.flight && scene.surfaces) { add(scene.surfaces.extent.min); add(scene.surfaces.extent.max); }
  for (const v of [...scene.candidates, ...scene.views]) add([v.x, v.y, v.z]);
  for (const [, x, y, z] of [...scene.truth, ...scene.estimated]) add([x, y, z]);
  if (min[0] > max[0]) { min.fill(-1); max.fill(1); }
  return { min, max, floor: min[2], radius: Math.max(0.1, Math.hypot(...Vec.sub(max, min)) / 2) };
}

function startCamera(scene, aspect) {
  const focus = scene.region ?? sceneBox(scene);
  const centre = Vec.scale(Vec.add(focus.min, focus.max), 0.5);
  const radius = Math.hypot(...Vec.sub(focus.max, focus.min)) / 2;
  const ring = [...scene.candidates, ...scene.views].reduce((r, v) => Math.max(r, Math.hypot(v.x - centre[0], v.y - centre[1])), radius);
  const half = Math.tan(FIELD_OF_VIEW_RAD / 2);
  const room = scene.flight ? 0.9 : scene.surfaces ? 1.7 : 1;    // seen obliquely; a table with what is round it
  const distance = room * Math.max((1.05 * radius) / half, ring / (0.86 * half * aspect) + 0.5 * ring);
  return { target: centre, azimuth: -0.9, elevation: 0.56, distance };
}

function cameraShot(camera, aspect) {
  const ce = Math.cos(camera.elevation);
  const back = [ce * Math.cos(camera.azimuth), ce * Math.sin(camera.azimuth), Math.sin(camera.elevation)];
  const right = [-Math.sin(camera.azimuth), Math.cos(camera.azimuth), 0];
  const up = Vec.cross(back, right);
  const eye = Vec.add(camera.target, Vec.scale(back, camera.distance));
  const projection = perspective(FIELD_OF_VIEW_RAD, aspect, camera.distance / 100, camera.distance * 20);
  const toLight = Vec.unit(Vec.add(Vec.add(Vec.scale(right, -0.45), Vec.scale(up, 0.75)), Vec.scale(back, 0.6)));
  return { eye, right, up, toLight, worldToClip: multiply(projection, lookAt(eye, right, up, back)) };
}

function moveCamera(viewer, change) {
  const camera = viewer.camera;
  if (change.turn) {
    camera.azimuth -= change.turn[0];
    camera.elevation = Math.max(-0.4, Math.min(1.55, camera.elevation + change.turn[1]));
  }
  if (change.pan) {
    const { right, up } = cameraShot(camera, 1);
    const metres = (2 * camera.distance * Math.tan(FIELD_OF_VIEW_RAD / 2)) / viewer.canvas.clientHeight;
    camera.target = Vec.add(camera.target, Vec.add(Vec.scale(right, -change.pan[0] * metres), Vec.scale(up, change.pan[1] * metres)));
  }
  if (change.zoom) camera.distance = Math.max(0.05, Math.min(500, camera.distance * change.zoom));
  viewer.redraw();
}

function attachControls(viewer) {
  const { canvas } = viewer;
  const pointers = new Map();
  const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const move = [event.clientX - last.x, event.clientY - last.y];
    const before = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 2) {
      moveCamera(viewer, { pan: Vec.scale([...move, 0], 0.5), zoom: before / Math.max(1, spread()) });
    } else if (event.shiftKey || event.buttons & 6) {
      moveCamera(viewer, { pan: move });
    } else {
      moveCamera(viewer, { turn: [move[0] * 0.008, move[1] * 0.006] });
    }
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => viewer.reset());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
    moveCamera(viewer, { zoom: Math.exp(Math.max(-120, Math.min(120, pixels)) * 0.0016) });
  }, { passive: false });
  const keys = {
    ArrowLeft: { turn: [-0.1, 0] }, ArrowRight: { turn: [0.1, 0] }, ArrowUp: { turn: [0, 0.08] }, ArrowDown: { turn: [0, -0.08] },
    "+": { zoom: 0.9 }, "=": { zoom: 0.9 }, "-": { zoom: 1.1 },
  };
  canvas.addEventListener("keydown", (event) => {
    if (!keys[event.key]) return;
    event.preventDefault();
    moveCamera(viewer, keys[event.key]);
  });
}

// Where a point is on the canvas, in px; null behind the eye.
function projected(viewer, shot, x, y, z) {
  const m = shot.worldToClip, p = [x, y, z, 1];
  const clip = [0, 1, 3].map((row) => p.reduce((sum, v, k) => sum + m[4 * k + row] * v, 0));
  if (clip[2] <= 0) return null;
  return [((clip[0] / clip[2] + 1) / 2) * viewer.canvas.clientWidth, ((1 - clip[1] / clip[2]) / 2) * viewer.canvas.clientHeight];
}

function placeLabels(viewer, shot) {
  viewer.labelLayer.replaceChildren();
  placeObjectLabels(viewer, (x, y, z) => projected(viewer, shot, x, y, z));
  if (viewer.layers.views) placeViewLabels(viewer, shot);
}

// Order numbers of the views taken, over their sensors; views from one place share a label.
function placeViewLabels(viewer, shot) {
  const labels = [];
  for (const view of viewer.scene.views.filter((v) => v.step <= viewer.step)) {
    const at = projected(viewer, shot, view.x, view.y, view.z);
    if (!at) continue;
    const near = labels.find((l) => Math.hypot(l.x - at[0], l.y - at[1]) < 18);
    if (near) { near.numbers.push(view.number); near.now ||= view.step === viewer.step; }
    else labels.push({ x: at[0], y: at[1], numbers: [view.number], now: view.step === viewer.step });
  }
  for (const label of labels) {
    const node = append(viewer.labelLayer, "span", { class: label.now ? "now" : "" }, label.numbers.join(","));
    node.style.transform = `translate(${label.x}px, ${label.y}px) translate(-50%, -50%)`;
  }
}
