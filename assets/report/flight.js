// A flight past objects: cards, the map of observations, and figures.

const OBJECTS = METRICS.objects ?? [];
const LOOKS = OBJECTS.flatMap((o, i) => (o.looks ?? []).map((look) => ({ ...look, object: i, truth: o.truth })));
const FLIGHT = SECTIONS.figures === "flight" ? { path: METRICS.path ?? [], objects: OBJECTS, looks: LOOKS } : null;
const DIRECTIONS = 8;

// Of the objects that were observed.
function entropyAtTheEnd() {
  const entropy = isNumber(METRICS.mean_entropy_observed_nats) ? `mean entropy ${formatNumber(METRICS.mean_entropy_observed_nats, 3)} nats, ` : "";
  return `${entropy}${METRICS.objects_unseen} objects unseen`;
}

function flightCards() {
  const right = OBJECTS.filter((o) => o.correct).length;
  card("Recognised", `${right} of ${OBJECTS.length}`, { share: OBJECTS.length ? right / OBJECTS.length : 0, sub: `${METRICS.objects_found} found, ${METRICS.false_objects} false` });
  card("Observations", String(METRICS.observations_total), { sub: entropyAtTheEnd() });
  card("Minimum clearance", formatNumber(METRICS.minimum_clearance_m, 3), { unit: "m", sub: "true, from surface to surface" });
  card("Tracking error", formatNumber(1000 * METRICS.tracking_error_m.mean, 3), { unit: "mm", sub: `at most ${formatNumber(1000 * METRICS.tracking_error_m.max, 3)} mm` });
  card("Replanning", formatNumber(1000 * METRICS.plan_time_s.median, 3), { unit: "ms", sub: `95 %: ${formatNumber(1000 * METRICS.plan_time_s.p95, 3)} ms; ${METRICS.missed_deadlines} of ${METRICS.replans} missed` });
  card("Energy", formatNumber(METRICS.energy_j / 1000, 3), { unit: "kJ", sub: "of the rotors" });
}

// One row an object: what it is and what it was taken for.
function flightTable() {
  const section = append(at("section-plots"), "div", { class: "panel table-wrap", tabindex: "0", style: "margin-top: 16px" });
  const table = append(section, "table");
  const head = append(append(table, "thead"), "tr");
  for (const name of ["object", "truth", "estimate", "entropy in nats", "observations", "place off by"]) append(head, "th", { scope: "col", class: "text" }, name);
  const body = append(table, "tbody");
  OBJECTS.forEach((o, i) => {
    const row = append(body, "tr");
    const estimate = o.estimate ?? (o.found ? "not seen closely" : "not found");
    const cells = [String(i + 1), o.truth, `${o.correct ? "✓" : "✗"} ${estimate}`, formatNumber(o.entropy_nats, 3), String(o.observations), isNumber(o.position_error_m) ? `${formatNumber(1000 * o.position_error_m, 2)} mm` : "–"];
    cells.forEach((text) => append(row, "td", { class: "text" }, text));
  });
}

// Entropy of each object over time, from the prior on.
function flightPlots(parent) {
  const series = OBJECTS.map((o, i) => ({
    name: `${i + 1} ${words(o.truth)}`, colour: seriesColour(i),
    points: (o.looks ?? []).map((look) => [look.time_s, look.entropy_nats]),
  })).filter((s) => s.points.length);
  if (series.length) lineChart(parent, { title: "Entropy of each object", subtitle: "after each observation", x: "time in s", y: "entropy in nats", unit: "nats", series });
  const { columns, rows } = DATA.steps;
  const value = (row, name) => { const i = columns.indexOf(name); return i < 0 || row[i] === "" ? null : Number(row[i]); };
  const over = (name, scale = 1) => rows.map((row) => { const v = value(row, name); return [value(row, "waypoint"), isNumber(v) ? scale * v : null]; });
  const planned = (name, scale) => over(name, scale).slice(1);
  const chart = (title, subtitle, y, unit, lines) => lineChart(parent, { title, subtitle, x: "waypoint", y, unit, integerX: true, series: lines });
  chart("Time of a replan", "measured, and what the flight is charged for it", "time in ms", "ms", [
    { name: "measured", colour: seriesColour(4), strong: true, points: planned("plan_time_s", 1000) },
    { name: "charged", colour: seriesColour(8), dashed: true, points: planned("latency_s", 1000) },
  ]);
  chart("Clearance", "least so far, truly; and of the spline that was planned, from the body's middle by the map", "distance in m", "m", [
    { name: "true", colour: seriesColour(0), strong: true, points: over("clearance_m") },
    { name: "planned", colour: seriesColour(1), dashed: true, points: planned("planned_clearance_m").map(([x, y]) => [x, isNumber(y) && y < 10 ? y : null]) },
  ]);
  chart("Observations and objects", "so far", "count", "", [
    { name: "observations", colour: seriesColour(0), strong: true, points: over("looks") },
    { name: "objects found", colour: seriesColour(2), points: over("objects") },
    { name: "of these, known", colour: seriesColour(3), dashed: true, points: over("known") },
  ]);
  flightTable();
}

function flightMarks(mark) {
  mark("path as given", "var(--dim)", { dashed: true });
  mark("object, its directions seen", "var(--view)");
  mark("where it was seen from", "var(--belief)");
}

function drawFlight(svg, flight, px, py, scale) {
  const line = flight.path.map((q, i) => `${i ? "L" : "M"}${px(q[0]).toFixed(1)} ${py(q[1]).toFixed(1)}`).join("");
  append(svg, "path", { class: "given", d: line });
  flight.path.forEach((q) => append(svg, "circle", { class: "given-point", cx: px(q[0]), cy: py(q[1]), r: 1.8 }));
  flight.looks.forEach((look) => {
    const o = flight.objects[look.object];
    append(svg, "line", { class: "sight", x1: px(o.x_m), y1: py(o.y_m), x2: px(look.view.x_m), y2: py(look.view.y_m) });
    append(svg, "circle", { class: "look", cx: px(look.view.x_m), cy: py(look.view.y_m), r: 3 });
  });
  flight.objects.forEach((o, i) => drawFlightObject(svg, o, i, px, py, scale));
}

function drawFlightObject(svg, o, index, px, py, scale) {
  const group = append(svg, "g", { class: "chosen", tabindex: 0 });
  const seen = new Set((o.looks ?? []).map((look) => look.direction));
  for (let i = 0; i < DIRECTIONS; ++i) {
    const a = (2 * Math.PI * i) / DIRECTIONS;
    const end = (r) => [px(o.x_m) + r * scale * Math.cos(a), py(o.y_m) - r * scale * Math.sin(a)];
    const [[x1, y1], [x2, y2]] = [end(0.22), end(0.5)];
    append(group, "line", { class: seen.has(i) ? "direction seen" : "direction", x1, y1, x2, y2 });
  }
  append(group, "rect", { class: o.correct ? "pin" : "pin wrong", x: px(o.x_m) - 9, y: py(o.y_m) - 9, width: 18, height: 18, rx: 9 });
  append(group, "text", { x: px(o.x_m), y: py(o.y_m) + 4 }, String(index + 1));
  const rows = [
    { name: "truth", value: o.truth }, { name: "estimate", value: String(o.estimate ?? "none") },
    { name: "entropy", value: `${formatNumber(o.entropy_nats, 3)} nats` }, { name: "observations", value: String(o.observations) },
  ];
  const show = (x, y) => Tooltip.show(x, y, `object ${index + 1}`, rows);
  group.addEventListener("pointermove", (event) => show(event.clientX, event.clientY));
  group.addEventListener("pointerleave", () => Tooltip.hide());
  group.addEventListener("focus", () => { const box = group.getBoundingClientRect(); show(box.right, box.top); });
  group.addEventListener("blur", () => Tooltip.hide());
}

FIGURES.flight = { cards: flightCards, plots: flightPlots };
