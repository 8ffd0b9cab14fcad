// What grows or falls with a number, and what stays together where the odd one out is chosen.

// Of what is drawn once the page is laid out a browser tells the size in the same frame only if it lies deeper
// than what was told of before.
const drawn_later = (...parts) => element('div', {}, ...parts);

function show_trends() {
  const all = answers.trends.filter(r => of_all(r) && r.slope.v !== null);
  if (!all.length) return;
  // Times first: that a line is told of them is most often what they were taken for; and of a search with its target apart from
  // that without, as the page's first sentence has it.
  const is_time = r => r.measure.includes('time'), place = r => (is_time(r) ? 0 : 2) + (r.column === 'target' ? 0 : 1);
  const order = all.map((r, i) => [place(r), i, r]).sort((a, b) => a[0] - b[0] || a[1] - b[1]).map(([, , r]) => r);
  const kinds = unique(order, r => [...r.of.slice(1), r.measure, r.along, r.column].join('\t')), box = element('div', {class: 'chart'}), names = element('div');
  const show = index => {
    const wanted = kinds[index], mine = all.filter(r => same_answer(r, wanted) && r.measure === wanted.measure && r.along === wanted.along && r.column === wanted.column);
    names.replaceChildren(...(mine.length > 1 ? [curve_names(mine.map(r => `${r.column} ${r.level}`))] : []));
    const points = mine.flatMap(r => r.points), xs = points.map(p => p[0]), ends = [Math.min(...xs), Math.max(...xs)];
    const heights = points.flatMap(p => [p[1].v, p[1].lo, p[1].hi]).filter(v => Number.isFinite(v)), room = 0.06 * (ends[1] - ends[0] || 1);
    const share = wanted.measure === 'share correct', low = Math.min(...heights), high = Math.max(...heights), above = 0.08 * (high - low || Math.abs(high) || 1);
    responsive(box, width => {
      const x = [ends[0] - room, ends[1] + room], y = share ? [0, 1] : [is_time(wanted) ? 0 : low - above, high + above];
      const frame = plot({width: Math.min(width, 620), height: 340, x, y, x_label: wanted.along, y_label: wanted.measure === 'mean' ? answer_name(wanted.of) : wanted.measure, label: `${wanted.measure} over ${wanted.along}`});
      mine.forEach((r, i) => {
        if (r.intercept.v !== null) frame.svg.append(curve(i, ends.map(at => [frame.px(at), frame.py(Math.min(y[1], Math.max(y[0], r.intercept.v + r.slope.v * at)))])));
        for (const [at, mean] of r.points) {
          if (mean.lo !== undefined) frame.svg.append(shape('line', {x1: frame.px(at), x2: frame.px(at), y1: frame.py(Math.max(y[0], mean.lo)), y2: frame.py(Math.min(y[1], mean.hi)), stroke: colour_of(i)}));
          const dot = marker(i, frame.px(at), frame.py(mean.v));
          dot.append(shape('title', {}, `${r.column ? `${r.column} ${r.level}, ` : ''}${wanted.along} ${digits(at)}: ${estimate_text(mean)}`));
          frame.svg.append(dot);
        }
      });
      box.replaceChildren(frame.svg);
    });
  };
  const rows = answers.trends;
  answer_part('answers_body', 'What goes with a number', chooser('Line', kinds.map(r => `${answer_name(r.of)}: ${r.measure} over ${r.along}${r.column ? ` by ${r.column}` : ''}`), show), drawn_later(names, box),
      table({name: 'answer_trends', title: 'Lines over numbers', rows: rows_shown(rows), columns: [
        ...answer_columns(rows), text_column('measure', r => r.measure), text_column('over', r => r.along), ...if_any(rows, text_column('within', r => (r.column ? `${r.column} ${r.level}` : ''))), number_column('slope', r => r.slope), number_column('intercept', r => r.intercept),
        number_column('answers', r => r.answers), number_column('observers', r => r.observers), ...if_any(rows, number_column('planted slope', r => r.planted))],
        note: `Dots: means over observers with the ${level}. Slope: per unit of the factor, by least squares over each observer's answers, then the mean over observers. Response times are of answers that are not wrong.` + on_rows(rows, 'answer_trends')}));
}

function show_likenesses() {
  const rows = answers.likenesses.filter(r => of_all(r) && r.share.v !== null);
  if (!rows.length) return;
  const factors = [...new Map(rows.map(r => [[...r.of.slice(1), r.factor].join('\t'), r])).values()], box = element('div', {class: 'chart'}), note = element('p', {class: 'note'});
  const show = index => {
    const wanted = factors[index], mine = rows.filter(r => same_answer(r, wanted) && r.factor === wanted.factor);
    const levels = [...new Set(mine.flatMap(r => [r.a, r.b]))].sort((a, b) => (Number.isFinite(Number(a)) && Number.isFinite(Number(b)) ? Number(a) - Number(b) : a < b ? -1 : 1));
    const at = (a, b) => mine.find(r => (r.a === a && r.b === b) || (r.a === b && r.b === a));
    note.textContent = `In how many of the trials that show both, two stay together: neither is chosen as the one that does not belong. By chance ${percent(wanted.chance)}. Empty: never shown together.`;
    responsive(box, width => {
      const left = Math.min(180, 14 + Math.max(...levels.map(width_of))), side = Math.max(24, Math.min(72, Math.floor((width - left - 10) / levels.length))), top = 12;
      const across = left + side * levels.length, foot = Math.min(180, 14 + Math.max(...levels.map(width_of)));
      const svg = shape('svg', {width: across + 10, height: top + side * levels.length + foot, viewBox: `0 0 ${across + 10} ${top + side * levels.length + foot}`, role: 'img', 'aria-label': `What stays together, by ${wanted.factor}`});
      levels.forEach((row, i) => {
        svg.append(shape('text', {x: left - 6, y: top + side * (i + 0.5) + 4, 'text-anchor': 'end'}, row));
        const x = left + side * (i + 0.5) + 4, y = top + side * levels.length + 8;
        svg.append(shape('text', {x, y, 'text-anchor': 'end', transform: `rotate(-90 ${x} ${y})`}, row));
        levels.forEach((column, k) => {
          const found = at(row, column), cell = {x: left + side * k + 1, y: top + side * i + 1, width: side - 2, height: side - 2};
          const box_of = shape('rect', found ? {...cell, fill: colour_of(0), 'fill-opacity': (0.06 + 0.5 * found.share.v).toFixed(3)} : {...cell, fill: 'none', stroke: 'var(--line)'});
          if (found) {
            box_of.append(shape('title', {}, `${row} and ${column}: ${estimate_text(found.share)}, ${found.together} of ${found.trials}`));
            svg.append(box_of, shape('text', {x: cell.x + cell.width / 2, y: cell.y + cell.height / 2 + 4, 'text-anchor': 'middle'}, (100 * found.share.v).toFixed(0)));
          } else svg.append(box_of);
        });
      });
      box.replaceChildren(svg);
    });
  };
  answer_part('answers_body', 'What stays together', chooser('Factor', factors.map(r => `${answer_name(r.of)}, ${r.factor}`), show), drawn_later(box), note,
      table({name: 'answer_likenesses', title: 'What stays together', rows, columns: [
        ...answer_columns(rows).slice(1), text_column('factor', r => r.factor), text_column('a', r => r.a), text_column('b', r => r.b), share_column('together', r => r.share), share_column('by chance', r => r.chance), number_column('pairs', r => r.trials),
        ...if_any(rows, share_column('planted', r => r.planted))],
        note: `In brackets the ${level} over observers. Single observers are in the table answer_likenesses beside the page.`}));
}
