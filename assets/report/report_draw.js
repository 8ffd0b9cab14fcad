// Charts and tables as SVG and HTML. Everything that is shown as text goes through textContent.
'use strict';

const palette = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#7a6f00', '#444444'];

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  for (const child of children) made.append(child);
  return made;
}

function shape(name, attributes = {}, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

// Three or so significant digits, without exponents where they can be had. `least`: nobody can use less than
// this of the quantity, such as a thousandth of a millimetre.
function digits(value, count = 3, least = 0) {
  if (value === null || value === undefined || !Number.isFinite(value)) return 'n/a';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < least / 2) return `< ${least}`;
  if (least) return String(Number(size >= 10 ** count ? value.toFixed(0) : Number(value.toPrecision(count)).toFixed(Math.max(0, Math.round(-Math.log10(least))))));
  if (size >= 1e6 || size < 1e-4) return value.toExponential(count - 1);
  return size >= 10 ** count ? value.toFixed(0) : String(Number(value.toPrecision(count)));
}
const mm_text = value => digits(value, 3, 0.001);
const p_text = p => (p === null || p === undefined || !Number.isFinite(p) ? 'n/a' : p < 0.001 ? '< 0.001' : p.toFixed(3));

function percent(value) { return value === null || value === undefined ? 'n/a' : (100 * value).toFixed(1) + ' %'; }

// "0.61 [0.55, 0.67]", or why there is none. With an interval as many decimals as tell its ends apart by two digits.
function estimate_text(e, count = 3) {
  if (!e || e.v === null || e.v === undefined) return 'n/a' + (e && e.absent ? ' (' + e.absent + ')' : '');
  const width = e.lo === undefined || e.lo === null ? 0 : e.hi - e.lo;
  if (!(width > 0)) return digits(e.v, count) + (e.lo === undefined || e.lo === null ? '' : ` [${digits(e.lo, count)}, ${digits(e.hi, count)}]`);
  const decimals = Math.min(9, Math.max(0, 1 - Math.floor(Math.log10(width))));
  const text = v => v.toFixed(decimals).replace(/^-(0(\.0*)?)$/, '$1');
  return `${text(e.v)} [${text(e.lo)}, ${text(e.hi)}]`;
}

function table(head, rows, note) {
  const texts = new Set(head.map((name, i) => (typeof name === 'object' ? i : -1)));
  const line = head.map((name, i) => element('th', texts.has(i) ? {scope: 'col', class: 'text'} : {scope: 'col'},
                                             typeof name === 'object' ? name.text : name));
  const body = element('tbody');
  for (const row of rows)
    body.append(element('tr', {}, ...row.map((cell, i) => element('td', texts.has(i) ? {class: 'text'} : {}, String(cell)))));
  const box = element('div', {class: 'scroll', tabindex: '0'},
                      element('table', {}, element('thead', {}, element('tr', {}, ...line)), body));
  return note ? element('div', {}, box, element('p', {class: 'note'}, note)) : box;
}

// Even steps of 1, 2 or 5 times a power of ten.
function ticks(low, high, wanted = 5) {
  if (!(high > low)) return [low];
  const raw = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(s => s * power >= raw);
  const list = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) list.push(Math.abs(v) < 1e-12 ? 0 : v);
  return list;
}

// A plot with axes; gives functions from values to pixels.
function plot({width, height, x, y, x_label, y_label, log, left = 62, bottom = 44, label}) {
  const svg = shape('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label || y_label});
  const right = width - 12, top = 14, floor = height - bottom;
  const of = v => (log ? Math.log10(v) : v);
  const px = v => left + (of(v) - of(x[0])) / (of(x[1]) - of(x[0]) || 1) * (right - left);
  const py = v => floor - (of(v) - of(y[0])) / (of(y[1]) - of(y[0]) || 1) * (floor - top);
  const decades = range => {
    const list = [];
    for (let p = Math.ceil(Math.log10(range[0])); p <= Math.log10(range[1]); ++p) list.push(10 ** p);
    return list;
  };
  for (const v of log ? decades(y) : ticks(...y)) {
    svg.append(shape('line', {x1: left, x2: right, y1: py(v), y2: py(v), stroke: '#e4e8ee'}));
    svg.append(shape('text', {x: left - 6, y: py(v) + 4, 'text-anchor': 'end'}, digits(v)));
  }
  if (x_label !== null)
    for (const v of log ? decades(x) : ticks(...x, Math.max(3, Math.round(width / 90))))
      svg.append(shape('text', {x: px(v), y: floor + 17, 'text-anchor': 'middle'}, digits(v)));
  svg.append(shape('path', {d: `M${left} ${top}V${floor}H${right}`, fill: 'none', stroke: '#5b6675'}));
  if (x_label) svg.append(shape('text', {x: (left + right) / 2, y: height - 6, 'text-anchor': 'middle', class: 'soft'}, x_label));
  svg.append(shape('text', {x: 14, y: (top + floor) / 2, 'text-anchor': 'middle', class: 'soft',
                            transform: `rotate(-90 14 ${(top + floor) / 2})`}, y_label));
  return {svg, px, py, left, right, top, floor};
}

function whisker(svg, x, low, high) {
  svg.append(shape('path', {d: `M${x} ${low}V${high}M${x - 4} ${low}h8M${x - 4} ${high}h8`, stroke: '#1c2430', fill: 'none'}));
}

// Bars in clusters; each bar {label, estimate}. Clusters {name, bars}.
// Bars from 0; `each` of a bar: dots of single observers, side by side.
function bars(clusters, {y_label, label, most, least = 0, width = 1120}) {
  const count = clusters.reduce((sum, c) => sum + c.bars.length + 1, 0);
  const names = [...new Set(clusters.flatMap(c => c.bars.map(b => b.label)))];
  const frame = plot({width, height: 300, x: [0, count], y: [least, most], x_label: null, y_label, label, bottom: 60});
  let at = 0.5;
  for (const cluster of clusters) {
    const begin = at;
    for (const bar of cluster.bars) {
      const e = bar.estimate, x = frame.px(at + 0.5);
      if (e && e.v !== null && e.v !== undefined) {
        const wide = (frame.px(1) - frame.px(0)) * 0.84;
        const top = frame.py(Math.max(0, e.v)), foot = frame.py(Math.min(0, e.v));
        const rect = shape('rect', {x: x - wide / 2, width: wide, y: top, height: Math.max(0, foot - top),
                                    fill: palette[names.indexOf(bar.label) % palette.length]});
        rect.append(shape('title', {}, `${cluster.name}, ${bar.label}: ${estimate_text(e)}`));
        frame.svg.append(rect);
        (bar.each || []).forEach((v, i, all) => frame.svg.append(shape('circle',
            {cx: (x + wide * 0.8 * ((i + 0.5) / all.length - 0.5)).toFixed(1), cy: frame.py(v).toFixed(1), r: 1.7, fill: '#1c2430', 'fill-opacity': 0.55})));
        if (e.lo !== undefined) whisker(frame.svg, x, frame.py(e.lo), frame.py(Math.min(e.hi, most)));
      } else frame.svg.append(shape('text', {x, y: frame.floor - 4, 'text-anchor': 'middle', class: 'soft'}, 'n/a'));
      ++at;
    }
    frame.svg.append(shape('text', {x: (frame.px(begin) + frame.px(at)) / 2, y: frame.floor + 17, 'text-anchor': 'middle'}, cluster.name));
    ++at;
  }
  let x = frame.left;
  for (const name of names) {
    frame.svg.append(shape('rect', {x, y: 284, width: 11, height: 11, fill: palette[names.indexOf(name) % palette.length]}));
    frame.svg.append(shape('text', {x: x + 15, y: 294}, name));
    x += 32 + 7 * name.length;
  }
  return frame.svg;
}
