// What observers answered: functions, scales, ratings, choices, times, tracks, and where they looked before.

const answers = data.answers, answer_name = ([, task, answer, item]) => [...(several_tasks() ? [task] : []), answer, ...(item ? [item] : [])].join(', ');
const several_tasks = () => new Set(answers.summaries.map(r => r.of[1])).size > 1;
const of_all = r => r.of[0] === '', same_answer = (a, b) => a.of.slice(1).join('\t') === b.of.slice(1).join('\t');
const observer_column = text_column('observer', r => r.of[0] || 'all');
const answer_columns = rows => [
    observer_column, ...(new Set(rows.map(r => r.of[1])).size > 1 ? [text_column('task', r => r.of[1])] : []), text_column('answer', r => r.of[2]),
    ...(rows.some(r => r.of[3]) ? [text_column('item', r => r.of[3] || 'n/a')] : [])];
// A column only where a row has something in it.
const if_any = (rows, column) => (rows.some(r => { const cell = column.of(r); return cell !== null && cell !== '' && (!is_estimate(cell) || cell.v !== null); }) ? [column] : []);
// Of many rows those of all observers alone: single ones are in the files beside the page.
const most_rows = 40;
const rows_shown = rows => (rows.length > most_rows && rows.some(of_all) ? rows.filter(of_all) : rows);
const on_rows = (rows, file) => (rows_shown(rows).length < rows.length ? ` Single observers are in the table ${file} beside the page.` : '');
const has_any = (rows, of) => rows.some(r => of(r) !== null && of(r) !== undefined);
const unique = (rows, key) => [...new Map(rows.map(r => [key(r), r])).values()];

function answer_part(id, title, ...children) {
  by_id(id).append(element('h3', {}, title), ...children);
}

// A select with its label, that calls `show` with the chosen index; left out where there is nothing to choose.
function chooser(name, options, show) {
  const box = element('div', {class: 'controls'}), select = element('select');
  fill(select, options.map((text, i) => [String(i), text]));
  select.addEventListener('change', () => show(Number(select.value)));
  if (options.length > 1) box.append(element('label', {}, name + ' ', select));
  show(0);
  return box;
}

// Psychometric functions.
const share_at = (c, x) => c.guess + (1 - c.guess - (c.lapse || 0)) / (1 + Math.exp(-c.slope * (x - c.threshold.v)));

// Curves with their counts in one plot; each dot as large as its answers are many.
function curve_plot(box, curves, names, height) {
  const levels = curves.flatMap(c => c.points.map(p => p[0])), most = Math.max(1, ...curves.flatMap(c => c.points.map(p => p[1])));
  const low = Math.min(...levels), high = Math.max(...levels), room = 0.06 * (high - low || 1);
  const x = [low - room, high + room], c0 = curves[0];
  responsive(box, width => {
    const frame = plot({width: Math.min(width, 760), height, x, y: [0, 1], x_label: c0.factor + (c0.yes.includes('less the other') ? ', first slot less the other' : ''), y_label: 'share of answers',
                        label: `Share of answers by ${c0.factor}`});
    curves.forEach((c, i) => {
      const colour = colour_of(i);
      if (c.threshold.v !== null && c.slope !== null) {
        const line = [];
        for (let s = 0; s <= 120; ++s) { const at = x[0] + (x[1] - x[0]) * s / 120; line.push([frame.px(at), frame.py(share_at(c, at))]); }
        frame.svg.append(curve(i, line));
        // The threshold with its interval, on the floor of the plot.
        const inside = v => Math.min(Math.max(v, x[0]), x[1]), floor = frame.floor - 6 - 9 * i, t = c.threshold;
        if (t.v >= x[0] && t.v <= x[1]) {
          frame.svg.append(shape('line', {x1: frame.px(t.v), x2: frame.px(t.v), y1: frame.py(share_at(c, t.v)), y2: floor, stroke: colour, 'stroke-dasharray': '2 3'}));
          const mark = shape('path', {d: (t.lo === undefined ? '' : `M${frame.px(inside(t.lo))} ${floor}H${frame.px(inside(t.hi))}`) + `M${frame.px(t.v)} ${floor - 4}v8`, stroke: colour, 'stroke-width': 2.5, fill: 'none'});
          mark.append(shape('title', {}, `threshold ${estimate_text(t)}`));
          frame.svg.append(mark);
        }
      }
      for (const [level, trials, yes, from, to] of c.points) {
        const at = frame.px(level), share = yes / trials;
        frame.svg.append(shape('line', {x1: at, x2: at, y1: frame.py(from), y2: frame.py(to), stroke: colour, 'stroke-opacity': 0.6}));
        const dot = shape('circle', {cx: at, cy: frame.py(share), r: (2 + 4 * Math.sqrt(trials / most)).toFixed(1), fill: colour});
        dot.append(shape('title', {}, `${names[i]}, ${c.factor} ${digits(level)}: ${digits(yes)} of ${digits(trials)}`));
        frame.svg.append(dot);
      }
    });
    box.replaceChildren(frame.svg);
  });
}

function show_curves() {
  const rows = answers.curves, key = c => [...c.of.slice(1), c.factor, c.yes].join('\t');
  const functions = unique(rows.filter(c => of_all(c) && !c.column), key);
  if (!functions.length) return;
  const drawn = element('div');
  const show = index => {
    const wanted = key(functions[index]), mine = rows.filter(c => key(c) === wanted);
    const pooled = mine.find(c => of_all(c) && !c.column), columns = [...new Set(mine.map(c => c.column).filter(Boolean))];
    const single = mine.filter(c => !of_all(c) && !c.column);
    drawn.replaceChildren();
    const together = element('div', {class: 'chart'});
    drawn.append(together, element('p', {class: 'note'}, `Counted is ${pooled.yes}. Dots: answers of all observers, the larger the more; bars: Wilson's ${level}. Curve: the function with the means of observers' thresholds and slopes; the mark at the foot is the threshold with its ${level} over observers: ${estimate_text(pooled.threshold)}.`));
    curve_plot(together, [pooled], ['all'], 340);
    for (const column of columns) {
      const levels = mine.filter(c => of_all(c) && c.column === column), names = levels.map(c => c.level), box = element('div', {class: 'chart'});
      drawn.append(element('h4', {}, `By ${column}`), curve_names(names), box);
      curve_plot(box, levels, names, 340);
    }
    if (single.length > 1) {
      const grid = element('div', {class: 'panels small'});
      drawn.append(element('h4', {}, 'Each observer'), grid);
      for (const c of single) {
        const box = element('div', {class: 'chart'});
        grid.append(element('div', {}, element('b', {}, c.of[0]), element('span', {class: 'soft'}, ' ' + (c.threshold.v === null ? c.threshold.absent || 'no threshold' : estimate_text(c.threshold))), box));
        curve_plot(box, [c], [c.of[0]], 190);
      }
    }
  };
  answer_part('answers_body', 'Psychometric functions', chooser('Answer', functions.map(c => `${answer_name(c.of)} by ${c.factor}: ${c.yes}`), show), drawn,
      table({name: 'psychometric_functions', title: 'Psychometric functions', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('factor', r => r.factor), text_column('counted', r => r.yes), ...if_any(rows, text_column('within', r => r.column ? `${r.column} ${r.level}` : '')),
        number_column('threshold', r => r.threshold), number_column('slope', r => r.slope), ...if_any(rows, number_column('lapse rate', r => r.lapse)), number_column('guess rate', r => r.guess),
        ...if_any(rows, number_column('deviance', r => r.deviance)), number_column('degrees', r => r.degrees), ...if_any(rows, number_column('limit of the deviance', r => r.limit)), number_column('answers', r => r.trials),
        ...if_any(rows, number_column('planted threshold', r => r.planted)), ...if_any(rows, number_column('planted slope', r => r.planted_slope)), ...remark_column(rows, r => (r.note === r.threshold.absent ? '' : r.note))],
        note: `guess + (1 - guess - lapse) / (1 + exp(-slope (x - threshold))), by maximum likelihood. In brackets the ${level}: of an observer by the bootstrap over answers, of all over observers.${has_any(rows, r => r.limit) ? ' A deviance above its limit says that the function does not fit.' : ''}` + on_rows(rows, 'psychometric_functions')}));
}

// Dots with intervals, in panels.
function dot_panels(box, panels, options) { bars(box, panels, {...options, as_points: true}); }

function show_scales() {
  const rows = answers.scales;
  if (!rows.length) return;
  const kinds = unique(rows.filter(of_all), r => [...r.of.slice(1), r.method, r.factor].join('\t')), chart = element('div', {class: 'chart'});
  const show = index => {
    const wanted = kinds[index], mine = rows.filter(r => same_answer(r, wanted) && r.method === wanted.method && r.factor === wanted.factor);
    const bars_of = mine.filter(of_all).map(r => ({label: r.level, estimate: r.value, each: mine.filter(o => !of_all(o) && o.level === r.level && o.value.v !== null).map(o => o.value.v)}));
    dot_panels(chart, [{name: '', bars: bars_of}], {x_label: `place on the scale (${wanted.method})`, label: `Scale of ${wanted.factor}`});
  };
  answer_part('answers_body', 'Scales of comparisons', chooser('Scale', kinds.map(r => `${answer_name(r.of)}: ${r.factor}, ${r.method}`), show), chart,
      table({name: 'answer_scales', title: 'Scales of comparisons', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('method', r => r.method), text_column('factor', r => r.factor), text_column('level', r => r.level), number_column('place', r => r.value),
        ...if_any(rows, number_column('first slot adds', r => r.first)), ...if_any(rows, number_column('noise of a judgement', r => r.sigma)), number_column('judgements', r => r.trials),
        ...if_any(rows, number_column('planted', r => r.planted)), ...remark_column(rows, r => (r.penalised ? 'penalised: answers so consistent that the likelihood has no maximum' : ''))],
        note: `Large dots: all answers together, with the ${level}; small dots: single observers. Bradley-Terry in logits and Thurstone's Case V in standard deviations of a percept, with a mean of 0; MLDS from 0 to 1.` + on_rows(rows, 'answer_scales')}));
}

function show_ratings() {
  const rows = answers.ratings;
  if (!rows.length) return;
  const kinds = unique(rows.filter(of_all), r => r.of.slice(1).join('\t')), chart = element('div', {class: 'chart'});
  const label_of = r => (r.factor ? r.level : 'all');
  const panels = mine => panels_of(mine.filter(of_all), r => r.factor || '', r => ({label: label_of(r), estimate: r.mean, each: mine.filter(o => !of_all(o) && o.factor === r.factor && o.level === r.level && o.mean.v !== null).map(o => o.mean.v)}));
  const show = index => dot_panels(chart, panels(rows.filter(r => same_answer(r, kinds[index]))), {x_label: `mean of ${answer_name(kinds[index].of)}`, label: 'Mean ratings'});
  answer_part('answers_body', 'Ratings and numbers', chooser('Answer', kinds.map(r => answer_name(r.of)), show), chart,
      table({name: 'ratings', title: 'Ratings and numbers', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), ...if_any(rows, text_column('factor', r => r.factor)), ...if_any(rows, text_column('level', r => r.level)), number_column('mean', r => r.mean), number_column('SD', r => r.sd), number_column('answers', r => r.ratings),
        ...if_any(rows, number_column('place on a continuous quality', r => r.place)), ...if_any(rows, number_column('planted', r => r.planted))],
        note: `Large dots: means over observers of their means, with the ${level} over observers; small dots: single observers.${has_any(rows, r => r.place) ? " Place: cumulative probit model, the factor's first level being 0." : ''}` + on_rows(rows, 'ratings')}));
}

function show_choices() {
  const rows = answers.choices, sums = answers.summaries;
  const chart = element('div', {class: 'chart'}), judged = sums.filter(r => r.correct.v !== null);
  const each_of = (all, fits, value) => all.filter(o => !of_all(o) && fits(o) && value(o) !== null).map(value);
  const of_choices = panels_of(rows.filter(of_all), r => answer_name(r.of), r => ({label: r.choice, estimate: r.share, each: each_of(rows, o => same_answer(o, r) && o.choice === r.choice, o => o.share.v)}));
  const right = judged.filter(of_all).map(r => ({label: answer_name(r.of), estimate: r.correct, each: each_of(judged, o => same_answer(o, r), o => o.correct.v)}));
  const panels = [...(right.length ? [{name: 'correct', bars: right}] : []), ...of_choices];
  if (panels.length) bars(chart, panels, {x_label: 'share of the answers', most: 1, label: 'Shares of answers'});
  answer_part('answers_body', 'How often, how right, how fast', ...(panels.length ? [chart] : []),
      table({name: 'answers', title: 'Answers', rows: rows_shown(sums), columns: [
        ...answer_columns(sums), number_column('asked', r => r.trials), number_column('missed', r => r.missed), ...if_any(sums, share_column('correct', r => r.correct)), ...if_any(sums, share_column('planted', r => r.planted)),
        ...if_any(sums, number_column('d′', r => r.d_prime)), ...if_any(sums, number_column('SE of d′', r => r.d_prime_se)), ...if_any(sums, number_column('criterion', r => r.criterion)),
        ...if_any(sums, text_column('design', r => r.design)), ...if_any(sums, number_column('d′ by the design', r => r.design_d_prime)), number_column('median time / s', r => r.median)],
        note: [...(panels.length ? [`Bars with Wilson's ${level}, as if answers were independent of each other; dots: single observers.`] : []),
          ...(has_any(sums, r => r.d_prime) || has_any(sums, r => r.design_d_prime) ? ['d′ with the log-linear correction; the design is told by what was shown.'] : []),
          'Median time: of all answers together.'].join(' ') + on_rows(sums, 'answers')}),
      ...(rows.length ? [table({name: 'answer_choices', title: 'How often each choice was made', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('choice', r => r.choice), number_column('times', r => r.chosen), number_column('of', r => r.answered), share_column('share', r => r.share)],
        note: on_rows(rows, 'answer_choices').trim()})] : []));
}

function show_times() {
  const rows = answers.times;
  if (!rows.length) return;
  const kinds = unique(answers.samples, r => r.of.slice(1).join('\t')), charts = element('div', {class: 'two'});
  const show = index => {
    charts.replaceChildren();
    const mine = answers.samples.filter(r => same_answer(r, kinds[index])), all = mine.flatMap(r => r.ms).sort((a, b) => a - b);
    const most = Math.max(1, all[Math.floor(0.99 * (all.length - 1))]), bins = 40, width_ms = most / bins;
    const of_which = mine.map(r => { const counts = new Array(bins).fill(0); for (const ms of r.ms) if (ms >= 0) counts[Math.min(bins - 1, Math.floor(ms / width_ms))]++; return counts; });
    const box = element('div', {class: 'chart'}), left = element('div', {}, ...(mine.length > 1 ? [curve_names(mine.map(r => r.which))] : []), box);
    charts.append(left);
    responsive(box, width => {
      const highest = Math.max(1, ...of_which.flat());
      const frame = plot({width, height: 280, x: [0, most / 1000], y: [0, highest], x_label: 'response time / s (the last step: all longer ones)', y_label: 'answers', label: 'Response times'});
      of_which.forEach((counts, i) => {
        const line = counts.flatMap((n, b) => [[frame.px(b * width_ms / 1000), frame.py(n)], [frame.px((b + 1) * width_ms / 1000), frame.py(n)]]);
        frame.svg.append(curve(i, line));
      });
      box.replaceChildren(frame.svg);
    });
    const speeds = answers.speeds.filter(r => of_all(r) && same_answer(r, kinds[index]) && r.correct.v !== null);
    if (!speeds.length) return;
    const speed_box = element('div', {class: 'chart'});
    charts.append(element('div', {}, speed_box, element('p', {class: 'note'}, `How often answers are correct by how fast they come: means over observers of fifths of their times, with the ${level}.`)));
    responsive(speed_box, width => {
      const frame = plot({width, height: 280, x: [0, 1.1 * Math.max(...speeds.map(r => r.time))], y: [0, 1], x_label: 'mean response time / s', y_label: 'share correct', label: 'Correct answers by response time'});
      frame.svg.append(curve(0, speeds.map(r => [frame.px(r.time), frame.py(r.correct.v)])));
      for (const r of speeds) {
        const at = frame.px(r.time);
        if (r.correct.lo !== undefined) frame.svg.append(shape('line', {x1: at, x2: at, y1: frame.py(Math.max(0, r.correct.lo)), y2: frame.py(Math.min(1, r.correct.hi)), stroke: colour_of(0)}));
        frame.svg.append(marker(0, at, frame.py(r.correct.v)));
      }
      speed_box.replaceChildren(frame.svg);
    });
  };
  const better = r => (r.ex_likelihood === null || r.shifted_likelihood === null ? null : r.ex_likelihood > r.shifted_likelihood ? 'ex-Gaussian' : 'shifted log-normal');
  answer_part('answers_body', 'Response times', chooser('Answer', kinds.map(r => answer_name(r.of)), show), charts,
      table({name: 'response_times', title: 'Response times', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('which', r => r.which), number_column('answers', r => r.times), number_column('median / s', r => r.median), number_column('mean / s', r => r.mean), number_column('SD / s', r => r.sd),
        ...['μ', 'σ', 'τ'].flatMap((name, i) => if_any(rows, number_column(`ex-Gaussian ${name} / s`, r => r.ex[i]))),
        ...['shift / s', 'mean of log', 'SD of log'].flatMap((name, i) => if_any(rows, number_column(`log-normal: ${name}`, r => r.shifted[i]))),
        ...if_any(rows, text_column('fits better', better))],
        note: `From the zero that the protocol names. Median of all: the mean of observers' medians, in brackets the ${level} over observers. ` + (rows.some(better) ? 'Both distributions by maximum likelihood, of an observer with 40 times at least; what fits better has the larger likelihood (both have three parameters).'
            : 'Distributions (ex-Gaussian, shifted log-normal) are fitted to an observer with 40 times at least: nobody has so many.') + on_rows(rows, 'response_times')}));
}

function show_tracks() {
  const tracks = answers.tracks;
  if (!tracks.length) return;
  const kinds = unique(tracks, t => [...t.of.slice(1), t.procedure].join('\t')), grid = element('div', {class: 'panels small'});
  const show = index => {
    const wanted = kinds[index], mine = tracks.filter(t => same_answer(t, wanted) && t.procedure === wanted.procedure), levels = mine.flatMap(t => t.steps.map(s => s[1]));
    const y = [Math.min(...levels), Math.max(...levels)], room = 0.06 * (y[1] - y[0] || 1);
    grid.replaceChildren();
    for (const t of mine) {
      const box = element('div', {class: 'chart'});
      grid.append(element('div', {}, element('b', {}, t.of[0]), element('span', {class: 'soft'}, mine.filter(o => o.of[0] === t.of[0]).length > 1 ? ` track ${t.track}` : ''), box));
      responsive(box, width => {
        const frame = plot({width, height: 190, x: [1, Math.max(2, t.steps.length)], y: [y[0] - room, y[1] + room], x_label: 'trial of the track', y_label: t.factor, label: `Track of ${t.procedure}, ${t.of[0]}`});
        frame.svg.append(curve(0, t.steps.map((s, i) => [frame.px(i + 1), frame.py(s[1])])));
        t.steps.forEach(([trial, at, value, right, turns], i) => {
          const dot = shape('circle', {cx: frame.px(i + 1), cy: frame.py(at), r: 3, stroke: colour_of(0), fill: value === null ? 'none' : right === 0 ? 'var(--paper)' : colour_of(0)});
          dot.append(shape('title', {}, `trial ${trial}: ${t.factor} ${digits(at)}, ${value === null ? 'missed' : value}${right === null ? '' : right ? ', correct' : ', wrong'}${turns ? ', a reversal' : ''}`));
          frame.svg.append(dot);
          if (turns) frame.svg.append(shape('circle', {cx: frame.px(i + 1), cy: frame.py(at), r: 6, class: 'mark'}));
        });
        box.replaceChildren(frame.svg);
      });
    }
  };
  const rows = tracks.map(t => ({...t, last: t.steps[t.steps.length - 1][1], turns: t.steps.filter(s => s[4]).length}));
  answer_part('answers_body', 'Levels that procedures chose', chooser('Procedure', kinds.map(t => `${t.procedure}, ${answer_name(t.of)}`), show), grid,
      element('p', {class: 'note'}, 'Full dots: answered, and correct where something is; open dots: wrong; rings: reversals.'),
      table({name: 'tracks', title: 'Tracks of procedures', rows, columns: [
        ...answer_columns(rows), text_column('procedure', r => r.procedure), number_column('track', r => r.track), text_column('factor', r => r.factor), number_column('trials', r => r.steps.length),
        number_column('reversals', r => r.turns), number_column('last level', r => r.last)], note: 'Each trial is in the table procedure_tracks.'}));
}

function show_differences() {
  const rows = answers.differences.filter(r => r.difference.v !== null);
  if (!rows.length) return;
  answer_part('answers_body', 'Do levels of factors differ in what is answered?', table({name: 'answer_differences', title: 'Differences of answers between levels', rows, columns: [
      ...answer_columns(rows).slice(1), text_column('measure', r => r.measure), text_column('factor', r => r.column), text_column('a', r => r.a), text_column('b', r => r.b), number_column('a − b', r => r.difference),
      p_column('p', r => r.p), p_column('p after Holm', r => r.holm), ...evidence_columns('', r => r.evidence), number_column('observers', r => r.observers), ...if_any(rows, number_column('planted', r => r.planted))],
      note: `Within observers. In brackets the ${level} over observers; p by flipping the signs of observers' differences. Holm: over the rows of an answer's measure.`}));
}

function show_matches() {
  const rows = answers.matches, lines = answers.match_lines, kinds = unique(rows.filter(of_all), r => [...r.of.slice(1), r.along, r.column].join('\t')), box = element('div', {class: 'chart'}), names = element('div');
  if (!kinds.length) return;
  const show = index => {
    const wanted = kinds[index], mine = rows.filter(r => of_all(r) && same_answer(r, wanted) && r.along === wanted.along && r.column === wanted.column && r.match.v !== null);
    const levels = [...new Set(mine.map(r => r.level))], all = mine.flatMap(r => [r.reference, r.match.v, r.match.lo, r.match.hi]).filter(v => Number.isFinite(v));
    names.replaceChildren(...(levels.length > 1 ? [curve_names(levels)] : []));
    responsive(box, width => {
      const ends = [Math.min(...all), Math.max(...all)], room = 0.05 * (ends[1] - ends[0] || 1), range = [ends[0] - room, ends[1] + room];
      const frame = plot({width: Math.min(width, 620), height: 360, x: range, y: range, x_label: `${wanted.along} of the reference`, y_label: `${wanted.along} that was set`, label: 'Matches'});
      frame.svg.append(shape('line', {x1: frame.px(range[0]), y1: frame.py(range[0]), x2: frame.px(range[1]), y2: frame.py(range[1]), class: 'axis', 'stroke-dasharray': '4 4'}));
      levels.forEach((one, i) => {
        const line = lines.find(r => of_all(r) && same_answer(r, wanted) && r.along === wanted.along && r.column === wanted.column && r.level === one && r.slope.v !== null && r.intercept.v !== null);
        const own = mine.filter(r => r.level === one).sort((a, b) => a.reference - b.reference);
        if (line && own.length > 1) frame.svg.append(curve(i, [own[0], own[own.length - 1]].map(r => [frame.px(r.reference), frame.py(line.intercept.v + line.slope.v * r.reference)])));
        for (const r of own) {
          if (r.match.lo !== undefined) frame.svg.append(shape('line', {x1: frame.px(r.reference), x2: frame.px(r.reference), y1: frame.py(r.match.lo), y2: frame.py(r.match.hi), stroke: colour_of(i)}));
          const dot = marker(i, frame.px(r.reference), frame.py(r.match.v));
          dot.append(shape('title', {}, `${one || 'all'}, reference ${digits(r.reference)}: ${estimate_text(r.match)}`));
          frame.svg.append(dot);
        }
      });
      box.replaceChildren(frame.svg);
    });
  };
  answer_part('answers_body', 'Matches', chooser('Match', kinds.map(r => `${answer_name(r.of)}, ${r.along}${r.column ? ` by ${r.column}` : ''}`), show), drawn_later(names, box),
      table({name: 'match_lines', title: 'Lines of matches over references', rows: rows_shown(lines), columns: [
        ...answer_columns(lines), text_column('along', r => r.along), ...if_any(lines, text_column('within', r => r.column ? `${r.column} ${r.level}` : '')), number_column('slope', r => r.slope), number_column('intercept', r => r.intercept),
        ...if_any(lines, number_column('slope, errors in both', r => r.deming)), ...if_any(lines, number_column('constancy (Brunswik)', r => r.brunswik)), ...if_any(lines, number_column('constancy (Thouless)', r => r.thouless)), number_column('settings', r => r.settings), ...if_any(lines, number_column('planted slope', r => r.planted))],
        note: `Dots: means over observers with the ${level}; broken line: a match that is the reference.` + on_rows(lines, 'match_lines')}),
      table({name: 'matches', title: 'Matches', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('along', r => r.along), ...if_any(rows, text_column('within', r => r.column ? `${r.column} ${r.level}` : '')), number_column('reference', r => r.reference), number_column('match', r => r.match),
        ...if_any(rows, number_column('constant error', r => r.error)), ...if_any(rows, number_column('SD', r => r.sd)), number_column('settings', r => r.settings), number_column('stopped at an end', r => r.at_end)],
        note: on_rows(rows, 'matches').trim()}));
}

function show_reliefs() {
  const rows = answers.reliefs, drawn = rows.filter(r => r.places.length > 1), box = element('div', {class: 'chart'});
  if (!rows.length) return;
  const show = index => {
    const places = drawn.length ? drawn[index].places : [];
    if (!places.length) return;
    responsive(box, width => {
      const of = i => [Math.min(...places.map(p => p[i])), Math.max(...places.map(p => p[i]))];
      const frame = plot({width: Math.min(width, 620), height: 320, x: of(0), y: of(1), x_label: 'true depth towards the eye (unit of the mesh)', y_label: 'depth of the relief', label: 'Relief over true depth'});
      for (const [truth, set] of places) frame.svg.append(marker(0, frame.px(truth), frame.py(set)));
      box.replaceChildren(frame.svg);
    });
  };
  answer_part('answers_body', 'Reliefs of gauge settings', ...(drawn.length ? [chooser('Relief', drawn.map(r => `${r.of[0] || 'all'}, ${r.of[2]}, ${r.of[3]}`), show), drawn_later(box)] : []),
      table({name: 'reliefs', title: 'Reliefs of gauge settings', rows, columns: [
        observer_column, text_column('answer', r => r.of[2]), text_column('shown', r => r.of[3]), number_column('points', r => r.points), number_column('settings', r => r.settings), number_column('from the true normal / deg', r => r.deviation),
        number_column('SD of repeats / deg', r => r.repeat), number_column('gain of attitudes', r => r.attitude_gain), ...if_any(rows, number_column('planted gain', r => r.planted)), number_column('gain of the relief', r => r.gain), number_column('r', r => r.r), number_column('gain, affine', r => r.affine_gain), number_column('shear x', r => r.x_shear), number_column('shear y', r => r.y_shear),
        number_column('r, affine', r => r.affine_r), ...remark_column(rows, r => r.note)],
        note: 'The relief that fits the settings best, by least squares, against the true depth: with a gain, and with a gain and shears (affine). Depths are in the unit of the mesh, from the mean depth. Where places lie farther apart than the folds of the surface, attitudes at them do not add up to its depth, whoever sets them: gain and r are then below those of the settings. The gain of attitudes is of each place by itself, and free of that.'}));
}

if (answers) {
  // What the main result is of comes first.
  const parts = {curves: show_curves, matches: show_matches, reliefs: show_reliefs, likenesses: show_likenesses, scales: show_scales, trends: show_trends,
                 ratings: show_ratings, choices: show_choices, times: show_times, tracks: show_tracks, differences: show_differences};
  const main_part = parts[data.headline.measure];
  if (main_part) main_part();
  for (const part of Object.values(parts)) if (part !== main_part) part();
} else by_id('answers').hidden = true;

// Looking and answering.
if (answers && answers.gaze.length) {
  const all = answers.gaze.filter(of_all), of_slots = all.filter(r => !r.area), of_areas = all.filter(r => r.area);
  const chart = element('div', {class: 'chart'});
  if (of_slots.length) {
    const panels = panels_of(of_slots, r => answer_name(r.of), r => ({label: r.measure, estimate: r.value, each: r.each, expected: r.chance}));
    bars(chart, panels, {x_label: 'of the stimulus that was chosen', most: 1, label: 'How the chosen stimulus was looked at', as_points: true});
    by_id('answer_gaze_chart').append(chart, element('p', {class: 'note'}, 'Grey bars: what it would be if each observer chose as often, and looked as much, but one independently of the other. ' +
        'A stimulus may be looked at because it is going to be chosen, and chosen because it was looked at: both look like this.'));
  }
  if (of_areas.length) {
    const areas = element('div', {class: 'chart'});
    bars(areas, panels_of(of_areas, r => `${answer_name(r.of)}: ${r.a} less ${r.b}`, r => ({label: r.area, estimate: r.value, each: r.each})),
         {x_label: 'share of the time on the stimulus, difference', most: 0, label: 'Areas looked at before one answer less before another', as_points: true});
    by_id('answer_gaze_chart').append(areas);
  }
  by_id('answer_gaze_table').append(table({name: 'gaze_and_choice', title: 'Looking and answering', rows: rows_shown(answers.gaze), columns: [
      ...answer_columns(answers.gaze), text_column('measure', r => r.measure), text_column('area', r => r.area || 'all'), ...if_any(answers.gaze, text_column('a', r => r.a)), ...if_any(answers.gaze, text_column('b', r => r.b)),
      number_column('value', r => r.value), number_column('by chance', r => r.chance), p_column('p', r => r.p), p_column('p after Holm', r => r.holm), ...evidence_columns('', r => r.evidence), number_column('observers', r => r.observers), number_column('answers', r => r.trials),
      ...if_any(answers.gaze, number_column('planted', r => r.planted))],
      note: `Counted fixations that began before the answer, up to it. In brackets the ${level} over observers; p by flipping the signs of observers' differences from chance, after Holm over the rows of the answer. Each answer is in the table answer_gaze.` + on_rows(answers.gaze, 'gaze_and_choice')}));
} else by_id('answer_gaze').hidden = true;

// Maps of gaze before one answer less before another.
if (data.answer_maps.length) {
  const caption = by_id('answer_map_caption'), title = element('b'), text = element('span'), here = element('span', {role: 'status'});
  caption.append(title, text, here);
  const view = new MapView(by_id('stage_answers'), caption), maps = data.answer_maps;
  const show = index => {
    const map = maps[index], object = data.objects[map.object], geometry = geometry_of(object, map.object);
    here.textContent = '';
    title.textContent = `${object.title || object.id}: gaze before ${map.column}, ${map.a} less ${map.b}. `;
    if (!map.values) {
      text.textContent = map.absent || object.remark || 'There is no map of these.';
      view.show(geometry, null, colour_tables.viridis, null);
      return;
    }
    const values = Float32Array.from(numbers_of(map.values, Int8Array), q => 0.5 + 0.5 * q / 127), of_cluster = bytes_of(map.cluster);
    const clusters = map.clusters.filter(c => c.p <= alpha).length;
    text.textContent = `Red: looked at more before ${map.a}, blue: before ${map.b}; full colour is ${digits(map.most)} of the fixation time per mm². ${map.observers} observers; ` +
        (clusters ? `${clusters} of ${map.clusters.length} clusters with corrected p at most ${digits(alpha, 2)}.` : `no cluster with corrected p at most ${digits(alpha, 2)}.`) +
        (map.least_p > alpha + 1e-9 ? ` So many observers can give no p below ${digits(map.least_p)}.` : '');
    view.show(geometry, values, colour_tables.coolwarm, (value, v) => {
      const n = of_cluster[v], c = n ? map.clusters[n - 1] : null;
      return `${digits((2 * value - 1) * map.most)} of the fixation time per mm²` + (c ? `, in cluster ${n} (${digits(c.area)} mm², p ${p_text(c.p)})` : ', in no cluster');
    });
  };
  by_id('answer_map_pick').append(chooser('Map', maps.map(m => `${data.objects[m.object].title || data.objects[m.object].id}: ${words(m.keys)}, ${m.column}, ${m.a} less ${m.b}`), show));
  const rows = maps.flatMap(m => (m.clusters.length ? m.clusters.filter((c, i) => i === 0 || c.p <= 0.2).map((c, i) => ({m, c, where: (c.part !== null ? data.objects[m.object].parts[c.part] : 'n/a') + `, cluster ${i + 1} of ${m.clusters.length}`})) : [{m, c: null, where: m.absent || 'no vertex beyond the threshold'}]));
  const of_cluster = of => row => (row.c ? of(row.c) : null);
  by_id('answer_map_table').append(table({name: 'answer_map_clusters', title: 'Where gaze differs before answers', rows, columns: [
      ...factor_columns(rows, r => r.m.keys), text_column('object', r => data.objects[r.m.object].title), text_column('answer', r => r.m.column), text_column('a', r => r.m.a), text_column('b', r => r.m.b), number_column('observers', r => r.m.observers),
      text_column('where', r => r.where), number_column('area / mm²', of_cluster(c => c.area)), share_column('a less b, of the fixation time', of_cluster(c => c.difference)), p_column('p', of_cluster(c => c.p)), p_column('p over all maps', of_cluster(c => c.p_all))],
      note: 'As in "Where conditions differ", of fixations that began before the answer. Shown are the largest cluster of each map, and others with p up to 0.2.'}));
} else by_id('answer_map').hidden = true;
