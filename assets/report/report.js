// What stands where in the report, and what its controls do.

const data = JSON.parse(document.getElementById('data').textContent);
const by_id = id => document.getElementById(id);
const colour_tables = Object.fromEntries(Object.entries(data.colours).map(([name, text]) => [name, bytes_of(text)]));
const words = keys => keys.map(([column, value]) => `${column} ${value}`).join(', ') || 'all';
const short = keys => keys.map(key => key[1]).join(', ') || 'all';
const level = `${Math.round(100 * data.confidence)} % interval`;

function fill(select, options) {
  select.replaceChildren(...options.map(([value, text]) => element('option', {value}, text)));
}

// At a glance.
{
  const g = data.glance;
  by_id('title').textContent = g.title || 'Gaze on surfaces';
  by_id('subtitle').textContent = g.simulated ? 'Gaze of simulated observers: no measurement of people.' : 'Measured gaze.';
  const card = (value, text) => by_id('cards').append(element('div', {class: 'card'}, element('b', {}, value), element('span', {}, text)));
  card(g.observers, 'observers');
  card(g.trials, 'trials' + (g.excluded ? `, ${g.excluded} excluded` : ''));
  card(g.samples.toLocaleString('en'), 'gaze samples');
  card(g.counted.toLocaleString('en'), `fixations counted of ${g.fixations.toLocaleString('en')}`);
  card(digits(g.seconds / 60), 'minutes of fixation');
  card(data.maps.filter(m => m.values && m.by === 'duration').length, 'maps');
  for (const remark of data.remarks) by_id('remarks').append(element('p', {class: 'remark'}, remark));
}

// Maps.
const kind = by_id('map_kind'), weighting = by_id('map_weighting'), scale = by_id('map_scale'), colours = by_id('map_colours'), clusters_shown = by_id('map_clusters');
const alpha = 1 - data.confidence;
const common = {};
for (const w of ['duration', 'count']) common[w] = Math.max(1e-300, ...data.maps.filter(m => m.by === w && m.values).map(m => m.peak));
const exposure_kinds = {exposure: ['exposure', 'share of the exposure per mm²'], seconds: ['time visible', 's of a presentation']};
for (const what of Object.keys(exposure_kinds)) common[what] = Math.max(1e-300, ...data.sculptures.filter(s => s[what]).map(s => s[what].most));
const common_difference = Math.max(1e-300, ...data.differences.filter(d => d.values).map(d => d.most));

class Panel {
  constructor(letter, first) {
    this.picks = by_id('pick_' + letter);
    this.caption = by_id('caption_' + letter);
    this.caption.append(element('span'), element('span', {role: 'status'}));
    this.view = new MapView(by_id('stage_' + letter), this.caption);
    this.letter = letter;
    this.chosen = {};
    this.first = first;
    this.rebuild();
  }
  // Selects for the factors of the maps, or one for the differences.
  rebuild() {
    this.picks.replaceChildren();
    const add = (name, options) => {
      const select = element('select', {id: `pick_${this.letter}_${name}`});
      fill(select, options);
      if (this.chosen[name] !== undefined && options.some(o => o[0] === this.chosen[name])) select.value = this.chosen[name];
      this.chosen[name] = select.value;
      select.addEventListener('change', () => { this.chosen[name] = select.value; this.show(); if (kind.value === 'exposure') draw_legend(panels); });
      this.picks.append(element('label', {}, name + ' ', select));
    };
    if (kind.value === 'exposure') {
      add('sculpture', data.sculptures.map((s, i) => [String(i), s.title || s.id]));
      if (this.first && this.chosen.quantity === undefined) this.chosen.quantity = 'seconds';
      add('quantity', Object.entries(exposure_kinds).map(([what, texts]) => [what, texts[0]]));
    } else if (kind.value === 'difference') {
      const options = data.differences.map((d, i) => [String(i), `${data.sculptures[d.sculpture].title}: ${words(d.keys)}, ${d.a} less ${d.b}`]);
      add('difference', options);
      if (this.first && options.length > 1 && this.chosen.seen === undefined) {
        this.chosen.seen = true;
        this.picks.querySelector('select').selectedIndex = Math.min(this.first, options.length - 1);
        this.chosen.difference = this.picks.querySelector('select').value;
      }
    } else {
      const columns = data.by.filter(c => c !== 'sculpture');
      const values = column => [...new Set(data.groups.flatMap(g => g.keys.filter(k => k[0] === column).map(k => k[1])))];
      add('sculpture', data.sculptures.map((s, i) => [String(i), s.title || s.id]));
      columns.forEach((column, i) => {
        const list = values(column).map(v => [v, v]);
        if (this.first && this.chosen[column] === undefined && i === columns.length - 1 && list.length > 1) this.chosen[column] = list[1][0];
        add(column, list);
      });
    }
    this.show();
  }
  map() {
    if (kind.value === 'exposure') {
      const sculpture = Number(this.chosen.sculpture), found = data.sculptures[sculpture] && data.sculptures[sculpture][this.chosen.quantity];
      return found ? {sculpture, ...found} : null;
    }
    if (kind.value === 'difference') return data.differences[Number(this.chosen.difference)];
    return data.maps.find(m => m.by === weighting.value && m.sculpture === Number(this.chosen.sculpture) &&
                               data.groups[m.group].keys.every(([c, v]) => c === 'sculpture' || this.chosen[c] === v));
  }
  show() {
    const map = this.map(), [text, here] = this.caption.children;
    here.textContent = '';
    const index = map ? map.sculpture : Number(this.chosen.sculpture || 0);
    const sculpture = data.sculptures[index], geometry = sculpture ? geometry_of(sculpture, index) : null;
    if (!map || !map.values) {
      text.textContent = (map && map.absent) || (sculpture && sculpture.remark) || 'There is no map of these.';
      this.view.show(geometry, null, colour_tables.viridis, null);
      return;
    }
    const coarse = sculpture.mesh.vertices < sculpture.mesh.of ?
        ` Shown with ${sculpture.mesh.vertices.toLocaleString('en')} of ${sculpture.mesh.of.toLocaleString('en')} vertices.` : '';
    if (kind.value === 'exposure') {
      const [name, unit] = exposure_kinds[this.chosen.quantity], most = scale.value === 'own' ? map.most : common[this.chosen.quantity];
      const values = Float32Array.from(bytes_of(map.values), q => q / 255 * map.most / most);
      const all = data.tables.exposures.find(e => e.sculpture === index && e.part === 'all');
      text.textContent = (this.chosen.quantity === 'exposure' ? 'Where gaze would lie that is spread evenly over the picture all the time, blurred as the maps are'
                                                              : 'How long each place is visible in one presentation') +
          `; highest ${digits(map.most)} ${unit}` + (all ? `; ${percent(all.never)} of the surface is never visible` : '') + '.' + coarse;
      this.view.show(geometry, values, colour_tables[colours.value], v => `${digits(v * most)} ${unit}`);
    } else if (kind.value === 'difference') {
      const coded = numbers_of(map.values, Int8Array), most = scale.value === 'own' ? map.most : common_difference;
      const of_cluster = bytes_of(map.cluster), is_significant = n => n > 0 && map.clusters[n - 1] && map.clusters[n - 1].p <= alpha;
      const values = Float32Array.from(coded, (q, v) => clusters_shown.value === 'all' || is_significant(of_cluster[v]) ? 0.5 + 0.5 * q / 127 * map.most / most : 0.5);
      const clusters = map.clusters.filter(c => c.p <= alpha).length;
      text.textContent = `${map.a} less ${map.b}, ${map.observers} observers; ${clusters} of ${map.clusters.length} clusters with corrected p at most ` +
          `${digits(alpha, 2)} (|t| above ${digits(map.threshold)}).` +
          (map.least_p > alpha + 1e-9 ? ` So many observers can give no p below ${digits(map.least_p)}.` : '') + coarse;
      this.view.show(geometry, values, colour_tables.coolwarm, (value, v) => {
        const n = of_cluster[v], c = n ? map.clusters[n - 1] : null;
        return `${digits((2 * value - 1) * most)} of the fixation time per mm²` + (c ? `, in cluster ${n} (${digits(c.area)} mm², p ${p_text(c.p)})` : ', in no cluster');
      });
    } else {
      const unit = map.by === 'duration' ? 'ms/mm²' : 'fixations/mm²', most = scale.value === 'own' ? map.peak : common[map.by];
      const values = Float32Array.from(bytes_of(map.values), q => q / 255 * map.peak / most);
      text.textContent = `${map.observers} observers, ${map.trials} trials, ${map.fixations} fixations; peak ${digits(map.peak)} ${unit} a trial; ` +
          `kernel sigma ${digits(map.sigma[0])} to ${digits(map.sigma[1])} mm` +
          (map.leak !== null ? `; a Euclidean kernel would put ${percent(map.leak)} beyond three sigmas along the surface` : '') +
          (map.error.together !== null ? `; uncertainty of a place ${mm_text(map.error.together)} mm` : '') + '.' + coarse;
      this.view.show(geometry, values, colour_tables[colours.value], v => `${digits(v * most)} ${unit} a trial`);
    }
  }
}

function draw_legend(panels) {
  const is_difference = kind.value === 'difference', is_exposure = kind.value === 'exposure', name = is_difference ? 'coolwarm' : colours.value;
  const canvas = element('canvas', {width: 256, height: 1}), pen = canvas.getContext('2d'), line = pen.createImageData(256, 1);
  for (let i = 0; i < 256; ++i) for (let c = 0; c < 4; ++c) line.data[4 * i + c] = c < 3 ? colour_tables[name][3 * i + c] : 255;
  pen.putImageData(line, 0, 0);
  const quantities = is_exposure ? [...new Set(panels.map(p => p.chosen.quantity))] : [];
  const most = is_difference ? common_difference : is_exposure ? common[quantities[0]] : common[weighting.value];
  const unit = is_difference ? 'share of fixation time per mm²' : is_exposure ? quantities.map(q => `${exposure_kinds[q][0]}: ${digits(common[q])} ${exposure_kinds[q][1]}`).join('; at the right end ') :
               weighting.value === 'duration' ? 'ms of fixation per mm² and trial' : 'fixations per mm² and trial';
  const svg = shape('svg', {width: 760, height: 62, viewBox: '0 0 760 62', role: 'img', 'aria-label': 'Legend: ' + unit});
  svg.append(shape('image', {href: canvas.toDataURL(), x: 10, y: 6, width: 300, height: 18, preserveAspectRatio: 'none'}));
  if (scale.value === 'common' && quantities.length < 2)
    for (const v of ticks(is_difference ? -most : 0, most, 4))
      svg.append(shape('text', {x: 10 + 300 * (is_difference ? 0.5 + 0.5 * v / most : v / most), y: 39, 'text-anchor': 'middle'}, digits(v)));
  else svg.append(shape('text', {x: 10, y: 39}, 'lowest'), shape('text', {x: 310, y: 39, 'text-anchor': 'end'}, scale.value === 'common' ? 'highest' : 'highest of each map'));
  svg.append(shape('text', {x: 10, y: 57, class: 'soft'}, unit + (scale.value === 'common' ? ', one scale for all maps' : ', each map its own scale')));
  svg.append(shape('rect', {x: 350, y: 6, width: 18, height: 18, fill: 'rgb(150,150,150)'}), shape('text', {x: 374, y: 20}, 'never visible'));
  const low = is_difference ? 128 : 0, c = colour_tables[name];
  svg.append(shape('rect', {x: 476, y: 6, width: 18, height: 18, fill: `rgb(${c[3 * low]},${c[3 * low + 1]},${c[3 * low + 2]})`}),
             shape('text', {x: 500, y: 20}, is_difference ? 'no difference' : is_exposure ? 'hardly visible' : 'visible, not looked at'));
  by_id('legend').replaceChildren(svg);
}

if (!data.differences.some(d => d.values)) kind.querySelector('[value=difference]').disabled = true;
if (!data.sculptures.some(s => s.exposure || s.seconds)) kind.querySelector('[value=exposure]').disabled = true;
const panels = [new Panel('a', 0), new Panel('b', 1)];
const renew = rebuild => { for (const p of panels) rebuild ? p.rebuild() : p.show(); draw_legend(panels); };
kind.addEventListener('change', () => {
  weighting.disabled = kind.value !== 'density';
  colours.disabled = kind.value === 'difference';
  clusters_shown.disabled = kind.value !== 'difference';
  renew(true);
});
for (const select of [weighting, scale, colours, clusters_shown]) select.addEventListener('change', () => renew(false));
by_id('view_front').addEventListener('click', () => orbit.look(0));
by_id('view_left').addEventListener('click', () => orbit.look(-1.1));
by_id('view_right').addEventListener('click', () => orbit.look(1.1));
draw_legend(panels);

// Figure 4: clusters of the first column, bars of the last.
{
  const rows = data.tables.heads, full = rows.filter(r => r.keys.length === data.by.length && r.keys.length);
  const single = rows.filter(r => r.keys.length === 1);
  const charted = single.length ? single : full, clusters = new Map();
  for (const row of charted) {
    const name = row.keys.length === 1 ? row.keys[0][0] : row.keys[0][1];
    if (!clusters.has(name)) clusters.set(name, []);
    clusters.get(name).push({label: row.keys.length === 1 ? row.keys[0][1] : short(row.keys.slice(1)), estimate: row.count, each: row.each});
  }
  if (rows.length) {
    by_id('figure4_chart').append(bars([...clusters].map(([name, list]) => ({name, bars: list})),
                                       {y_label: 'share of fixations on the head', most: 1, label: 'Figure 4: share of fixations on the head'}));
    by_id('figure4_table').append(table([{text: 'condition'}, 'by count, mean over observers', 'by duration', 'corrected for tracker error', 'pooled', 'observers', 'trials', 'fixations'],
        rows.map(r => [words(r.keys), estimate_text(r.count), estimate_text(r.duration), estimate_text(r.corrected), digits(r.pooled), r.observers, r.trials, r.fixations]),
        `Dots: single observers. In brackets the ${level} over observers. Pooled: all fixations as if they were independent, as in the paper's figure 4. The paper's numbers are raw shares (by count, pooled); corrected: the share under which the measured places are most probable, given the tracker's error.`));
  } else by_id('figure4_chart').append(element('p', {class: 'note'}, 'No sculpture has a part named "head".'));
}

// Figure 5.
function draw_figure5() {
  const deg = by_id('unit5').value === 'deg', rows = data.tables.distributions;
  const wss = r => (deg ? r.wss_deg : r.wss), unit = deg ? 'deg²' : 'mm²';
  const most = Math.max(1e-9, ...rows.map(r => Math.max(wss(r).v || 0, wss(r).hi || 0)));
  const clusters = new Map();
  for (const row of rows) {
    const keys = data.groups[row.group].keys, name = keys.length ? keys[0][1] : 'all';
    if (!clusters.has(name)) clusters.set(name, []);
    const rest = keys.slice(1).map(k => k[1]);
    if (!data.by.includes('sculpture')) rest.unshift(data.sculptures[row.sculpture].id);
    clusters.get(name).push({label: rest.join(', ') || data.sculptures[row.sculpture].id, estimate: wss(row)});
  }
  by_id('figure5_chart').replaceChildren(bars([...clusters].map(([name, list]) => ({name, bars: list})),
      {y_label: 'mean WSS / ' + unit, most: 1.05 * most, label: 'Figure 5: mean within-cluster sum of squares'}));
  by_id('figure5_table').replaceChildren(table([{text: 'condition'}, {text: 'sculpture'}, `mean WSS / ${unit}`, 'Var x', 'Var y', 'Var z', 'map: peak', 'map: mean', 'observers', 'fixations'],
      rows.map(r => [words(data.groups[r.group].keys), data.sculptures[r.sculpture].title, estimate_text(wss(r), 4),
                     ...(deg ? r.variance_deg : r.variance).map(v => digits(v, 4)), digits(r.peak), digits(r.mean), r.observers, r.fixations]),
      `Mean WSS is the sum of the variances along x, y and z (1/N). In brackets the ${level} over observers; peak and mean of the map in ms/mm² a trial.`));
}
by_id('unit5').addEventListener('change', draw_figure5);
draw_figure5();

// Table 1.
{
  const rows = data.tables.pairs;
  by_id('table1_body').append(rows.length ? table(
      [{text: 'pair (a, b)'}, 'WSS a - b / deg²', 'its p', 'p after Holm', 'CC of all maps', 'its p', 'p after Holm', 'CC', 'halves of a and b', 'halves of one', 'SIM', 'halves of a and b', 'halves of one', 'observers'],
      rows.map(r => [`${words(r.keys)}: ${r.a}, ${r.b}` + (r.absent ? ` (${r.absent})` : ''), estimate_text(r.wss_deg), p_text(r.p), p_text(r.holm),
                     digits(r.maps_cc), p_text(r.maps_p), p_text(r.maps_holm), ...[r.cc, r.sim].flatMap(s => [estimate_text(s.value), estimate_text(s.between), estimate_text(s.within)]), r.observers]),
      `WSS, CC and SIM are of one observer and one sculpture, then averaged; in brackets the ${level} over observers. CC of all maps: the maps of all observers are added up for each level. ` +
      'Whether maps differ is told by its p, for which an observer\'s two levels are swapped, whole maps at once; for the p of WSS the signs of observers\' differences are flipped. After Holm: corrected for the rows of the table, those over all groups apart. ' +
      'A similarity grows with the number of fixations and is below 1 even where nothing differs. Halves all have as many fixations, so those of a and b can be held against two halves of one level. ' +
      'The latter are somewhat more alike even without a difference where the fixations of a trial share an error of calibration. SIM: maps scaled from 0 to 1 first (MIT benchmark); table1_pairs has it without scaling, too.')
      : element('p', {class: 'note'}, 'There is no factor whose levels the same observers saw on the same sculpture.'));
}

// Maps of differences, cluster by cluster.
{
  const maps = data.differences, rows = [];
  for (const d of maps) {
    const name = words(d.keys), where = data.sculptures[d.sculpture], pair = `${d.a} less ${d.b}`;
    if (!d.values || !d.clusters.length) rows.push([name, where.title, pair, d.observers, d.absent || 'no vertex beyond the threshold', 'n/a', 'n/a', 'n/a', 'n/a', 'n/a', p_text(d.least_p)]);
    d.clusters.forEach((c, i) => {
      // Small ones are in the table of clusters.
      if (i > 0 && c.p > 0.2) return;
      rows.push([name, where.title, pair, d.observers, (c.part !== null ? where.parts[c.part] : 'n/a') + `, cluster ${i + 1} of ${d.clusters.length}`,
                 digits(c.area), c.centre.map(mm_text).join(', '), percent(c.difference), p_text(c.p), p_text(c.p_all), p_text(d.least_p)]);
    });
  }
  by_id('differences').hidden = rows.length === 0;
  if (rows.length) by_id('differences_body').append(table(
      [{text: 'condition'}, {text: 'sculpture'}, {text: 'difference'}, 'observers', {text: 'where'}, 'area / mm²', 'centre / mm', 'of the fixation time', 'p', 'p over all maps', 'smallest p there can be'], rows,
      'Each observer with fixations in both conditions gives a map of differences; clusters of vertices with a t beyond the threshold are tested by flipping the signs of ' +
      'observers\' maps (largest cluster, sum of t times area). p holds for the whole surface of one sculpture; "over all maps" also for all rows (Bonferroni). ' +
      'Shown are the largest cluster of each map, and others with p up to 0.2.'));
}

// Exposure, prediction, reliability, errors.
{
  const t = data.tables, title = r => data.sculptures[r.sculpture].title, condition = r => words(data.groups[r.group].keys);
  const put = (id, rows, make) => {
    by_id(id).hidden = by_id(id).previousElementSibling.hidden = rows.length === 0;
    if (rows.length) by_id(id).append(make());
  };
  put('exposure_body', t.exposures, () => table(
      [{text: 'sculpture'}, {text: 'part'}, 'area / mm²', 'of the area', 'of the exposure', 'of the fixations', 'visible / s', 'never visible', 'mean cosine of view'],
      t.exposures.map(e => [title(e), e.part, digits(e.area), percent(e.share_of_area), percent(e.share), percent(e.fixations), digits(e.seconds), percent(e.never), digits(e.foreshortening)]),
      'What one presentation shows of each part: the exposure is the share of time and picture area that a part fills among all that shows the sculpture. Gaze that looks at all of the picture alike has the same share of fixations.'));
  put('predictions_body', t.predictions, () => table(
      [{text: 'condition'}, {text: 'sculpture'}, {text: 'predicted by'}, 'KL / nat', 'NSS', 'AUC (Judd)', 'AUC (Borji)', 'gain over exposure / bit', 'gain over even gaze / bit', 'observers'],
      t.predictions.map(r => [condition(r), title(r), r.by + (r.level ? ': ' + r.level : ''), ...['kl', 'nss', 'auc', 'borji', 'gain', 'gain_area'].map(k => estimate_text(r[k])), r.observers]),
      'Each observer\'s fixations are told from a map of other observers, in the same condition or in another one, or from the exposure alone. A material that gaze does not care about is predicted as well by another material as by itself.'));
  put('reliability_body', t.reliabilities, () => table(
      [{text: 'condition'}, {text: 'sculpture'}, 'CC of halves', 'reliability', 'observers', 'fixations'],
      t.reliabilities.map(r => [words(r.keys), title(r), estimate_text(r.split), estimate_text(r.reliability), r.observers, r.fixations]),
      'Correlation of the maps of random halves of the observers, and of all observers after Spearman and Brown; the interval is by leaving out each observer in turn.'));
  const errors = data.maps.filter(m => m.by === 'duration' && m.values);
  put('errors_body', errors, () => table(
      [{text: 'condition'}, {text: 'sculpture'}, 'accuracy / mm', 'precision / mm', 'timing / mm', 'look-up / mm', 'together / mm', 'kernel sigma / mm', 'Euclidean leak', 'cone beyond an edge', 'samples near an edge'],
      errors.map(m => [condition(m), title(m), ...['accuracy', 'precision', 'timing', 'lut', 'together'].map(k => mm_text(m.error[k])), `${digits(m.sigma[0])} to ${digits(m.sigma[1])}`,
                       percent(m.leak), percent(m.error.at_edge), percent(m.error.near_edge)]),
      'Root mean squares over the fixations, along the surface. Accuracy: the gaze cone of the validation before each trial. Precision: of a single sample (RMS-S2S divided by the root of 2). ' +
      'Timing: uncertainty of the clocks times the speed of the surface under gaze. An edge is where the sculpture ends or another sheet of it begins.'));
  by_id('metrics').hidden = !t.exposures.length && !t.predictions.length && !t.reliabilities.length && !errors.length;
}

// Effects of the factors.
{
  const rows = data.tables.effects;
  if (rows.length) by_id('effects_body').append(
      table([{text: 'measure'}, {text: 'effect'}, 'p', 'p after Holm', 'observers', {text: 'remark'}],
            rows.map(r => [r.measure, r.effect.replace(':', ' × '), p_text(r.p), p_text(r.holm), r.observers, r.absent || (r.least > alpha + 1e-9 ? `so many observers can give no p below ${digits(r.least)}` : '')]),
            'Of trials: the share of counted fixations on the head, and the logarithm of WSS. Permutations within observers: of a factor the levels are exchanged, of two together (×) the signs of whole observers. ' +
            'Holm: corrected over the rows of the same measure. Mixed models (lme4): run mixed_models.R beside this page.'));
  else by_id('effects').hidden = true;
}

// Gaze and the moving surface.
{
  const rows = data.tables.motions, found = rows.filter(r => r.gain.v !== null), clusters = new Map();
  for (const row of found) {
    const name = row.keys.length ? row.keys[0][0] : 'all';
    if (!clusters.has(name)) clusters.set(name, []);
    clusters.get(name).push({label: row.keys.length ? row.keys[0][1] : 'all', estimate: row.gain});
  }
  if (found.length) {
    by_id('motion_chart').append(bars([...clusters].map(([name, list]) => ({name, bars: list})),
        {y_label: 'gain of gaze along the surface', most: Math.max(1.1, ...found.map(r => r.gain.hi ?? r.gain.v)), least: Math.min(0, ...found.map(r => r.gain.lo ?? r.gain.v)), label: 'Gain of gaze along the motion of the surface'}));
    by_id('motion_body').append(table([{text: 'condition'}, 'gain', 'speed of the surface / (deg/s)', 'observers', 'fixations'],
        rows.map(r => [words(r.keys), estimate_text(r.gain), estimate_text(r.speed), r.observers, r.fixations]),
        `While a fixation lasts the sculpture turns on. Gain 1: gaze goes with the place that it looks at; 0: it stays on the screen. In brackets the ${level} over observers.`));
  } else by_id('motion').hidden = true;
}

// Light at gaze.
{
  const rows = data.tables.lights, found = rows.filter(r => r.met.v !== null);
  if (found.length) {
    const of = (name, key) => ({name, bars: found.filter(r => r[key].v !== null).map(r => ({label: r.keys.length ? r.keys[0][1] : 'all', estimate: r[key]}))});
    const groups = [of('than at the same place of the screen', 'place'), of('than on the same point of the surface', 'point')].filter(g => g.bars.length);
    const all = groups.flatMap(g => g.bars.map(b => b.estimate));
    by_id('light_chart').append(bars(groups,
        {y_label: 'more lightness met (SD)', most: Math.max(0.1, ...all.map(e => e.hi ?? e.v)), least: Math.min(0, ...all.map(e => e.lo ?? e.v)), label: 'How much brighter what gaze met was than the same places at other times'}));
    by_id('light_body').append(table([{text: 'condition'}, 'lightness met', 'more than at the place of the screen', 'more than on the point of the surface', 'observers', 'fixations'],
        rows.map(r => [words(r.keys), estimate_text(r.met), estimate_text(r.place), estimate_text(r.point), r.observers, r.fixations]),
        `Lightness in standard deviations from its mean over the object in the same picture; gaze that is spread evenly over the object has 0. Highlights that stay while the surface turns beneath them, and are looked at, make the fourth column positive: the points were bright when gaze was on them, and are darker at other times. In brackets the ${level} over observers.`));
  } else by_id('light').hidden = true;
}

// Time course.
{
  const rows = data.tables.course.filter(r => r.head.v !== null);
  if (rows.length) {
    const end = Math.max(...rows.map(r => r.to)), names = [...new Set(rows.map(r => r.key[1]))];
    const frame = plot({width: 900, height: 320, x: [0, end], y: [0, 1], x_label: 'time since onset / s', y_label: 'share of fixation time on the head'});
    names.forEach((name, i) => {
      const mine = rows.filter(r => r.key[1] === name), colour = palette[i % palette.length];
      const at = r => frame.px((r.from + r.to) / 2) + 2 * (i - names.length / 2);
      frame.svg.append(shape('polyline', {points: mine.map(r => `${at(r)},${frame.py(r.head.v)}`).join(' '), fill: 'none', stroke: colour, 'stroke-width': 2}));
      for (const r of mine) if (r.head.lo !== undefined)
        frame.svg.append(shape('line', {x1: at(r), x2: at(r), y1: frame.py(Math.max(0, r.head.lo)), y2: frame.py(Math.min(1, r.head.hi)), stroke: colour}));
      frame.svg.append(shape('rect', {x: 780, y: 18 + 18 * i, width: 11, height: 11, fill: colour}), shape('text', {x: 796, y: 28 + 18 * i}, name));
    });
    by_id('course_chart').append(frame.svg, element('p', {class: 'note'}, `${rows[0].key[0]}; bars: ${level} over observers.`));
  } else by_id('course_chart').append(element('p', {class: 'note'}, 'There is no time course of the head.'));
}

// Single trials.
const traces = new Map(data.traces.map(t => [t.trial, t]));
const view = new TrialView(by_id('stage_trial'));
let trial = null, angles = null, marker = null, frame_of_trace = null, clock = null;

function angle_at(time) {
  if (!angles || !angles.times.length) return 0;
  let low = 0, high = angles.times.length;
  while (low + 1 < high) { const middle = (low + high) >> 1; if (angles.times[middle] <= time) low = middle; else high = middle; }
  return angles.angles[low];
}

function draw_time() {
  const time = Number(by_id('time').value), keep = by_id('all_fixations').checked;
  by_id('time_text').textContent = time.toFixed(2) + ' s';
  const circles = [];
  trial.fixations.forEach(([onset, duration, x, y, position, counted], i) => {
    const now = time >= onset && time < onset + duration;
    if (onset <= time && (keep || now)) circles.push({position, place: [x, y], number: i + 1, radius: 30 * Math.sqrt(Math.max(0.02, duration)), now, counted});
  });
  view.draw(angle_at(time), circles);
  if (marker) for (const name of ['x1', 'x2']) marker.setAttribute(name, frame_of_trace.px(time));
}
view.redraw = () => { if (trial) draw_time(); };

function draw_trace() {
  const box = by_id('trace'), trace = traces.get(Number(by_id('trial').value));
  box.replaceChildren();
  marker = null;
  if (!trace) { box.append(element('p', {class: 'note'}, 'There is no trace of this trial.')); return; }
  const times = numbers_of(trace.times, Int32Array), places = numbers_of(trace.places, Int16Array), pupils = numbers_of(trace.pupils, Uint16Array);
  const sculpture = data.sculptures[trial.sculpture], ppd = sculpture.px_per_deg || 1;
  const frame = plot({width: 560, height: 380, x: [0, trial.seconds || 8], y: [-8, 8], x_label: 'time since onset / s', y_label: 'gaze from the middle / deg', label: 'Gaze trace'});
  const shade = {f: '#e3eefb', s: '#fde2cf', b: '#d9d9d9'};
  for (const [what, onset, duration] of trace.events) {
    const from = Math.max(frame.left, frame.px(onset)), to = Math.min(frame.right, frame.px(onset + duration));
    if (to > from) frame.svg.insertBefore(shape('rect', {x: from, width: to - from, y: frame.top, height: frame.floor - frame.top, fill: shade[what]}), frame.svg.firstChild);
  }
  for (const [axis, colour] of [[0, '#0072b2'], [1, '#d55e00']]) {
    let d = '', down = false;
    times.forEach((t, i) => {
      const q = places[2 * i + axis];
      if (q === -32768) { down = false; return; }
      const v = (axis ? -1 : 1) * (q / 10 - sculpture.screen[axis] / 2) / ppd;
      d += (down ? 'L' : 'M') + frame.px(t / 1e4).toFixed(1) + ' ' + frame.py(Math.max(-8, Math.min(8, v))).toFixed(1);
      down = true;
    });
    frame.svg.append(shape('path', {d, fill: 'none', stroke: colour, 'stroke-width': 1.3}));
  }
  if (pupils.some(p => p)) {
    const d = Array.from(times, (t, i) => (pupils[i] ? frame.px(t / 1e4).toFixed(1) + ',' + (frame.floor - 60 * pupils[i] / 65535).toFixed(1) : '')).filter(Boolean).join(' ');
    frame.svg.append(shape('polyline', {points: d, fill: 'none', stroke: '#888', 'stroke-width': 0.8}));
  }
  marker = shape('line', {x1: frame.left, x2: frame.left, y1: frame.top, y2: frame.floor, stroke: '#1c2430'});
  frame.svg.append(marker);
  frame_of_trace = frame;
  box.append(frame.svg, element('p', {class: 'note'}, 'Blue: to the right. Orange: up. Grey line: pupil, from 0 to its largest. Shaded: fixations blue, saccades orange, blinks grey.'));
}

function load_trial() {
  trial = data.trials[Number(by_id('trial').value)];
  angles = {times: numbers_of(trial.times, Float32Array), angles: numbers_of(trial.angles, Float32Array)};
  view.load(data.sculptures[trial.sculpture], trial.sculpture);
  by_id('time').max = trial.seconds || 8;
  by_id('time').value = trial.seconds || 8;
  const q = trial.quality;
  by_id('trial_caption').textContent = `${trial.label}: ${words(trial.keys.filter(k => data.by.includes(k[0])))}.` +
      (trial.excluded ? ' Excluded: ' + trial.excluded : '') + ' Circles turn with the surface; their area is the duration; dashed ones are not counted.';
  by_id('trial_facts').replaceChildren(table([{text: 'measure'}, 'value'],
      [['accuracy of the validation / deg', digits(q.accuracy)], ['error at the drift check / deg', digits(q.drift)], ['RMS-S2S / deg', digits(q.rms)],
       ['SD / deg', digits(q.sd)], ['samples lost without blinks', percent(q.lost)], ['lost in blinks', percent(q.blinked)], ['rate / Hz', digits(q.rate, 5)],
       ['refreshes, missed', `${q.refreshes}, ${q.missed}`], ['fixations', trial.fixations.length]]));
  draw_trace();
  draw_time();
}

function stop() { if (clock) cancelAnimationFrame(clock); clock = null; by_id('play').textContent = 'Play'; }
function play() {
  if (clock) { stop(); return; }
  const slider = by_id('time');
  if (Number(slider.value) >= Number(slider.max)) slider.value = 0;
  let before = performance.now();
  by_id('play').textContent = 'Stop';
  const go = now => {
    slider.value = Number(slider.value) + (now - before) / 1000;
    before = now;
    draw_time();
    if (Number(slider.value) >= Number(slider.max)) stop(); else clock = requestAnimationFrame(go);
  };
  clock = requestAnimationFrame(go);
}

if (data.trials.length) {
  fill(by_id('trial'), data.trials.map((t, i) => [String(i), `${t.label}: ${short(t.keys.filter(k => data.by.includes(k[0])))}` + (t.excluded ? ' (excluded)' : '')]));
  const step = by => { stop(); const s = by_id('trial'); s.selectedIndex = Math.max(0, Math.min(s.options.length - 1, s.selectedIndex + by)); load_trial(); };
  by_id('trial').addEventListener('change', () => { stop(); load_trial(); });
  by_id('trial_before').addEventListener('click', () => step(-1));
  by_id('trial_after').addEventListener('click', () => step(1));
  by_id('time').addEventListener('input', () => { stop(); draw_time(); });
  by_id('all_fixations').addEventListener('change', draw_time);
  by_id('play').addEventListener('click', play);
  load_trial();
} else by_id('trials').hidden = true;

// Data quality.
{
  const rows = data.sessions.map((s, i) => {
    const q = data.session_quality[i] || {};
    return [`${s.observer}, session ${s.number}` + (s.simulated ? ' (simulated)' : '') + (s.complete ? '' : ' (incomplete)'), s.tracker, digits(q.accuracy), digits(q.worst), digits(q.rms), digits(q.sd),
            percent(q.lost), percent(q.blinked), q.blinks, digits(q.rate, 5), q.refreshes, q.missed, s.trials];
  });
  by_id('quality_table').append(table([{text: 'observer'}, {text: 'tracker'}, 'accuracy / deg', 'worst / deg', 'RMS-S2S / deg', 'SD / deg', 'lost', 'lost in blinks', 'blinks', 'rate / Hz', 'refreshes', 'missed', 'trials'], rows,
      'As the minimum reporting guideline asks (Dunn et al. 2023). Accuracy: mean and largest offset at the validation targets. RMS-S2S and SD: within fixations, medians; SD around the motion of the eye, a line through each 0.2 s.'));
  by_id('reporting_body').append(table([{text: 'aspect'}, {text: 'item'}, {text: 'value'}], data.reporting.map(r => r.slice(0, 3)),
      'Aspects of Holmqvist et al. (2022, table 7), on which the minimum reporting guideline of Dunn et al. (2023) rests. What is not recorded has to be added by hand.'));
  const excluded = data.trials.filter(t => t.excluded);
  by_id('exclusions').append(element('p', {class: 'note'}, excluded.length ? `${excluded.length} trials are excluded: ` + excluded.map(t => `${t.label} (${t.excluded})`).join(' ') : 'No trial is excluded.'));
  by_id('exclusions').append(element('p', {class: 'note'}, data.glance.not_counted.length ? 'Fixations not counted: ' + data.glance.not_counted.map(([why, n]) => `${n} ${why}`).join(', ') + '.' : 'All fixations are counted.'));

  const durations = data.trials.flatMap(t => t.fixations.filter(f => f[5]).map(f => 1000 * f[1]));
  if (durations.length) {
    const width = 25, most_ms = 1000, bins = new Array(most_ms / width).fill(0);
    for (const d of durations) bins[Math.min(bins.length - 1, Math.floor(d / width))]++;
    const frame = plot({width: 560, height: 280, x: [0, most_ms], y: [0, Math.max(...bins)], x_label: 'fixation duration / ms (the last bar: all longer ones)', y_label: 'fixations'});
    bins.forEach((n, i) => frame.svg.append(shape('rect', {x: frame.px(i * width) + 0.5, width: Math.max(1, frame.px(width) - frame.px(0) - 1), y: frame.py(n), height: frame.floor - frame.py(n), fill: palette[0]})));
    const sorted = durations.slice().sort((a, b) => a - b);
    by_id('durations').append(frame.svg, element('p', {class: 'note'}, `Median ${digits(sorted[sorted.length >> 1])} ms of ${durations.length} fixations.`));
  }
  // Amplitude and peak velocity from the thinned traces: fast saccades come out slower than they were.
  const points = [];
  for (const trace of data.traces) {
    const times = numbers_of(trace.times, Int32Array), places = numbers_of(trace.places, Int16Array), ppd = data.sculptures[data.trials[trace.trial].sculpture].px_per_deg || 1;
    let i = 0;
    for (const [what, onset, duration] of trace.events) {
      if (what !== 's' || points.length > 4000) continue;
      while (i < times.length && times[i] / 1e4 < onset - 0.009) ++i;
      let j = i, peak = 0;
      while (j + 1 < times.length && times[j] / 1e4 < onset + duration) {
        if (places[2 * j] !== -32768 && places[2 * j + 2] !== -32768) {
          const way = Math.hypot(places[2 * j + 2] - places[2 * j], places[2 * j + 3] - places[2 * j + 1]) / 10 / ppd;
          peak = Math.max(peak, way / ((times[j + 1] - times[j]) / 1e4));
        } else { peak = NaN; }
        ++j;
      }
      if (j < times.length && j > i && Number.isFinite(peak)) {
        const size = Math.hypot(places[2 * j] - places[2 * i], places[2 * j + 1] - places[2 * i + 1]) / 10 / ppd;
        if (size > 0.1 && size < 40 && peak > 5 && peak < 1500) points.push([size, peak]);
      }
    }
  }
  if (points.length) {
    const frame = plot({width: 560, height: 280, x: [0.1, 40], y: [5, 1500], x_label: 'saccade amplitude / deg', y_label: 'peak velocity / (deg/s)', log: true, label: 'Main sequence'});
    for (const [size, peak] of points) frame.svg.append(shape('circle', {cx: frame.px(size).toFixed(1), cy: frame.py(peak).toFixed(1), r: 1.6, fill: palette[5], 'fill-opacity': 0.35}));
    by_id('main_sequence').append(frame.svg, element('p', {class: 'note'}, 'Main sequence, from traces thinned to 125 samples a second: peak velocities of short saccades come out too low.'));
  }
}

// Methods.
{
  for (const [topic, text] of data.methods) by_id('methods_text').append(element('p', {}, element('b', {}, topic + '. '), text));
  by_id('parameters').append(table([{text: 'parameter'}, 'value', {text: 'unit'}, {text: 'meaning'}], data.parameters));
  by_id('copy_methods').addEventListener('click', () => {
    const text = data.methods.map(([topic, words]) => topic + '. ' + words).join('\n\n'), done = () => { by_id('copied').textContent = 'Copied.'; };
    const by_hand = () => {
      const range = document.createRange();
      range.selectNodeContents(by_id('methods_text'));
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      document.execCommand('copy');
      done();
    };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, by_hand); else by_hand();
  });
}
