// How observers turned objects.

{
  const rows = data.explorations, levels = rows.filter(r => !r.of), of_observers = rows.filter(r => r.of);
  const measures = [['path_deg', 'path / deg'], ['turned_share', 'share of the time'], ['speed_deg_s', 'speed / (deg/s)'], ['reversals', 'reversals'], ['poses', 'poses seen']];
  by_id('explorations').hidden = rows.length === 0;
  if (rows.length) {
    const name_of = r => (r.column ? r.level : 'all'), chart = element('div', {class: 'chart'});
    const show = index => {
      const [key, name] = measures[index];
      bars(chart, panels_of(levels.filter(r => r[key].v !== null), r => r.column, r => ({label: name_of(r), estimate: r[key],
             each: of_observers.filter(o => o.column === r.column && o.level === r.level && o[key].v !== null).map(o => o[key].v)})),
           {x_label: `${name}, of a show`, most: 0, label: `How objects were turned: ${name}`});
    };
    by_id('explorations_body').append(chooser('Measure', measures.map(m => m[1]), show), chart,
        table({name: 'explorations', title: 'How objects were turned', rows: levels, columns: [
          text_column('factor', r => r.column || 'all'), text_column('level', r => r.level || 'all'), ...measures.map(([key, name]) => number_column(name, r => r[key])),
          number_column('observers', r => r.observers), number_column('shows', r => r.shows)],
          note: `Of objects that observers turned themselves; means over observers of their own means over shows, in brackets the ${level}; dots: single observers. Path: the sum of the angles between poses that follow one another; ` +
              'speed: path over the time of turning; a reversal turns against the direction of the turn before. Each show is in the table exploration_shows.'}));
  }
}
