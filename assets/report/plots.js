// Small helpers for elements and numbers, and a line chart in SVG.

// The namespace comes from an SVG element the page already holds.
const SVG_NAMESPACE = document.querySelector("svg").namespaceURI;

function append(parent, tag, attributes = {}, text) {
  const svg = parent instanceof SVGElement || tag === "svg";
  const node = svg ? document.createElementNS(SVG_NAMESPACE, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== null) node.setAttribute(name, value);
  }
  if (text !== undefined) node.textContent = text;
  parent.append(node);
  return node;
}

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

// 1234567 -> "1 234 567", 0.012345 -> "0.0123".
function formatNumber(value, digits = 4) {
  if (!isNumber(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(2);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = Number.isInteger(value) ? String(value) : value.toFixed(Math.min(decimals, 6));
  const [whole, fraction] = text.split(".");
  const trimmed = fraction ? fraction.replace(/0+$/, "") : "";
  const grouped = whole.replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
  return (trimmed ? `${grouped}.${trimmed}` : grouped).replace("-", "−");
}

function tickLabel(value, step) {
  if (Math.abs(value) >= 1e4 && step >= 100) return formatNumber(value / 1000, 6) + "k";
  return formatNumber(Number(value.toPrecision(10)), 6);
}

// Ticks at 1, 2 or 5 times a power of ten.
function ticks(low, high, count) {
  const raw = Math.max(high - low, 1e-12) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= raw * 0.999);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; ++k) list.push(k * step);
  return { step, list };
}

const Tooltip = {
  node: document.getElementById("tooltip"),
  // rows: [{colour, name, value}]
  show(x, y, title, rows) {
    this.node.replaceChildren();
    append(this.node, "b", {}, title);
    for (const row of rows) {
      const line = append(this.node, "div", { class: "row" });
      if (row.colour) append(line, "i", {}).style.background = row.colour;
      append(line, "span", {}, row.name);
      append(line, "strong", {}, row.value);
    }
    this.node.hidden = false;
    const box = this.node.getBoundingClientRect();
    const left = x + 16 + box.width > innerWidth ? x - 16 - box.width : x + 16;
    this.node.style.left = `${Math.max(4, left)}px`;
    this.node.style.top = `${Math.max(4, Math.min(y + 12, innerHeight - box.height - 4))}px`;
  },
  hide() { this.node.hidden = true; },
};

// Calls draw(width) now and whenever the element's width changes.
function onWidth(element, draw) {
  let last = 0;
  const redraw = () => {
    const width = Math.round(element.clientWidth);
    if (width > 0 && width !== last) { last = width; draw(width); }
  };
  new ResizeObserver(redraw).observe(element);
  redraw();
}

function legendMark(parent, series) {
  const svg = append(parent, "svg", { width: 22, height: 10, "aria-hidden": "true" });
  if (series.pin) { append(svg, "circle", { cx: 11, cy: 5, r: 5, fill: series.colour }); return; }
  append(svg, "line", {
    x1: 1, x2: 21, y1: 5, y2: 5, stroke: series.colour, "stroke-linecap": "round",
    "stroke-width": series.strong ? 3.4 : 2, "stroke-dasharray": series.dashed ? "5 4" : null,
  });
  if (series.dots !== false) append(svg, "circle", { cx: 11, cy: 5, r: 3, fill: series.colour });
}

// spec: {title, subtitle, x, y (axis labels), unit, series: [{name, colour, points: [[x, y]],
// strong, dashed, note}], integerX}
function lineChart(parent, spec) {
  const figure = append(parent, "figure", { class: "plot" });
  const caption = append(figure, "figcaption");
  append(caption, "h3", {}, spec.title);
  if (spec.subtitle) append(caption, "span", {}, spec.subtitle);
  const holder = append(figure, "div");
  const legend = append(figure, "div", { class: "legend" });
  const series = spec.series.filter((s) => s.points.some((p) => isNumber(p[1])));
  const hidden = new Set();
  let width = 0;
  const draw = () => drawChart(holder, spec, series.filter((s) => !hidden.has(s)), width);
  for (const s of series) {
    const button = append(legend, "button", { type: "button", "aria-pressed": "true" });
    legendMark(button, s);
    append(button, "span", {}, s.note ? `${s.name} (${s.note})` : s.name);
    button.addEventListener("click", () => {
      if (hidden.has(s)) hidden.delete(s); else hidden.add(s);
      button.setAttribute("aria-pressed", String(!hidden.has(s)));
      draw();
    });
  }
  onWidth(holder, (w) => { width = w; draw(); });
}

function drawChart(holder, spec, series, width) {
  const height = 270, left = 62, right = 14, top = 10, bottom = 44;
  const xs = [...new Set(spec.series.flatMap((s) => s.points.filter((p) => isNumber(p[1])).map((p) => p[0])))].sort((a, b) => a - b);
  const values = series.flatMap((s) => s.points.map((p) => p[1])).filter(isNumber);
  const xLow = xs.length ? xs[0] : 0;
  const xHigh = xs.length > 1 ? xs[xs.length - 1] : xLow + 1;
  const yTicks = ticks(Math.min(0, ...values), Math.max(0, ...values) || 1, 5);
  const yLow = Math.floor(Math.min(0, ...values) / yTicks.step) * yTicks.step;
  const yHigh = Math.ceil((Math.max(0, ...values) || 1) / yTicks.step - 1e-9) * yTicks.step;
  const px = (x) => left + ((x - xLow) / (xHigh - xLow)) * (width - left - right);
  const py = (y) => height - bottom - ((y - yLow) / (yHigh - yLow || 1)) * (height - top - bottom);

  holder.replaceChildren();
  const svg = append(holder, "svg", {
    class: "chart", width, height, viewBox: `0 0 ${width} ${height}`, tabindex: 0, role: "img",
    "aria-label": `${spec.title}. ${spec.y} against ${spec.x}. ` + series.map((s) => {
      const seen = s.points.filter((p) => isNumber(p[1]));
      return seen.length ? `${s.name}: from ${formatNumber(seen[0][1])} to ${formatNumber(seen[seen.length - 1][1])}` : s.name;
    }).join("; "),
  });
  for (const y of ticks(yLow, yHigh, 5).list) {
    append(svg, "line", { class: y === 0 ? "axis" : "grid", x1: left, x2: width - right, y1: py(y), y2: py(y) });
    append(svg, "text", { x: left - 8, y: py(y) + 4, "text-anchor": "end" }, tickLabel(y, yTicks.step));
  }
  const xTicks = ticks(xLow, xHigh, Math.min(12, width / 60));
  for (const x of xTicks.list.filter((x) => !spec.integerX || Number.isInteger(Number(x.toFixed(9))))) {
    append(svg, "text", { x: px(x), y: height - bottom + 18, "text-anchor": "middle" }, tickLabel(x, xTicks.step));
  }
  append(svg, "text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, spec.x);
  append(svg, "text", { transform: `translate(14 ${(top + height - bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, spec.y);
  for (const s of series) drawSeries(svg, s, px, py);
  addCursor(svg, spec, series, xs, px, py, { top, bottom: height - bottom, width });
}

function drawSeries(svg, s, px, py) {
  const group = append(svg, "g", { class: `series${s.strong ? " strong" : ""}${s.dashed ? " dashed" : ""}` });
  let path = "", pen = false;
  for (const [x, y] of s.points) {
    if (!isNumber(y)) { pen = false; continue; }
    path += `${pen ? "L" : "M"}${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
    pen = true;
  }
  append(group, "path", { d: path, stroke: s.colour });
  if (s.points.length > 60) return;
  for (const [x, y] of s.points) {
    if (isNumber(y)) append(group, "circle", { cx: px(x), cy: py(y), r: s.strong ? 4 : 2.8, fill: s.colour });
  }
}

// A vertical line that follows the pointer or the arrow keys, and a tooltip with every value there.
function addCursor(svg, spec, series, xs, px, py, frame) {
  const line = append(svg, "line", { class: "cursor", y1: frame.top, y2: frame.bottom, visibility: "hidden" });
  let at = -1;
  const show = (index, clientY) => {
    at = Math.max(0, Math.min(xs.length - 1, index));
    const x = xs[at], box = svg.getBoundingClientRect();
    line.setAttribute("x1", px(x));
    line.setAttribute("x2", px(x));
    line.setAttribute("visibility", "visible");
    const rows = series.map((s) => ({ s, point: s.points.find((p) => p[0] === x) }))
      .filter((r) => r.point && isNumber(r.point[1])).sort((a, b) => b.point[1] - a.point[1])
      .map((r) => ({ colour: r.s.colour, name: r.s.name, value: `${formatNumber(r.point[1])} ${spec.unit || ""}` }));
    Tooltip.show(box.left + (px(x) / frame.width) * box.width, clientY ?? box.top + 40, `${spec.xName || spec.x} ${formatNumber(x)}`, rows);
  };
  const hide = () => { line.setAttribute("visibility", "hidden"); Tooltip.hide(); };
  const nearest = (event) => {
    const box = svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * frame.width;
    let best = 0;
    xs.forEach((value, i) => { if (Math.abs(px(value) - x) < Math.abs(px(xs[best]) - x)) best = i; });
    return best;
  };
  if (!xs.length) return;
  svg.addEventListener("pointermove", (event) => show(nearest(event), event.clientY));
  svg.addEventListener("pointerdown", (event) => show(nearest(event), event.clientY));
  svg.addEventListener("pointerleave", hide);
  svg.addEventListener("blur", hide);
  svg.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (move) { event.preventDefault(); show(at + move); }
    if (event.key === "Escape") hide();
  });
}
