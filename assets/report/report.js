// What stands where in the report, and what its controls do.

const data = JSON.parse(document.getElementById('data').textContent);
const by_id = id => document.getElementById(id);
const colour_tables = Object.fromEntries(Object.entries(data.colours).map(([name, text]) => [name, bytes_of(text)]));
const words = keys => keys.map(([column, value]) => `${column} ${value}`).join(', ') || 'all';
const short = keys => keys.map(key => key[1]).join(', ') || 'all';
const alpha = 1 - data.confidence;
const evidence_note = 'Effect size: mean over standard deviation of observers\' differences (Hedges\' g), with its interval. Bayes factor (JZS): above 3 it speaks for a difference, below 1/3 for none. ' +
    `p of equivalence: small where the effect is shown to be smaller than ${(data.parameters.find(p => p.name === 'smallest-effect') || {value: 'the smallest of interest'}).value}.`;
const level = `${Math.round(100 * data.confidence)} % interval`;

function fill(select, options) {
  select.replaceChildren(...options.map(([value, text]) => element('option', {value}, text)));
}

// A fixation of a trial, as the data have it, that counts; without a known stimulus all do that an area of the screen counts.
const counts = f => f[5] || (!data.knows_stimuli && f[6] === 'no stimulus known');
const seconds_of_fixation = () => (data.knows_stimuli ? data.glance.seconds : data.trials.filter(t => !t.excluded).flatMap(t => t.fixations.filter(counts)).reduce((sum, f) => sum + f[1], 0));

// At a glance.
{
  const g = data.glance;
  by_id('title').textContent = g.title || 'Gaze on surfaces';
  by_id('subtitle').textContent = g.simulated ? 'Gaze of simulated observers: no measurement of people.' : 'Measured gaze.';
  const card = (value, text) => by_id('cards').append(element('div', {class: 'card'}, element('b', {}, value), element('span', {}, text)));
  card(g.observers, 'observers');
  const of_trials = g.presentations > g.trials;
  card(g.trials.toLocaleString('en'), (g.trials === 1 ? 'trial' : 'trials') + (of_trials || !g.excluded ? '' : `, ${g.excluded} excluded`));
  if (of_trials) card(g.presentations.toLocaleString('en'), 'presentations' + (g.excluded ? `, ${g.excluded} excluded` : ''));
  card(g.samples.toLocaleString('en'), 'gaze samples');
  if (data.knows_stimuli) card(g.counted.toLocaleString('en'), `fixations counted of ${g.fixations.toLocaleString('en')}`);
  else card(g.fixations.toLocaleString('en'), 'fixations on the screen');
  card(digits(seconds_of_fixation() / 60), 'minutes of fixation');
  if (data.knows_stimuli) card(data.maps.filter(m => m.values && m.by === 'duration').length, 'maps');
  if (data.answers) card(data.answers.summaries.filter(r => r.of[0] === '').reduce((sum, r) => sum + r.trials - r.missed, 0).toLocaleString('en'), 'answers');
  if (data.tables.areas.length) card(new Set(data.tables.areas.map(a => a.area)).size - 1, 'areas of the screen');
  const h = data.headline;
  for (const [name, text, kind] of [['Question', h.question], ['Design', h.design], ['Observers', h.sample], ['Result', h.result, 'result']])
    if (text) by_id('headline').append(element('dt', {}, name), element('dd', kind ? {class: kind} : {}, text));
  for (const remark of data.remarks) by_id('remarks').append(element('p', {class: 'remark'}, remark));
}

// Rows of a table as panels of bars: one for each value of `panel_of`.
function panels_of(rows, panel_of, bar_of) {
  const panels = new Map();
  for (const row of rows) {
    const name = panel_of(row);
    if (!panels.has(name)) panels.set(name, []);
    panels.get(name).push(bar_of(row));
  }
  return [...panels].map(([name, list]) => ({name, bars: list}));
}

// Columns of groups in which any two differ. Where a column has one level alone, its rows are those of all once more.
const levels_of_column = column => new Set(data.groups.flatMap(g => g.keys.filter(key => key[0] === column).map(key => key[1])));
const varied_columns = data.by.filter(column => levels_of_column(column).size > 1);
const varied_keys = keys => keys.filter(key => !data.by.includes(key[0]) || varied_columns.includes(key[0]));
// Rows without those that say the same of the same once more; what else tells them apart is `of`.
function without_repeats(rows, keys_of, of = () => '') {
  const known = new Set();
  return rows.filter(r => { const key = JSON.stringify([varied_keys(keys_of(r)), of(r)]); return !known.has(key) && known.add(key); });
}

// A column of remarks, where there are any.
const remark_column = (rows, of) => (rows.some(of) ? [text_column('remark', of, {long: true})] : []);

// Figure 4: a panel for each factor, a bar for each of its levels; of groups one for each level of the first factor.
function draw_figure4() {
  const area = by_id('area4').value, all = data.tables.surface_areas.filter(r => r.area === area), rows = without_repeats(all, r => r.keys);
  const of_one = all.filter(r => r.keys.length === 1), varied = of_one.filter(r => varied_columns.includes(r.keys[0][0])), single = varied.length ? varied : of_one.slice(0, 1);
  const full = all.filter(r => r.keys.length === data.by.length && r.keys.length);
  const bar_of = r => ({label: short(r.keys.length === 1 ? r.keys : r.keys.slice(1)), estimate: r.count, each: r.each});
  bars(by_id('figure4_chart'), single.length ? panels_of(single, r => r.keys[0][0], bar_of) : panels_of(full.length ? full : rows, r => (r.keys[0] || ['', 'all'])[1], bar_of),
       {x_label: `share of fixations on the area ${area}`, most: 1, label: `Figure 4: share of fixations on the area ${area}`});
  by_id('figure4_table').replaceChildren(table({name: 'figure_4', title: `Where they looked: fixations on the area ${area}`, rows, columns: [
      ...factor_columns(rows, r => r.keys), number_column('by count, mean over observers', r => r.count), number_column('by duration', r => r.duration),
      number_column('corrected for tracker error', r => r.corrected), number_column('pooled', r => r.pooled), number_column('observers', r => r.observers),
      number_column('trials', r => r.trials), number_column('fixations', r => r.fixations)],
      note: `Dots: single observers. In brackets the ${level} over observers. Pooled: all fixations as if they were independent, as in the paper's figure 4. The paper's numbers are raw shares (by count, pooled); corrected: the share under which the measured places are most probable, given the tracker's error.`}));
}
if (data.areas.length) {
  for (const area of data.areas) by_id('area4').append(element('option', area === data.area ? {selected: ''} : {}, area));
  by_id('area4').addEventListener('change', draw_figure4);
  draw_figure4();
} else by_id('figure4').hidden = true;

// All areas.
if (data.areas.length) {
  const rows = without_repeats(data.tables.surface_areas.filter(r => r.keys.length < 2), r => r.keys, r => r.area);
  by_id('surface_areas_table').append(table({name: 'areas', title: 'What gaze does with each area', rows, columns: [
      text_column('area', r => r.area), ...factor_columns(rows, r => r.keys), number_column('share by count', r => r.count), number_column('by duration', r => r.duration),
      number_column('corrected for tracker error', r => r.corrected), number_column('of the surface', r => r.surface), number_column('of the exposure', r => r.exposure), number_column('share over exposure', r => r.over_exposure),
      number_column('dwell / s', r => r.dwell), number_column('visits', r => r.visits), number_column('visit / s', r => r.visit), number_column('reached', r => r.reached),
      number_column('first arrival / s', r => r.arrival), number_column('by fixation', r => r.arrival_number)],
      note: `Of a trial, means over observers; in brackets the ${level}. The exposure is what gaze would have that is spread evenly over what is seen. First arrival: a trial in which the area was never fixated counts with its whole presentation. Groups are in the table areas.`}));
  const moves = data.tables.surface_transitions.filter(r => !r.keys.length && r.p.v !== null);
  if (moves.length) by_id('surface_transitions_table').append(table({name: 'area_transitions', title: 'From area to area', rows: moves, columns: [
      text_column('from', r => r.from), text_column('to', r => r.to), number_column('probability', r => r.p), number_column('by shares alone', r => r.chance), number_column('difference', r => r.over),
      number_column('transitions', r => r.count), number_column('observers', r => r.observers)],
      note: `Probability that the next fixation is on the second area after one on the first, and the second's share of all next fixations. In brackets the ${level} over observers. Levels of factors are in the table area_transitions.`}));
  const pairs = data.tables.area_pairs.filter(r => r.difference.v !== null);
  if (pairs.length) by_id('area_pairs_table').append(table({name: 'area_pairs', title: `Do levels of ${pairs[0].column} differ in where gaze goes?`, rows: pairs, columns: [
      text_column('area', r => r.area), ...factor_columns(pairs, r => r.keys), text_column('a', r => r.a), text_column('b', r => r.b), number_column('share, a − b', r => r.difference), p_column('p', r => r.p),
      p_column('p after Holm', r => r.holm), p_column('over all areas, too', r => r.holm_areas), ...evidence_columns('', r => r.evidence), number_column('observers', r => r.observers), number_column('comparisons', r => r.comparisons)],
      note: `Within observers and objects. In brackets the ${level} over observers; p by flipping the signs of observers' differences. Holm: over the rows of an area, and over those of all areas. ${evidence_note}`}));
} else by_id('surface_areas').hidden = true;

// Figure 5.
function draw_figure5() {
  const deg = by_id('unit5').value === 'deg', rows = data.tables.distributions;
  const wss = r => (deg ? r.wss_deg : r.wss), unit = deg ? 'deg²' : 'mm²', keys_of = r => data.groups[r.group].keys;
  const object_of = r => data.objects[r.object], with_object = !data.by.includes('object');
  bars(by_id('figure5_chart'), panels_of(rows, r => (keys_of(r)[0] || ['', 'all'])[1],
           r => ({label: [...(with_object ? [object_of(r).id] : []), ...keys_of(r).slice(1).map(k => k[1])].join(', ') || object_of(r).id, estimate: wss(r)})),
       {x_label: 'mean WSS / ' + unit, most: 0, label: 'Figure 5: mean within-cluster sum of squares in ' + unit});
  by_id('figure5_table').replaceChildren(table({name: 'figure_5', title: 'How widely they looked', rows, columns: [
      ...factor_columns(rows, keys_of).filter(c => c.name !== 'object'), text_column('object', r => object_of(r).title),
      number_column('mean WSS / ' + unit, wss, {digits: 4}),
      ...['x', 'y', 'z'].map((axis, i) => number_column(`Var ${axis} / ${unit}`, r => (deg ? r.variance_deg : r.variance)[i], {digits: 4})),
      number_column('map: peak / (ms/mm²)', r => r.peak), number_column('map: mean / (ms/mm²)', r => r.mean),
      number_column('observers', r => r.observers), number_column('fixations', r => r.fixations)],
      note: `Mean WSS is the sum of the variances along x, y and z (1/N). In brackets the ${level} over observers; peak and mean of the map for one trial.`}));
}
by_id('unit5').addEventListener('change', draw_figure5);
draw_figure5();

// Table 1.
{
  const rows = data.tables.pairs;
  by_id('table1_body').append(rows.length ? table({name: 'table_1', title: 'Pairs of conditions within observers', rows, columns: [
      ...factor_columns(rows, r => r.keys), text_column('a', r => r.a), text_column('b', r => r.b),
      number_column('WSS a - b / deg²', r => r.wss_deg), p_column('WSS: p', r => r.p), p_column('WSS: p after Holm', r => r.holm), ...evidence_columns('WSS: ', r => r.evidence),
      number_column('CC of all maps', r => r.maps_cc), p_column('CC of all maps: p', r => r.maps_p), p_column('CC of all maps: p after Holm', r => r.maps_holm),
      ...[['CC', 'cc'], ['SIM', 'sim']].flatMap(([name, key]) => [number_column(name, r => r[key].value), number_column(name + ': two observers, other level', r => r[key].other), number_column(name + ': two observers, same level', r => r[key].same), number_column(name + ': same less other', r => r[key].effect)]),
      number_column('observers', r => r.observers), ...remark_column(rows, r => r.absent)],
      note: `WSS, CC and SIM are of one observer and one object, then averaged; in brackets the ${level} over observers. CC of all maps: the maps of all observers are added up for each level. ` +
      'Whether maps differ is told by its p, for which an observer\'s two levels are swapped, whole maps at once; for the p of WSS the signs of observers\' differences are flipped. After Holm: corrected for the rows of the table, those over all groups apart. ' +
      'A similarity grows with the number of fixations and is below 1 even where nothing differs. So maps of two observers are compared, all of as many fixations: the same level is the ceiling of the other level, and their difference is 0 where levels make none. SIM: maps scaled from 0 to 1 first (MIT benchmark); table1_pairs has it without scaling, too. ' + evidence_note})
      : element('p', {class: 'note'}, 'There is no factor whose levels the same observers saw on the same object.'));
}

// Maps of differences, cluster by cluster.
{
  const rows = [];
  for (const d of without_repeats(data.differences, d => d.keys, d => [d.object, d.a, d.b])) {
    if (!d.values || !d.clusters.length) rows.push({d, c: null, where: d.absent || 'no vertex beyond the threshold'});
    d.clusters.forEach((c, i) => {
      // Small ones are in the table of clusters.
      if (i === 0 || c.p <= 0.2) rows.push({d, c, where: (c.part !== null ? data.objects[d.object].parts[c.part] : 'n/a') + `, cluster ${i + 1} of ${d.clusters.length}`});
    });
  }
  const of_cluster = of => row => (row.c ? of(row.c) : null);
  by_id('differences').hidden = rows.length === 0;
  if (rows.length) by_id('differences_body').append(table({name: 'differences', title: 'Where conditions differ', rows, columns: [
      ...factor_columns(rows, r => r.d.keys).filter(c => c.name !== 'object'), text_column('object', r => data.objects[r.d.object].title), text_column('a', r => r.d.a), text_column('b', r => r.d.b),
      number_column('observers', r => r.d.observers), text_column('where', r => r.where),
      number_column('area / mm²', of_cluster(c => c.area)), ...['x', 'y', 'z'].map((axis, i) => mm_column(`centre ${axis} / mm`, of_cluster(c => c.centre[i]))),
      share_column('a less b, of the fixation time', of_cluster(c => c.difference)), p_column('p', of_cluster(c => c.p)), p_column('p over all maps', of_cluster(c => c.p_all)),
      ...(rows.some(r => r.d.tfce_least_p !== null) ? [p_column('p without a threshold', of_cluster(c => c.tfce_p)), number_column('area of p up to ' + digits(alpha, 2) + ' / mm²', r => r.d.tfce_area)] : []),
      p_column('smallest p there can be', r => r.d.least_p)],
      note:
      'Each observer with fixations in both conditions gives a map of differences; clusters of vertices with a t beyond the threshold are tested by flipping the signs of ' +
      'observers\' maps (largest cluster, sum of t times area). p holds for the whole surface of one object; "over all maps" is that of the largest cluster of any row. ' +
      'Shown are the largest cluster of each map, and others with p up to 0.2.' + (rows.some(r => r.d.tfce_least_p !== null) ? ' Without a threshold (TFCE): the least p within the cluster; the area is that of the whole map.' : '')}));
}

// Exposure, prediction, reliability, errors.
{
  const t = data.tables, title = text_column('object', r => data.objects[r.object].title), keys_of = r => data.groups[r.group].keys;
  const conditions = (rows, of = keys_of) => [...factor_columns(rows, of).filter(c => c.name !== 'object'), title];
  const put = (id, rows, make) => {
    by_id(id).hidden = by_id(id).previousElementSibling.hidden = rows.length === 0;
    if (rows.length) by_id(id).append(table({name: id.replace('_body', ''), title: by_id(id).previousElementSibling.textContent, rows, ...make()}));
  };
  put('exposure_body', t.exposures, () => ({columns: [
      title, text_column('area', e => e.area_name), number_column('area / mm²', e => e.area), share_column('of the area', e => e.share_of_area), share_column('of the exposure', e => e.share),
      share_column('of the fixations', e => e.fixations), number_column('visible / s', e => e.seconds), share_column('never visible', e => e.never), number_column('mean cosine of view', e => e.foreshortening)],
      note: 'What one presentation shows of each area: the exposure is the share of time and picture area that it fills among all that shows the object. Gaze that looks at all of the picture alike has the same share of fixations.'}));
  put('predictions_body', t.predictions, () => ({columns: [
      ...conditions(t.predictions), text_column('predicted by', r => r.by + (r.level ? ': ' + r.level : '')), number_column('KL / nat', r => r.kl), number_column('NSS', r => r.nss),
      number_column('AUC (Judd)', r => r.auc), number_column('AUC (Borji)', r => r.borji), number_column('gain over exposure / bit', r => r.gain),
      number_column('gain over even gaze / bit', r => r.gain_area), share_column('of the ceiling', r => r.ceiling), number_column('observers', r => r.observers)],
      note: 'Of the ceiling: gain over even gaze, of that which other observers\' map gives in the same condition. Each observer\'s fixations are told from a map of other observers, in the same condition or in another one, or from the exposure alone. A material that gaze does not care about is predicted as well by another material as by itself.'}));
  const reliabilities = without_repeats(t.reliabilities, r => r.keys, r => r.object);
  put('reliability_body', reliabilities, () => ({columns: [
      ...conditions(reliabilities, r => r.keys), number_column('CC of halves', r => r.split), number_column('reliability', r => r.reliability),
      number_column('observers', r => r.observers), number_column('fixations', r => r.fixations)],
      note: 'How well the map of all observers would agree with that of as many others (Cronbach\'s alpha), and the correlation of two halves that goes with it; the interval is by leaving out each observer in turn.'}));
  const errors = data.maps.filter(m => m.by === 'duration' && m.values);
  put('errors_body', errors, () => ({columns: [
      ...conditions(errors), ...[['accuracy', 'accuracy'], ['precision', 'precision'], ['timing', 'timing'], ['look-up', 'lut'], ['together', 'together']].map(([name, key]) => mm_column(name + ' / mm', m => m.error[key])),
      number_column('least kernel sigma / mm', m => m.sigma[0]), number_column('largest kernel sigma / mm', m => m.sigma[1]),
      share_column('Euclidean leak', m => m.leak), share_column('cone beyond an edge', m => m.error.at_edge), share_column('samples near an edge', m => m.error.near_edge)],
      note: 'Root mean squares over the fixations, along the surface. Accuracy: the gaze cone of the validation before each trial. Precision: of a single sample (RMS-S2S divided by the root of 2). ' +
      'Timing: uncertainty of the clocks times the speed of the surface under gaze. An edge is where the object ends or another sheet of it begins.'}));
  by_id('metrics').hidden = !t.exposures.length && !t.predictions.length && !t.reliabilities.length && !errors.length;
}

// Effects of the factors.
{
  const rows = data.tables.effects.filter(r => r.effect.split(':').every(column => !data.by.includes(column) || varied_columns.includes(column)));
  if (rows.length) by_id('effects_body').append(
      table({name: 'effects', title: 'Effects of the factors', rows, columns: [
            text_column('measure', r => r.measure), text_column('effect', r => r.effect.replace(':', ' × ')), p_column('p', r => r.p), p_column('p after Holm', r => r.holm),
            number_column('observers', r => r.observers), ...remark_column(rows, r => r.absent || (r.least > alpha + 1e-9 ? `so many observers can give no p below ${digits(r.least)}` : ''))],
            note:
            'Of trials: the share of counted fixations on an area, and the logarithm of WSS. p is of the largest difference of two levels, of two factors together (×) of the largest difference of differences, under flips of the signs of whole observers; levels may vary differently, and trials may be missing. ' +
            'Holm: corrected over the rows of the same measure. Mixed models (lme4): run mixed_models.R beside this page.'}));
  else by_id('effects').hidden = true;
}

// Gaze and the moving surface.
{
  const rows = without_repeats(data.tables.motions, r => r.keys), found = rows.filter(r => r.gain.v !== null);
  if (found.length) {
    bars(by_id('motion_chart'), panels_of(found, r => (r.keys[0] || [''])[0], r => ({label: r.keys.length ? r.keys[0][1] : 'all', estimate: r.gain})),
         {x_label: 'gain of gaze along the surface', most: 1.1, label: 'Gain of gaze along the motion of the surface'});
    by_id('motion_body').append(table({name: 'motion', title: 'Does gaze go with the surface?', rows, columns: [
        ...factor_columns(rows, r => r.keys), number_column('gain', r => r.gain), number_column('without the tracker\'s error', r => r.corrected), number_column('speed of the surface / (deg/s)', r => r.speed), number_column('observers', r => r.observers), number_column('fixations', r => r.fixations)],
        note: `While a fixation lasts the object turns on. Gain 1: gaze goes with the place that it looks at; 0: it stays on the screen. In brackets the ${level} over observers. The tracker\'s constant error changes the gain; without it: extrapolated from points that lie as far again from the measured ones.`}));
  } else by_id('motion').hidden = true;
}

// Light at gaze.
{
  const rows = without_repeats(data.tables.lights, r => r.keys), found = rows.filter(r => r.met.v !== null);
  if (found.length) {
    const of = (name, key) => ({name, bars: found.filter(r => r[key].v !== null).map(r => ({label: r.keys.length ? r.keys[0][1] : 'all', estimate: r[key]}))});
    bars(by_id('light_chart'), [of('against the same place of the screen', 'place'), of('against the same point of the surface', 'point')].filter(g => g.bars.length),
         {x_label: 'more lightness met (SD)', most: 0.1, label: 'How much brighter what gaze met was than the same places at other times'});
    by_id('light_body').append(table({name: 'light', title: 'Is gaze drawn by light?', rows, columns: [
        ...factor_columns(rows, r => r.keys), number_column('lightness met', r => r.met), number_column('more than at the place of the screen', r => r.place), number_column('more than on the point of the surface', r => r.point),
        number_column('observers', r => r.observers), number_column('fixations', r => r.fixations)],
        note: `Lightness in standard deviations from its mean over the object in the same picture; gaze that is spread evenly over the object has 0. Highlights that stay while the surface turns beneath them, and are looked at, make the third number positive: the points were bright when gaze was on them, and are darker at other times. In brackets the ${level} over observers.`}));
  } else by_id('light').hidden = true;
}

// Time course.
function draw_course() {
  const area = by_id('area_course').value, rows = data.tables.course.filter(r => r.area === area && r.share.v !== null);
  by_id('course_chart').replaceChildren();
  if (rows.length) {
    const end = Math.max(...rows.map(r => r.to)), step = Math.max(...rows.map(r => r.to - r.from)), names = [...new Set(rows.map(r => r.key[1]))];
    const chart = element('div');
    by_id('course_chart').append(curve_names(names), chart, element('p', {class: 'note'}, `${names.length > 1 ? `By ${rows[0].key[0]}; bars` : 'Bars'}: ${level} over observers.`));
    responsive(chart, width => {
      const frame = plot({width: Math.min(width, 1100), height: names.length > 8 ? 460 : 340, x: [0, end], y: [0, 1], x_label: 'time since onset / s', y_label: `share of fixation time on the area ${area}`});
      // Side by side, so that intervals do not hide each other, but within their stretch of time.
      const aside = Math.min(3, 0.7 * (frame.px(step) - frame.px(0)) / names.length);
      names.forEach((name, i) => {
        const mine = rows.filter(r => r.key[1] === name), at = r => frame.px((r.from + r.to) / 2) + aside * (i - (names.length - 1) / 2);
        frame.svg.append(curve(i, mine.map(r => [at(r), frame.py(r.share.v)])));
        for (const r of mine) {
          if (r.share.lo !== undefined)
            frame.svg.append(shape('line', {x1: at(r), x2: at(r), y1: frame.py(Math.max(0, r.share.lo)), y2: frame.py(Math.min(1, r.share.hi)), stroke: colour_of(i)}));
          const point = marker(i, at(r), frame.py(r.share.v));
          point.append(shape('title', {}, `${name}, ${r.from} to ${r.to} s: ${estimate_text(r.share)}`));
          frame.svg.append(point);
        }
      });
      chart.replaceChildren(frame.svg);
    });
  } else by_id('course_chart').append(element('p', {class: 'note'}, 'There is no time course of this area.'));
}
if (data.areas.length) {
  for (const area of data.areas) by_id('area_course').append(element('option', area === data.area ? {selected: ''} : {}, area));
  by_id('area_course').addEventListener('change', draw_course);
  draw_course();
} else by_id('course').hidden = true;

// Data quality.
{
  const rows = data.sessions.map((s, i) => ({s, q: data.session_quality[i] || {}}));
  const of = key => r => r.q[key] ?? null;
  by_id('quality_table').append(table({name: 'data_quality', title: 'Data quality by session', rows, columns: [
      text_column('observer', r => r.s.observer), number_column('session', r => r.s.number),
      ...(rows.some(r => !r.s.complete) ? [text_column('recording', r => (r.s.complete ? 'complete' : 'incomplete'))] : []),
      text_column('tracker', r => r.s.tracker + (r.s.simulated && r.s.tracker !== 'simulated' ? ' (simulated)' : '')),
      number_column('accuracy / deg', of('accuracy')), number_column('worst / deg', of('worst')), number_column('RMS-S2S / deg', of('rms')), number_column('SD / deg', of('sd')),
      share_column('lost', of('lost')), share_column('lost in blinks', of('blinked')), number_column('blinks', of('blinks')), number_column('rate / Hz', of('rate'), {digits: 5}),
      number_column('refreshes', of('refreshes')), number_column('missed', of('missed')), number_column('trials', r => r.s.trials)],
      note:
      'As the minimum reporting guideline asks (Dunn et al. 2023). Accuracy: mean and largest offset at the validation targets. RMS-S2S and SD: within fixations, medians; SD around the motion of the eye, a line through each 0.2 s.'}));
  by_id('reporting_body').append(table({name: 'reporting', title: 'What an article has to report', rows: data.reporting, columns: [
      text_column('aspect', r => r[0]), text_column('item', r => r[1]), text_column('value', r => r[2], {long: true})],
      note: 'Aspects of Holmqvist et al. (2022, table 7), on which the minimum reporting guideline of Dunn et al. (2023) rests. What is not recorded has to be added by hand.'}));
  const excluded = data.trials.filter(t => t.excluded);
  by_id('exclusions').append(element('p', {class: 'note'}, excluded.length ? `${excluded.length} trials are excluded: ` + excluded.map(t => `${t.label} (${t.excluded})`).join(' ') : 'No trial is excluded.'));
  by_id('exclusions').append(element('p', {class: 'note'}, !data.knows_stimuli ? 'Of the object that was shown nothing is known, so that no fixation counts on a surface.' : data.glance.not_counted.length ? 'Fixations not counted: ' + data.glance.not_counted.map(([why, n]) => `${n} ${why}`).join(', ') + '.' : 'All fixations are counted.'));

  const durations = data.trials.flatMap(t => (t.excluded ? [] : t.fixations.filter(counts)).map(f => 1000 * f[1]));
  if (durations.length) {
    const width_ms = 25, most_ms = 1000, bins = new Array(most_ms / width_ms).fill(0);
    for (const d of durations) bins[Math.min(bins.length - 1, Math.floor(d / width_ms))]++;
    const chart = element('div', {class: 'chart'});
    responsive(chart, width => {
      const frame = plot({width, height: 300, x: [0, most_ms], y: [0, Math.max(...bins)], x_label: 'fixation duration / ms (the last bar: all longer ones)', y_label: 'fixations', label: 'Fixation durations'});
      bins.forEach((n, i) => frame.svg.append(shape('rect', {x: frame.px(i * width_ms) + 0.5, width: Math.max(1, frame.px(width_ms) - frame.px(0) - 1), y: frame.py(n), height: frame.floor - frame.py(n), fill: colour_of(0)})));
      chart.replaceChildren(frame.svg);
    });
    const sorted = durations.slice().sort((a, b) => a - b);
    by_id('durations').append(chart, element('p', {class: 'note'}, `Median ${digits(sorted[sorted.length >> 1])} ms of ${durations.length} fixations.`));
  }
  // Amplitude and peak velocity of all saccades, as their events have them.
  const saccades = data.traces.flatMap(t => t.events.filter(e => e[0] === 's'));
  const points = saccades.filter(e => e[3] > 0 && e[4] > 0).map(e => [e[3], e[4]]);
  if (points.length) {
    const range = i => points.reduce(([low, high], p) => [Math.min(low, p[i] / 1.2), Math.max(high, p[i] * 1.2)], [Infinity, -Infinity]);
    const chart = element('div', {class: 'chart'});
    responsive(chart, width => {
      const frame = plot({width, height: 300, x: range(0), y: range(1), x_label: 'saccade amplitude / deg', y_label: 'peak velocity / (deg/s)', log: true, label: 'Main sequence'});
      point_cloud(frame, points, colour_of(5));
      chart.replaceChildren(frame.svg);
    });
    by_id('main_sequence').append(chart, element('p', {class: 'note'}, 'Main sequence: ' + (points.length === saccades.length ? `all ${saccades.length.toLocaleString('en')} saccades.`
        : `${points.length.toLocaleString('en')} of ${saccades.length.toLocaleString('en')} saccades: those whose amplitude and peak velocity are on record.`)));
  } else if (saccades.length) by_id('main_sequence').append(element('p', {class: 'note'}, `No main sequence: of ${saccades.length.toLocaleString('en')} saccades no peak velocity is on record.`));
}

// Methods.
{
  for (const [topic, text] of data.methods) by_id('methods_text').append(element('p', {}, element('b', {}, topic + '. '), text));
  by_id('parameters').append(table({name: 'parameters', title: 'Parameters of the analysis', rows: data.parameters, columns: [
      text_column('parameter', p => p[0]), text_column('value', p => p[1]), text_column('unit', p => p[2]), text_column('meaning', p => p[3], {long: true})]}));
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
