// The run's data, and the plots against scans, or against views of an object.

const DATA = JSON.parse(document.getElementById("run-data").textContent);
const METRICS = DATA.metrics;
const SECTIONS = DATA.sections;    // what the run's task says of its page
const STEPS = METRICS[SECTIONS.steps] ?? [];
const STEP_WORD = SECTIONS.step_word || "step";
// What a task's page shows, by the name that the task gives: each has cards() and plots(parent).
const FIGURES = {};
const at = (id) => document.getElementById(id);
const column = (key) => STEPS.map((s) => s[key]);
const words = (key) => String(key ?? "").replaceAll("_", " ");
const seriesColour = (i) => `var(--s${i % 9})`;

// Numbers of the x axis: scans count from 1.
const perScan = (values) => values.map((v, i) => [i + 1, isNumber(v) ? v : null]);

function gainNames() {
  return [...new Set(STEPS.flatMap((s) => Object.keys(s.predicted ?? {})))];
}

// A first scan that nobody chose has no prediction, whatever number stands there.
const chosenOnly = (values) => values.map((v, i) => (STEPS[i].chosen_view < 0 ? null : v));
const predictions = (name) => chosenOnly(STEPS.map((s) => s.predicted?.[name]));

function predictionPlots(parent) {
  const names = gainNames();
  if (!names.length) return;
  const actual = chosenOnly(column("actual_new_cells"));
  const own = (name) => name === METRICS.method;
  const styled = (name, i, points, note) => ({ name: words(name), colour: seriesColour(i), strong: own(name), points, note });
  lineChart(parent, {
    title: "Predicted and actual new cells", subtitle: "predictions for the view taken by each gain that predicts cells; the run's own method drawn bold",
    x: "scan", y: "new cells", unit: "cells", integerX: true,
    series: [
      ...names.map((name, i) => styled(name, i, perScan(predictions(name)))),
      { name: "actual", colour: "var(--text)", strong: true, points: perScan(actual) },
    ],
  });
  const errors = names.map((name) => predictions(name).map((p, i) => (isNumber(p) && isNumber(actual[i]) ? Math.abs(p - actual[i]) : null)));
  const mean = (list) => { const seen = list.filter(isNumber); return seen.length ? seen.reduce((a, b) => a + b) / seen.length : NaN; };
  lineChart(parent, {
    title: "Error of the prediction", subtitle: "|predicted − actual|, with each gain's mean",
    x: "scan", y: "absolute error in cells", unit: "cells", integerX: true,
    series: names.map((name, i) => styled(name, i, perScan(errors[i]), `mean ${formatNumber(Math.round(mean(errors[i])))}`)),
  });
}

// Of recognition: what each view told, and how well it was flown to.
function observationPlots(parent) {
  const seen = (key, scale = 1) => perScan(STEPS.map((s) => (isNumber(s[key]) ? scale * s[key] : null)));
  const chart = (title, subtitle, y, unit, series) => lineChart(parent, { title, subtitle, x: "view", y, unit, integerX: true, series });
  chart("Entropy", "of object and pose, after each view", "entropy in bits", "bits", [
    { name: "entropy", colour: seriesColour(0), strong: true, points: seen("entropy_bits") },
  ]);
  chart("Probability of the estimate", "summed over its poses", "probability", "", [
    { name: "most probable object", colour: seriesColour(2), strong: true, points: seen("map_probability") },
  ]);
  if (METRICS.others?.length || METRICS.targets?.length > 1) {
    chart("How much of the object was seen", "of the surface that faces the camera", "share", "", [
      { name: "as the map said", colour: seriesColour(1), dashed: true, points: seen("expected_visible") },
      { name: "as the image shows", colour: seriesColour(0), strong: true, points: seen("seen_share") },
    ]);
  }
  chart("Where the images were taken", "camera against where it was meant to be", "position error in mm", "mm", [
    { name: "position", colour: seriesColour(1), strong: true, points: seen("position_error_m", 1000) },
  ]);
  chart("How the camera was turned", "against how it was meant to be", "angle error in degrees", "°", [
    { name: "angle", colour: seriesColour(3), strong: true, points: seen("angle_error_rad", 180 / Math.PI) },
  ]);
}

function changePlots(parent) {
  lineChart(parent, {
    title: "Probability of a change", subtitle: "P(u): that it is not as expected, after each view",
    x: "view", y: "probability", unit: "", integerX: true,
    series: [{ name: "changed", colour: seriesColour(3), strong: true, points: perScan(column("change_probability")) }],
  });
  observationPlots(parent);
}

// What is left of all that can be seen, after each scan, over what it took.
function leftPlots(parent) {
  const all = METRICS.observable_cells ?? STEPS[0]?.observable_unobserved_cells;
  if (!(all > 0)) return;
  const over = (key) => STEPS.filter((s) => isNumber(s[key]) && isNumber(s.observable_unobserved_cells)).map((s) => [s[key], 100 * s.observable_unobserved_cells / all]);
  for (const [key, title, x] of [["time_s", "Left to see, over time", "time in s"], ["path_length_m", "Left to see, over the way", "path length in m"]]) {
    const points = over(key);
    if (points.length < 2) continue;
    lineChart(parent, { title, subtitle: "of what can be seen at all, after each scan", x, y: "left in %", unit: "%", series: [{ name: "left", colour: seriesColour(0), strong: true, points }] });
  }
}

function mappingPlots(parent) {
  const chart = (title, subtitle, y, unit, series) => {
    if (series.some((s) => s.points.some((p) => isNumber(p[1])))) lineChart(parent, { title, subtitle, x: "scan", y, unit, integerX: true, series });
  };
  chart("Cells not yet observed", "after each scan", "cells", "cells", [
    { name: "unobserved", colour: seriesColour(8), points: perScan(column("unobserved_cells")), dashed: true },
    { name: "of these, observable from some view", colour: seriesColour(0), strong: true, points: perScan(column("observable_unobserved_cells")) },
  ]);
  leftPlots(parent);
  predictionPlots(parent);
  const millimetres = (key) => perScan(column(key).map((v) => (isNumber(v) ? 1000 * v : null)));
  chart("Pose error", "against the simulator's truth", "position error in mm", "mm", [
    { name: "the wheels alone since the scan before", colour: seriesColour(1), dashed: true, points: millimetres("pose_error_before_registration_m") },
    { name: "as the scan was taken into the map", colour: seriesColour(0), strong: true, points: millimetres("pose_error_m") },
  ]);
  chart("Planning time", "wall time of the decision that led to each scan", "time in s", "s", [
    { name: "planning", colour: seriesColour(4), strong: true, points: perScan(chosenOnly(column("plan_time_s"))) },
  ]);
  chart("Distance travelled", "cumulative", "path length in m", "m", [
    { name: "path length", colour: seriesColour(2), strong: true, points: perScan(column("path_length_m")) },
  ]);
  chart("Occupied cells against the true scene", "after each scan", "share", "", [
    { name: "precision", colour: seriesColour(0), strong: true, points: perScan(column("precision")) },
    { name: "recall", colour: seriesColour(3), strong: true, points: perScan(column("recall")) },
  ]);
}

function coverageCard() {
  const left = column("observable_unobserved_cells").filter(isNumber);
  if (!left.length) return;
  const known = isNumber(METRICS.observable_cells) && METRICS.observable_cells > 0;
  const total = known ? METRICS.observable_cells : left[0];
  const share = total > 0 ? 1 - left[left.length - 1] / total : 1;
  const sub = known ? `${formatNumber(left[left.length - 1])} of ${formatNumber(total)} cells left` : "of those left after the first scan";
  card("Observable cells seen", percent(share), { unit: "%", share, sub });
}

function mappingCards() {
  coverageCard();
  const fallbacks = STEPS.filter((s) => s.fallback).length;
  card("Scans", String(STEPS.length), { sub: fallbacks ? `${fallbacks} of them fallbacks` : "no fallback" });
  const { precision, recall } = METRICS.map ?? {};
  const shut = METRICS.unreachable;
  if (shut?.rooms > 0) {
    const rooms = shut.rooms === 1 ? "1 room" : `${shut.rooms} rooms`;
    card("Out of reach", rooms, { sub: `with ${percent(shut.share)} % of all that could be seen; not counted` });
  }
  card("Precision / recall", `${percent(precision)} / ${percent(recall)}`, { unit: "%", sub: "of occupied cells, against the true scene" });
}

function viewsCard() {
  card("Views", String(STEPS.length), { sub: `entropy ${formatNumber(METRICS.entropy_bits, 3)} bits at the end` });
}

function recognitionCards() {
  if (METRICS.targets?.length > 1) {
    for (const target of METRICS.targets) {
      card(`Object ${METRICS.targets.indexOf(target) + 1}`, String(target.estimate ?? "–"), { sub: `truth: ${target.truth}; ${target.views} views`, kind: target.correct ? "good" : "bad" });
    }
    viewsCard();
    return;
  }
  card("Estimate", String(METRICS.estimate ?? "–"), { sub: `truth: ${METRICS.truth}`, kind: METRICS.correct ? "good" : "bad" });
  viewsCard();
}

function changeCards() {
  const decision = METRICS.decision ?? "not decided";
  card("Change", String(decision), { sub: `truth: ${METRICS.scenario}; ${METRICS.expected?.object} was expected`, kind: METRICS.correct ? "good" : "bad" });
  card("Probability of a change", isNumber(METRICS.change_probability) ? formatNumber(METRICS.change_probability, 3) : "–", { share: METRICS.change_probability });
  const seen = METRICS.decision === "removed" ? "nothing" : METRICS.estimate ?? "–";
  card("Most like", String(seen), { sub: `there is ${METRICS.truth ?? "nothing"}` });
  viewsCard();
}

FIGURES.mapping = { cards: mappingCards, plots: mappingPlots };
FIGURES.recognition = { cards: recognitionCards, plots: observationPlots };
FIGURES.change = { cards: changeCards, plots: changePlots };
