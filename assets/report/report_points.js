// Places that observers pointed at as their answers.

{
  const points = data.points;
  by_id('points').hidden = !points;
  if (points) {
    const answer_of = ([, task, answer]) => (new Set(points.spreads.map(r => r.of[1])).size > 1 ? `${task}, ${answer}` : answer), several = points.pictures.length > 1;
    const names = [...new Set(points.spreads.filter(r => !r.of[0]).map(r => answer_of(r.of)))], box = element('div', {class: 'chart'}), keys = element('div');
    const show = index => {
      const picture = points.pictures[index], [wide, high] = picture.size;
      const there = names.map((name, i) => [name, i]).filter(([name]) => picture.places.some(p => answer_of([, p[2], p[3]]) === name));
      keys.replaceChildren(element('ul', {class: 'curves', 'aria-label': 'Answers'}, ...there.map(([name, i]) => {
        const sample = shape('svg', {width: 14, height: 14, viewBox: '0 0 14 14', 'aria-hidden': 'true'});
        sample.append(marker(i, 7, 7));
        return element('li', {}, sample, name);
      })));
      responsive(box, width => {
        const across = Math.min(width, 520), scale = across / wide, svg = shape('svg', {width: across, height: high * scale, viewBox: `0 0 ${across} ${high * scale}`, role: 'img', 'aria-label': `Places that were pointed at on ${picture.object}`});
        for (const [x, y] of picture.shape) svg.append(shape('circle', {cx: (x * scale).toFixed(1), cy: (y * scale).toFixed(1), r: 1.2, fill: 'var(--soft)', 'fill-opacity': 0.35}));
        for (const [x, y, task, answer, observer, part] of picture.places) {
          const dot = marker(names.indexOf(answer_of([, task, answer])), x * scale, y * scale);
          dot.append(shape('title', {}, `${observer}: ${answer_of([, task, answer])}${part ? `, on ${part}` : ''}`));
          svg.append(dot);
        }
        box.replaceChildren(svg);
      });
    };
    const all = rows => rows.filter(r => !r.of[0]), object_column = rows => (several ? [text_column('object', r => r.of[r.of.length - 1])] : []);
    const parts = [chooser('Object', points.pictures.map(p => p.object), show), drawn_later(keys, box),
      element('p', {class: 'note'}, 'The object from the front, as it stands unturned; what was pointed at while it was turned is drawn where it lies on the surface. Grey: places of the surface that could be seen. Each place is in the table answered_points.'),
      table({name: 'answered_point_spreads', title: 'How places lie to each other', rows: all(points.spreads), columns: [
        text_column('answer', r => answer_of(r.of)), ...object_column(), number_column('answers', r => r.answers), number_column('on the object', r => r.on_surface), number_column('observers', r => r.observers),
        text_column('middle on', r => r.middle_part), number_column('spread / mm', r => r.spread), number_column('of one observer / mm', r => r.within), number_column('between observers / mm', r => r.between),
        number_column('by chance / mm', r => r.chance), number_column('share of chance', r => r.of_chance)],
        note: `Middle: that of the places which lies nearest to all; spread: root mean square of the distances from it. Of one observer, between observers: mean distance of two places, straight through space, in brackets the ${level} over observers. ` +
            'By chance: of two places that are drawn evenly from the object\'s pictures. Single observers are in the table answered_point_spreads beside the page.'})];
    if (all(points.areas).length)
      parts.push(table({name: 'answered_point_areas', title: 'On which areas places lie', rows: all(points.areas), columns: [
        text_column('answer', r => answer_of(r.of)), ...object_column(), text_column('area', r => r.area), share_column('share', r => r.share), share_column('by chance', r => r.chance), number_column('answers', r => r.answers), number_column('observers', r => r.observers)],
        note: `Means over observers of their own shares, in brackets the ${level}. By chance: the share of the area in the object's pictures.`}));
    if (all(points.pairs).length)
      parts.push(table({name: 'answered_point_pairs', title: 'How far two answers of a trial lie apart', rows: all(points.pairs), columns: [
        ...(new Set(points.pairs.map(r => r.of[1])).size > 1 ? [text_column('task', r => r.of[1])] : []), text_column('one', r => r.first), text_column('other', r => r.second), ...object_column(), number_column('distance / mm', r => r.distance), number_column('trials', r => r.trials), number_column('observers', r => r.observers)],
        note: `Straight through space; means over observers, in brackets the ${level}.`}));
    by_id('points_body').append(...parts);
  }
}
