// Areas of the screen, and which sections a study has.

{
  const rows = data.tables.areas, ways = data.tables.transitions, all = rows.filter(r => !r.keys.length);
  if (rows.length) {
    const overall = all.length ? all : rows, by_area = r => ({label: r.area, estimate: r.share});
    bars(by_id('areas_chart'), [{name: 'share of the time of fixation', bars: overall.map(by_area)}, {name: 'by chance', bars: overall.filter(r => r.chance !== null).map(r => ({label: r.area, estimate: {v: r.chance}}))}],
         {x_label: 'share of the time', most: 1, label: 'Share of the time of fixation in each area of the screen, and by chance'});
    by_id('areas_table').append(table({name: 'screen_areas', title: 'Areas of the screen', rows, columns: [
        ...factor_columns(rows, r => r.keys), text_column('area', r => r.area), share_column('of the time of fixation', r => r.share), share_column('by chance', r => r.chance),
        number_column('visits in a trial', r => r.visits), share_column('of trials with a fixation', r => r.reached), number_column('first arrival / s', r => r.arrival),
        number_column('observers', r => r.observers), number_column('trials', r => r.trials), number_column('fixations', r => r.fixations)],
        note: `Means over observers of their own means; in brackets the ${level} over observers. A fixation is in an area if its mean place is, and if the area is there halfway through it; (none): in no area of the trial. ` +
        'By chance: the share that gaze spread evenly over the screen and the presentation would have. A visit is a run of fixations in the area; first arrival is the onset of the first of them, in trials that have one. Single trials are in screen_area_trials.'}));
    by_id('transitions_table').append(ways.length ? table({name: 'transitions', title: 'From one area straight to another', rows: ways, columns: [
        text_column('from', r => r.from), text_column('to', r => r.to), number_column('times', r => r.count), number_column('trials', r => r.trials)],
        note: 'Over all trials: of two successive fixations the first is in one area and not in the other, the second the other way round. Single trials are in screen_area_transitions.'})
        : element('p', {class: 'note'}, 'Gaze never went straight from one area to another.'));
  }
  by_id('areas').hidden = rows.length === 0;
}

// Where nothing is known of what was shown, no section of it is left empty: the remarks at the beginning say what was not computed.
if (!data.knows_stimuli)
  for (const id of ['maps', 'figure4', 'surface_areas', 'figure5', 'table1', 'measures', 'ways', 'effects', 'differences', 'metrics', 'motion', 'light', 'course']) if (by_id(id)) by_id(id).hidden = true;
for (const link of document.querySelectorAll('nav a')) link.hidden = document.querySelector(link.getAttribute('href')).hidden;
