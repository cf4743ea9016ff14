// What a run could have been: bound.json and branches.json, which vantage bound and vantage branch write.

// A table in a frame that scrolls. columns: [[label, unit]]; rows: lists of texts, marked ones bold.
function hindsightTable(parent, label, columns, rows) {
  const wrap = append(parent, "div", { class: "table-wrap", tabindex: 0, role: "region", "aria-label": label });
  const table = append(wrap, "table");
  const head = append(append(table, "thead"), "tr");
  for (const [name, unit] of columns) {
    append(append(head, "th", { scope: "col" }, name), "small", {}, unit ? `in ${unit}` : "\u00a0");
  }
  const body = append(table, "tbody");
  for (const { cells, marked } of rows) {
    const line = append(body, "tr");
    for (const text of cells) append(marked ? append(line, "td") : line, marked ? "b" : "td", {}, text);
  }
}

function notRun(parent, what, command) {
  const note = append(parent, "p", { class: "empty" }, `${what}: not run. `);
  append(note, "code", {}, command);
  note.append(" does it, and writes this page again.");
}

const orNever = (value) => (isNumber(value) ? formatNumber(value, 4) : "never");
const ratioText = (value) => (isNumber(value) ? `${formatNumber(value, 3)} ×` : "–");

function showBound(parent, bound) {
  append(parent, "h3", {}, "Against any policy");
  if (!bound) { notRun(parent, "Bound", "vantage bound DIR"); return; }
  const oracle = bound.has_oracle_tour;
  append(parent, "p", { class: "note" }, `From ${formatNumber(bound.poses)} poses, at ${bound.speed_m_s} m/s at most, with scans of ${formatNumber(bound.scan_s, 3)} s at least. `
    + "Each least is one on its own; = is exact for such a policy, ≥ is below every one."
    + (oracle ? " oracle_tour knew the building." : ""));
  const columns = [["observed", "%"], ["", ""], ["scans", ""], ["way", "m"], ["time", "s"]];
  const rows = [];
  for (const share of bound.shares) {
    const line = (name, of) => rows.push({ cells: [String(share.percent), name, orNever(of?.scans), orNever(of?.way_m), orNever(of?.time_s)] });
    line("this run", share.run);
    if (oracle) line("oracle_tour", share.oracle_tour);
    const sign = (key) => (share.least ? `${share.exact[key] ? "=" : "≥"} ${formatNumber(share.least[key], 4)}` : "cannot be");
    rows.push({ cells: [String(share.percent), "any policy", sign("scans"), sign("way_m"), sign("time_s")] });
    const ratios = (name, of) => of && rows.push({ marked: true, cells: [String(share.percent), name, ratioText(of.scans), ratioText(of.way_m), ratioText(of.time_s)] });
    ratios("run / least", share.run_over_least);
    if (oracle) ratios("run / oracle_tour", share.run_over_oracle_tour);
  }
  hindsightTable(parent, "Bound", columns, rows);
}

const ratePerS = (branch) => (branch && branch.seconds > 0 ? (branch.new_cells ?? 0) / branch.seconds : null);

// Every view of a decision: what was predicted of it, and what came of it.
function showAlternatives(parent, decision) {
  const box = append(parent, "details");
  append(box, "summary", {}, `All views after scan ${decision.scan}`);
  const columns = [["view", ""], ["predicted", decision.gain_unit], ["new cells", ""], ["way as planned", "m"], ["way as driven", "m"], ["took", "s"], ["cells / s", ""]];
  const byRate = [...decision.branches].sort((a, b) => (ratePerS(b) ?? -1) - (ratePerS(a) ?? -1));
  hindsightTable(box, `All views after scan ${decision.scan}`, columns, byRate.map((b) => ({
    marked: b.chosen,
    cells: [`${b.view}${b.chosen ? ", chosen" : ""}`, formatNumber(b.gain, 4), isNumber(b.new_cells) ? formatNumber(b.new_cells) : "no scan",
      isNumber(b.planned_m) ? formatNumber(b.planned_m, 3) : "out of reach", formatNumber(b.way_m, 3), formatNumber(b.seconds, 3), isNumber(ratePerS(b)) ? formatNumber(ratePerS(b), 3) : "–"],
  })));
}

// Decision by decision; those that nobody has branched say so.
function showRegret(parent, branches) {
  append(parent, "h3", {}, "Regret of each decision");
  if (!branches?.decisions?.length) { notRun(parent, "Branches", "vantage branch DIR --all"); return; }
  append(parent, "p", { class: "note" }, "Every view of a decision was really taken, in a repetition of the run: observable cells that it newly showed, and how long it took to drive there and to scan.");
  const columns = [["after scan", ""], ["chosen", "view"], ["new cells", ""], ["took", "s"], ["cells / s", ""], ["best", "view"], ["regret", "cells"], ["fastest", "view"], ["regret", "cells / s"]];
  const byScan = new Map(branches.decisions.map((d) => [d.scan, d]));
  const rows = STEPS.slice(1).map((step, i) => {
    const decision = byScan.get(i + 1);
    const chosen = decision?.branches.find((b) => b.chosen);
    const of = (view) => decision.branches.find((b) => b.view === view);
    if (!decision?.regret) return { cells: [String(i + 1), String(step.chosen_view), "not run", "", "", "", "", "", ""] };
    const { best_view, cells, fastest_view, cells_per_s } = decision.regret;
    return { cells: [String(i + 1), String(chosen.view), formatNumber(chosen.new_cells), formatNumber(chosen.seconds, 3), formatNumber(ratePerS(chosen), 3),
      `${best_view} (${formatNumber(of(best_view).new_cells)})`, formatNumber(cells), `${fastest_view} (${formatNumber(ratePerS(of(fastest_view)), 3)})`, formatNumber(cells_per_s, 3)] };
  });
  hindsightTable(parent, "Regret", columns, rows);
  for (const decision of branches.decisions) showAlternatives(parent, decision);
  const told = branches.decisions.filter((d) => d.regret);
  if (told.length < 2) return;
  const plot = append(parent, "div", { class: "plots" });
  const chosen = (d) => d.branches.find((b) => b.chosen);
  const view = (d, id) => d.branches.find((b) => b.view === id);
  lineChart(plot, {
    title: "What a decision brought, and what it could have", subtitle: "cells newly observed per second of driving and scanning", x: "after scan", y: "cells per second", unit: "cells/s", integerX: true,
    series: [
      { name: "chosen view", colour: seriesColour(0), strong: true, points: told.map((d) => [d.scan, ratePerS(chosen(d))]) },
      { name: "fastest view", colour: seriesColour(1), dashed: true, points: told.map((d) => [d.scan, ratePerS(view(d, d.regret.fastest_view))]) },
    ],
  });
}

function fillHindsight() {
  if (!DATA.hindsight) return;
  at("section-hindsight").hidden = false;
  showBound(at("hindsight"), DATA.hindsight.bound);
  showRegret(at("hindsight"), DATA.hindsight.branches);
}
