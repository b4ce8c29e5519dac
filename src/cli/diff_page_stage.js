'use strict';
// How a pair is shown: slider, blink, side by side, the map; zoom; pixel values; regions.
const modes = ['slider', 'blink', 'side by side', 'difference', 'A', 'B'];
let stage = null, pair = null, mode = 'slider', split = 0.5, zoom = 1, fitted = true, blinkOn = false, timer = 0;
let boxes = true, faded = true, region = -1, exposure = 0, low = 0, high = 1;

function onStage() {
  const {a, b, map} = stage;
  const seen = map && faded ? stage.over ??= mapOver(map, a || b) : map;
  return (mode === 'side by side' ? [a, b, map] : mode === 'difference' ? [seen || a || b]
    : mode === 'A' ? [a] : mode === 'B' ? [b] : [a, b]).filter(c => c);
}
function nameOf(canvas) {
  return canvas === stage.a ? 'A, baseline' : canvas === stage.b ? 'B' : stage.map ? 'difference (FLIP)' : '';
}
function fit(canvases) {
  const view = $('view'), across = mode === 'side by side' ? canvases.length : 1;
  const room = Math.min((view.clientWidth - 8 * (across - 1)) / (across * Math.max(...canvases.map(c => c.width))),
    view.clientHeight / Math.max(...canvases.map(c => c.height)));
  zoom = room > 2 ? clamp(Math.floor(room), 2, 16) : Math.max(room, 0.01);
}
function drawStage() {
  clearInterval(timer);
  const view = $('view'), box = element('div'), canvases = onStage(), {a, b} = stage;
  box.id = 'stage';
  if (fitted && canvases.length) fit(canvases);
  canvases.forEach((c, i) => {
    c.className = mode !== 'side by side' && i > 0 ? 'over' : '';
    c.style.clipPath = c.style.visibility = '';
    c.style.width = c.width * zoom + 'px'; c.style.height = c.height * zoom + 'px';
    box.append(c);
  });
  if (!canvases.length) box.append(element('div', absence(mode), 'nothing'));
  $('size').textContent = canvases.length ? `${canvases[0].width} × ${canvases[0].height}, ×${format(zoom)}` : '';
  const both = a && b && canvases.length === 2, slides = both && mode === 'slider';
  const line = element('div'); line.id = 'divider';
  if (slides) box.append(line);
  const place = () => {
    if (!slides) return;
    line.style.left = split * a.width * zoom + 'px';
    b.style.clipPath = `inset(0 0 0 ${split * a.width / b.width * 100}%)`;
    drawValues();
  };
  if (both && mode === 'blink') {
    const swap = () => {
      blinkOn = !blinkOn;
      b.style.visibility = blinkOn ? 'visible' : 'hidden'; a.style.visibility = blinkOn ? 'hidden' : 'visible';
      drawLabels(); drawValues();
    };
    swap();
    timer = setInterval(swap, 500);
  }
  // Dragging moves the slider, or pans.
  box.onpointerdown = e => {
    if (e.button !== 0) return;
    box.setPointerCapture(e.pointerId);
    const from = [e.clientX + view.scrollLeft, e.clientY + view.scrollTop];
    const drag = e => {
      if (slides) {
        split = clamp((e.clientX - box.getBoundingClientRect().left) / (a.width * zoom), 0, 1);
        place();
      } else { view.scrollLeft = from[0] - e.clientX; view.scrollTop = from[1] - e.clientY; }
    };
    if (slides) drag(e);
    box.onpointermove = e => { drag(e); tell(e, canvases); };
  };
  box.onpointerup = box.onpointercancel = () => { box.onpointermove = e => tell(e, canvases); };
  box.onpointermove = e => tell(e, canvases);
  view.onwheel = e => {
    if (!e.ctrlKey && !e.altKey) return;
    e.preventDefault();
    const r = view.getBoundingClientRect();
    setZoom(zoom * (e.deltaY < 0 ? 1.25 : 0.8), e.clientX - r.left, e.clientY - r.top);
  };
  view.onscroll = () => { drawValues(); drawLabels(); };
  const values = element('canvas'); values.id = 'values';
  drawRegions(box, canvases);
  view.replaceChildren(box, values);
  place();
  drawValues();
  drawLabels();
}
/// Why a picture is missing.
function absence(mode) {
  if (!stage.a && !stage.b && !pair.error && pair.same) return 'These equal pictures were left out to keep the page small.';
  return mode === 'A' ? 'A cannot be shown.' : mode === 'B' ? 'B cannot be shown.' : 'Neither picture can be shown.';
}

/// Shows what is under the mouse: both pictures' values as stored, and the error.
function tell(e, canvases) {
  const over = canvases.find(c => { const r = c.getBoundingClientRect(); return e.clientX >= r.left && e.clientX < r.right; });
  if (!over) return;
  const r = over.getBoundingClientRect();
  const x = Math.floor((e.clientX - r.left) / zoom), y = Math.floor((e.clientY - r.top) / zoom);
  if (x < 0 || y < 0 || x >= over.width || y >= over.height) return;
  const text = (canvas, values) => {
    const numbers = numbersAt(canvas, values, x, y);
    return numbers ? numbers.map(exact).join(' ') : 'none';
  };
  const {a, b, valuesA, valuesB} = stage, values = valuesA || valuesB, error = stage.errorAt(x, y);
  const kind = !values ? '8-bit sRGB codes' : values.linear ? 'as stored, linear' : '16-bit codes';
  $('pixel').textContent = `${x}, ${y}   A ${text(a, valuesA)}   B ${text(b, valuesB)}` +
    (error === undefined ? '' : `   FLIP ${error.toFixed(3)}`) + `   (${kind})`;
  const mark = document.querySelector('#scale i');
  if (mark && error !== undefined) { mark.style.display = 'block'; mark.style.left = 256 * error + 'px'; }
}

function drawLabels() {
  const view = $('view'), frame = $('frame');
  for (const old of frame.querySelectorAll('.label')) old.remove();
  const add = (text, style) => {
    const label = element('div', text, 'label');
    Object.assign(label.style, style);
    frame.append(label);
  };
  const canvases = onStage(), {a, b} = stage;
  if (!canvases.length) return;
  const origin = frame.getBoundingClientRect();
  const end = c => Math.min(c.getBoundingClientRect().right - origin.left, view.clientWidth);
  if (mode === 'side by side') {
    for (const c of canvases) {
      const left = c.getBoundingClientRect().left - origin.left;
      if (left < view.clientWidth - 40) add(nameOf(c), {left: Math.max(left, 0) + 8 + 'px'});
    }
  } else if (a && b && mode === 'slider') {
    add(nameOf(a), {left: '8px'});
    add(nameOf(b), {left: end(b) - 8 + 'px', transform: 'translateX(-100%)'});
  } else if (a && b && mode === 'blink') {
    add(nameOf(blinkOn ? b : a), {left: '8px'});
  } else {
    const c = canvases[canvases.length - 1];
    add(mode === 'difference' && !stage.map ? nameOf(c) : mode === 'difference' ? nameOf(stage.map) : nameOf(c), {left: '8px'});
  }
}

function drawRegions(box, canvases) {
  if (!boxes || !pair.regions) return;
  const width = canvases.length ? canvases[0].width : 0;
  pair.regions.forEach((r, i) => {
    (mode === 'side by side' ? canvases : canvases.slice(0, 1)).forEach((c, k) => {
      const e = element('div', undefined, 'region' + (i === region ? ' on' : ''));
      Object.assign(e.style, {left: r.left * zoom + k * (width * zoom + 8) + 'px', top: r.top * zoom + 'px',
        width: (r.right - r.left + 1) * zoom + 'px', height: (r.bottom - r.top + 1) * zoom + 'px'});
      e.append(element('span', i + 1));
      box.append(e);
    });
  });
}
/// Centres a region, as large as fits.
function showRegion(i) {
  const r = pair.regions && pair.regions[i];
  if (!r) return;
  region = i;
  const view = $('view'), w = r.right - r.left + 1, h = r.bottom - r.top + 1;
  const room = Math.min(view.clientWidth / (w + 16), view.clientHeight / (h + 16));
  look((r.left + r.right) / 2, (r.top + r.bottom) / 2, clamp(room > 1 ? Math.floor(room) : room, 0.05, 16));
  const rows = $('regions') ? $('regions').rows : [];
  [...rows].forEach((tr, k) => { tr.className = k === i ? 'on' : ''; if (k === i) tr.scrollIntoView({block: 'nearest'}); });
}

// Where pixels are large, shows their values in them.
function drawValues() {
  const view = $('view'), canvas = $('values');
  if (!canvas) return;
  canvas.width = canvas.height = 0;
  if (zoom < 40) return;
  const width = view.clientWidth, height = view.clientHeight;
  canvas.width = width; canvas.height = height;
  canvas.style.left = view.scrollLeft + 'px'; canvas.style.top = view.scrollTop + 'px';
  const context = canvas.getContext('2d');
  context.font = '11px monospace'; context.textAlign = 'center';
  const {a, b, valuesA, valuesB} = stage, origin = view.getBoundingClientRect();
  for (const c of onStage()) {
    if (c.style.visibility === 'hidden') continue;
    const r = c.getBoundingClientRect(), left = r.left - origin.left - view.clientLeft, top = r.top - origin.top - view.clientTop;
    const x0 = clamp(Math.floor(-left / zoom), 0, c.width), y0 = clamp(Math.floor(-top / zoom), 0, c.height);
    const x1 = clamp(Math.ceil((width - left) / zoom), x0, c.width), y1 = clamp(Math.ceil((height - top) / zoom), y0, c.height);
    if (x0 === x1 || y0 === y1) continue;
    const data = codes(c, x0, y0, x1 - x0, y1 - y0), values = c === a ? valuesA : c === b ? valuesB : null;
    for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) {
      if (mode === 'slider' && a && b && (x + 0.5 < split * a.width) !== (c === a)) continue;
      const i = 4 * ((y - y0) * (x1 - x0) + x - x0);
      context.fillStyle = 0.3 * data[i] + 0.6 * data[i + 1] + 0.1 * data[i + 2] > 110 ? '#000' : '#fff';
      let texts = [0, 1, 2].map(k => data[i + k]);
      if (values) texts = numbersAt(c, values, x, y).slice(0, 3).map(v => Number.isFinite(v) ? +v.toPrecision(3) : v);
      else if (c !== a && c !== b) texts = [(stage.errorAt(x, y) ?? 0).toFixed(2)];
      texts.forEach((text, k) => context.fillText(text, left + (x + 0.5) * zoom, top + (y + 0.5) * zoom + 12 * k - 8, zoom - 2));
    }
  }
}
/// Zooms and keeps the point x, y of the view fixed.
function setZoom(z, x, y) {
  const view = $('view'), before = zoom;
  x = x ?? view.clientWidth / 2; y = y ?? view.clientHeight / 2;
  const left = view.scrollLeft + x, top = view.scrollTop + y;
  zoom = clamp(z, 0.05, 64);
  fitted = false;
  drawStage();
  $('view').scrollTo(left * zoom / before - x, top * zoom / before - y);
}
/// Shows a pixel in the middle.
function look(x, y, scale) {
  if (mode === 'side by side') mode = 'slider';
  zoom = scale;
  fitted = false;
  if (stage.a) split = clamp((x + 0.5) / stage.a.width, 0, 1);
  drawDetail();
  const view = $('view');
  view.scrollIntoView({block: 'nearest'});
  view.scrollTo((x + 0.5) * zoom - view.clientWidth / 2, (y + 0.5) * zoom - view.clientHeight / 2);
}

/// Exposure and range for pictures whose values are not codes.
function developBar() {
  const bar = element('div', undefined, 'bar');
  bar.id = 'develop';
  const values = [stage.valuesA, stage.valuesB];
  const input = (label, type, value, step, use) => {
    const e = element('input'), text = element('label', label + ' ');
    e.type = type; e.step = step; e.value = value;
    if (type === 'range') { e.min = -12; e.max = 12; }
    e.oninput = () => {
      if (!Number.isFinite(e.valueAsNumber)) return;
      use(e.valueAsNumber);
      if (high > low) redraw();
    };
    text.append(e);
    bar.append(text);
    return e;
  };
  const stops = element('span');
  const redraw = () => {
    stops.textContent = (exposure > 0 ? '+' : '') + exposure + ' EV';
    if (stage.a && values[0]) develop(stage.a, values[0], exposure, low, high);
    if (stage.b && values[1]) develop(stage.b, values[1], exposure, low, high);
    stage.over = undefined;
    drawStage();
  };
  const slider = input('exposure', 'range', exposure, 0.25, v => { exposure = v; });
  slider.id = 'exposure';
  bar.append(stops);
  const least = input('black at', 'number', low, 'any', v => { low = v; });
  const most = input('white at', 'number', high, 'any', v => { high = v; });
  least.id = 'low'; most.id = 'high';
  const button = (text, ends) => {
    const e = element('button', text);
    e.onclick = () => { [low, high] = ends(); exposure = 0; slider.value = 0; least.value = low; most.value = high; redraw(); };
    bar.append(e);
  };
  button('range of both', () => rangeOf(values));
  button('0 to 1', () => [0, 1]);
  stops.textContent = (exposure > 0 ? '+' : '') + exposure + ' EV';
  return bar;
}

/// The colours of FLIP's map, labelled with their errors.
function scaleBar() {
  const bar = element('div');
  bar.id = 'scale';
  const c = canvasOf(256, 1), context = contextOf(c);
  for (let i = 0; i < 256; ++i) { context.fillStyle = '#' + report.magma.slice(6 * i, 6 * i + 6); context.fillRect(i, 0, 1, 1); }
  bar.append(c, element('i'));
  for (const v of [0, 0.25, 0.5, 0.75, 1]) { const e = element('span', v); e.style.left = 256 * v + 'px'; bar.append(e); }
  return bar;
}
