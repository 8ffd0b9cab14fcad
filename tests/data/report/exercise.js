// Put into a copy of the page by the test: uses each control and writes what it saw into the page.
'use strict';
const seen = {errors: [], steps: []};
window.addEventListener('error', e => seen.errors.push(String(e.message)));
for (const level of ['error', 'warn']) console[level] = (...words) => seen.errors.push(words.join(' '));

window.addEventListener('load', () => setTimeout(() => {
  const by = id => document.getElementById(id);
  // What stands where, before anything is chosen.
  seen.sections = [...document.querySelectorAll('main > section')].map(section => section.id);
  seen.links = [...document.querySelectorAll('nav a')].map(link => link.getAttribute('href').slice(1));
  seen.parts = [...document.querySelectorAll('#answers_body > h3')].map(title => title.textContent);
  // The share of pixels that are not white, and a number that changes with the picture.
  const look = stage => {
    const canvas = by(stage).querySelector('canvas');
    if (!canvas) return {filled: 0, sum: 0};
    const small = document.createElement('canvas');
    small.width = small.height = 64;
    const pen = small.getContext('2d');
    // The views are transparent where nothing is: by day the page behind them is white.
    pen.fillStyle = '#fff';
    pen.fillRect(0, 0, 64, 64);
    pen.drawImage(canvas, 0, 0, 64, 64);
    const bytes = pen.getImageData(0, 0, 64, 64).data;
    let filled = 0, sum = 0;
    for (let i = 0; i < bytes.length; i += 4) {
      if (bytes[i] + bytes[i + 1] + bytes[i + 2] < 720) ++filled;
      sum = (sum * 31 + bytes[i] + 7 * bytes[i + 1] + 13 * bytes[i + 2]) % 1000000007;
    }
    return {filled: filled / 4096, sum};
  };
  const step = (name, change, of) => {
    const before = of();
    try { change(); } catch (failure) { seen.errors.push(name + ': ' + failure); }
    seen.steps.push({name, changed: JSON.stringify(before) !== JSON.stringify(of())});
  };
  const choose = (id, index) => {
    const select = by(id);
    select.selectedIndex = index;
    select.dispatchEvent(new Event('change'));
  };
  const both = () => [look('stage_a').sum, look('stage_b').sum, by('legend').innerHTML.length];
  const key = (name, stage) => by(stage).querySelector('canvas').dispatchEvent(new KeyboardEvent('keydown', {key: name, cancelable: true}));
  seen.blank = ['stage_a', 'stage_b', 'stage_trial'].filter(stage => look(stage).filled < 0.02);
  step('drag with arrows turns both views', () => key('ArrowLeft', 'stage_a'), () => look('stage_b').sum);
  step('plus comes nearer', () => key('+', 'stage_b'), () => look('stage_a').sum);
  step('home', () => key('Home', 'stage_a'), both);
  step('left', () => by('view_left').click(), both);
  step('right', () => by('view_right').click(), both);
  step('front', () => by('view_front').click(), both);
  step('wheel', () => by('stage_a').querySelector('canvas').dispatchEvent(new WheelEvent('wheel', {deltaY: 300, cancelable: true})), both);
  step('click tells a value', () => {
    const canvas = by('stage_a').querySelector('canvas'), box = canvas.getBoundingClientRect();
    const at = {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2, pointerId: 1, bubbles: true};
    canvas.setPointerCapture = () => {};
    canvas.dispatchEvent(new PointerEvent('pointerdown', at));
    canvas.dispatchEvent(new PointerEvent('pointerup', at));
  }, () => by('caption_a').textContent);
  for (const panel of ['a', 'b'])
    for (const select of [...by('pick_' + panel).querySelectorAll('select')])
      if (select.options.length > 1)
        step(select.id, () => choose(select.id, select.selectedIndex ? 0 : 1), () => [look('stage_' + panel).sum, by('caption_' + panel).textContent]);
  step('weighting', () => choose('map_weighting', 1), () => by('legend').textContent);
  step('weighting back', () => choose('map_weighting', 0), () => by('legend').textContent);
  step('own scale', () => choose('map_scale', 1), () => by('legend').textContent);
  step('common scale', () => choose('map_scale', 0), () => by('legend').textContent);
  step('cividis', () => choose('map_colours', 1), both);
  step('viridis', () => choose('map_colours', 0), both);
  if (!by('map_kind').options[1].disabled) {
    step('differences', () => choose('map_kind', 1), both);
    step('significant clusters', () => choose('map_clusters', 1), both);
    step('all differences', () => choose('map_clusters', 0), both);
    step('densities', () => choose('map_kind', 0), both);
  }
  if (!by('map_kind').options[2].disabled) {
    step('exposure', () => choose('map_kind', 2), both);
    step('the other quantity', () => choose('pick_a_quantity', 1), () => [look('stage_a').sum, by('caption_a').textContent]);
    step('densities again', () => choose('map_kind', 0), both);
  }
  step('unit of figure 5', () => choose('unit5', 1), () => by('figure5').textContent);
  const trial = () => [by('trial_caption').textContent, by('trace').innerHTML.length];
  step('next trial', () => by('trial_after').click(), trial);
  step('trial before', () => by('trial_before').click(), trial);
  step('trial by list', () => choose('trial', by('trial').options.length - 1), trial);
  const overlay = () => [by('stage_trial').querySelector('svg').innerHTML, look('stage_trial').sum];
  step('time', () => { by('time').value = 2.5; by('time').dispatchEvent(new Event('input')); }, overlay);
  seen.turned = seen.steps[seen.steps.length - 1].changed;
  step('only the running fixation', () => by('all_fixations').click(), overlay);
  step('copy', () => by('copy_methods').click(), () => 0);
  seen.steps.pop();
  seen.traces = {trials: by('trial').options.length, without: 0, said: by('traces_shown').textContent};
  for (let i = 0; i < by('trial').options.length; ++i) { choose('trial', i); seen.traces.without += by('trace').querySelector('svg') ? 0 : 1; }
  by('all_traces_box').open = true;
  by('all_traces_box').dispatchEvent(new Event('toggle'));
  step('a trace of all', () => by('all_traces').firstChild.click(), trial);

  choose('unit5', 0);
  // Tables: sorting, the filter, and the file of what is shown.
  const figure5 = by('table_figure_5'), heads = [...figure5.querySelectorAll('thead th')], named = name => heads.findIndex(h => h.textContent.startsWith(name));
  const column = at => [...figure5.querySelectorAll('tbody tr')].map(row => row.children[at].firstChild.textContent);
  const wss = named('mean WSS'), var_z = named('Var z');
  const press = at => heads[at].querySelector('button').click();
  const sorts = () => heads.map(h => h.getAttribute('aria-sort')).join();
  seen.factors = heads.map(h => h.textContent);
  seen.focusable = heads.every(h => h.querySelector('button').tabIndex === 0);
  seen.sorted = {before: column(var_z), sorts: [sorts()]};
  press(var_z); seen.sorted.up = column(var_z); seen.sorted.sorts.push(sorts());
  press(var_z); seen.sorted.down = column(var_z); seen.sorted.sorts.push(sorts());
  press(var_z); seen.sorted.after = column(var_z); seen.sorted.sorts.push(sorts());
  press(named('material'));
  const filter = figure5.querySelector('input');
  filter.value = 'ROUGH free';
  filter.dispatchEvent(new Event('input'));
  seen.filtered = {rows: column(named('material')), said: figure5.querySelector('output').textContent};
  // What is in a blob, a letter a byte, at once: virtual time goes on while a promise of a blob waits for another thread.
  const bytes_of = blob => {
    const request = new XMLHttpRequest(), url = URL.createObjectURL(blob);
    request.open('GET', url, false);
    request.overrideMimeType('text/plain; charset=x-user-defined');
    request.send();
    URL.revokeObjectURL(url);
    return Uint8Array.from(request.responseText, letter => letter.charCodeAt(0) & 255);
  };
  const text_of = blob => new TextDecoder().decode(bytes_of(blob));
  const kept = {make: URL.createObjectURL, click: HTMLAnchorElement.prototype.click};
  let file = null;
  URL.createObjectURL = blob => { file = blob; return '#'; };
  HTMLAnchorElement.prototype.click = function() { seen.file = this.download; };
  [...figure5.querySelectorAll('.tools button')].pop().click();
  URL.createObjectURL = kept.make;
  HTMLAnchorElement.prototype.click = kept.click;
  seen.csv = text_of(file);
  filter.value = '';
  filter.dispatchEvent(new Event('input'));

  // What does not fit: a page wider than its window, texts of charts that leave them or lie on each other.
  seen.too_wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  seen.texts_apart = [];
  let texts_of_charts = 0;
  for (const svg of document.querySelectorAll('svg[role=img]')) {
    const page = svg.getBoundingClientRect(), texts = [...svg.querySelectorAll('text')].map(t => ({t: t.textContent, r: t.getBoundingClientRect()}));
    texts_of_charts += texts.length;
    texts.forEach(({t, r}, i) => {
      if (r.left < page.left - 1 || r.right > page.right + 1 || r.top < page.top - 1 || r.bottom > page.bottom + 1) seen.texts_apart.push(`'${t}' leaves its chart`);
      for (const other of texts.slice(0, i)) {
        const across = Math.min(r.right, other.r.right) - Math.max(r.left, other.r.left), down = Math.min(r.bottom, other.r.bottom) - Math.max(r.top, other.r.top);
        if (across > 1 && down > 2) seen.texts_apart.push(`'${t}' lies on '${other.t}'`);
      }
    });
  }
  seen.texts_of_charts = texts_of_charts;

  // Each figure is saved in both widths, as its buttons do, and read again without the page's style sheet.
  const files = [], told = [];
  URL.createObjectURL = blob => { files.push(blob); return '#'; };
  HTMLAnchorElement.prototype.click = function() { told.push(this.download); };
  const wanted = [];
  for (const tools of document.querySelectorAll('.save')) {
    const svg_button = [...tools.querySelectorAll('button')].find(b => b.textContent === 'SVG');
    if (!svg_button || tools.hidden || tools.closest('[hidden]')) continue;
    for (const mm of ['85', '170']) {
      tools.querySelector('select').value = mm;
      svg_button.click();
      wanted.push(mm);
    }
  }
  URL.createObjectURL = kept.make;
  HTMLAnchorElement.prototype.click = kept.click;
  seen.figures = [];
  files.forEach((blob, i) => {
    const text = text_of(blob), read = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement, room = element('div', {style: 'position:absolute;left:0;top:0;visibility:hidden'});
    // Apart from the page's rules for drawings.
    room.attachShadow({mode: 'open'}).append(document.importNode(read, true));
    document.body.append(room);
    const drawing = room.shadowRoot.firstChild, page = drawing.getBoundingClientRect(), texts = [...drawing.querySelectorAll('text')].map(t => t.getBoundingClientRect());
    seen.figures.push({name: told[i], wanted: wanted[i], width: read.getAttribute('width'), pixels_wide: Number(read.getAttribute('viewBox').split(' ')[2]), texts: texts.length,
      of_the_page: [...text.matchAll(/var\(|class=|NaN|undefined/g)].map(m => m[0]),
      unpainted: [...drawing.querySelectorAll('text')].filter(t => !/^#[0-9a-f]{6}$/.test(t.getAttribute('fill')) || t.getAttribute('font-size') !== '12px').length,
      apart: texts.filter(r => r.left < page.left - 1 || r.right > page.right + 1 || r.top < page.top - 1 || r.bottom > page.bottom + 1).length});
    room.remove();
  });
  const dot = element('canvas', {width: 2, height: 1});
  const drawn = Uint8Array.from(atob(dot.toDataURL('image/png').split(',')[1]), letter => letter.charCodeAt(0));
  seen.png = [...bytes_of(with_size(drawn))];
  seen.stuck = getComputedStyle(heads[0]).position;
  step('play', () => by('play').click(), () => by('play').textContent);
  setTimeout(() => {
    seen.played = Number(by('time').value);
    by('play').click();
    seen.bad_texts = ['NaN', 'undefined', '[object', 'Infinity'].filter(word => document.body.innerText.includes(word));
    seen.svg_nan = [...document.querySelectorAll('svg *')].filter(s => [...s.attributes].some(a => a.value.includes('NaN'))).length;
    const note = document.createElement('script');
    note.type = 'application/json';
    note.id = 'seen';
    note.textContent = JSON.stringify(seen);
    document.body.append(note);
    if (parent !== window) parent.postMessage(note.textContent, '*');
  }, 600);
}, 300));
