// The model, live: fields and sliders, and what Python computes from them.

const SVG = "http://www.w3.org/2000/svg";
const REST = 120; // milliseconds: the address is written when the slider rests

const shown = (value, digits = 6) => String(Number(value.toPrecision(digits)));
const nano = (seconds) => shown(seconds * 1e9);
const micro = (meters) => shown(meters * 1e6, 7);
const giga = (value) => shown(value / 1e9, 5);
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

export class Model {
  constructor(python, hears) {
    this.python = python;
    this.hears = hears;
    this.part = document.getElementById("model");
    this.form = document.getElementById("inputs");
    this.said = document.getElementById("said");
    this.figure = document.getElementById("figure");
    this.fields = [...this.form.querySelectorAll("input[data-unit]")];
    this.sliders = new Map();
    for (const slider of this.form.querySelectorAll("input[type=range]")) {
      this.sliders.set(slider.dataset.of, slider);
      slider.addEventListener("input", () => {
        this.form.elements[slider.dataset.of].value = slider.value;
        this.changed();
      });
    }
    for (const field of this.fields) {
      field.addEventListener("input", () => {
        this.follow(field);
        this.changed();
      });
    }
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.compute();
    });
    document.getElementById("report-case").addEventListener("click", () => {
      this.form.reset();
      this.changed();
    });
    new ResizeObserver(() => this.answer?.curve && this.draw(this.answer)).observe(this.figure);
    document.getElementById("compute").disabled = false;
    if (this.fromAddress()) {
      this.part.open = true;
      if (!location.hash) this.part.scrollIntoView();
      this.compute();
    }
  }

  // Take over the inputs of the address; return whether there are some.
  fromAddress() {
    const given = new URLSearchParams(location.search);
    const named = this.fields.filter((field) => given.has(field.name));
    for (const field of named) {
      field.value = given.get(field.name);
      this.follow(field);
    }
    return named.length > 0;
  }

  toAddress() {
    const changed = this.fields.filter((field) => field.value !== field.defaultValue);
    const given = new URLSearchParams(changed.map((field) => [field.name, field.value]));
    const query = given.size > 0 ? `?${given}` : location.pathname;
    history.replaceState(null, "", `${query}${location.hash}`);
  }

  follow(field) {
    const slider = this.sliders.get(field.name);
    if (slider && Number.isFinite(Number(field.value))) slider.value = field.value;
  }

  changed() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.toAddress(), REST);
    this.compute();
  }

  // A number is in the field's unit; a text such as "98 ksi" has its own.
  inputs() {
    return Object.fromEntries(
      this.fields.map((field) => {
        const text = field.value.trim();
        const isNumber = text !== "" && Number.isFinite(Number(text));
        return [field.name, isNumber ? `${text} ${field.dataset.unit}`.trim() : text];
      }),
    );
  }

  // Ask for the newest inputs; those that were passed over meanwhile are never computed.
  async compute() {
    this.isStale = true;
    if (this.isAsking) return;
    this.isAsking = true;
    try {
      const wasStarted = this.python.worker !== undefined;
      if (!wasStarted) this.hears.say("Starting Python.");
      await this.python.start();
      if (!wasStarted) this.hears.say("Python is ready.");
      while (this.isStale) {
        this.isStale = false;
        const inputs = this.inputs();
        this.show(await this.python.ask({ ask: "model", inputs }), inputs);
        this.hears.clear();
        this.said.dataset.asked = JSON.stringify(inputs); // the inputs that it is said of
      }
    } catch (error) {
      this.hears.sayWrong(error);
      this.refuse(error.message);
    }
    this.isAsking = false;
  }

  // Say why nothing was computed; what is shown is of older inputs, and is dimmed.
  refuse(why) {
    this.said.textContent = `Not computed: ${why}`;
    this.part.classList.add("old");
  }

  show(answer, inputs) {
    if (answer.refused !== undefined) {
      this.refuse(answer.refused);
      return;
    }
    this.part.classList.remove("old");
    this.answer = answer;
    document.getElementById("results").hidden = false;
    const { sheet, depth, inverse } = answer;
    const bySheet = sheet.refused
      ? `The sheet was not run: ${sheet.refused}.`
      : `The sheet: ${micro(sheet.depth)} µm after ${counted(sheet.steps, "step")}, X/R ` +
        `${shown(sheet.normalized_depth)}.`;
    const doubtful = answer.warnings.length > 0 ? " Doubtful: see the warnings." : "";
    this.said.textContent =
      `Exact depth ${micro(depth)} µm, X/R ${shown(answer.normalized_depth)}, at rest after ` +
      `${nano(answer.stop_time)} ns, for Rₜ = ${giga(answer.resistance)} GPa. ${bySheet}${doubtful}`;
    this.said.dataset.depth = depth;
    this.said.dataset.sheet = sheet.depth ?? "";
    const printed = inputs.measured_depth.replace(/ um$/, " µm");
    const proven = inverse.range
      ? ` Proven for all depths that are printed as ${printed}: ${inverse.range}.`
      : "";
    const fewest = inverse.fewest_digits
      ? ` If the zeros that end it count for no digits: ${inverse.fewest_digits}.`
      : "";
    document.getElementById("inverse").textContent = inverse.refused
      ? `No resistance: ${inverse.refused}.`
      : `A depth of ${micro(inverse.depth)} µm takes Rₜ = ${giga(inverse.resistance)} GPa.${proven}${fewest}`;
    this.showDoubts(answer);
    this.showRows(sheet);
    this.showApproaches(answer.approaches);
    this.draw(answer);
  }

  showDoubts({ warnings, notes }) {
    const item = (kind, words) => {
      const line = document.createElement("li");
      line.className = kind;
      line.textContent = `${kind}: ${words}.`;
      return line;
    };
    document.getElementById("doubts").replaceChildren(
      ...warnings.map((words) => item("Warning", words)),
      ...notes.map((words) => item("Note", words)),
    );
  }

  showRows(sheet) {
    const body = document.getElementById("rows");
    body.replaceChildren();
    if (sheet.refused) return;
    const row = ([k, time, before, x, deceleration, after]) => [
      k, nano(time), shown(before, 7), micro(x), giga(deceleration),
      after === null ? "" : shown(after, 7),
    ];
    const rows = sheet.first.map(row);
    if (sheet.last[0]?.[0] > sheet.first.length) rows.push(["…", "", "", "", "", ""]);
    rows.push(...sheet.last.map(row));
    for (const cells of rows) body.append(tableRow(cells));
  }

  showApproaches({ rows, longest }) {
    document.getElementById("approaches-live").replaceChildren(
      ...rows.map(({ name, normalized_depth: value, text }) => {
        const bar = document.createElement("meter");
        bar.max = longest;
        bar.value = value;
        bar.setAttribute("aria-label", `X/R, ${name}`);
        return tableRow([name, text, bar]);
      }),
    );
  }

  // Figure 3 of the report: the exact motion as a line, rows of the sheet as marks on it.
  draw({ curve, sheet, depth }) {
    const width = Math.max(280, this.figure.clientWidth);
    const height = Math.min(360, Math.max(200, width * 0.55));
    const [left, top, right, bottom] = [46, 10, width - 12, height - 42];
    const marks = sheet.points ?? [];
    const ends = [curve.at(-1), ...marks];
    const times = ticks(Math.max(...ends.map(([t]) => t)) * 1e9);
    const depths = ticks(Math.max(...ends.map(([, x]) => x)) * 1e6);
    const across = (t) => left + ((right - left) * t * 1e9) / times.at(-1);
    const down = (x) => bottom - ((bottom - top) * x * 1e6) / depths.at(-1);
    const svg = drawn("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img" });
    svg.setAttribute("aria-label", `Depth against time, from 0 to ${micro(depth)} µm at rest`);
    for (const time of times) {
      const x = across(time / 1e9);
      svg.append(drawn("path", { class: "grid", d: `M${x} ${top}V${bottom}` }));
      svg.append(drawn("text", { x, y: bottom + 16, "text-anchor": "middle" }, shown(time)));
    }
    for (const value of depths) {
      const y = down(value / 1e6);
      svg.append(drawn("path", { class: "grid", d: `M${left} ${y}H${right}` }));
      svg.append(drawn("text", { x: left - 6, y: y + 4, "text-anchor": "end" }, shown(value)));
    }
    const middle = (left + right) / 2;
    svg.append(drawn("text", { x: middle, y: height - 6, "text-anchor": "middle" }, "Time [ns]"));
    const upright = `rotate(-90 12 ${(top + bottom) / 2})`;
    const place = { x: 12, y: (top + bottom) / 2, "text-anchor": "middle", transform: upright };
    svg.append(drawn("text", place, "Depth [µm]"));
    const line = curve.map(([t, x]) => `${across(t)},${down(x)}`).join(" ");
    svg.append(drawn("polyline", { class: "exact", points: line }));
    for (const [t, x] of marks) {
      svg.append(drawn("circle", { class: "row", cx: across(t), cy: down(x), r: 3.2 }));
    }
    this.figure.replaceChildren(svg);
    const rows = sheet.every === 1 ? "each row" : `one row in ${sheet.every} and the last`;
    const points = sheet.refused
      ? "The sheet was not run."
      : `Points: ${rows} of the sheet, in the middle of the step, where a row’s depth belongs.`;
    document.getElementById("figure-words").textContent =
      `Depth against time, as in Figure 3 of the report. Line: the exact motion. ${points}`;
  }
}

function tableRow(cells) {
  const row = document.createElement("tr");
  cells.forEach((content, k) => {
    const cell = document.createElement(k === 0 ? "th" : "td");
    if (k === 0) cell.scope = "row";
    cell.append(content);
    row.append(cell);
  });
  return row;
}

function drawn(name, attributes, words = "") {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = words;
  return element;
}

// Round numbers from 0 to the first that is at least the greatest value.
function ticks(greatest) {
  const power = 10 ** Math.floor(Math.log10(greatest));
  const part = [0.2, 0.5, 1, 2].find((p) => greatest / (p * power) <= 6) * power;
  const count = Math.ceil(greatest / part);
  return Array.from({ length: count + 1 }, (_, k) => Number((k * part).toPrecision(6)));
}
