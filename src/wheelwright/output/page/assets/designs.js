"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const svg = document.getElementById("plot");
const { known, shown, ends, scale } = plotAxes;
const frame = { left: 90, right: 880, top: 20, bottom: 460 };

function element(parent, name, attributes, text) {
  const namespace = parent.namespaceURI === "http://www.w3.org/2000/svg" ? parent.namespaceURI : null;
  const made = namespace ? document.createElementNS(namespace, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.appendChild(made);
  return made;
}

const report = design => `designs/${design.name}/report.html`;

function thumbnail(parent, design) {
  const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  picture.setAttribute("class", "thumbnail");
  picture.setAttribute("viewBox", "-50 -50 100 100");
  element(picture, "path", { class: "wheel", d: design.outline });
  if (design.layers) element(picture, "path", { class: "layers", d: design.layers });
  parent.appendChild(picture);
}

function card(parent, design, x, y) {
  const left = Math.min(x + 14, frame.right - 150), top = Math.min(y + 10, frame.bottom - 150);
  const group = element(parent, "g", { class: "card", transform: `translate(${left} ${top})`, "pointer-events": "none" });
  element(group, "rect", { width: 150, height: 146, rx: 8 });
  if (design.outline) element(group, "path", { class: "wheel", d: design.outline, transform: "translate(75 58)" });
  if (design.layers) element(group, "path", { class: "layers", d: design.layers, transform: "translate(75 58)" });
  element(group, "text", { x: 75, y: 134, "text-anchor": "middle", textLength: design.text.length > 20 ? 140 : undefined,
                           lengthAdjust: "spacingAndGlyphs" }, design.text);
}

function draw() {
  svg.replaceChildren();
  const x = data.quantities[document.getElementById("x").value], y = data.quantities[document.getElementById("y").value];
  const points = data.designs.filter(d => known(d.values[x.key]) && known(d.values[y.key]));
  if (points.length === 0) return;
  const across = scale(points.flatMap(d => ends(d, x)), frame.left, frame.right);
  const up = scale(points.flatMap(d => ends(d, y)), frame.bottom, frame.top);
  for (const t of across.ticks) {
    element(svg, "line", { class: "tick", x1: across.of(t), x2: across.of(t), y1: frame.top, y2: frame.bottom });
    element(svg, "text", { x: across.of(t), y: frame.bottom + 20, "text-anchor": "middle" }, String(t));
  }
  for (const t of up.ticks) {
    element(svg, "line", { class: "tick", x1: frame.left, x2: frame.right, y1: up.of(t), y2: up.of(t) });
    element(svg, "text", { x: frame.left - 8, y: up.of(t) + 5, "text-anchor": "end" }, String(t));
  }
  element(svg, "text", { x: (frame.left + frame.right) / 2, y: frame.bottom + 46, "text-anchor": "middle" },
          `${x.label} [${x.unit}]`);
  element(svg, "text", { transform: `translate(20 ${(frame.top + frame.bottom) / 2}) rotate(-90)`, "text-anchor": "middle" },
          `${y.label} [${y.unit}]`);
  for (const d of [...points].reverse()) {
    const px = across.of(d.values[x.key] * x.factor), py = up.of(d.values[y.key] * y.factor);
    const [[x1, x2], [y1, y2]] = [ends(d, x).map(across.of), ends(d, y).map(up.of)];
    if (x1 !== x2) element(svg, "line", { class: "error", x1, x2, y1: py, y2: py });
    if (y1 !== y2) element(svg, "line", { class: "error", x1: px, x2: px, y1, y2 });
    const link = element(svg, "a", { href: report(d) });
    const kind = (d.front === 1 ? "best " : "") + (d.progression === "preview" ? "preview" : "");
    const circle = element(link, "circle", { cx: px, cy: py, r: d.front === 1 ? 8 : 5, class: kind });
    element(circle, "title", {}, `${d.name}: ${d.text}`);
    let open = null;
    const show = () => { open = open || card(svg, d, px, py) || svg.lastChild; };
    const hide = () => { if (open) open.remove(); open = null; };
    link.addEventListener("mouseenter", show);
    link.addEventListener("focus", show);
    link.addEventListener("mouseleave", hide);
    link.addEventListener("blur", hide);
  }
}

function fill_table() {
  const table = document.getElementById("table");
  const head = element(element(table, "thead"), "tr");
  for (const [name, kind] of [["rank", ""], ["", ""], ["design", "text"], ["shapes", ""], ["ended", "text"]])
    element(head, "th", { class: kind }, name);
  for (const q of data.quantities) element(head, "th", {}, `${q.label} [${q.unit}]`);
  const body = element(table, "tbody");
  for (const d of data.designs) {
    const row = element(body, "tr", { class: d.front === 1 ? "best" : "" });
    element(row, "td", {}, d.rank);
    const picture = element(row, "td");
    if (d.outline) thumbnail(picture, d);
    const name = element(row, "td", { class: "text" });
    element(name, "a", { href: report(d) }, `${d.name}: ${d.text}`);
    element(row, "td", {}, d.shapes);
    element(row, "td", { class: "text" }, d.status);
    for (const q of data.quantities) element(row, "td", {}, shown(d.values[q.key], q, d.errors[q.key]));
  }
}

for (const [axis, chosen] of [["x", 0], ["y", Math.min(1, data.asked.length - 1)]]) {
  const select = document.getElementById(axis);
  data.quantities.forEach((q, i) => element(select, "option", { value: i }, `${q.label} [${q.unit}]`));
  select.value = data.quantities.findIndex(q => q.key === data.asked[chosen]);
  select.addEventListener("change", draw);
}
const best = data.designs.filter(d => d.front === 1).length;
document.getElementById("summary").textContent = `${data.designs.length} designs. For ${best} of them, no other ` + `design is better in all of: ${data.asked.map(key => data.quantities.find(q => q.key === key).label).join(", ")}.`;
const undecided = document.getElementById("undecided");
for (const text of data.undecided) element(undecided, "li", {}, text);
fill_table();
draw();
