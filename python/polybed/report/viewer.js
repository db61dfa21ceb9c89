"use strict";
// Draws what a page of a run holds: maps and particles with a slider over the stored times, profiles beside them, the history.
(() => {
  const COLOURS = {  // 17 points of viridis, cividis and RdBu, between which colours are linear
    solids: "44015448186a472d7b4240863b528b33638d2c728e26828e21918c1fa08828ae803fbc735ec96284d44baddc30d8e219fde725",
    fluid: "00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838",
    signed: "0530611752902a71b23f8ec06bacd19bc9e0c2ddece0ecf3f7f6f6fbe5d8fbccb4f5aa89e48066d05548ba2832930e2667001f",
  };
  const NOTHING = [238, 238, 238], PIXELS = window.devicePixelRatio || 1;
  const make = (kind, into, text = "", looks = "") => { const e = document.createElement(kind); e.textContent = text; e.className = looks; into.append(e); return e; };

  function colourTable(name) {
    const points = COLOURS[name].match(/.{6}/g).map(p => [0, 2, 4].map(n => parseInt(p.substr(n, 2), 16)));
    return Array.from({ length: 255 }, (_, level) => {
      const at = level / 254 * 16, n = Math.min(15, Math.floor(at)), share = at - n;
      return points[n].map((c, k) => Math.round(c + (points[n + 1][k] - c) * share));
    });
  }

  /** The bytes of a text from the page: base64 of zlib. */
  async function unpacked(text) {
    const packed = new Blob([Uint8Array.from(atob(text), c => c.charCodeAt(0))]);
    return new Uint8Array(await new Response(packed.stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
  }

  /** Puts the bytes in place of every packed text. */
  async function unpack({ maps, profiles, particles }) {
    const texts = maps ? maps.maps.map(map => [map, "levels"]) : [];
    if (profiles) texts.push(...profiles.charts.flatMap(chart => chart.lines.map(line => [line, "y"])));
    if (particles) texts.push(...["places", "speeds", "species", "radius"].map(name => [particles, name]));
    await Promise.all(texts.map(async ([part, name]) => { part[name] = await unpacked(part[name]); }));
  }

  function nearest(times, time) {
    let best = 0;
    times.forEach((t, n) => { if (Math.abs(t - time) < Math.abs(times[best] - time)) best = n; });
    return best;
  }

  /** A canvas of a size in pixels of the page, sharp on every screen; returns its context. */
  function canvas(into, width, height) {
    const element = make("canvas", into);
    element.width = width * PIXELS; element.height = height * PIXELS;
    element.style.width = width + "px";
    const to = element.getContext("2d");
    to.scale(PIXELS, PIXELS);
    to.font = "11px sans-serif";
    return to;
  }

  /** A figure with its title and a canvas; returns both, the canvas as its context. */
  function framed(into, title, width, height) {
    const figure = make("div", into, "", "figure");
    make("div", figure, title);
    return [figure, canvas(figure, width, height)];
  }

  const shown = value => String(Number(value.toPrecision(3)));

  function ticks(low, high, most) {
    const rough = (high - low) / most, size = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find(s => s * size >= rough) * size, found = [];
    for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * (high - low); ++n) found.push(n * step);
    return found;
  }

  /** Axes and curves. chart: {lines: [{x, y, colour, dash}], x: [low, high], y: [low, high], across, up, mark} */
  function drawChart(to, width, height, chart) {
    const left = 52, right = 10, top = 8, bottom = 34;
    const px = x => left + (x - chart.x[0]) / (chart.x[1] - chart.x[0] || 1) * (width - left - right);
    const py = y => height - bottom - (y - chart.y[0]) / (chart.y[1] - chart.y[0] || 1) * (height - top - bottom);
    to.clearRect(0, 0, width, height);
    to.strokeStyle = "#222"; to.fillStyle = "#222"; to.lineWidth = 1; to.setLineDash([]);
    to.beginPath(); to.moveTo(left, top); to.lineTo(left, height - bottom); to.lineTo(width - right, height - bottom); to.stroke();
    to.textAlign = "center";
    for (const x of ticks(...chart.x, Math.max(2, width / 90))) { to.fillText(shown(x), px(x), height - bottom + 14); to.fillRect(px(x), height - bottom, 1, 4); }
    to.fillText(chart.across, (left + width - right) / 2, height - 4);
    to.textAlign = "right";
    for (const y of ticks(...chart.y, Math.max(2, height / 60))) { to.fillText(shown(y), left - 6, py(y) + 4); to.fillRect(left - 4, py(y), 4, 1); }
    if (chart.up) { to.save(); to.translate(11, (height - bottom) / 2); to.rotate(-Math.PI / 2); to.textAlign = "center"; to.fillText(chart.up, 0, 0); to.restore(); }
    to.save(); to.beginPath(); to.rect(left, top, width - left - right, height - top - bottom); to.clip();
    if (chart.mark !== undefined) { to.strokeStyle = "#aaa"; to.beginPath(); to.moveTo(px(chart.mark), top); to.lineTo(px(chart.mark), height); to.stroke(); }
    for (const line of chart.lines) {
      to.strokeStyle = line.colour; to.lineWidth = 1.6; to.setLineDash(line.dash); to.beginPath();
      let pen = false;
      line.x.forEach((x, n) => {
        const y = line.y[n];
        if (x === null || y === null) { pen = false; return; }
        if (pen) to.lineTo(px(x), py(y)); else to.moveTo(px(x), py(y));
        pen = true;
      });
      to.stroke();
    }
    to.restore(); to.setLineDash([]);
  }

  function drawKey(into, lines) {
    const key = make("div", into, "", "key");
    for (const line of lines) {
      const entry = make("span", key), mark = make("i", entry);
      mark.style.borderColor = line.colour;
      if (line.dash.length) mark.style.borderTopStyle = line.dash[0] > 3 ? "dashed" : "dotted";
      make("b", entry, line.label).style.fontWeight = "normal";
    }
  }

  function rangeOf(lines, zero) {
    const all = lines.flatMap(l => l.y).filter(v => v !== null);
    let low = all.reduce((a, b) => Math.min(a, b), Infinity), high = all.reduce((a, b) => Math.max(a, b), -Infinity);
    if (!all.length) return [0, 1];
    if (zero) { low = Math.min(0, low); high = Math.max(0, high); }
    const margin = 0.05 * (high - low || Math.abs(high) || 1);
    return [zero && low === 0 ? 0 : low - margin, high + margin];
  }

  /** Adds the panels of the history; returns what moves their marks to a time. */
  function showHistory(into, panels, end) {
    const drawn = panels.map(panel => {
      const width = 490, height = 190, [figure, to] = framed(into, panel.title, width, height);
      drawKey(figure, panel.lines);
      if (panel.note) make("div", figure, panel.note, "source");
      const chart = { lines: panel.lines, x: [panel.lines[0].x[0], Math.max(end, panel.lines[0].x[0] + 1e-9)], y: rangeOf(panel.lines, panel.zero), across: "time (s)" };
      return time => drawChart(to, width, height, { ...chart, mark: time });
    });
    return time => drawn.forEach(draw => draw(time));
  }

  /** Adds the maps; returns {time, draw(step, kind), kinds}. */
  function showMaps(into, maps, unit, height) {
    const width = Math.min(330, Math.max(46, height * maps.size[0] / maps.size[1])), tall = Math.min(height, width * maps.size[1] / maps.size[0]);
    const cells = maps.nx * maps.ny, plane = document.createElement("canvas");
    plane.width = maps.nx; plane.height = maps.ny;
    const paint = plane.getContext("2d"), image = paint.createImageData(maps.nx, maps.ny);
    for (const map of maps.maps) {
      const level = map.levels, table = colourTable(map.colours), [figure, to] = framed(into, map.label, width + 34, tall + 62);
      const scale = make("div", figure, map.scale, "source");
      map.figure = figure;
      scale.style.width = `${width + 34}px`;  // wrapped below a narrow map
      map.draw = step => {
        for (let n = 0; n < cells; ++n) {
          const row = maps.ny - 1 - Math.floor(n / maps.nx), value = level[step * cells + n];
          const colour = value === maps.empty ? NOTHING : table[value], at = 4 * (row * maps.nx + n % maps.nx);
          image.data[at] = colour[0]; image.data[at + 1] = colour[1]; image.data[at + 2] = colour[2]; image.data[at + 3] = 255;
        }
        paint.putImageData(image, 0, 0);
        to.clearRect(0, 0, width + 34, tall + 62);
        to.imageSmoothingEnabled = false;
        to.drawImage(plane, 30, 4, width, tall);
        to.strokeStyle = "#222"; to.lineWidth = 1; to.strokeRect(30, 4, width, tall);
        to.fillStyle = "#222"; to.textAlign = "right";
        for (const y of ticks(0, maps.size[1], 6)) to.fillText(shown(y), 27, 8 + tall * (1 - y / maps.size[1]));
        for (let n = 0; n < 255; ++n) { to.fillStyle = `rgb(${table[n]})`; to.fillRect(30 + n / 255 * width, tall + 22, width / 255 + 0.7, 8); }
        to.fillStyle = "#222";
        to.textAlign = "left"; to.fillText(shown(map.low), 24, tall + 43);
        to.textAlign = "right"; to.fillText(shown(map.high), 34 + width, tall + 43);
        to.textAlign = "center"; to.fillText(unit, 30 + width / 2, tall + 17);
      };
    }
    const kinds = [...new Set(maps.maps.map(m => m.kind))];
    return { time: maps.time, draw(step, chosen) {
      for (const map of maps.maps) { map.figure.style.display = chosen.includes(map.kind) ? "" : "none"; if (chosen.includes(map.kind)) map.draw(step); }
    }, kinds };
  }

  /** Adds the profiles; returns {time, draw(step)}. */
  function showProfiles(into, profiles, unit, height, top) {
    const draws = [];
    for (const chart of profiles.charts) {
      const width = 300, rows = profiles.y.length, [figure, to] = framed(into, `lateral mean: ${chart.title}`, width, height + 40);
      drawKey(figure, chart.lines);
      for (const line of chart.lines) line.levels = new Uint16Array(line.y.buffer);
      draws.push(step => drawChart(to, width, height + 40, { x: [chart.low, chart.high], y: [0, top], across: "", up: `height (${unit})`,
        lines: chart.lines.map(line => {
          const found = Array.from(line.levels.subarray(step * rows, (step + 1) * rows), v => v === 65535 ? null : chart.low + v / 65534 * (chart.high - chart.low));
          return { colour: line.colour, dash: line.dash, x: found, y: profiles.y };
        }) }));
    }
    return { time: profiles.time, draw: step => draws.forEach(d => d(step)) };
  }

  function ball(colour) {
    const size = 64, element = document.createElement("canvas");
    element.width = element.height = size;
    const to = element.getContext("2d"), light = to.createRadialGradient(size * 0.36, size * 0.32, 2, size / 2, size / 2, size / 2);
    light.addColorStop(0, "#ffffff"); light.addColorStop(0.35, colour); light.addColorStop(1, "#00000066");
    to.beginPath(); to.arc(size / 2, size / 2, size / 2, 0, 7);
    to.fillStyle = colour; to.fill();
    to.globalAlpha = 0.55; to.fillStyle = light; to.fill();
    return element;
  }

  const MOVING = 20000;  // particles drawn while the view turns

  /** Adds the particles, in a view that can be turned; returns {time, draw(step), by}. */
  function showParticles(into, all, unit) {
    const { places: packed, speeds, species, count } = all, radius = new Float32Array(all.radius.buffer);
    const steps = all.time.length, numbers = count * 3, total = steps * numbers;
    const places = new Uint16Array(total);
    for (let n = 0; n < total; ++n) places[n] = packed[n] + 256 * packed[total + n] + (n >= numbers ? places[n - numbers] : 0);
    const size = 460, told = "particles: drag to turn, wheel to come nearer, double click to reset";
    const [figure, to] = framed(into, told, size, size), element = to.canvas;
    element.id = "particles"; element.tabIndex = 0;
    const key = all.names.map((label, n) => ({ label, colour: all.colours[n], dash: [] })), keys = make("div", figure);
    const bySpecies = all.colours.map(ball), bySpeed = colourTable("solids").filter((_, n) => n % 8 === 0).map(c => ball(`rgb(${c})`));
    const start = { yaw: 0.5, pitch: 0.25, zoom: 1 }, view = { ...start, by: "species", step: 0 };
    const span = all.high.map((h, k) => h - all.low[k]);

    function draw(most = Infinity) {
      // y is up; the box turns about its middle
      const [cy, sy, cp, sp] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
      const scale = view.zoom * 0.92 * size / Math.hypot(...all.size), base = view.step * numbers;
      const project = (x, y, z) => {
        const [a, b, c] = [x - all.size[0] / 2, y - all.size[1] / 2, z - all.size[2] / 2];
        const across = cy * a + sy * c, into = -sy * a + cy * c;
        return [size / 2 + scale * across, size / 2 - scale * (cp * b - sp * into), cp * into + sp * b];
      };
      const trace = points => { to.beginPath(); for (const point of points) to.lineTo(...project(...point).slice(0, 2)); };
      to.clearRect(0, 0, size, size);
      to.strokeStyle = "#bbb";
      for (let k = 0; k < 3; ++k) for (let n = 0; n < 4; ++n) {
        trace([0, 1].map(end => all.size.map((length, axis) => length * [end, n & 1, n >> 1][(axis - k + 3) % 3])));
        to.stroke();
      }
      const seen = [], stride = Math.max(1, Math.ceil(count / most));
      for (let n = 0; n < count; n += stride) {
        const at = base + 3 * n;
        if (places[at] === 65535) continue;
        const [x, y, deep] = project(...[0, 1, 2].map(k => all.low[k] + places[at + k] / 65534 * span[k]));
        seen.push([deep, x, y, n]);
      }
      seen.sort((a, b) => a[0] - b[0]);
      for (const [, x, y, n] of seen) {
        const r = radius[n] * scale, speed = speeds[view.step * count + n];
        const sprite = view.by === "species" ? bySpecies[species[n]] : bySpeed[Math.min(bySpeed.length - 1, speed >> 3)];
        to.drawImage(sprite, x - r, y - r, 2 * r, 2 * r);
      }
      to.strokeStyle = "#222"; to.lineWidth = 1.5; to.fillStyle = "#00000014";  // walls inside and the rim of an opening, seen through the particles
      for (const line of all.outlines) { trace(line); to.closePath(); to.fill(); to.stroke(); }
      to.font = "11px sans-serif"; to.textAlign = "left";
      for (const [label, colour, line] of all.ports) {
        to.strokeStyle = to.fillStyle = colour;
        trace(line); to.closePath(); to.stroke(); to.fillText(label, ...project(...line[0]).slice(0, 2));
      }
      to.lineWidth = 1;
      element.dataset.drawn = seen.length; element.dataset.outlines = all.outlines.length;
    }

    let held = null;
    element.addEventListener("pointerdown", e => { held = [e.clientX, e.clientY]; element.setPointerCapture(e.pointerId); });
    element.addEventListener("pointermove", e => {
      if (!held) return;
      view.yaw += (e.clientX - held[0]) / 120; view.pitch = Math.max(-1.57, Math.min(1.57, view.pitch + (e.clientY - held[1]) / 120));
      held = [e.clientX, e.clientY];
      draw(MOVING);
    });
    element.addEventListener("pointerup", () => { held = null; draw(); });
    element.addEventListener("dblclick", () => { Object.assign(view, start); draw(); });
    element.addEventListener("wheel", e => { e.preventDefault(); view.zoom = Math.max(0.2, Math.min(20, view.zoom * Math.exp(-e.deltaY / 500))); draw(); }, { passive: false });
    element.addEventListener("keydown", e => {
      const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[e.key];
      if (!turn) return;
      e.preventDefault(); view.yaw += turn[0]; view.pitch += turn[1]; draw();
    });
    function by(name) {
      view.by = name;
      keys.replaceChildren();
      if (name === "species") drawKey(keys, key);
      else make("div", keys, `speed: dark 0, bright ${all.fastest} and more`, "key");
      draw();
    }
    by("species");
    return { time: all.time, draw(step) { view.step = step; draw(); }, by };
  }

  function choice(into, id, name, options, chosen, act) {
    const select = make("select", make("label", into, name + " "));
    for (const [value, text] of options) make("option", select, text).value = value;
    select.id = id; select.value = chosen;
    select.addEventListener("change", () => act(select.value));
  }

  let showing = 0;  // drawings so far

  /** Draws all; where: {time, end, kind, by} keeps what the reader has chosen when the page renews itself. */
  async function show(data, where = { end: true }) {
    await unpack(data);
    const bed = document.createElement("div"), height = 400;
    const controls = make("div", bed, "", "row controls"), views = make("div", bed, "", "row"), rows = make("div", bed, "", "row");
    const maps = data.maps && showMaps(views, data.maps, data.unit, height);
    const particles = data.particles && showParticles(views, data.particles, data.unit);
    const top = data.maps ? data.maps.size[1] : data.particles ? data.particles.size[1] : data.profiles ? data.profiles.y.at(-1) : 1;
    const profiles = data.profiles && showProfiles(rows, data.profiles, data.unit, 300, top);
    const history = document.getElementById("history-view"), panels = document.createElement("div");
    panels.className = "row";
    const mark = history && data.history.length ? showHistory(panels, data.history, data.history[0].lines[0].x.at(-1)) : () => {};
    const times = (particles || maps || profiles || { time: [] }).time;
    const slider = make("input", controls), label = make("output", controls);
    let kind = where.kind || "solids";
    function draw() {
      const time = times[slider.value] ?? 0;
      label.textContent = `t = ${time} s`;
      if (maps) maps.draw(nearest(maps.time, time), kind === "solids" ? ["solids", "voidage"] : [kind]);
      if (particles) particles.draw(nearest(particles.time, time));
      if (profiles) profiles.draw(nearest(profiles.time, time));
      mark(times.length ? time : undefined);
      Object.assign(where, { time, end: Number(slider.value) === times.length - 1, kind });
    }
    slider.type = "range"; slider.id = "slider"; slider.min = 0; slider.max = Math.max(0, times.length - 1);
    slider.setAttribute("aria-label", "stored time");
    slider.value = nearest(times, where.end ? particles ? data.particles.open : times.at(-1) : where.time);
    slider.addEventListener("input", draw);
    const play = make("button", controls, "play");
    play.id = "play";
    controls.prepend(play);
    let timer = null;
    play.addEventListener("click", () => {
      play.textContent = timer ? "play" : "stop";
      if (timer) { clearInterval(timer); timer = null; return; }
      timer = setInterval(() => {
        if (!slider.isConnected) { clearInterval(timer); return; }
        slider.value = (Number(slider.value) + 1) % times.length; draw();
      }, Math.max(40, 8000 / times.length));
    });
    if (maps && maps.kinds.includes("velocity")) {
      const options = [["solids", "solids fraction and voidage"], ["velocity", "upward velocity"]];
      choice(controls, "kind", "show", options, kind, value => { kind = value; draw(); });
    }
    if (particles) {
      const by = where.by || "species";
      choice(controls, "by", "colour by", [["species", "species"], ["speed", "speed"]], by, value => { where.by = value; particles.by(value); });
      particles.by(by);
    }
    for (const part of [data.maps, data.particles]) if (part && part.note) make("p", bed, part.note, "source");
    if (times.length < 2) controls.style.display = "none";
    document.getElementById("bed-view")?.replaceChildren(bed);
    history?.replaceChildren(panels);
    draw();
    document.body.dataset.shown = ++showing;
  }

  window.polybedShow = show;
  show(JSON.parse(document.getElementById("data").textContent));
})();
