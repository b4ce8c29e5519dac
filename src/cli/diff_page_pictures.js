// The pictures of a pair, decoded when it is shown.
const clamp = (v, low, high) => Math.min(high, Math.max(low, v));
const format = v => v === undefined ? '' : v === null ? '∞' : typeof v === 'number' ? String(+v.toPrecision(5)) : v;
const exact = v => Number.isFinite(v) ? String(+v.toPrecision(6)) : String(v);

function contextOf(canvas) { return canvas.getContext('2d', {willReadFrequently: true}); }
function canvasOf(width, height) {
  const canvas = element('canvas');
  canvas.width = width; canvas.height = height;
  return canvas;
}
/// The 8-bit codes of a part of a canvas: red, green, blue, alpha.
function codes(c, x, y, w, h) { return [...contextOf(c).getImageData(x, y, w, h).data]; }

// Pictures beside the page are scripts that call this: a page opened from a file must not read
// other files.
const beside = new Map();
function picture(id, base64) { beside.get(id)(base64); }

/// The base64 text of a picture, or null. Pictures in the page come after this script and may not
/// have loaded yet.
async function textOf(kind, p) {
  if (!(p.pictures || '').includes(kind)) return null;
  const id = kind + p.index;
  if (report.pictures) {
    return new Promise(done => {
      const script = element('script');
      beside.set(id, text => { script.remove(); done(text); });
      script.onerror = () => { script.remove(); done(null); };
      script.src = encodeURIComponent(report.pictures) + '/' + id + '.js';
      document.head.append(script);
    });
  }
  while (document.readyState === 'loading' && !($(id) && $(id).nextElementSibling))
    await new Promise(done => setTimeout(done, 20));
  return $(id) ? $(id).textContent : null;
}
async function bytesOf(kind, p) {
  const text = await textOf(kind, p);
  return text ? Uint8Array.from(atob(text), c => c.charCodeAt(0)) : null;
}
async function canvasFrom(kind, p) {
  const bytes = await bytesOf(kind, p);
  if (!bytes) return null;
  try {
    const bitmap = await createImageBitmap(new Blob([bytes]), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
    const canvas = canvasOf(bitmap.width, bitmap.height);
    contextOf(canvas).drawImage(bitmap, 0, 0);
    return canvas;
  } catch {
    return null;  // more than this browser can show
  }
}
/// The values of a picture of 16 bits or floats: {width, height, channels, linear, colour, data}.
async function valuesFrom(kind, p) {
  const bytes = await bytesOf(kind, p);
  if (!bytes) return null;
  const end = bytes.indexOf(10), head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
  const stream = new Blob([bytes.subarray(end + 1)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return {...head, data: new Float32Array(await new Response(stream).arrayBuffer())};
}
function blank(a) {
  const c = canvasOf(a.width, a.height), context = contextOf(c);
  context.fillStyle = '#' + report.magma.slice(0, 6); context.fillRect(0, 0, c.width, c.height);
  return c;
}

/// Everything of a pair: canvases a, b and map (null if absent), values a and b.
async function picturesOf(p) {
  const [a, other, map, valuesA, valuesB] = await Promise.all(
    [canvasFrom('a', p), canvasFrom('b', p), canvasFrom('m', p), valuesFrom('v', p), valuesFrom('w', p)]);
  // Equal pictures are stored once.
  const equal = a && p.a && p.b && !p.error && !p.pictures.includes('b');
  let b = other;
  if (equal) { b = canvasOf(a.width, a.height); contextOf(b).drawImage(a, 0, 0); }
  const all = {a, b, map: map || (equal ? blank(a) : null), valuesA, valuesB: valuesB || (equal ? valuesA : null)};
  const ofMap = map ? contextOf(map).getImageData(0, 0, map.width, map.height).data : null;
  all.errorAt = (x, y) => {
    if (!all.map || x >= all.map.width || y >= all.map.height) return undefined;
    if (!ofMap) return 0;
    const i = 4 * (y * all.map.width + x);
    return errorOf(ofMap[i], ofMap[i + 1], ofMap[i + 2]);
  };
  return all;
}

// A colour of FLIP's map gives its error: the page has the colours of 256 errors from 0 to 1.
const magma = Array.from({length: 256}, (_, i) => parseInt(report.magma.slice(6 * i, 6 * i + 6), 16));
const errors = new Map(magma.map((colour, i) => [colour, i / 255]));
function errorOf(red, green, blue) {
  const colour = red << 16 | green << 8 | blue;
  if (!errors.has(colour)) {
    const far = c => (red - (c >> 16)) ** 2 + (green - (c >> 8 & 255)) ** 2 + (blue - (c & 255)) ** 2;
    let best = 0;
    for (let i = 1; i < 256; ++i) if (far(magma[i]) < far(magma[best])) best = i;
    errors.set(colour, best / 255);
  }
  return errors.get(colour);
}

/// The map over the faded picture, more opaque where the error is larger.
function mapOver(map, below) {
  const c = canvasOf(map.width, map.height), context = contextOf(c);
  context.fillStyle = '#fff'; context.fillRect(0, 0, c.width, c.height);
  if (below) context.drawImage(below, 0, 0);
  const picture = context.getImageData(0, 0, c.width, c.height), out = picture.data;
  const from = contextOf(map).getImageData(0, 0, c.width, c.height).data;
  for (let i = 0; i < out.length; i += 4) {
    const error = errorOf(from[i], from[i + 1], from[i + 2]);
    const grey = 255 - 0.25 * (255 - (0.3 * out[i] + 0.59 * out[i + 1] + 0.11 * out[i + 2])), share = Math.min(1, 5 * error);
    for (let k = 0; k < 3; ++k) out[i + k] = grey + share * (from[i + k] - grey);
    out[i + 3] = 255;
  }
  context.putImageData(picture, 0, 0);
  return c;
}

/// Draws values into a canvas: low is black and high white, times 2^exposure; colours are encoded.
function develop(canvas, values, exposure, low, high) {
  const context = contextOf(canvas), picture = context.createImageData(values.width, values.height);
  const {channels, data, colour} = values, gain = 2 ** exposure / (high - low);
  const code = v => {
    const x = Number.isNaN(v) ? 1 : clamp((v - low) * gain, 0, 1);
    return 255 * (!colour ? x : x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  };
  for (let i = 0, j = 0; i < picture.data.length; i += 4, j += channels) {
    for (let k = 0; k < 3; ++k) picture.data[i + k] = code(data[j + (channels > 2 ? k : 0)]);
    picture.data[i + 3] = channels === 4 && colour ? 255 * clamp(data[j + 3], 0, 1) : 255;
  }
  context.putImageData(picture, 0, 0);
}
/// The smallest and the largest finite value in the pictures.
function rangeOf(all) {
  let low = Infinity, high = -Infinity;
  for (const values of all) if (values)
    for (let i = 0; i < values.data.length; ++i) {
      if (values.channels === 4 && i % 4 === 3) continue;
      const v = values.data[i];
      if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
    }
  return low < high ? [low, high] : [0, 1];
}
/// The values of a pixel, exact if they are known: {numbers, kind}; null outside.
function numbersAt(canvas, values, x, y) {
  if (!canvas || x >= canvas.width || y >= canvas.height) return null;
  if (!values) return codes(canvas, x, y, 1, 1);
  const at = values.channels * (y * values.width + x);
  return [...values.data.subarray(at, at + values.channels)];
}
