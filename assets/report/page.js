// Puts the run's data on the page.

// The run as the map and the 3-D view want it; whatever is missing becomes empty.
function collectScene() {
  const view = (v) => ({ x: v.x_m, y: v.y_m, z: v.z_m ?? 0, yaw: v.yaw_rad ?? 0, id: v.id });
  const placed = (v) => v && isNumber(v.x_m) && isNumber(v.y_m);
  const candidates = (METRICS.candidates ?? []).filter(placed).map(view);
  const views = STEPS.map((scan, step) => {
    const source = placed(scan.view) ? scan.view : (METRICS.candidates ?? []).find((c) => c.id === scan.chosen_view);
    return placed(source) ? { ...view(source), id: scan.chosen_view, number: step + 1, step, scan } : null;
  }).filter(Boolean);
  const voxels = DATA.voxels && { ...DATA.voxels, packed: u16FromBase64(DATA.voxels.data) };
  const box = (low, high) => (low?.length === 3 && high?.length === 3 ? { min: low, max: high } : null);
  const surfaces = decodeSurfaces(DATA.scene);
  const region = box(METRICS.region?.min_m, METRICS.region?.max_m) ?? (FLIGHT ? null : box(voxels?.min_m, voxels?.max_m));
  const scanTimes = FLIGHT ? stepTimes() : STEPS.map((s) => s.time_s);
  return {
    candidates, views, voxels, surfaces, region, cloud: DATA.cloud, truth: DATA.trajectory.truth,
    flight: FLIGHT, estimated: DATA.trajectory.estimated, scanTimes, scans: scanCount(voxels, scanTimes.length),
  };
}

// When each waypoint of a flight was passed: rows of steps.csv.
const stepTimes = () => DATA.steps.rows.map((row) => Number(row[0]));

function scanCount(voxels, steps) {
  let count = Math.max(1, steps);
  if (voxels?.kept[0]) count = Math.max(count, voxels.packed[4 * voxels.kept[0] - 1] + 1);
  return count;
}

function fillHead() {
  at("eyebrow").textContent = words(METRICS.task);
  at("heading").textContent = DATA.title;
  if (SECTIONS.view_heading) at("h-map3d").textContent = SECTIONS.view_heading;
  const tag = (name, value, kind = "") => {
    if (value === undefined || value === null) return;
    const node = append(at("tags"), "span", { class: `tag ${kind}` });
    if (name) node.append(`${name} `);
    append(node, "b", {}, String(value));
  };
  tag("", METRICS.status, { completed: "good", interrupted: "warn" }[METRICS.status] ?? "bad");
  tag("method", METRICS.method);
  tag("seed", METRICS.seed);
  tag("candidates", METRICS.candidates?.length || undefined);
}

function card(name, value, { unit, sub, kind, share, mono } = {}) {
  const node = append(at("cards"), "div", { class: `card ${kind ?? ""}` });
  append(node, "span", { class: "name" }, name);
  const figure = append(node, "span", { class: `value ${mono ? "mono" : ""}` }, value);
  if (unit) append(figure, "small", {}, unit);
  if (isNumber(share)) append(append(node, "div", { class: "meter" }), "i", { style: `width:${(100 * Math.max(0, Math.min(1, share))).toFixed(1)}%` });
  if (sub) append(node, "span", { class: "sub" }, sub);
}

const percent = (share) => (isNumber(share) ? formatNumber(100 * share, 3) : "–");

function fillCards() {
  FIGURES[SECTIONS.figures]?.cards();
  if (isNumber(METRICS.path_length_m)) card("Path length", formatNumber(METRICS.path_length_m, 3), { unit: "m" });
  if (isNumber(METRICS.collisions)) card("Collisions", String(METRICS.collisions), { kind: METRICS.collisions ? "bad" : "good", sub: METRICS.collisions ? "" : "none" });
  const sub = isNumber(METRICS.wall_time_s) ? `in ${formatNumber(METRICS.wall_time_s, 3)} s of real time` : "";
  if (isNumber(METRICS.simulated_time_s)) card("Simulated time", formatNumber(METRICS.simulated_time_s, 4), { unit: "s", sub });
  if (isNumber(METRICS.real_time_factor)) card("Real-time factor", formatNumber(METRICS.real_time_factor, 3), { unit: "×" });
  if (METRICS.state_hash) card("State hash", String(METRICS.state_hash), { mono: true, sub: "equal hashes: equal runs" });
}

// "plan_time_s" -> "plan time", "s".
function columnHead(name) {
  const found = name.match(/^(.*)_(m|s|rad|bits|nats|cells|px|j|hz|m_s)$/);
  return found ? [words(found[1]), found[2].replace("m_s", "m/s").replace("j", "J").replace("hz", "Hz")] : [words(name), ""];
}

function fillPlots() {
  const figures = FIGURES[SECTIONS.figures];
  if (figures) figures.plots(at("plots"));
  at("section-plots").hidden = !at("plots").hasChildNodes();
}

function fillSteps() {
  const { columns, rows } = DATA.steps;
  const numeric = columns.map((_, i) => rows.every((r) => r[i] === "" || r[i] === "nan" || !Number.isNaN(Number(r[i]))));
  const head = append(append(at("steps"), "thead"), "tr");
  columns.forEach((name, i) => {
    const [label, unit] = columnHead(name);
    const cell = append(head, "th", { scope: "col", class: numeric[i] ? null : "text" }, label);
    append(cell, "small", {}, unit ? `in ${unit}` : "\u00a0");
  });
  const body = append(at("steps"), "tbody");
  for (const row of rows) {
    const line = append(body, "tr");
    row.forEach((text, i) => {
      const shown = numeric[i] && text !== "" ? formatNumber(Number(text)) : text;
      append(line, "td", { title: shown === text ? null : text, class: numeric[i] ? null : "text" }, shown);
    });
  }
}

function pairs(table, object, prefix = "") {
  for (const [key, value] of Object.entries(object)) {
    if (value !== null && typeof value === "object" && !Array.isArray(value)) { pairs(table, value, `${prefix}${key}.`); continue; }
    const row = append(table, "tr");
    append(row, "th", { scope: "row" }, prefix + key);
    append(row, "td", {}, typeof value === "string" ? value : JSON.stringify(value));
  }
}

function fillDetails() {
  pairs(at("manifest"), DATA.manifest);
  at("config").textContent = DATA.config;
  const { scans, observations, candidates, objects, targets, others, path, plan, ...rest } = METRICS;
  pairs(at("other"), rest);
}

function fillMedia() {
  const { video, frame } = DATA.media;
  if (video) {
    const node = append(at("media"), "video", { controls: "", muted: "", preload: "metadata", playsinline: "", src: video, poster: frame });
    node.addEventListener("error", () => node.replaceWith(Object.assign(document.createElement("p"), { className: "empty", textContent: `${video} is not beside this page.` })));
  } else if (frame) {
    append(at("media"), "img", { src: frame, alt: "The last image of the run" });
  } else {
    at("section-media").hidden = true;
  }
}

function voxelNote(voxels) {
  if (!voxels) return "";
  const [kept, surface, total] = [voxels.kept[0], voxels.surface[0], voxels.total[0]];
  const thinned = kept < surface ? ` ${formatNumber(kept)} of ${formatNumber(surface)} surface cells shown, evenly thinned.` : "";
  const cells = voxels.cells.join(" × ");
  return `${formatNumber(total)} occupied cells of ${voxels.cell_size_m.map((c) => formatNumber(1000 * c, 3)).filter((c, i, all) => all.indexOf(c) === i).join(" × ")} mm in a grid of ${cells}.${thinned}`;
}

function fillLayers(viewer, scene) {
  const unobserved = scene.voxels?.kept[1] ?? 0;
  const part = unobserved < (scene.voxels?.surface[1] ?? 0) ? " (thinned)" : "";
  const layers = [
    ["surfaces", "room", scene.surfaces], ["voxels", scene.flight ? "map" : "voxels", scene.voxels], ["objects", "objects", scene.flight?.objects.length],
    ["looks", "looks at objects", scene.flight?.looks.length], ["given", "path as given", scene.flight?.path.length], ["candidates", "candidates", scene.candidates.length], ["views", "views taken", scene.views.length],
    ["truth", "true path", scene.truth.length], ["estimated", "estimated path", scene.estimated.length],
    ["points", "laser points", scene.cloud], ["unobserved", `unobserved at the end${part}`, unobserved],
  ];
  for (const [key, name, present] of layers) {
    if (!present) continue;
    const label = append(at("layers"), "label");
    const box = append(label, "input", { type: "checkbox" });
    box.checked = viewer.layers[key];
    label.append(` ${name}`);
    box.addEventListener("change", () => { viewer.layers[key] = box.checked; viewer.redraw(); });
  }
}

function showScale(viewer, scene) {
  const scale = document.querySelector(".viewer .scale");
  const [low, bar, high] = scale.children;
  const metres = (z) => `${formatNumber(z, 3)} m`;
  low.textContent = viewer.byScan ? `${STEP_WORD} 1` : metres(scene.voxels?.min_m[2] ?? 0);
  high.textContent = viewer.byScan ? `${STEP_WORD} ${scene.scans}` : metres(scene.voxels?.max_m[2] ?? 0);
  bar.style.background = rampCss(viewer.byScan ? SCAN_STOPS : HEIGHT_STOPS);
  scale.hidden = !scene.voxels;
}

function attachSteps(viewer, scene) {
  const slider = at("step"), play = at("play");
  let timer = 0;
  const show = (step) => {
    viewer.step = step;
    slider.value = step;
    at("step-label").textContent = `${STEP_WORD} ${step + 1} of ${scene.scans}`;
    slider.setAttribute("aria-valuetext", at("step-label").textContent);
    viewer.redraw();
  };
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = "▶"; };
  slider.max = scene.scans - 1;
  slider.addEventListener("input", () => { stop(); show(Number(slider.value)); });
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    show(viewer.step >= scene.scans - 1 ? 0 : viewer.step + 1);
    play.textContent = "❚❚";
    timer = setInterval(() => { if (viewer.step >= scene.scans - 1) stop(); else show(viewer.step + 1); }, 900);
  });
  show(scene.scans - 1);
}

function startViewer(scene) {
  const message = document.querySelector(".viewer-message");
  const fail = (text) => {
    message.textContent = text;
    message.hidden = false;
    at("viewer").classList.add("failed");
    at("viewer-controls").hidden = true;
    document.querySelector("#section-map3d .hint").hidden = true;
  };
  at("voxel-note").textContent = voxelNote(scene.voxels);
  if (!scene.voxels && !scene.views.length && !scene.truth.length) { at("section-map3d").hidden = true; return null; }
  let viewer = null;
  try {
    viewer = createViewer(document.querySelector(".viewer canvas"), document.querySelector(".viewer .labels"), scene);
  } catch (error) {
    fail(`The 3-D view could not start: ${error.message}`);
    return null;
  }
  if (!viewer) {
    fail("This browser offers no WebGL 2, which the 3-D view needs. Everything else on this page works without it.");
    return null;
  }
  fillLayers(viewer, scene);
  showScale(viewer, scene);
  if (!scene.voxels) at("colour-by").closest("label").hidden = true;
  at("colour-by").options[1].textContent = `by ${STEP_WORD}`;
  attachSteps(viewer, scene);
  at("colour-by").addEventListener("change", (event) => { viewer.byScan = event.target.value === "scan"; showScale(viewer, scene); viewer.redraw(); });
  at("reset-view").addEventListener("click", () => viewer.reset());
  return viewer;
}

function attachTheme() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let choice = "auto";
  const apply = () => {
    document.documentElement.dataset.theme = choice === "auto" ? (system.matches ? "dark" : "light") : choice;
    at("theme").textContent = { auto: "◐ Auto", light: "○ Light", dark: "● Dark" }[choice];
  };
  at("theme").addEventListener("click", () => { choice = { auto: "dark", dark: "light", light: "auto" }[choice]; apply(); });
  system.addEventListener("change", apply);
  addEventListener("beforeprint", () => { document.documentElement.dataset.theme = "light"; });
  addEventListener("afterprint", apply);
  apply();
}

function fillNavigation() {
  const names = { map3d: "Map", topdown: "Path", plans: "Plans", media: "Recording", plots: "Figures", hindsight: "In hindsight", steps: "Steps", details: "Details" };
  for (const [id, name] of Object.entries(names)) {
    if (!at(`section-${id}`).hidden) append(at("sections"), "a", { href: `#section-${id}` }, name);
  }
}

function main() {
  attachTheme();
  const scene = collectScene();
  fillHead();
  fillCards();
  fillPlots();
  fillHindsight();
  fillSteps();
  fillDetails();
  fillMedia();
  topDownMap(at("topdown"), scene);
  fillPlans(scene);
  const viewer = startViewer(scene);
  if (viewer) new MutationObserver(() => viewer.retheme()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  fillNavigation();
}

main();
