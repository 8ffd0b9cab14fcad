// How gaze goes over the surface, and what else of trials differs between two levels.

{
  const put = (id, name, title, rows, columns, note) => {
    if (rows.length) by_id(id).append(element('h3', {}, title), table({name, title, rows, columns, note}));
  };
  const t = data.tables, differ = t.measure_differences;
  put('measures_body', 'measure_differences', 'Two levels compared, measure by measure', differ, [
      text_column('measure', r => r.measure), text_column('of', r => r.of), text_column('a', r => r.a), text_column('b', r => r.b), text_column('unit', r => r.unit),
      number_column('a - b', r => r.difference), p_column('p', r => r.p), p_column('p after Holm', r => r.holm), ...evidence_columns('', r => r.evidence), number_column('observers', r => r.observers)],
      `Within observers, on the same object with all else alike, then averaged; in brackets the ${level} over observers. p flips the signs of observers' differences; after Holm: corrected for the rows of the measure, not over measures. ` +
      'Areas: dwell_s, visits, visit_s, reached, first_arrival_s; transition: the probability that the next fixation is there. ' + evidence_note);
  put('measures_body', 'time_clusters', 'When two levels differ', t.time_clusters, [
      text_column('area', r => r.area), text_column('a', r => r.a), text_column('b', r => r.b), number_column('from / s', r => r.from), number_column('to / s', r => r.to),
      share_column('a less b, of the fixation time', r => r.difference), p_column('p', r => r.p), p_column('p over all rows', r => r.p_all), p_column('smallest p there can be', r => r.least), number_column('observers', r => r.observers)],
      'Successive stretches of the presentation in which the share of the time on the area differs beyond a threshold of t, tested by the largest that flips of the signs of observers give. That there is a difference is what p says, not exactly when it begins.');
  by_id('measures').hidden = !differ.length && !t.time_clusters.length;

  const ways = without_repeats(t.ways, r => r.keys);
  put('ways_body', 'ways_of_gaze', 'Ways of gaze', ways, [
      ...factor_columns(ways, r => r.keys), number_column('fixations', r => r.fixations), number_column('duration / s', r => r.fixation), mm_column('step / mm', r => r.step_mm), number_column('step / deg', r => r.step_deg),
      mm_column('way / mm', r => r.way), share_column('covered', r => r.coverage), share_column('effective share of the surface', r => r.effective), share_column('recurrence', r => r.recurrence),
      share_column('determinism', r => r.determinism), share_column('distance of returns', r => r.distance), number_column('observers', r => r.observers), number_column('trials', r => r.trials)],
      `Of a trial, means over observers; in brackets the ${level}. A step is the way along the surface from one fixation to the next. Covered: of the visible surface, no farther than the kernel from a fixation. ` +
      'Recurrence: of the pairs of fixations, those no farther from each other than that; determinism: of these, those that repeat a way. All of these grow or shrink with the number of fixations.');
  const likeness = without_repeats(t.likeness, r => r.keys, r => [r.measure, r.a, r.b]);
  put('ways_body', 'ways_alike', 'How alike the ways of two observers are', likeness, [
      text_column('measure', r => r.measure), ...factor_columns(likeness, r => r.keys), text_column('a', r => r.a), text_column('b', r => r.b), number_column('same level', r => r.same), number_column('other level', r => r.other),
      number_column('same less other', r => r.effect), number_column('order by chance', r => r.shuffled), number_column('observers', r => r.observers)],
      'ScanMatch and MultiMatch with distances along the surface; 1: the same. Two observers who saw the same level are the ceiling of two who saw different ones. Order by chance: what is left if the fixations of one of both come in any order.');
  const first = without_repeats(t.first_fixations, r => r.keys, r => [r.area, r.number]);
  put('ways_body', 'first_fixations', 'First fixations', first, [
      text_column('area', r => r.area), ...factor_columns(first, r => r.keys), number_column('fixation', r => r.number), share_column('on the area', r => r.at), share_column('of all up to it', r => r.up_to),
      number_column('observers', r => r.observers), number_column('trials', r => r.trials)],
      'Of trials that have so many: how many have their first, second … counted fixation on the area.');
  by_id('ways').hidden = !ways.length && !likeness.length && !first.length;
}

