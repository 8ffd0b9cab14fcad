// Figures as files: each chart as SVG, PDF or PNG, as wide as a column or a page of a journal; each view as PNG.

// 8 point letters, as journals ask: 12 of the page's pixels.
const pixels_of_mm = 12 / (8 * 25.4 / 72), print_dots_of_mm = 600 / 25.4, widths_mm = [85, 170];

// The page's rules by day, whatever the system has: a figure is for paper.
const page_rules = [...document.styleSheets[0].cssRules];
const by_day = text => text.replace(/var\((--[\w-]+)\)/g, (whole, name) => page_rules[0].style.getPropertyValue(name).trim() || whole);

// What the style sheet says of a drawing, written into it, since a file has no style sheet.
function with_own_style(drawing) {
  for (const title of drawing.querySelectorAll('title')) title.remove();
  for (const rule of page_rules) {
    if (!rule.selectorText || !rule.selectorText.startsWith('svg ')) continue;
    for (const part of drawing.querySelectorAll(rule.selectorText.slice(4)))
      for (const name of ['fill', 'fill-opacity', 'stroke', 'font-size', 'font-family'])
        if (rule.style.getPropertyValue(name)) part.setAttribute(name, rule.style.getPropertyValue(name));
  }
  for (const part of drawing.querySelectorAll('*')) {
    part.removeAttribute('class');
    for (const {name, value} of [...part.attributes]) if (value.includes('var(')) part.setAttribute(name, by_day(value));
  }
  return drawing;
}

// The drawing of a box at a width, apart from the page.
function drawn_at(box, width) {
  const {draw, width: on_page} = drawings.get(box);
  draw(width);
  const copy = box.querySelector('svg').cloneNode(true);
  if (on_page) draw(Math.max(240, on_page));
  return copy;
}

// The names of a chart's curves stand before it or in it.
function names_of_curves(chart) {
  const inside = chart.querySelector('.curves');
  if (inside) return [...inside.children].map(item => item.textContent);
  const before = chart.previousElementSibling;
  const list = before && (before.matches('.curves') ? before : before.querySelector(':scope > .curves'));
  return list ? [...list.children].map(item => item.textContent) : [];
}

// A chart with the names of its curves and of its panels, `mm` wide.
function figure_of(chart, mm) {
  const boxes = [chart, ...chart.querySelectorAll('*')].filter(box => drawings.has(box) && box.querySelector('svg'));
  if (!boxes.length) return null;
  const width = Math.round(mm * pixels_of_mm), gap = 16, is_wide = mm > 100;
  const columns = boxes.length === 1 ? 1 : Math.min(boxes.length, (is_wide ? 2 : 1) + (chart.querySelector('.small') || chart.matches('.small') ? 1 : 0));
  const cell = Math.floor((width - gap * (columns - 1)) / columns);
  const figure = shape('svg', {xmlns: 'http://www.w3.org/2000/svg'});
  let x = 0, y = 0;
  names_of_curves(chart).forEach((name, number) => {
    const lines = lines_of(name, width - 48), room = 48 + Math.max(...lines.map(width_of)) + 14;
    if (x && x + room > width) { x = 0; y += line_px + 3; }
    figure.append(curve(number, [[x, y + 8], [x + 40, y + 8]]), marker(number, x + 20, y + 8), ...lines_at(lines, x + 46, y + 12));
    x += room;
    if (lines.length > 1) { x = 0; y += line_px * lines.length + 3; }
  });
  if (x) y += line_px + 8;
  for (let first = 0; first < boxes.length; first += columns) {
    const row = boxes.slice(first, first + columns);
    const heads = row.map(box => (boxes.length > 1 ? lines_of([...box.parentElement.children].filter(other => other !== box && other.compareDocumentPosition(box) & Node.DOCUMENT_POSITION_FOLLOWING)
        .map(other => other.textContent).join(' '), cell) : []).filter(Boolean));
    const head = line_px * Math.max(...heads.map(lines => lines.length)) + (heads.some(lines => lines.length) ? 4 : 0);
    let height = 0;
    row.forEach((box, column) => {
      const drawing = drawn_at(box, cell), left = column * (cell + gap), group = shape('g', {transform: `translate(${left} ${y + head})`});
      group.append(...drawing.childNodes);
      figure.append(...lines_at(heads[column], left, y + 12, {'font-weight': 'bold'}), group);
      height = Math.max(height, Number(drawing.getAttribute('height')));
    });
    y += head + height + gap;
  }
  const height = y - gap + 2;
  for (const [name, value] of [['width', `${mm}mm`], ['height', `${(height / pixels_of_mm).toFixed(2)}mm`], ['viewBox', `0 0 ${width} ${height}`]]) figure.setAttribute(name, value);
  return with_own_style(figure);
}

function save_blob(blob, name) {
  const link = element('a', {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// A PNG that says how large it is on paper (its chunk pHYs, in dots per metre).
function with_size(png) {
  const chunk = new Uint8Array(21), view = new DataView(chunk.buffer), dots = Math.round(1000 * print_dots_of_mm);
  view.setUint32(0, 9);
  chunk.set([0x70, 0x48, 0x59, 0x73], 4);
  view.setUint32(8, dots);
  view.setUint32(12, dots);
  chunk[16] = 1;
  let sum = -1;
  for (const byte of chunk.subarray(4, 17)) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  view.setUint32(17, ~sum >>> 0);
  const header_end = 33;
  return new Blob([png.subarray(0, header_end), chunk, png.subarray(header_end)], {type: 'image/png'});
}

function save_canvas(canvas, name) {
  canvas.toBlob(async blob => save_blob(with_size(new Uint8Array(await blob.arrayBuffer())), name), 'image/png');
}

function save_png(figure, mm, name) {
  const [, , width, height] = figure.getAttribute('viewBox').split(' ').map(Number), picture = new Image();
  picture.onload = () => {
    const canvas = element('canvas', {width: Math.round(mm * print_dots_of_mm), height: Math.round(mm * print_dots_of_mm * height / width)}), paint = canvas.getContext('2d');
    paint.fillStyle = '#ffffff';
    paint.fillRect(0, 0, canvas.width, canvas.height);
    paint.drawImage(picture, 0, 0, canvas.width, canvas.height);
    save_canvas(canvas, name);
  };
  picture.src = 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(new XMLSerializer().serializeToString(figure));
}

// The browser's own print, of a page as large as the figure: it saves a PDF of vectors with the letters in it.
function print_figure(figure, name) {
  const frame = element('iframe', {'aria-hidden': 'true', style: 'position:fixed;width:0;height:0;border:0'});
  document.body.append(frame);
  const page = frame.contentDocument;
  page.title = name;
  page.head.append(Object.assign(page.createElement('style'), {textContent: `@page { size: ${figure.getAttribute('width')} ${figure.getAttribute('height')}; margin: 0 } body { margin: 0 } svg { display: block }`}));
  page.body.append(page.importNode(figure, true));
  frame.contentWindow.addEventListener('afterprint', () => setTimeout(() => frame.remove(), 1000));
  frame.contentWindow.print();
}

// What a figure's file is called: as its place in the page, or as the last heading before it.
function name_of_figure(chart) {
  if (chart.id) return chart.id.replace(/_chart$/, '');
  const heads = [...document.querySelectorAll('h2, h3, h4')].filter(head => head.compareDocumentPosition(chart) & Node.DOCUMENT_POSITION_FOLLOWING && !chart.contains(head));
  const last = heads[heads.length - 1], part = last ? last.textContent : 'figure';
  return part.normalize('NFKD').replace(/[^\p{L}\p{N}]+/gu, '_').replace(/^_|_$/g, '').toLowerCase().slice(0, 60) || 'figure';
}

for (const chart of document.querySelectorAll('.chart, .panels')) {
  if (chart.parentElement.closest('.chart, .panels')) continue;
  const width = element('select', {'aria-label': 'Width of the figure'});
  fill(width, widths_mm.map(mm => [String(mm), `${mm} mm`]));
  const button = (name, save) => {
    const made = element('button', {type: 'button', title: `Save this figure as ${name}`}, name);
    made.addEventListener('click', () => {
      const mm = Number(width.value), figure = figure_of(chart, mm);
      if (figure) save(figure, mm, name_of_figure(chart));
    });
    return made;
  };
  const tools = element('div', {class: 'save controls'}, element('label', {}, 'Save figure ', width),
      element('span', {class: 'buttons'}, button('SVG', (figure, mm, name) => save_blob(new Blob([new XMLSerializer().serializeToString(figure)], {type: 'image/svg+xml'}), name + '.svg')), ' ',
              button('PDF', (figure, mm, name) => print_figure(figure, name)), ' ', button('PNG', (figure, mm, name) => save_png(figure, mm, name + '.png'))));
  chart.after(tools);
  // Nothing is offered where nothing is drawn.
  const renew = () => { tools.hidden = !chart.querySelector('svg'); };
  new MutationObserver(renew).observe(chart, {childList: true, subtree: true});
  renew();
}

// A view is a picture in any case.
for (const view of orbit.views) {
  if (!view.renderer) continue;
  const save = element('button', {type: 'button', title: 'Save this view as PNG, 85 mm wide'}, 'PNG');
  save.addEventListener('click', () => save_canvas(view.picture(Math.round(widths_mm[0] * print_dots_of_mm)), name_of_figure(view.stage) + '.png'));
  view.caption.after(element('div', {class: 'save controls'}, 'Save view ', save));
}
