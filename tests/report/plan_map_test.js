// The scripts of the page without a browser: a plan is drawn where its stops are, on the map of what was known then.
// node plan_map_test.js ASSETS
"use strict";
const assert = require("assert");
const fs = require("fs");
const vm = require("vm");

// As much of an element as the scripts use.
class SVGElement {
  constructor(tag) { this.tag = tag; this.attributes = {}; this.children = []; this.textContent = ""; this.listeners = {}; }
  setAttribute(name, value) { this.attributes[name] = String(value); }
  append(...nodes) { this.children.push(...nodes); }
  replaceChildren() { this.children = []; }
  addEventListener(name, listener) { this.listeners[name] = listener; }
  get classList() { return { toggle: (name, on) => { this.marks = { ...this.marks, [name]: on }; } }; }
  get clientWidth() { return 640; }
  all(test) { return this.children.flatMap((c) => [...(test(c) ? [c] : []), ...(c.all?.(test) ?? [])]); }
  of(name) { return this.all((c) => (c.attributes?.class ?? "").split(" ").includes(name)); }
}

function page(data) {
  const ids = {};
  const at = (id) => (ids[id] ??= Object.assign(new SVGElement("div"), { hidden: id === "section-plans" }));
  const context = {
    SVGElement, at, console, DATA: data, STEP_WORD: "scan", words: (text) => text, heightColour: () => [0, 0, 0],
    document: { querySelector: () => ({ namespaceURI: "svg" }), getElementById: at, createElement: (tag) => new SVGElement(tag),
      createElementNS: (_, tag) => new SVGElement(tag) },
    ResizeObserver: class { observe() {} },
  };
  vm.createContext(context);
  for (const name of ["plots.js", "map.js", "plans.js"]) vm.runInContext(fs.readFileSync(`${process.argv[2]}/${name}`, "utf8"), context);
  return { at, context };
}

const stop = (x, y, arrival_s) => ({ id: 3, x, y, yaw: 0, arrival_s, departure_s: arrival_s + 10, gain: 100, beyond: 0 });
const plan = (scan, time_s, why, stops) => ({ scan, time_s, change: "first", why, unit: "cells", ends_s: 30, stops });
const plans = [plan(2, 10, "the first plan", [stop(1, 0, 3), stop(2, 1, 15), stop(2, 2, 30)]), plan(3, 40, "goes on as intended", [stop(2, 1, 4)])];
const scene = {
  candidates: [], views: [1, 2].map((number) => ({ x: number - 1, y: 0, yaw: 0, number, scan: {} })), voxels: null, flight: null,
  truth: [], estimated: [[0, 0, 0], [10, 0, 0], [30, 1, 0], [50, 2, 1]], region: { min: [0, 0], max: [4, 3] },
};

const { at, context } = page({ plans });
context.scene = scene;
vm.runInContext("fillPlans(scene)", context);
assert.strictEqual(at("section-plans").hidden, false);

const map = at("plan-map");
const region = map.of("region")[0].attributes;
const scale = Number(region.width) / 4;
const px = (x) => Number(region.x) + x * scale, py = (y) => Number(region.y) + Number(region.height) - y * scale;
const near = (a, b) => assert.ok(Math.abs(a - b) < 0.11, `${a} is not ${b}`);

const stops = map.of("stop").reverse();
assert.deepStrictEqual(stops.map((s) => s.attributes["data-stop"]), ["1", "2", "3"], "the next one on top");
const circles = stops.map((s) => s.children[0].attributes);
assert.strictEqual(circles.length, 3);
plans[0].stops.forEach((s, i) => { near(Number(circles[i].cx), px(s.x)); near(Number(circles[i].cy), py(s.y)); });
assert.deepStrictEqual(stops.map((s) => s.children[1].textContent), ["2", "3", "4"]);
const points = (path) => path.attributes.d.match(/-?[\d.]+ -?[\d.]+/g).map((p) => p.split(" ").map(Number));
const next = points(map.of("next")[0]), later = points(map.of("later")[0]);
near(next[0][0], px(0)); near(next[1][0], px(1));
assert.strictEqual(later.length, 3);
near(later[2][1], py(2));
assert.deepStrictEqual(map.of("pin").length, 1, "the second scan was not taken yet");

const rows = at("plan-table").all((c) => c.tag === "tr").slice(1);
assert.deepStrictEqual(rows.map((row) => row.children.at(-1).textContent), ["the first plan", "goes on as intended"]);
assert.deepStrictEqual(rows.map((row) => row.marks["chosen-plan"]), [true, false]);
rows[1].children[0].children[0].listeners.click();
assert.strictEqual(map.of("stop").length, 1);
assert.strictEqual(map.of("later").length, 0, "there is nothing beyond the next view");
near(points(map.of("next")[0])[0][0], px(1));
near(Number(map.of("region")[0].attributes.width), 4 * scale);

for (const none of [null, []]) {
  const without = page({ plans: none });
  without.context.scene = scene;
  vm.runInContext("fillPlans(scene)", without.context);
  assert.strictEqual(without.at("section-plans").hidden, true);
}
