// The top-down map: trajectories, region, candidates, chosen views.

// run.views: [{number, scan, x, y, z, yaw, ...}] as page.js collects them.
function topDownMap(parent, run) {
  const holder = append(parent, "div", { class: "map" });
  const legend = append(parent, "div", { class: "legend" });
  const mark = (name, colour, look = {}) => {
    const entry = append(legend, "span", { class: "static" });
    legendMark(entry, { colour, dots: false, ...look });
    append(entry, "span", {}, name);
  };
  if (run.truth.length) mark("true path", "var(--truth)");
  if (run.estimated.length) mark("estimated path", "var(--belief)", { dashed: true });
  if (run.region) mark("region of interest", "var(--dim)");
  if (run.views.length) mark("views taken, in order", "var(--view)", { pin: true });
  if (run.flight) flightMarks(mark);
  const backdrop = run.voxels ? backdropImage(run.voxels, run.flight ? 1 : 0) : null;
  onWidth(holder, (width) => drawMap(holder, run, backdrop, width));
}

// Highest occupied cell of each column as an image, for orientation; the lowest layers may be floor. Of the first so
// many steps.
function backdropImage(voxels, floorLayers, steps = Infinity) {
  const [nx, ny, nz] = voxels.cells;
  if (nx * ny > 4e6) return null;
  const top = new Int32Array(nx * ny).fill(-1);
  for (let i = 0; i < voxels.packed.length; i += 4) {
    if (voxels.packed[i + 3] & 0x8000 || voxels.packed[i + 2] < floorLayers || voxels.packed[i + 3] >= steps) continue;
    const column = voxels.packed[i + 1] * nx + voxels.packed[i];
    top[column] = Math.max(top[column], voxels.packed[i + 2]);
  }
  const canvas = document.createElement("canvas");
  canvas.width = nx;
  canvas.height = ny;
  const context = canvas.getContext("2d");
  const image = context.createImageData(nx, ny);
  for (let y = 0; y < ny; ++y) {
    for (let x = 0; x < nx; ++x) {
      const z = top[y * nx + x];
      if (z < 0) continue;
      const colour = heightColour(z / Math.max(1, nz - 1)).map((c) => Math.round(255 * c));
      image.data.set([...colour, 215], 4 * ((ny - 1 - y) * nx + x));
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL();
}

function mapBounds(run) {
  const xs = [], ys = [];
  const add = (x, y) => { if (isNumber(x) && isNumber(y)) { xs.push(x); ys.push(y); } };
  for (const p of [...run.truth, ...run.estimated]) add(p[1], p[2]);
  for (const v of [...run.candidates, ...run.views]) add(v.x, v.y);
  for (const q of run.flight?.path ?? []) add(q[0], q[1]);
  for (const o of run.flight?.objects ?? []) add(o.x_m, o.y_m);
  if (run.flight && run.surfaces) for (const p of [run.surfaces.extent.min, run.surfaces.extent.max]) add(p[0], p[1]);
  if (run.region) { add(run.region.min[0], run.region.min[1]); add(run.region.max[0], run.region.max[1]); }
  if (!xs.length) return null;
  const low = (list) => list.reduce((a, b) => Math.min(a, b));
  const high = (list) => list.reduce((a, b) => Math.max(a, b));
  const pad = 0.06 * Math.max(high(xs) - low(xs), high(ys) - low(ys), 0.5);
  return { x0: low(xs) - pad, x1: high(xs) + pad, y0: low(ys) - pad, y1: high(ys) + pad };
}

function wedgePath(px, py, view, radius_px, half_rad) {
  const corner = (turn) => `${px(view.x) + radius_px * Math.cos(view.yaw + turn)} ${py(view.y) - radius_px * Math.sin(view.yaw + turn)}`;
  return `M${px(view.x)} ${py(view.y)}L${corner(-half_rad)}A${radius_px} ${radius_px} 0 0 0 ${corner(half_rad)}Z`;
}

function drawMap(holder, run, backdrop, width) {
  const bounds = run.bounds ?? mapBounds(run);
  holder.replaceChildren();
  if (!bounds) { append(holder, "p", { class: "empty" }, "No poses were recorded."); return; }
  const left = 46, right = 8, top = 8, bottom = 40;
  const aspect = (bounds.y1 - bounds.y0) / (bounds.x1 - bounds.x0);
  const height = Math.max(220, Math.min(560, (width - left - right) * aspect + top + bottom));
  const scale = Math.min((width - left - right) / (bounds.x1 - bounds.x0), (height - top - bottom) / (bounds.y1 - bounds.y0));
  const xMid = (bounds.x0 + bounds.x1) / 2, yMid = (bounds.y0 + bounds.y1) / 2;
  const px = (x) => (left + width - right) / 2 + (x - xMid) * scale;
  const py = (y) => (top + height - bottom) / 2 - (y - yMid) * scale;
  const svg = append(holder, "svg", {
    class: "chart", width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `Map from above with ${run.views.length} views taken out of ${run.candidates.length} candidates`,
  });
  drawMapAxes(svg, { left, right: width - right, top, bottom: height - bottom, scale, px, py, xMid, yMid, height });
  if (backdrop && run.voxels) {
    const { min_m: low, max_m: high } = run.voxels;
    const frame = append(svg, "svg", { x: left, y: top, width: width - left - right, height: height - top - bottom, viewBox: `${left} ${top} ${width - left - right} ${height - top - bottom}`, overflow: "hidden" });
    append(frame, "image", { href: backdrop, x: px(low[0]), y: py(high[1]), width: (high[0] - low[0]) * scale, height: (high[1] - low[1]) * scale, preserveAspectRatio: "none", style: "image-rendering: pixelated" });
  }
  if (run.region) {
    const { min, max } = run.region;
    append(svg, "rect", { class: "region", x: px(min[0]), y: py(max[1]), width: (max[0] - min[0]) * scale, height: (max[1] - min[1]) * scale, rx: 3 });
  }
  for (const view of run.candidates) append(svg, "path", { class: "candidate", d: wedgePath(px, py, view, 15, 0.13) });
  const route = (points) => points.map((p, i) => `${i ? "L" : "M"}${px(p[1]).toFixed(1)} ${py(p[2]).toFixed(1)}`).join("");
  if (run.truth.length) append(svg, "path", { class: "truth", d: route(run.truth) });
  if (run.estimated.length) append(svg, "path", { class: "estimated", d: route(run.estimated) });
  drawChosen(svg, run, px, py);
  if (run.tour) drawTour(svg, run.tour, run.tourFrom, px, py);
  if (run.flight) drawFlight(svg, run.flight, px, py, scale);
}

function drawMapAxes(svg, f) {
  const x0 = f.xMid - (f.right - f.left) / 2 / f.scale, x1 = f.xMid + (f.right - f.left) / 2 / f.scale;
  const y0 = f.yMid - (f.bottom - f.top) / 2 / f.scale, y1 = f.yMid + (f.bottom - f.top) / 2 / f.scale;
  const step = ticks(0, Math.max(x1 - x0, y1 - y0), 8).step;
  const along = (low, high) => ticks(low, high, (high - low) / step).list;
  for (const x of along(x0, x1)) {
    append(svg, "line", { class: "grid", x1: f.px(x), x2: f.px(x), y1: f.top, y2: f.bottom });
    append(svg, "text", { x: f.px(x), y: f.bottom + 16, "text-anchor": "middle" }, tickLabel(x, step));
  }
  for (const y of along(y0, y1)) {
    append(svg, "line", { class: "grid", x1: f.left, x2: f.right, y1: f.py(y), y2: f.py(y) });
    append(svg, "text", { x: f.left - 6, y: f.py(y) + 4, "text-anchor": "end" }, tickLabel(y, step));
  }
  append(svg, "text", { x: (f.left + f.right) / 2, y: f.height - 4, "text-anchor": "middle" }, "x in m");
  append(svg, "text", { transform: `translate(11 ${(f.top + f.bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, "y in m");
}

// One pin per place; a place visited twice carries both numbers.
function drawChosen(svg, run, px, py) {
  const pins = [];
  for (const view of run.views) {
    const near = pins.find((p) => Math.hypot(px(p.x) - px(view.x), py(p.y) - py(view.y)) < 17);
    if (near) near.views.push(view); else pins.push({ x: view.x, y: view.y, views: [view] });
  }
  for (const pin of pins) {
    const group = append(svg, "g", { class: "chosen", tabindex: 0 });
    for (const view of pin.views) append(group, "path", { class: "wedge", d: wedgePath(px, py, view, 40, 0.2) });
    const label = pin.views.map((v) => v.number).join(",");
    const half = 5 + 4 * label.length;
    append(group, "rect", { class: "pin", x: px(pin.x) - half, y: py(pin.y) - 10, width: 2 * half, height: 20, rx: 10 });
    append(group, "text", { x: px(pin.x), y: py(pin.y) + 4 }, label);
    const rows = pin.views.flatMap((v) => viewRows(v, pin.views.length > 1));
    const show = (x, y) => Tooltip.show(x, y, `${words(STEP_WORD)}${pin.views.length > 1 ? "s" : ""} ${label}`, rows);
    group.addEventListener("pointermove", (event) => show(event.clientX, event.clientY));
    group.addEventListener("pointerleave", () => Tooltip.hide());
    group.addEventListener("focus", () => { const box = group.getBoundingClientRect(); show(box.right, box.top); });
    group.addEventListener("blur", () => Tooltip.hide());
  }
}

function viewRows(view, several) {
  const rows = several ? [{ name: STEP_WORD, value: String(view.number) }] : [];
  if (isNumber(view.id) && view.id >= 0) rows.push({ name: "candidate", value: String(view.id) });
  rows.push({ name: "position", value: `${formatNumber(view.x, 3)}, ${formatNumber(view.y, 3)} m` });
  rows.push({ name: "heading", value: `${formatNumber((view.yaw * 180) / Math.PI, 3)}°` });
  if (isNumber(view.scan.actual_new_cells)) rows.push({ name: "new cells", value: formatNumber(view.scan.actual_new_cells) });
  if (view.scan.estimate) rows.push({ name: "estimate", value: `${view.scan.estimate}, ${formatNumber(view.scan.map_probability, 2)}` });
  if (isNumber(view.scan.entropy_bits)) rows.push({ name: "entropy", value: `${formatNumber(view.scan.entropy_bits, 3)} bits` });
  if (view.scan.fallback) rows.push({ name: "fallback", value: "yes" });
  return rows;
}
