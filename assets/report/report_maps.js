// The maps on the surface, side by side.
'use strict';

const kind = by_id('map_kind'), weighting = by_id('map_weighting'), scale = by_id('map_scale'), colours = by_id('map_colours'), clusters_shown = by_id('map_clusters');
const common = {};
for (const w of ['duration', 'count']) common[w] = Math.max(1e-300, ...data.maps.filter(m => m.by === w && m.values).map(m => m.peak));
const exposure_kinds = {exposure: ['exposure', 'share of the exposure per mm²'], seconds: ['time visible', 's of a presentation']};
for (const what of Object.keys(exposure_kinds)) common[what] = Math.max(1e-300, ...data.objects.filter(s => s[what]).map(s => s[what].most));
const common_difference = Math.max(1e-300, ...data.differences.filter(d => d.values).map(d => d.most));

class Panel {
  constructor(letter, first) {
    this.picks = by_id('pick_' + letter);
    this.caption = by_id('caption_' + letter);
    this.caption.append(element('b'), element('span'), element('span', {role: 'status'}));
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
      add('object', data.objects.map((s, i) => [String(i), s.title || s.id]));
      if (this.first && this.chosen.quantity === undefined) this.chosen.quantity = 'seconds';
      add('quantity', Object.entries(exposure_kinds).map(([what, texts]) => [what, texts[0]]));
    } else if (kind.value === 'difference') {
      const options = data.differences.map((d, i) => [String(i), `${data.objects[d.object].title}: ${words(d.keys)}, ${d.a} less ${d.b}`]);
      add('difference', options);
      if (this.first && options.length > 1 && this.chosen.seen === undefined) {
        this.chosen.seen = true;
        this.picks.querySelector('select').selectedIndex = Math.min(this.first, options.length - 1);
        this.chosen.difference = this.picks.querySelector('select').value;
      }
    } else {
      const columns = data.by.filter(c => c !== 'object');
      const values = column => [...new Set(data.groups.flatMap(g => g.keys.filter(k => k[0] === column).map(k => k[1])))];
      add('object', data.objects.map((s, i) => [String(i), s.title || s.id]));
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
      const object = Number(this.chosen.object), found = data.objects[object] && data.objects[object][this.chosen.quantity];
      return found ? {object, ...found} : null;
    }
    if (kind.value === 'difference') return data.differences[Number(this.chosen.difference)];
    return data.maps.find(m => m.by === weighting.value && m.object === Number(this.chosen.object) &&
                               data.groups[m.group].keys.every(([c, v]) => c === 'object' || this.chosen[c] === v));
  }
  // What is shown, in words that stand without the controls: on paper there are none.
  title(map, object) {
    const of_object = object ? object.title || object.id : '', others = keys => words(keys.filter(([column]) => column !== 'object'));
    if (kind.value === 'exposure') return `${of_object}: ${exposure_kinds[this.chosen.quantity][0]}`;
    if (kind.value === 'difference') return map ? `${of_object}: ${others(map.keys)}, ${map.column} ${map.a} less ${map.b}` + (clusters_shown.value === 'all' ? '' : ', significant clusters alone') : 'No difference';
    const chosen = data.by.filter(column => column !== 'object').map(column => [column, this.chosen[column]]);
    return `${of_object}: ${words(chosen)}, fixations weighted by ${weighting.value === 'duration' ? 'duration' : 'number'}`;
  }
  show() {
    const map = this.map(), [title, text, here] = this.caption.children;
    here.textContent = '';
    const index = map ? map.object : Number(this.chosen.object || 0);
    const object = data.objects[index], geometry = object ? geometry_of(object, index) : null;
    title.textContent = this.title(map, object) + '. ';
    if (!map || !map.values) {
      text.textContent = (map && map.absent) || (object && object.remark) || 'There is no map of these.';
      this.view.show(geometry, null, colour_tables.viridis, null);
      return;
    }
    const coarse = object.mesh.vertices < object.mesh.of ?
        ` Shown with ${object.mesh.vertices.toLocaleString('en')} of ${object.mesh.of.toLocaleString('en')} vertices.` : '';
    if (kind.value === 'exposure') {
      const [name, unit] = exposure_kinds[this.chosen.quantity], most = scale.value === 'own' ? map.most : common[this.chosen.quantity];
      const values = Float32Array.from(bytes_of(map.values), q => q / 255 * map.most / most);
      const all = data.tables.exposures.find(e => e.object === index && e.part === 'all');
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
  const swatch = (colour, text) => element('span', {class: 'swatch'}, element('i', {style: `background:${colour}`}), text);
  const low = is_difference ? 128 : 0, c = colour_tables[name], has_numbers = scale.value === 'common' && quantities.length < 2;
  const values = has_numbers ? ticks(is_difference ? -most : 0, most, 4) : [];
  const svg = shape('svg', {width: 330, height: 44, viewBox: '0 0 330 44', role: 'img', 'aria-label': 'Legend: ' + unit});
  svg.append(shape('image', {href: canvas.toDataURL(), x: 15, y: 4, width: 300, height: 18, preserveAspectRatio: 'none'}));
  for (const v of values) svg.append(shape('text', {x: 15 + 300 * (is_difference ? 0.5 + 0.5 * v / most : v / most), y: 37, 'text-anchor': 'middle'}, digits(v)));
  if (!has_numbers) svg.append(shape('text', {x: 15, y: 37}, 'lowest'), shape('text', {x: 315, y: 37, 'text-anchor': 'end'}, scale.value === 'common' ? 'highest' : 'highest of each map'));
  by_id('legend').replaceChildren(svg, element('p', {}, swatch('rgb(150,150,150)', 'never visible'),
      swatch(`rgb(${c[3 * low]},${c[3 * low + 1]},${c[3 * low + 2]})`, is_difference ? 'no difference' : is_exposure ? 'hardly visible' : 'visible, not looked at'),
      element('span', {class: 'soft'}, unit + (scale.value === 'common' ? ', one scale for all maps' : ', each map its own scale'))));
}

if (!data.differences.some(d => d.values)) kind.querySelector('[value=difference]').disabled = true;
if (!data.objects.some(s => s.exposure || s.seconds)) kind.querySelector('[value=exposure]').disabled = true;
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

