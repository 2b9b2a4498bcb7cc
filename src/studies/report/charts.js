// Curves that can be switched off and on, and read.

const CURVE_COLOURS = ["#1b7fd1", "#e07b00", "#119a6c", "#d64550", "#a565c9", "#7c8a1c", "#c9589c", "#3aa6b9", "#8d6e54",
  "#7d8796"];
const DECADES = 4; // of logarithmic axes at most
const MARGIN = { left: 64, right: 12, top: 10, bottom: 42 };

/** Numbers that an axis is marked with. */
function findTicks(low, high, log) {
  const ticks = [];
  if (log) {
    const decades = Math.log10(high / low);
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
      for (const digit of decades > 3 ? [1] : [1, 2, 5]) ticks.push(digit * 10 ** power);
    }
  } else {
    const rough = (high - low) / 5;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((digit) => digit * power >= rough);
    for (let k = Math.ceil(low / step); k * step <= high; ++k) ticks.push(k * step);
  }
  return ticks.filter((tick) => tick >= low && tick <= high);
}

class Chart {
  constructor(section, chart) {
    this.chart = chart;
    this.curves = chart.curves;
    this.cursor = null; // where it is read: 0 … 1 of the axis; of dots: [curve, point]
    this.svg = makeSvg("svg", { tabindex: 0, role: "img", "aria-label": `${chart.title}: ${chart.y} over ${chart.x}` });
    this.readout = make("output", { class: "readout" });
    this.legend = make("div", { class: "legend" });
    this.values = this.curves.map(() => make("b"));
    this.buttons = this.curves.map((curve, i) => this.buildButton(curve, i));
    this.legend.append(...this.buttons);
    const controls = make("div", { class: "controls" });
    if (this.curves.length > 2) {
      controls.append(make("button", { type: "button", click: () => this.showAll(true) }, "All curves"),
        make("button", { type: "button", click: () => this.showAll(false) }, "None"));
    }
    section.append(make("h2", {}, chart.title), make("p", {}, chart.about), this.svg, this.readout, controls, this.legend);
    this.svg.addEventListener("pointermove", (event) => this.point(event));
    this.svg.addEventListener("pointerdown", (event) => this.point(event));
    this.svg.addEventListener("keydown", (event) => this.press(event));
    new ResizeObserver(() => this.draw()).observe(section);
  }

  colour(i) {
    const at = this.curves[i].colour ?? i;
    if (!this.chart.ordered) return CURVE_COLOURS[at % CURVE_COLOURS.length];
    const last = Math.max(1, ...this.curves.map((curve, k) => curve.colour ?? k));
    return `hsl(${265 - 225 * at / last} 65% 50%)`;
  }

  dashes(i) {
    const again = this.chart.ordered ? 0 : Math.floor(i / CURVE_COLOURS.length);
    return this.curves[i].dashed ? "7 4" : ["", "2 3", "9 3 2 3"][again % 3];
  }

  buildButton(curve, i) {
    const sample = makeSvg("svg", { viewBox: "0 0 26 10", "aria-hidden": "true" });
    sample.append(this.chart.dots ? makeSvg("circle", { cx: 13, cy: 5, r: 4, fill: this.colour(i) }) :
      makeSvg("line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: this.colour(i), "stroke-width": 3,
        "stroke-dasharray": this.dashes(i) }));
    return make("button", { type: "button", "aria-pressed": String(curve.shown), click: () => {
      curve.shown = !curve.shown;
      this.draw();
    } }, sample, curve.name, this.values[i]);
  }

  showAll(shown) {
    for (const curve of this.curves) curve.shown = shown;
    this.draw();
  }

  /** Extents of all curves, shown or not, so that switching them keeps the axes; what is too small for them is not drawn. */
  extents() {
    return this.found ??= ["x", "y"].map((axis) => {
      const log = this.chart[`log_${axis}`];
      const values = this.curves.flatMap((curve) => curve[axis].filter((value, i) =>
        value !== null && curve.y[i] !== null && (!log || value > 0)));
      let [low, high] = [Infinity, -Infinity];
      for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
      if (!(low <= high)) return [log ? 0.1 : 0, 1];
      if (log) return [Math.max(low / 1.2, high * 10 ** -DECADES), high * 1.2];
      if (low > 0 && low < 0.3 * high) low = 0;
      return high > low ? [low, high] : [low - 0.5, low + 0.5];
    });
  }

  /** From 0 to 1 along an axis. */
  share(axis, value) {
    const [low, high] = this.extents()[axis === "x" ? 0 : 1];
    if (!this.chart[`log_${axis}`]) return (value - low) / (high - low);
    return Math.log(value / low) / Math.log(high / low);
  }

  valueAt(share) {
    const [low, high] = this.extents()[0];
    return this.chart.log_x ? low * (high / low) ** share : low + share * (high - low);
  }

  placeX(x) {
    return MARGIN.left + this.share("x", x) * (this.width - MARGIN.left - MARGIN.right);
  }
  placeY(y) {
    return this.height - MARGIN.bottom - this.share("y", y) * (this.height - MARGIN.top - MARGIN.bottom);
  }

  draw() {
    this.width = Math.max(280, this.svg.parentElement.clientWidth);
    this.height = clamp(0.5 * this.width, 240, 460);
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.style.height = `${this.height}px`;
    this.svg.replaceChildren();
    this.drawAxes();
    this.curves.forEach((curve, i) => {
      this.buttons[i].setAttribute("aria-pressed", String(curve.shown));
      if (!curve.shown) return;
      if (this.chart.dots) this.drawDots(curve, i);
      else this.drawLine(curve, i);
    });
    this.drawCursor();
  }

  drawAxes() {
    const [x, y] = this.extents();
    const bottom = this.height - MARGIN.bottom;
    for (const tick of findTicks(...x, this.chart.log_x)) {
      const at = this.placeX(tick);
      this.svg.append(makeSvg("line", { class: "grid", x1: at, x2: at, y1: MARGIN.top, y2: bottom }),
        makeSvg("text", { x: at, y: bottom + 16, "text-anchor": "middle" }, inDigits(tick)));
    }
    for (const tick of findTicks(...y, this.chart.log_y)) {
      const at = this.placeY(tick);
      this.svg.append(makeSvg("line", { class: "grid", x1: MARGIN.left, x2: this.width - MARGIN.right, y1: at, y2: at }),
        makeSvg("text", { x: MARGIN.left - 6, y: at + 4, "text-anchor": "end" }, inDigits(tick)));
    }
    const middle = (MARGIN.top + bottom) / 2;
    this.svg.append(
      makeSvg("text", { x: (MARGIN.left + this.width - MARGIN.right) / 2, y: this.height - 6, "text-anchor": "middle" },
        this.chart.x),
      makeSvg("text", { x: 12, y: middle, "text-anchor": "middle", transform: `rotate(-90 12 ${middle})` },
        this.chart.y));
  }

  hasPlace(curve, i) {
    const [x, y] = this.extents();
    return curve.y[i] !== null && curve.x[i] >= x[0] && curve.y[i] >= y[0];
  }

  drawLine(curve, i) {
    let path = "";
    let pen = "M";
    for (let k = 0; k < curve.x.length; ++k) {
      if (!this.hasPlace(curve, k)) {
        pen = "M";
        continue;
      }
      path += `${pen}${this.placeX(curve.x[k]).toFixed(1)} ${this.placeY(curve.y[k]).toFixed(1)}`;
      pen = "L";
    }
    this.svg.append(makeSvg("path", { d: path, fill: "none", stroke: this.colour(i), "stroke-width": 2,
      "stroke-dasharray": this.dashes(i) }));
  }

  drawDots(curve, i) {
    for (let k = 0; k < curve.x.length; ++k) {
      if (!this.hasPlace(curve, k)) continue;
      this.svg.append(makeSvg("circle", { cx: this.placeX(curve.x[k]), cy: this.placeY(curve.y[k]), r: 4,
        fill: this.colour(i) }));
    }
  }

  point(event) {
    const box = this.svg.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    if (this.chart.dots) this.cursor = this.nearestDot(x, y);
    else this.cursor = clamp((x - MARGIN.left) / (this.width - MARGIN.left - MARGIN.right), 0, 1);
    this.draw();
  }

  dots() {
    return this.curves.flatMap((curve, i) => curve.shown ?
      curve.x.map((_, k) => [i, k]).filter(([, k]) => this.hasPlace(curve, k)) : []);
  }

  nearestDot(x, y) {
    const away = ([i, k]) => Math.hypot(this.placeX(this.curves[i].x[k]) - x, this.placeY(this.curves[i].y[k]) - y);
    return this.dots().reduce((best, dot) => best === null || away(dot) < away(best) ? dot : best, null);
  }

  press(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    if (this.chart.dots) {
      const dots = this.dots();
      const at = dots.findIndex((dot) => this.cursor && dot[0] === this.cursor[0] && dot[1] === this.cursor[1]);
      this.cursor = dots[(at + step + dots.length) % dots.length] ?? null;
    } else {
      this.cursor = clamp((this.cursor ?? 0.5) + step / 100, 0, 1);
    }
    this.draw();
  }

  /** A curve's y at x: between its points on a straight line; null where it has none. */
  readCurve(curve, x) {
    for (let k = 0; k + 1 < curve.x.length; ++k) {
      if (x < curve.x[k] || x > curve.x[k + 1] || !this.hasPlace(curve, k) || !this.hasPlace(curve, k + 1)) continue;
      const part = curve.x[k + 1] > curve.x[k] ? (x - curve.x[k]) / (curve.x[k + 1] - curve.x[k]) : 0;
      return curve.y[k] + part * (curve.y[k + 1] - curve.y[k]);
    }
    return null;
  }

  drawCursor() {
    this.values.forEach((value) => { value.textContent = ""; });
    if (this.cursor === null) {
      this.readout.textContent = this.chart.dots ? "Point at a dot to read it." : "Point at the curves to read them.";
    } else if (this.chart.dots) {
      this.drawDotCursor(...this.cursor);
    } else {
      this.drawLineCursor(this.valueAt(this.cursor));
    }
  }

  drawDotCursor(i, k) {
    const curve = this.curves[i];
    if (!curve.shown) return;
    this.svg.append(makeSvg("circle", { cx: this.placeX(curve.x[k]), cy: this.placeY(curve.y[k]), r: 8, fill: "none",
      stroke: this.colour(i), "stroke-width": 2 }));
    const label = curve.labels[k] ? ` (${curve.labels[k]})` : "";
    this.readout.textContent = `${curve.name}${label}\n${this.chart.x}: ${inDigits(curve.x[k])}; ${this.chart.y}: ` +
      inDigits(curve.y[k]);
  }

  drawLineCursor(x) {
    const at = this.placeX(x);
    this.svg.append(makeSvg("line", { class: "cursor", x1: at, x2: at, y1: MARGIN.top, y2: this.height - MARGIN.bottom }));
    this.readout.textContent = `${this.chart.x}: ${inDigits(x, 3)}`;
    this.curves.forEach((curve, i) => {
      const y = curve.shown ? this.readCurve(curve, x) : null;
      if (y === null) return;
      this.values[i].textContent = inDigits(y);
      this.svg.append(makeSvg("circle", { cx: at, cy: this.placeY(y), r: 3.5, fill: this.colour(i) }));
    });
  }
}
