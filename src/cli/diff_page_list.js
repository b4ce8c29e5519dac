'use strict';
// The list of pairs, the details of one pair, and the keys.
const counted = (n, what) => n + ' ' + what + (n === 1 ? '' : 's');
const kinds = ['differs', 'error', 'missing', 'no baseline', 'same'];
const kindOf = p => p.status === 0 ? 'same' : p.status === 1 ? 'differs' : p.status === 4 ? 'no baseline'
  : p.b ? 'error' : 'missing';
const pairs = report.pairs.map((p, index) => ({...p, index, kind: kindOf(p)}));
const value = (p, name) => p.metrics && p.metrics[name] ? p.metrics[name].value : undefined;
const error = p => value(p, 'flip') ?? value(p, 'hdr-flip') ?? value(p, 'max') ?? 0;
const columns = [['name', p => p.name], ['status', p => kinds.indexOf(p.kind)],
  ...['flip', 'hdr-flip', 'ssim', 'max', 'rmse', 'pixels'].filter(n => pairs.some(p => value(p, n) !== undefined))
    .map(n => [n, p => value(p, n)])];
let sortBy = 1, descending = false, current = -1, listed = [], loading = 0, drawing = 0;

function drawHead() {
  $('head').replaceChildren(...columns.map(([name], i) => {
    const th = element('th', name + (i === sortBy ? (descending ? ' ▼' : ' ▲') : ''), i > 1 ? 'n' : '');
    th.tabIndex = 0;
    th.onclick = () => { descending = i === sortBy ? !descending : i > 1 && name !== 'ssim'; sortBy = i; drawList(); };
    th.onkeydown = e => { if (e.key === 'Enter') th.onclick(); };
    return th;
  }));
}
// A thousand pictures at once would take seconds, so they load when they become visible.
const thumbnails = new IntersectionObserver(seen => {
  for (const {target, isIntersecting} of seen) if (isIntersecting) {
    thumbnails.unobserve(target);
    target.src = 'data:image/png;base64,' + pairs[target.closest('tr').dataset.index].thumbnail;
  }
}, {root: $('list'), rootMargin: '300px'});
function rowOf(p) {
  const tr = element('tr', undefined, p.index === current ? 'on' : '');
  tr.dataset.index = p.index;
  tr.append(...columns.map(([, get], i) => {
    const td = element('td', i === 1 ? p.kind : format(get(p)), i > 1 ? 'n' : i === 1 ? 's' + p.status : '');
    if (i > 0) return td;
    td.title = p.name;
    if (p.thumbnail) {
      const img = element('img');
      img.alt = ''; img.decoding = 'async';
      thumbnails.observe(img);
      td.prepend(img);
    }
    return td;
  }));
  tr.onclick = () => select(p.index);
  return tr;
}
function drawList() {
  drawHead();
  const text = $('filter').value.toLowerCase(), only = $('only').value, get = columns[sortBy][1];
  listed = pairs.filter(p => p.name.toLowerCase().includes(text) &&
    (only === 'all' || (only === 'not the same' ? p.kind !== 'same' : p.kind === only)));
  const key = p => { const v = get(p); return v === null ? Infinity : v === undefined ? -Infinity : v; };
  listed.sort((p, q) => {
    const a = key(p), b = key(q);
    if (a !== b) return (a < b ? -1 : 1) * (descending ? -1 : 1);
    return error(q) - error(p) || p.index - q.index;
  });
  // Rows that fit the screen now, the others when idle, so that the first picture does not wait.
  const later = f => window.requestIdleCallback ? requestIdleCallback(f, {timeout: 200}) : setTimeout(f);
  const rows = $('rows'), turn = ++drawing, at = listed.findIndex(p => p.index === current);
  const add = count => rows.append(...listed.slice(rows.children.length, rows.children.length + count).map(rowOf));
  const more = () => {
    if (turn !== drawing || rows.children.length >= listed.length) return;
    add(200);
    later(more);
  };
  rows.replaceChildren();
  add(Math.max(60, at + 30));
  later(more);
  const counts = kinds.map(k => [k, pairs.filter(p => p.kind === k).length]).filter(([, n]) => n > 0);
  $('summary').textContent = `${counted(pairs.length, 'pair')}: ${counts.map(([k, n]) => n + ' ' + k).join(', ')}; ${listed.length} shown`;
}

async function select(index) {
  current = index;
  for (const tr of $('rows').children) {
    const on = +tr.dataset.index === index;
    tr.className = on ? 'on' : '';
    if (on) tr.scrollIntoView({block: 'nearest'});
  }
  const p = pairs[index], turn = ++loading;
  history.replaceState(null, '', '#' + encodeURIComponent(p.name));
  const all = await picturesOf(p);
  if (turn !== loading) return;
  pair = p;
  stage = all;
  fitted = true; region = -1; exposure = 0; low = 0; high = 1;
  // Depths and normals are drawn over their whole range.
  const values = stage.valuesA || stage.valuesB;
  if (values && !values.colour) [low, high] = rangeOf([stage.valuesA, stage.valuesB]);
  drawDetail();
}

function tableOf(id, caption, rows) {
  const table = element('table');
  table.id = id;
  table.append(element('caption', caption));
  for (const cells of rows) {
    const tr = element('tr');
    tr.append(...cells.map(c => element('td', c, typeof c === 'number' ? 'n' : '')));
    table.append(tr);
  }
  const tall = element('div', undefined, 'tall');
  tall.append(table);
  return tall;
}
/// A command, with a button that copies it to the clipboard.
function commandOf(label, command) {
  const line = element('div', label + ' ', 'bar'), code = element('code', command), button = element('button', 'copy');
  button.onclick = async () => {
    try {
      await navigator.clipboard.writeText(command);
    } catch {
      getSelection().selectAllChildren(code);
      document.execCommand('copy');
    }
    button.textContent = 'copied';
    setTimeout(() => { button.textContent = 'copy'; }, 1500);
  };
  line.append(code, button);
  return line;
}
/// Quotes a word for the shell; one that looks like an option gets "./" in front.
function quoted(word) {
  if (word.startsWith('-')) word = './' + word;
  if (/^[\w./+=:%-]+$/.test(word)) return word;
  if (!/[\x00-\x1f\x7f]/.test(word)) return "'" + word.replaceAll("'", "'\\''") + "'";
  return "$'" + word.replace(/['\\]/g, '\\$&')
    .replace(/[\x00-\x1f\x7f]/g, c => '\\x' + c.charCodeAt(0).toString(16).padStart(2, '0')) + "'";
}

function drawDetail() {
  const p = pair, main = $('detail'), top = main.scrollTop;
  const bar = element('div', undefined, 'bar');
  for (const m of modes) {
    const button = element('button', m);
    button.setAttribute('aria-pressed', m === mode);
    button.dataset.mode = m;
    button.onclick = () => setMode(m);
    bar.append(button);
  }
  const size = element('span'); size.id = 'size';
  bar.append(size);
  if (stage.map) bar.append(scaleBar());
  const frame = element('div'), view = element('div');
  frame.id = 'frame'; view.id = 'view'; view.tabIndex = 0;
  frame.append(view);
  const pixel = element('div', ' '); pixel.id = 'pixel';
  const title = element('h2', p.name + ': ' + p.kind, 's' + p.status);
  const link = element('a', 'link to this pair');
  link.href = '#' + encodeURIComponent(p.name);
  const heading = element('div');
  heading.append(title, link);
  main.replaceChildren(heading, bar);
  const values = stage.valuesA || stage.valuesB;
  if (values && values.linear) main.append(developBar());
  main.append(frame, pixel);
  for (const text of [p.error, ...(p.failures || [])]) if (text) main.append(element('div', text, 's' + p.status));
  for (const text of p.notes || []) main.append(element('div', text));
  for (const [what, text] of Object.entries(p.notFollowed || {}))
    main.append(element('div', `ignored metadata: ${what}${text === 'yes' ? '' : ' (' + text + ')'}`));
  if (report.updateCommand && (p.status === 1 || p.status === 4) && p.b)
    main.append(commandOf('To accept it:', report.updateCommand + (pairs.length > 1 || report.run ? ' ' + quoted(p.name) : '')));
  main.append(columnsOf(p));
  if (p.log) {
    const log = element('details'), pre = element('pre', p.log);
    log.open = p.status !== 0;
    log.append(element('summary', 'output of the program'), pre);
    main.append(log);
  }
  drawStage();
  main.scrollTop = top;
}
function columnsOf(p) {
  const below = element('div', undefined, 'columns');
  if (p.regions && p.regions.length) {
    const more = p.regionCount > p.regions.length ? `, the worst ${p.regions.length} of them` : '';
    const list = tableOf('regions', `regions that differ: ${p.regionCount}${more}`, p.regions.map((r, i) =>
      [i + 1, `${r.left}, ${r.top} – ${r.right}, ${r.bottom}`, counted(r.pixels, 'pixel'), r.difference === null ? 'not finite' : format(r.difference)]));
    const rows = list.firstChild.rows;
    [...rows].forEach((tr, i) => { tr.title = 'show this region'; tr.className = i === region ? 'on' : ''; tr.onclick = () => showRegion(i); });
    below.append(list);
  }
  if (p.metrics) {
    const list = tableOf('metrics', 'metrics', Object.entries(p.metrics).map(([name, m]) => [name, format(m.value),
      m.threshold !== undefined ? (name === 'psnr' || name === 'ssim' ? 'at least ' : 'at most ') + m.threshold
        : m.atMost ? 'at most ' + m.atMost.join(', ') : '']));
    for (const tr of list.firstChild.rows) tr.cells[1].className = 'n';
    below.append(list);
  }
  if (p.conditions && p.conditions.length) below.append(tableOf('conditions', 'conditions', [[p.conditions.join(' ')]]));
  if (p.layers && p.layers.length)
    below.append(tableOf('layers', 'other layers', p.layers.map(l => [l.name, l.same ? 'same' : 'differs',
      counted(l.differing, 'pixel') + (l.differing === 1 ? ' differs' : ' differ'), l.name === p.shown ? 'shown' : ''])));
  if (p.worst && p.worst.length) {
    const show = v => v.map(x => x === null ? 'not finite' : String(+x.toPrecision(4))).join(' ');
    const list = tableOf('worst', `worst pixels (${p.values === 'linear' ? 'linear light' : 'sRGB, 0 to 1'})`,
      p.worst.map(w => [`${w.x}, ${w.y}`, show(w.a) + ' → ' + show(w.b), format(w.difference)]));
    [...list.firstChild.rows].forEach((tr, i) => {
      tr.title = 'show this pixel'; tr.onclick = () => look(p.worst[i].x, p.worst[i].y, Math.max(zoom, 48));
    });
    below.append(list);
  }
  const texts = [p.textA || {}, p.textB || {}], keys = [...new Set(texts.flatMap(t => Object.keys(t)))].sort();
  if (keys.length) {
    const list = tableOf('making', 'how the pictures were made',
      [['', 'A', 'B'], ...keys.map(k => [k, texts[0][k] ?? '', texts[1][k] ?? ''])]);
    keys.forEach((k, i) => { if (p.a && p.b && texts[0][k] !== texts[1][k]) list.firstChild.rows[i + 1].className = 'other'; });
    below.append(list);
  }
  return below;
}
function setMode(m) { mode = m; drawDetail(); }

for (const text of ['all', 'not the same', ...kinds]) $('only').append(element('option', text));
$('filter').oninput = $('only').onchange = drawList;
document.addEventListener('keydown', e => {
  if (e.target === $('filter')) {
    if (e.key === 'Escape' || e.key === 'Enter') $('filter').blur();
    return;
  }
  if (e.target === $('only') || e.target.tagName === 'INPUT' || e.ctrlKey || e.altKey || e.metaKey) return;
  if (['BUTTON', 'SUMMARY', 'A'].includes(e.target.tagName) && (e.key === ' ' || e.key === 'Enter')) return;
  const at = listed.findIndex(p => p.index === current), view = $('view');
  if ((e.key === 'j' || e.key === 'ArrowDown') && at + 1 < listed.length) select(listed[at + 1].index);
  else if ((e.key === 'k' || e.key === 'ArrowUp') && at > 0) select(listed[at - 1].index);
  else if (e.key === '/') $('filter').focus();
  else if (!stage || !view) return;
  else if (modes[e.key - 1]) setMode(modes[e.key - 1]);
  else if (e.key === ' ') setMode(mode === 'A' ? 'B' : 'A');
  else if (e.key === 'n' || e.key === 'p') {
    const count = (pair.regions || []).length;
    if (count) showRegion((region + (e.key === 'n' ? 1 : region < 0 ? 0 : -1) + count) % count);
  } else if (e.key === 'b') { boxes = !boxes; drawStage(); }
  else if (e.key === 'm') { faded = !faded; drawStage(); }
  else if (e.key === '+' || e.key === '=') setZoom(zoom * 2);
  else if (e.key === '-') setZoom(zoom / 2);
  else if (e.key === '0') setZoom(1);
  else if (e.key === 'f') { fitted = true; drawStage(); }
  else if (e.key === 'ArrowLeft' || e.key === 'ArrowRight') {
    split = clamp(split + (e.key === 'ArrowLeft' ? -0.02 : 0.02), 0, 1);
    drawStage();
  } else return;
  e.preventDefault();
});
addEventListener('resize', () => { if (stage && fitted) drawStage(); });
/// The pair that the address names.
function named() {
  const name = decodeURIComponent(location.hash.slice(1));
  return pairs.find(p => p.name === name);
}
addEventListener('hashchange', () => { const p = named(); if (p && p.index !== current) select(p.index); });
if (report.updateCommand && pairs.length > 1) $('accept').append(commandOf('To accept all:', report.updateCommand));
if (named()) current = named().index;
drawList();
const first = named() || listed[0];
if (first) select(first.index);
