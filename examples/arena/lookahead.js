#!/usr/bin/env node
// Looks two views ahead: takes the first of the pair that promises most per second.
//
// A planner for `choice: {name: external, command: [node, examples/arena/lookahead.js]}`. What the second view promises
// counts less the more it looks at what the first one has shown: views of nearby places in nearby directions overlap.
"use strict";

const OVERLAP_M = 1.2; // views that far apart see other things
const OVERLAP_RAD = 0.8; // as do those that look so far apart

const say = (message) => process.stdout.write(JSON.stringify(message) + "\n");

function apart(a, b) {
  const [ax, ay, , aYaw] = a.sensor;
  const [bx, by, , bYaw] = b.sensor;
  const turn = Math.abs(Math.atan2(Math.sin(aYaw - bYaw), Math.cos(aYaw - bYaw)));
  return { way_m: Math.hypot(ax - bx, ay - by), turn_rad: turn };
}

/** Share of what `second` promises that `first` leaves. */
function fresh(first, second) {
  const { way_m, turn_rad } = apart(first, second);
  return 1 - Math.exp(-way_m / OVERLAP_M - turn_rad / OVERLAP_RAD);
}

/** Metres of way a second, as the robot's own drives tell. */
function speedOf(views) {
  const driven = views.filter((view) => view.travel_s > 0 && view.path_length_m > 0);
  if (driven.length === 0) return 0.3;
  const sum = (key) => driven.reduce((total, view) => total + view[key], 0);
  return sum("path_length_m") / sum("travel_s");
}

function decide(request) {
  const all = request.candidates;
  const open = all.filter((view) => !view.exhausted && view.travel_s !== null);
  if (open.length === 0) return all.find((view) => !view.exhausted) || all[0];
  const speed_m_s = speedOf(open);
  const left_s = request.time_left_s === null ? Infinity : request.time_left_s;
  let best = { rate: -1, view: open[0] };
  for (const first of open) {
    const first_s = first.travel_s + request.scan_s;
    let rate = first.gain / first_s; // alone, if nothing fits behind it
    for (const second of request.scans_left > 1 ? open : []) {
      if (second === first) continue;
      const both_s = first_s + apart(first, second).way_m / speed_m_s + request.scan_s;
      if (both_s > left_s) continue;
      // What comes first is there for longer.
      const gain = first.gain + 0.8 * fresh(first, second) * second.gain;
      rate = Math.max(rate, gain / both_s);
    }
    if (rate > best.rate) best = { rate, view: first };
  }
  return best.view;
}

require("readline")
  .createInterface({ input: process.stdin })
  .on("line", (line) => {
    const message = JSON.parse(line);
    if (message.type === "hello") {
      say({ protocol: "vantage-planner", version: 1, name: "two views ahead" });
    } else if (message.type === "decide") {
      say({ view: decide(message).view });
    } else if (message.type === "end") {
      process.exit(0);
    }
  });
