#include <twin/page/live_view.h>

namespace swimtwin
{
  const char *const live_page = R"page(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>swimtwin</title>
<style>
body { font: 15px/1.4 "DejaVu Sans", sans-serif; color: #26262b; margin: 1.2em auto; max-width: 1100px; }
h1 { font-size: 1.3em; margin: 0; } #state { color: #5f6673; margin: 0 0 .8em; }
main { display: grid; grid-template-columns: 3fr 2fr; gap: 1em; }
figure { margin: 0; } figcaption { color: #5f6673; font-size: .9em; }
svg { width: 100%; background: #fff; border: 1px solid #e3e6ea; }
.flag { background: #c23b4e; color: #fff; border-radius: 3px; padding: 0 .4em; margin-right: .3em; }
td { padding: .1em .6em; vertical-align: top; } .over { color: #b4bac4; }
</style></head><body>
<h1 id="title">swimtwin</h1><p id="state">waiting for the twin</p>
<main>
<figure><svg id="map" viewBox="0 0 600 500"></svg><figcaption id="mapnote">position and shape</figcaption></figure>
<div id="panels"></div>
</main>
<table id="alarms"></table>
<script>
"use strict";
const svg = (name, attributes, parent) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (parent) parent.appendChild(node);
  return node;
};
const text = (id, words) => { document.getElementById(id).textContent = words; };
const names = { young_modulus_over_viscosity_1_s: ["E/\u03bc (1/ms)", 1e-3],
  magnetization_over_viscosity_A_m_Pa_s: ["M/\u03bc (kA/(m Pa s))", 1e-3], background_bx_T: ["background b\u2093 (mT)", 1e3],
  background_by_T: ["background b\u1d67 (mT)", 1e3], camera_delay_s: ["camera's delay (ms)", 1e3] };
const kept = 900, trail = [], series = {};
let path = [], body_mm = 8, latest = null, is_over = false;

function push(name, time, value, sd) {
  const s = series[name] || (series[name] = []);
  s.push([time, value, sd]);
  if (s.length > kept) s.shift();
}
function panel(name, label) {
  let figure = document.getElementById("p-" + name);
  if (!figure) {
    figure = document.createElement("figure");
    figure.id = "p-" + name;
    figure.appendChild(svg("svg", { viewBox: "0 0 400 90" }));
    figure.appendChild(document.createElement("figcaption"));
    document.getElementById("panels").appendChild(figure);
  }
  const s = series[name], drawing = figure.firstChild, last = s[s.length - 1];
  drawing.replaceChildren();
  const settled = s.slice(Math.floor(s.length / 10));
  let low = Math.min(...settled.map(p => p[1] - 1.96 * p[2])), high = Math.max(...settled.map(p => p[1] + 1.96 * p[2]));
  const margin = 0.1 * (high - low) || 1e-9;
  low -= margin; high += margin;
  const x = t => 400 * (t - s[0][0]) / Math.max(1e-9, last[0] - s[0][0]),
        y = v => Math.max(-20, Math.min(110, 90 * (high - v) / (high - low)));
  const band = s.map(p => x(p[0]) + "," + y(p[1] + 1.96 * p[2])).concat(
    s.slice().reverse().map(p => x(p[0]) + "," + y(p[1] - 1.96 * p[2])));
  svg("polygon", { points: band.join(" "), fill: "#1d4e89", opacity: 0.2 }, drawing);
  svg("polyline", { points: s.map(p => x(p[0]) + "," + y(p[1])).join(" "), fill: "none", stroke: "#1d4e89",
    "stroke-width": 1.6 }, drawing);
  figure.lastChild.textContent = label + ": " + last[1].toPrecision(5) + (last[2] > 0 ? " \u00b1 " + last[2].toPrecision(2) : "");
}
function map() {
  const drawing = document.getElementById("map"), axis = latest.axis_m.map(p => [1e3 * p[0], 1e3 * p[1]]);
  drawing.replaceChildren();
  const all = trail.concat(path, axis), xs = all.map(p => p[0]), ys = all.map(p => p[1]);
  const cx = (Math.min(...xs) + Math.max(...xs)) / 2, cy = (Math.min(...ys) + Math.max(...ys)) / 2;
  const half = Math.max((Math.max(...xs) - Math.min(...xs)) / 600, (Math.max(...ys) - Math.min(...ys)) / 500, body_mm / 500) * 1.15;
  const line = (points, colour, width) => svg("polyline", { fill: "none", stroke: colour, "stroke-width": width,
    "stroke-linecap": "round", points: points.map(p => (300 + (p[0] - cx) / half) + "," + (250 - (p[1] - cy) / half)).join(" ") }, drawing);
  line(path, "#f3c98b", 5);
  line(trail, "#b4bac4", 1);
  line(axis, "#d1662b", 4);
  line(axis.slice(0, 2), "#1d4e89", 9);
  text("mapnote", "position (" + axis[0][0].toFixed(2) + ", " + axis[0][1].toFixed(2) + ") mm, angle " +
    (latest.angle_rad * 57.29578).toFixed(1) + "\u00b0");
}
function state() {
  const place = document.getElementById("state");
  place.replaceChildren();
  for (const flag of latest.flags) {
    const span = document.createElement("span");
    span.className = "flag";
    span.textContent = flag;
    place.appendChild(span);
  }
  place.appendChild(document.createTextNode("t = " + latest.time_s.toFixed(2) + " s, trust " + latest.trust.toFixed(2) +
    (is_over ? ", ended" : "")));
}
function alarm(a) {
  const row = document.getElementById("alarms").insertRow(0);
  if (a.over) row.className = "over";
  for (const cell of [a.since_s.toFixed(2) + " s", a.name, a.over ? "over at " + a.time_s.toFixed(2) + " s" : a.what, a.remedy || ""])
    row.insertCell().textContent = cell;
  while (document.getElementById("alarms").rows.length > 100) document.getElementById("alarms").deleteRow(-1);
}
const events = new EventSource("/events");
events.onmessage = message => {
  const r = JSON.parse(message.data);
  if (r.type === "twin") { text("title", "swimtwin: " + r.model); body_mm = 1e3 * r.body_length_m; }
  if (r.type === "path") path = r.points_m.map(p => [1e3 * p[0], 1e3 * p[1]]);
  if (r.type === "alarm") alarm(r);
  if (r.type === "end") { is_over = true; if (latest) state(); events.close(); }
  if (r.type !== "view") return;
  latest = r;
  trail.push([1e3 * r.x_m, 1e3 * r.y_m]);
  if (trail.length > 3000) trail.shift();
  for (const name in r.parameters) {
    const factor = (names[name] || [name, 1])[1];
    push(name, r.time_s, factor * r.parameters[name][0], factor * r.parameters[name][1]);
  }
  push("bx", r.time_s, 1e3 * r.field_T[0], 0);
  push("by", r.time_s, 1e3 * r.field_T[1], 0);
};
setInterval(() => {
  if (!latest) return;
  state();
  map();
  for (const name in latest.parameters) panel(name, (names[name] || [name, 1])[0]);
  panel("bx", "b\u2093 (mT)");
  panel("by", "b\u1d67 (mT)");
}, 200);
</script></body></html>
)page";
} // namespace swimtwin
