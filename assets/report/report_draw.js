// Charts and tables as SVG and HTML. Everything that is shown as text goes through textContent.
'use strict';

// How curves, points and bars are told apart: colours repeat after eight, markers after seven, dashes change with each
// round of colours. The colours are the page's, which has others by night.
const curve_colours = 8;
const colour_of = number => `var(--c${number % curve_colours})`;
const dash_of = number => ['', '8 4', '2 3', '10 3 2 3'][Math.floor(number / curve_colours) % 4];

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

// Even steps of 1, 2 or 5 times a power of ten.
function ticks(low, high, wanted = 5) {
  if (!(high > low)) return [low];
  const raw = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(s => s * power >= raw);
  const list = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) list.push(Math.abs(v) < 1e-12 ? 0 : v);
  return list;
}

// Widths of texts as the page's charts have them, in pixels.
const ruler = document.createElement('canvas').getContext('2d');
function width_of(text) {
  ruler.font = '12px system-ui, "DejaVu Sans", sans-serif';
  return ruler.measureText(text).width;
}

// A text in pieces after which it may be broken: its words, and those that other marks join, as in names of conditions.
const pieces_of = text => String(text).split(/(?<=[\s_\-/.:])(?<!\.(?=\d))/);

// A text in lines no wider than `most`: broken between pieces, and within a piece that is wider than a line.
function lines_of(text, most) {
  const lines = [];
  let line = '';
  for (let piece of pieces_of(String(text).replace(/\s+/g, ' ').trim())) {
    if (width_of((line + piece).trimEnd()) <= most) { line += piece; continue; }
    if (line) lines.push(line.trimEnd());
    while (width_of(piece.trimEnd()) > most) {
      const letters = Array.from(piece);
      let count = 1;
      while (count < letters.length && width_of(letters.slice(0, count + 1).join('')) <= most) ++count;
      lines.push(letters.slice(0, count).join(''));
      piece = letters.slice(count).join('');
    }
    line = piece;
  }
  if (line || !lines.length) lines.push(line.trimEnd());
  return lines;
}
const line_px = 15;

// The text about a place, its lines one below the other; `y` is the first baseline.
function lines_at(lines, x, y, attributes = {}) {
  return lines.map((line, i) => shape('text', {x, y: y + line_px * i, ...attributes}, line));
}

// The steps that fit beside each other on an axis of so many pixels.
function fitting_ticks(range, length, wanted, log) {
  const of = v => (log ? Math.log10(v) : v), place = v => (of(v) - of(range[0])) / (of(range[1]) - of(range[0]) || 1) * length;
  for (let count = wanted; count > 0; --count) {
    let list = [];
    if (log) {
      const decades = [], all = [];
      for (let p = Math.floor(Math.log10(range[0])); p <= Math.ceil(Math.log10(range[1])); ++p)
        for (const factor of [1, 2, 5]) {
          const v = Number((factor * 10 ** p).toPrecision(3));
          if (v < range[0] || v > range[1]) continue;
          all.push(v);
          if (factor === 1) decades.push(v);
        }
      list = (decades.length < 3 ? all : decades).filter((v, i) => i % (wanted - count + 1) === 0);
    } else list = ticks(range[0], range[1], count);
    let end = -Infinity;
    const fit = list.every(v => {
      const half = width_of(digits(v, 4)) / 2, free = place(v) - half > end;
      end = place(v) + half + 8;
      return free;
    });
    if (fit && list.length) return list;
  }
  return [range[0]];
}

// What draws in each box, and how wide it is there.
const drawings = new WeakMap();

// Draws a chart as wide as its box, and anew when that changes or the page is printed. A box has one chart: the last.
function responsive(box, draw) {
  const known = drawings.get(box);
  if (known) {
    known.draw = draw;
    if (known.width) draw(Math.max(240, known.width));
    return;
  }
  const drawing = {draw, width: 0};
  drawings.set(box, drawing);
  const renew = wanted => {
    if (!wanted || Math.abs(wanted - drawing.width) < 1) return;
    drawing.width = wanted;
    drawing.draw(Math.max(240, wanted));
  };
  new ResizeObserver(() => renew(box.clientWidth)).observe(box);
  // Before the page is laid out on paper: half of it where charts stand side by side.
  window.addEventListener('beforeprint', () => renew(box.closest('.two, .trial, .panels') ? 345 : 690));
  window.addEventListener('afterprint', () => renew(box.clientWidth));
  renew(box.clientWidth);
}

// A plot with axes; gives functions from values to pixels. Room for numbers and labels is taken as they need it.
function plot({width, height, x, y, x_label, y_label, log, label}) {
  const svg = shape('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label || y_label});
  const of = v => (log ? Math.log10(v) : v), top = 12;
  const x_lines = x_label ? lines_of(x_label, width - 40) : [];
  const floor = height - 24 - line_px * x_lines.length;
  const y_lines = lines_of(y_label, floor - top);
  const y_ticks = log ? fitting_ticks(y, (floor - top) * 1.6, 6, true) : ticks(...y);
  const left = Math.ceil(10 + line_px * y_lines.length + Math.max(...y_ticks.map(v => width_of(digits(v, 4)))) + 6);
  let right = width - 12;
  const x_ticks = fitting_ticks(x, right - left - 10, Math.max(3, Math.round(width / 90)), log);
  right = Math.floor(width - 2 - Math.max(10, ...x_ticks.map(v => width_of(digits(v, 4)) / 2)));
  const px = v => left + (of(v) - of(x[0])) / (of(x[1]) - of(x[0]) || 1) * (right - left);
  const py = v => floor - (of(v) - of(y[0])) / (of(y[1]) - of(y[0]) || 1) * (floor - top);
  for (const v of y_ticks) {
    svg.append(shape('line', {x1: left, x2: right, y1: py(v), y2: py(v), class: 'grid'}));
    svg.append(shape('text', {x: left - 6, y: py(v) + 4, 'text-anchor': 'end'}, digits(v, 4)));
  }
  for (const v of x_ticks) svg.append(shape('text', {x: px(v), y: floor + 17, 'text-anchor': 'middle'}, digits(v, 4)));
  svg.append(shape('path', {d: `M${left} ${top}V${floor}H${right}`, class: 'axis'}));
  svg.append(...lines_at(x_lines, (left + right) / 2, floor + 33, {'text-anchor': 'middle', class: 'soft'}));
  y_lines.forEach((line, i) => {
    const at = 13 + line_px * i;
    svg.append(shape('text', {x: at, y: (top + floor) / 2, 'text-anchor': 'middle', class: 'soft', transform: `rotate(-90 ${at} ${(top + floor) / 2})`}, line));
  });
  return {svg, px, py, left, right, top, floor};
}

// A point of a curve with a number.
function marker(number, x, y) {
  const r = 4, fill = colour_of(number), stroke = {fill: 'none', stroke: fill, 'stroke-width': 2};
  const corners = list => shape('polygon', {points: list.map(([a, b]) => `${(x + r * a).toFixed(1)},${(y + r * b).toFixed(1)}`).join(' '), fill});
  return [() => shape('circle', {cx: x, cy: y, r: 3.2, fill}), () => corners([[-0.8, -0.8], [0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]]),
          () => corners([[0, -1], [0.95, 0.75], [-0.95, 0.75]]), () => corners([[0, -1.1], [1.1, 0], [0, 1.1], [-1.1, 0]]),
          () => corners([[0, 1], [0.95, -0.75], [-0.95, -0.75]]), () => shape('path', {d: `M${x - r} ${y}h${2 * r}M${x} ${y - r}v${2 * r}`, ...stroke}),
          () => shape('path', {d: `M${x - 3} ${y - 3}l6 6M${x - 3} ${y + 3}l6 -6`, ...stroke})][number % 7]();
}

function curve(number, points) {
  return shape('polyline', {points: points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' '), fill: 'none', stroke: colour_of(number),
                            'stroke-width': 2, 'stroke-dasharray': dash_of(number)});
}

// Which curve is whose.
function curve_names(names) {
  return element('ul', {class: 'curves', 'aria-label': 'Curves'}, ...names.map((name, i) => {
    const sample = shape('svg', {width: 40, height: 14, viewBox: '0 0 40 14', 'aria-hidden': 'true'});
    sample.append(curve(i, [[0, 7], [40, 7]]), marker(i, 20, 7));
    return element('li', {}, sample, name);
  }));
}

// Many points as what can be told apart of them: each is shown, darker where there are several.
function point_cloud(frame, points, colour) {
  const cell = 2, cells = new Map();
  for (const [x, y] of points) {
    const key = Math.floor(frame.px(x) / cell) + ',' + Math.floor(frame.py(y) / cell);
    cells.set(key, (cells.get(key) || 0) + 1);
  }
  for (const [key, count] of cells) {
    const [x, y] = key.split(',').map(Number);
    frame.svg.append(shape('circle', {cx: (x + 0.5) * cell, cy: (y + 0.5) * cell, r: 1.7, fill: colour, 'fill-opacity': (1 - 0.65 ** count).toFixed(3)}));
  }
}

// Rows of bars from 0, in a panel for each {name, bars}; each bar {label, estimate, each, expected}: `each` are dots of single
// observers, `expected` is a grey bar behind. With `as_points` values are dots, and the axis need not begin at 0. All
// panels have one axis.
function bars(box, panels, {x_label, label, most, least, as_points = false}) {
  const values = panels.flatMap(p => p.bars.flatMap(b => [b.estimate.v, b.estimate.lo, b.estimate.hi, b.expected, ...(b.each || [])])).filter(v => Number.isFinite(v));
  const ends = [least ?? (as_points ? undefined : 0), most, ...(panels.some(p => p.bars.some(b => b.expected !== undefined)) ? [0] : [])].filter(v => v !== undefined);
  const range = [Math.min(...ends, ...values), Math.max(...ends, ...values)];
  const grid = element('div', {class: panels.length > 1 ? 'panels' : ''});
  box.replaceChildren(grid);
  panels.forEach((panel, number) => {
    const chart = element('div');
    grid.append(element('div', {}, ...(panel.name ? [element('h3', {}, ...breakable(panel.name))] : []), chart));
    responsive(chart, width => chart.replaceChildren(bar_rows(panel, width, range, {x_label, label, as_points, colour: colour_of(number)})));
  });
}

function bar_rows(panel, width, range, {x_label, label, colour, as_points}) {
  const room = Math.min(0.42 * width, Math.max(...panel.bars.map(b => width_of(b.label))) + 1);
  const names = panel.bars.map(b => lines_of(b.label, room));
  const heights = names.map(lines => Math.max(24, line_px * lines.length + 8));
  const left = Math.ceil(room + 10), x_lines = lines_of(x_label, width - left);
  const top = 4, floor = top + heights.reduce((a, b) => a + b, 0), height = floor + 24 + line_px * x_lines.length;
  const svg = shape('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': `${label}${panel.name ? ', ' + panel.name : ''}: ` +
      panel.bars.map(b => `${b.label} ${estimate_text(b.estimate)}`).join('; ')});
  const inset = 14, px = v => left + inset + (v - range[0]) / (range[1] - range[0] || 1) * (width - left - 2 * inset);
  for (const v of fitting_ticks(range, width - left - 2 * inset, 6)) {
    svg.append(shape('line', {x1: px(v), x2: px(v), y1: top, y2: floor, class: 'grid'}));
    svg.append(shape('text', {x: px(v), y: floor + 16, 'text-anchor': 'middle'}, digits(v, 4)));
  }
  let y = top;
  panel.bars.forEach((bar, i) => {
    const e = bar.estimate, middle = y + heights[i] / 2, half = 7.5;
    svg.append(...lines_at(names[i], room, middle + 4 - line_px * (names[i].length - 1) / 2, {'text-anchor': 'end'}));
    if (e && e.v !== null && e.v !== undefined) {
      const from = px(Math.min(0, e.v)), to = px(Math.max(0, e.v));
      if (Number.isFinite(bar.expected)) svg.append(shape('rect', {x: px(0), width: Math.max(0, px(bar.expected) - px(0)), y: middle - half, height: 2 * half, class: 'expected'}));
      const rect = as_points ? shape('circle', {cx: px(e.v), cy: middle, r: 5, fill: colour}) : shape('rect', {x: from, width: Math.max(0, to - from), y: middle - half, height: 2 * half, fill: colour});
      rect.append(shape('title', {}, `${panel.name ? panel.name + ', ' : ''}${bar.label}: ${estimate_text(e)}`));
      svg.append(rect);
      (bar.each || []).forEach((v, o, all) => svg.append(shape('circle', {cx: px(v).toFixed(1), cy: (middle + 1.6 * half * ((o + 0.5) / all.length - 0.5)).toFixed(1), r: 1.7, class: 'dot'})));
      if (e.lo !== undefined) svg.append(shape('path', {d: `M${px(e.lo)} ${middle}H${px(e.hi)}M${px(e.lo)} ${middle - 4}v8M${px(e.hi)} ${middle - 4}v8`, class: 'mark'}));
    } else svg.append(shape('text', {x: px(Math.max(0, range[0])) + 4, y: middle + 4, class: 'soft'}, 'n/a'));
    y += heights[i];
  });
  if (range[0] <= 0 && range[1] >= 0) svg.append(shape('path', {d: `M${px(0)} ${top}V${floor}`, class: 'axis'}));
  svg.append(shape('path', {d: `M${left} ${floor}H${width - 1}`, class: 'axis'}));
  svg.append(...lines_at(x_lines, (left + width) / 2, floor + 32, {'text-anchor': 'middle', class: 'soft'}));
  return svg;
}
