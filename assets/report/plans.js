// What each decision intended: the tour on the map, and why it is not the one before.

// The next view solid, the rest dashed; stops are numbered on from the scans taken, the next one on top.
function drawTour(svg, plan, from, px, py) {
  const group = append(svg, "g", { class: "tour", "data-scan": plan.scan });
  const line = (kind, points) => points.length > 1 && append(group, "path", { class: kind, d: points.map((p, i) => `${i ? "L" : "M"}${px(p.x).toFixed(1)} ${py(p.y).toFixed(1)}`).join("") });
  line("later", plan.stops);
  if (from) line("next", [from, plan.stops[0]]);
  for (let i = plan.stops.length; i-- > 0;) drawStop(group, plan, plan.stops[i], i, px, py);
}

function drawStop(group, plan, stop, i, px, py) {
  const x = px(stop.x), y = py(stop.y);
  const node = append(group, "g", { class: i ? "stop" : "stop first", tabindex: 0, "data-stop": i + 1 });
  append(node, "circle", { cx: x, cy: y, r: 9.5 });
  append(node, "text", { x, y: y + 4 }, String(plan.scan + i));
  const show = (left, top) => Tooltip.show(left, top, `Stop ${i + 1} of ${plan.stops.length}, to be scan ${plan.scan + i}`, stopRows(plan, stop));
  node.addEventListener("pointermove", (event) => show(event.clientX, event.clientY));
  node.addEventListener("pointerleave", () => Tooltip.hide());
  node.addEventListener("focus", () => { const box = node.getBoundingClientRect(); show(box.right, box.top); });
  node.addEventListener("blur", () => Tooltip.hide());
}

function stopRows(plan, stop) {
  const rows = stop.id >= 0 ? [{ name: "candidate", value: String(stop.id) }] : [];
  rows.push({ name: "position", value: `${formatNumber(stop.x, 3)}, ${formatNumber(stop.y, 3)} m` });
  rows.push({ name: "heading", value: `${formatNumber((stop.yaw * 180) / Math.PI, 3)}°` });
  rows.push({ name: "there after", value: `${formatNumber(stop.arrival_s, 4)} s` });
  rows.push({ name: "adds", value: `${formatNumber(Math.round(stop.gain))} ${plan.unit}` });
  if (stop.beyond >= 0.5) rows.push({ name: "leads to", value: `${formatNumber(Math.round(stop.beyond))} ${plan.unit}` });
  return rows;
}

// What was known and had been done when the plan was made, and the plan.
function sceneAt(scene, plan, bounds) {
  const before = (samples) => samples.filter((p) => p[0] <= plan.time_s + 1e-9);
  const estimated = before(scene.estimated);
  const here = estimated[estimated.length - 1];
  return {
    ...scene, bounds, candidates: [], truth: before(scene.truth), estimated,
    views: scene.views.filter((v) => v.number < plan.scan),
    tour: plan, tourFrom: here ? { x: here[1], y: here[2] } : null,
  };
}

// Scene and all stops: every plan is drawn to the same scale.
function boundsOfPlans(scene) {
  return mapBounds({ ...scene, candidates: [...scene.candidates, ...DATA.plans.flatMap((plan) => plan.stops)] });
}

function planTable(parent, choose) {
  const wrap = append(parent, "div", { class: "table-wrap", tabindex: 0, role: "region", "aria-label": "Plans" });
  const table = append(wrap, "table");
  const head = append(append(table, "thead"), "tr");
  for (const [name, unit] of [["for scan", ""], ["at", "s"], ["views", ""], ["ends after", "s"], ["shows", DATA.plans[0].unit], ["why", ""]]) {
    append(append(head, "th", { scope: "col", class: name === "why" ? "text" : null }, name), "small", {}, unit ? `in ${unit}` : "\u00a0");
  }
  const body = append(table, "tbody");
  return DATA.plans.map((plan, i) => {
    const line = append(body, "tr", { "data-scan": plan.scan });
    const button = append(append(line, "td"), "button", { type: "button", class: "quiet" }, String(plan.scan));
    const gain = plan.stops.reduce((sum, stop) => sum + stop.gain, 0);
    for (const text of [formatNumber(plan.time_s, 4), String(plan.stops.length), formatNumber(plan.ends_s, 4), formatNumber(Math.round(gain))]) append(line, "td", {}, text);
    append(line, "td", { class: "text" }, plan.why);
    button.addEventListener("click", () => choose(i));
    return { line, button };
  });
}

function fillPlans(scene) {
  if (!DATA.plans?.length) return;
  at("section-plans").hidden = false;
  const bounds = boundsOfPlans(scene), slider = at("plan");
  const holder = append(at("plan-map"), "div", { class: "map" });
  let chosen = 0, width = 0;
  const draw = () => {
    const plan = DATA.plans[chosen];
    const backdrop = scene.voxels ? backdropImage(scene.voxels, 0, plan.scan - 1) : null;
    if (width > 0) drawMap(holder, sceneAt(scene, plan, bounds), backdrop, width);
  };
  const choose = (i) => {
    chosen = i;
    const plan = DATA.plans[i];
    slider.value = i;
    at("plan-label").textContent = `for scan ${plan.scan}`;
    at("plan-why").textContent = `${plan.stops.length} view${plan.stops.length > 1 ? "s" : ""}, ${formatNumber(plan.ends_s, 3)} s: ${plan.why}`;
    rows.forEach(({ line, button }, k) => { line.classList.toggle("chosen-plan", k === i); button.setAttribute("aria-pressed", String(k === i)); });
    draw();
  };
  slider.max = DATA.plans.length - 1;
  slider.addEventListener("input", () => choose(Number(slider.value)));
  const rows = planTable(at("plan-table"), choose);
  choose(0);
  onWidth(holder, (w) => { width = w; draw(); });
}
