// Pictures that zoom, flip at the same place, and tell the value under the pointer.

const MISSING_LEVEL = 65535;
const MISSING_COLOUR = [136, 64, 120];
const ERROR_STOPS = [[33, 102, 172], [120, 178, 213], [255, 255, 255], [242, 150, 110], [178, 24, 43]];
const LARGEST_CELL = 64; // pixels, zoomed in

/** The levels of a channel, which pack_levels (packed_levels.cpp) packed. */
async function unpackLevels(text, columns, rows) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const levels = new Uint16Array(columns * rows);
  for (let row = 0, i = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column, ++i) {
      const folded = bytes[i] | (bytes[levels.length + i] << 8);
      const difference = folded & 1 ? -(folded + 1) / 2 : folded / 2;
      const left = column > 0 ? levels[i - 1] : levels[i - columns];
      const upper = row > 0 ? levels[i - columns] : levels[i - 1];
      levels[i] = (i > 0 ? (left + upper) >> 1 : 0) + difference;
    }
  }
  return levels;
}

/** A picture whose levels are unpacked: value(channel, cell) is NaN where there is none. */
async function openPicture(picture) {
  const levels = [];
  for (const channel of picture.channels) {
    levels.push(await unpackLevels(channel.data, picture.columns, picture.rows));
    channel.data = null;
  }
  const scale = 10 ** Math.abs(picture.decimals);
  picture.value = (channel, cell) => {
    const level = levels[channel][cell];
    if (level === MISSING_LEVEL) return NaN;
    const whole = picture.channels[channel].base + level;
    return picture.decimals < 0 ? whole * scale : whole / scale;
  };
  return picture;
}

/** Finite values of a picture, sorted; of a sample where there are many. */
function sortedValues(count, valueOf) {
  const step = Math.max(1, Math.floor(count / 200000));
  const values = [];
  for (let cell = 0; cell < count; cell += step) {
    const value = valueOf(cell);
    if (!Number.isNaN(value)) values.push(value);
  }
  return values.sort((a, b) => a - b);
}

function extentOf(picture) {
  let [low, high] = [Infinity, -Infinity];
  for (let channel = 0; channel < picture.channels.length; ++channel) {
    for (let cell = 0; cell < picture.columns * picture.rows; ++cell) {
      const value = picture.value(channel, cell);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

/** What 99 % of the differences do not pass, rounded up to a digit. */
function errorReach(pictures, differenceOf) {
  let reach = 0;
  for (const picture of pictures) {
    const sizes = sortedValues(picture.columns * picture.rows, (cell) => Math.abs(differenceOf(picture, cell)));
    if (sizes.length > 0) reach = Math.max(reach, sizes[Math.floor(0.99 * (sizes.length - 1))]);
  }
  if (reach === 0) return 1e-6;
  const digit = 10 ** Math.floor(Math.log10(reach));
  return Math.ceil(reach / digit) * digit;
}

function encodeSrgb(linear) {
  const x = clamp(linear, 0, 1);
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

class PictureGroup {
  constructor(section, group) {
    this.section = section;
    this.pictures = group.pictures;
    this.group = group;
    this.chosen = 0;
    this.former = 0;
    this.showsError = false;
    this.ownScale = false;
    this.cell = null; // of the read-out: [column, row]
    this.drawn = new Map();
    this.pointers = new Map();
    this.build();
    this.fit();
    new ResizeObserver(() => this.fit()).observe(this.stage);
  }

  get picture() {
    return this.pictures[this.chosen];
  }
  get reference() {
    return this.group.reference === null ? null : this.pictures[this.group.reference];
  }

  /** Whether the chosen picture is shown as what it differs by from the reference. */
  get differs() {
    return this.showsError && this.reference !== null && this.picture !== this.reference;
  }

  differenceOf(picture, cell) {
    return picture.value(0, cell) - this.reference.value(0, cell);
  }

  build() {
    const { group, section } = this;
    this.tabs = this.pictures.map((picture, i) =>
      make("button", { role: "tab", type: "button", click: () => this.choose(i) },
        i < 9 ? `${i + 1} ` : "", picture.name));
    const tablist = make("div", { role: "tablist", "aria-label": group.title,
      keydown: (event) => this.flipByKey(event, true) }, ...this.tabs);
    this.canvas = make("canvas", { tabindex: 0, role: "img" });
    this.stage = make("div", { class: "stage", role: "tabpanel" }, this.canvas);
    this.readout = make("output", { class: "readout" });
    this.scaleBar = make("canvas", { width: 256, height: 1, "aria-hidden": "true" });
    this.scaleLow = make("span");
    this.scaleHigh = make("span");
    this.scaleText = make("span");
    this.missing = make("span", { class: "missing" }, "missing");
    this.about = make("p", { class: "about" });
    section.append(
      make("h2", {}, group.title), make("p", {}, group.about), tablist, this.buildControls(), this.stage,
      this.readout,
      make("div", { class: "scale" }, this.scaleLow, this.scaleBar, this.scaleHigh, this.scaleText,
        this.missing),
      this.about);
    if (section === document.querySelector("section.pictures")) section.append(this.buildKeys());
    this.listen();
  }

  buildKeys() {
    return make("p", { class: "keys" }, "Keys: 1 … 9 and ← → flip, space goes back to the picture before, + − 0 zoom, " +
      "Shift with arrows moves the place that is read. Drag to move; click into the picture, then scroll to zoom; " +
      "pinch on a phone.");
  }

  buildControls() {
    const controls = make("div", { class: "controls" });
    const choice = (texts, choose) => {
      const buttons = texts.map((text, i) => make("button", { type: "button", "aria-pressed": String(i === 0),
        click: () => {
          buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(k === i)));
          choose(i === 1);
          this.draw();
        } }, text));
      controls.append(make("span", {}, ...buttons));
    };
    if (this.reference && this.pictures.length > 1) {
      choice(["Values", `Error against ${this.reference.name}`], (second) => { this.showsError = second; });
    }
    choice(["Same scale for all", "Full contrast"], (second) => { this.ownScale = second; });
    const zoom = (text, label, act) =>
      make("button", { type: "button", "aria-label": label, click: act }, text);
    controls.append(make("span", {}, zoom("−", "zoom out", () => this.zoom(0.5)),
      zoom("+", "zoom in", () => this.zoom(2)), zoom("Whole map", "show the whole map", () => this.fit())));
    return controls;
  }

  listen() {
    const at = (event) => {
      const box = this.canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      this.pointers.set(event.pointerId, at(event));
      this.canvas.setPointerCapture(event.pointerId);
      this.read(...at(event));
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (this.pointers.has(event.pointerId)) this.drag(event.pointerId, at(event));
      else this.read(...at(event));
    });
    for (const end of ["pointerup", "pointercancel"]) {
      this.canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    this.canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== this.canvas) return; // the page scrolls
      event.preventDefault();
      this.zoom(2 ** (-event.deltaY / 300), ...at(event));
    }, { passive: false });
    this.canvas.addEventListener("keydown", (event) => this.press(event));
  }

  /** One pointer moves the picture, two zoom it. */
  drag(id, place) {
    const before = [...this.pointers.values()];
    const old = this.pointers.get(id);
    this.pointers.set(id, place);
    if (before.length === 2) {
      const after = [...this.pointers.values()];
      const apart = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
      this.zoom(apart(after) / Math.max(1, apart(before)), ...place);
      return;
    }
    this.view.x -= (place[0] - old[0]) / this.view.scale;
    this.view.y -= (place[1] - old[1]) / this.view.scale;
    this.keepInside();
    this.read(...place);
    this.draw();
  }

  press(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const zooms = { "+": 2, "=": 2, "-": 0.5 };
    if (event.shiftKey && event.key in steps) this.step(...steps[event.key]);
    else if (event.key in zooms) this.zoom(zooms[event.key]);
    else if (event.key === "0") this.fit();
    else if (event.key === " ") this.choose(this.former);
    else return this.flipByKey(event, false);
    event.preventDefault();
  }

  flipByKey(event, takesFocus) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const last = this.pictures.length - 1;
    const places = { ArrowRight: this.chosen < last ? this.chosen + 1 : 0,
      ArrowLeft: this.chosen > 0 ? this.chosen - 1 : last, Home: 0, End: last };
    const place = /^[1-9]$/.test(event.key) ? Number(event.key) - 1 : places[event.key];
    if (place === undefined || place > last) return;
    event.preventDefault();
    this.choose(place);
    if (takesFocus) this.tabs[place].focus();
  }

  choose(place) {
    if (place !== this.chosen) this.former = this.chosen;
    this.chosen = place;
    this.draw();
  }

  /** Moves the read-out by cells, and the picture where it would leave it. */
  step(columns, rows) {
    const { picture, view } = this;
    const [column, row] = this.cell ?? [Math.floor(picture.columns / 2), Math.floor(picture.rows / 2)];
    this.cell = [clamp(column + columns, 0, picture.columns - 1), clamp(row + rows, 0, picture.rows - 1)];
    const [x, y] = this.cell.map((at) => at * picture.side);
    view.x = clamp(view.x, x + picture.side - this.width / view.scale, x);
    view.y = clamp(view.y, y + picture.side - this.height / view.scale, y);
    this.keepInside();
    this.draw();
  }

  /** The whole map, as large as there is room for. */
  fit() {
    const { picture } = this;
    this.width = this.stage.clientWidth;
    this.height = clamp(this.width * picture.height / picture.width, 120, 0.75 * Math.max(400, innerHeight));
    this.least = Math.min(this.width / picture.width, this.height / picture.height);
    this.view = { scale: this.least, x: 0, y: 0 };
    this.canvas.style.height = `${this.height}px`;
    this.canvas.width = Math.round(this.width * devicePixelRatio);
    this.canvas.height = Math.round(this.height * devicePixelRatio);
    this.keepInside();
    this.draw();
  }

  /** About a place of the canvas; its middle where none is given. */
  zoom(times, x = this.width / 2, y = this.height / 2) {
    const { view } = this;
    const scale = clamp(view.scale * times, this.least, Math.max(this.least, LARGEST_CELL / this.picture.side));
    view.x += x / view.scale - x / scale;
    view.y += y / view.scale - y / scale;
    view.scale = scale;
    this.keepInside();
    this.draw();
  }

  keepInside() {
    const { view, picture } = this;
    for (const [axis, extent, room] of [["x", picture.width, this.width], ["y", picture.height, this.height]]) {
      const spare = extent - room / view.scale;
      view[axis] = spare < 0 ? spare / 2 : clamp(view[axis], 0, spare);
    }
    this.canvas.style.touchAction = view.scale > this.least ? "none" : "pan-y";
  }

  /** Reads what is at a place of the canvas. */
  read(x, y) {
    const { picture, view } = this;
    const column = Math.floor((view.x + x / view.scale) / picture.side);
    const row = Math.floor((view.y + y / view.scale) / picture.side);
    const inside = column >= 0 && row >= 0 && column < picture.columns && row < picture.rows;
    if (inside) this.cell = [column, row];
    this.draw();
  }

  /** What colours mean: the least and the greatest value that they tell apart. */
  range() {
    const { picture, pictures } = this;
    if (this.differs) {
      const others = this.ownScale ? [picture] : pictures.filter((other) => other !== this.reference);
      const reach = errorReach(others, (other, cell) => this.differenceOf(other, cell));
      return [-reach, reach];
    }
    if (picture.kind === "direction") return [-1, 1];
    const alike = this.ownScale ? [picture] :
      pictures.filter((other) => other.kind === picture.kind && other.unit === picture.unit);
    const extents = alike.map((other) => other.extent ??= extentOf(other));
    const low = Math.min(...extents.map((extent) => extent[0]));
    const high = Math.max(...extents.map((extent) => extent[1]));
    if (picture.kind === "error") {
      const reach = errorReach(alike, (other, cell) => other.value(0, cell));
      return [-reach, reach];
    }
    if (picture.kind === "light" && !this.ownScale) return [0, Math.max(1, high)];
    return high > low ? [low, high] : [low, low + 1];
  }

  /** The colour of a value of each channel. */
  colourOf(values, [low, high]) {
    if (values.some(Number.isNaN)) return MISSING_COLOUR;
    const shares = values.map((value) => (value - low) / (high - low));
    if (this.differs || this.picture.kind === "error") return blend(ERROR_STOPS, shares[0]);
    const encode = this.picture.kind === "light" ? encodeSrgb : (share) => Math.round(255 * clamp(share, 0, 1));
    const levels = shares.map(encode);
    return levels.length === 3 ? levels : [levels[0], levels[0], levels[0]];
  }

  valuesAt(cell) {
    if (this.differs) return [this.differenceOf(this.picture, cell)];
    return this.picture.channels.map((_, channel) => this.picture.value(channel, cell));
  }

  /** The picture as it is chosen, a pixel for each cell, with its range. */
  coloured() {
    const key = `${this.chosen} ${this.differs} ${this.ownScale}`;
    const { picture } = this;
    if (!this.drawn.has(key)) {
      if (this.drawn.size > 12) this.drawn.clear();
      const range = this.range();
      let missing = false;
      const canvas = make("canvas", { width: picture.columns, height: picture.rows });
      const context = canvas.getContext("2d");
      const image = context.createImageData(picture.columns, picture.rows);
      for (let cell = 0; cell < picture.columns * picture.rows; ++cell) {
        const values = this.valuesAt(cell);
        missing ||= values.some(Number.isNaN);
        image.data.set(this.colourOf(values, range), 4 * cell);
        image.data[4 * cell + 3] = 255;
      }
      context.putImageData(image, 0, 0);
      this.drawn.set(key, { canvas, range, missing });
    }
    return this.drawn.get(key);
  }

  draw() {
    const { picture, view } = this;
    const { canvas, range, missing } = this.coloured();
    this.missing.hidden = !missing;
    const context = this.canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.save();
    context.beginPath();
    context.rect(-view.x * view.scale, -view.y * view.scale, picture.width * view.scale, picture.height * view.scale);
    context.clip();
    context.imageSmoothingEnabled = view.scale * picture.side < 1;
    context.drawImage(canvas, -view.x * view.scale, -view.y * view.scale,
      picture.columns * picture.side * view.scale, picture.rows * picture.side * view.scale);
    context.restore();
    this.drawPlace(context);
    this.tell(range);
  }

  /** Marks the cell that is read. */
  drawPlace(context) {
    if (!this.cell) return;
    const { view } = this;
    const side = this.picture.side * view.scale;
    const [x, y] = this.cell.map((at, axis) => at * side - (axis === 0 ? view.x : view.y) * view.scale);
    const margin = Math.max(0, (9 - side) / 2);
    for (const [width, colour] of [[3, "#000000"], [1, "#ffffff"]]) {
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.strokeRect(x - margin, y - margin, side + 2 * margin, side + 2 * margin);
    }
  }

  tell(range) {
    const { picture } = this;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === this.chosen));
      tab.tabIndex = i === this.chosen ? 0 : -1;
    });
    const name = this.differs ? `${picture.name} less ${this.reference.name}` : picture.name;
    this.canvas.setAttribute("aria-label", `${this.group.title}: ${name}`);
    const [low, high] = range.map((value) => inDigits(value, 3));
    this.scaleLow.textContent = this.differs || picture.kind === "error" ? `≤ ${low}` : low;
    this.scaleHigh.textContent = this.differs || picture.kind === "error" ? `≥ ${high}` : high;
    this.scaleText.textContent = picture.unit ? `${name}, ${picture.unit}` : name;
    this.drawScale(range);
    const cells = picture.side === 1 ? "a pixel for each texel" : picture.picked ?
      `every ${picture.side}th texel of every ${picture.side}th row` :
      `shrunk: each pixel is the mean of ${picture.side} × ${picture.side} texels`;
    const step = picture.decimals < 0 ? 10 ** -picture.decimals : (10 ** -picture.decimals).toFixed(picture.decimals);
    this.about.textContent = `${picture.about} ${picture.width} × ${picture.height} texels; ${cells}; values rounded ` +
      `to ${step}.${picture.file ? ` In full: ${picture.file}.` : ""}`;
    this.tellPlace();
  }

  drawScale(range) {
    const context = this.scaleBar.getContext("2d");
    const channels = this.picture.channels.length;
    for (let x = 0; x < 256; ++x) {
      const value = range[0] + (range[1] - range[0]) * x / 255;
      const values = Array(this.differs ? 1 : channels).fill(value);
      context.fillStyle = `rgb(${this.colourOf(values, range).join()})`;
      context.fillRect(x, 0, 1, 1);
    }
  }

  tellPlace() {
    const { picture, readout } = this;
    if (!this.cell) {
      readout.textContent = "Point at the picture to read its values.";
      return;
    }
    const [column, row] = this.cell;
    const cell = row * picture.columns + column;
    const places = [column, row].map((at, axis) => {
      const first = at * picture.side;
      const last = Math.min(first + picture.side, axis === 0 ? picture.width : picture.height) - 1;
      return picture.picked || first === last ? String(first) : `${first}–${last}`;
    });
    const text = (of, value) => Number.isNaN(value) ? "missing" : value.toFixed(Math.max(0, of.decimals));
    const values = picture.channels.map((channel, c) =>
      (picture.channels.length > 1 ? `${channel.name} ` : "") + text(picture, picture.value(c, cell)));
    const lines = [`column ${places[0]}, row ${places[1]} from the upper left corner`,
      `${picture.name}: ${values.join(", ")}${picture.unit ? ` ${picture.unit}` : ""}`];
    if (this.reference && picture !== this.reference) {
      const difference = this.differenceOf(picture, cell);
      lines[1] += `; ${this.reference.name}: ${text(this.reference, this.reference.value(0, cell))}; error ` +
        `${difference > 0 ? "+" : ""}${text(picture, difference)}`;
    }
    readout.textContent = lines.join("\n");
    Object.assign(readout.dataset, { column, row, value: picture.channels.map((_, c) => picture.value(c, cell)).join() });
  }
}

async function showPictures(section) {
  const group = takeData(section);
  if (typeof DecompressionStream === "undefined") {
    section.append(make("h2", {}, group.title),
      make("p", { class: "warning" }, "This browser is too old to unpack pictures."));
    return;
  }
  for (const picture of group.pictures) await openPicture(picture);
  new PictureGroup(section, group);
}
