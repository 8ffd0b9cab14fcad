// Single trials: the object as it turned, and the trace of gaze.
'use strict';

const traces = new Map(data.traces.map(t => [t.trial, t]));
const view = new TrialView(by_id('stage_trial'));
let trial = null, angles = null, marker_line = null, frame_of_trace = null, clock = null, trace_width = 560;

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
  trial.fixations.forEach((fixation, i) => {
    const [onset, duration, x, y, position] = fixation, counted = counts(fixation);
    const now = time >= onset && time < onset + duration;
    if (onset <= time && (keep || now)) circles.push({position, place: [x, y], number: i + 1, radius: 30 * Math.sqrt(Math.max(0.02, duration)), now, counted});
  });
  view.draw(angle_at(time), circles, (trial.areas === undefined ? [] : data.area_sets[trial.areas]).filter(a => time >= a.from && (a.until === null || time < a.until)));
  if (marker_line) for (const name of ['x1', 'x2']) marker_line.setAttribute(name, frame_of_trace.px(time));
}
view.redraw = () => { if (trial) draw_time(); };

// Times in s, places in px as pairs (null: the eye was lost), pupils from 0 to 1.
function samples_of(trace) {
  const steps = numbers_of(trace.steps, Uint16Array), places = numbers_of(trace.places, Int16Array);
  let time = 0;
  return {times: Array.from(steps, step => (time += step) / 1e4), places, pupils: Array.from(bytes_of(trace.pupils), p => p / 255)};
}

// The path of one axis of gaze; `place` gives the point of a time and an angle from the middle of the screen.
function gaze_path({times, places}, of_trial, axis, place) {
  const object = data.objects[of_trial.object], ppd = object.px_per_deg || 1;
  let d = '', down = false;
  times.forEach((t, i) => {
    const q = places[2 * i + axis];
    if (q === -32768) { down = false; return; }
    const [x, y] = place(t, (axis ? -1 : 1) * (q / 10 - object.screen[axis] / 2) / ppd);
    d += (down ? 'L' : 'M') + x.toFixed(1) + ' ' + y.toFixed(1);
    down = true;
  });
  return d;
}

// How far gaze goes from the middle, in degrees; a sample far beside the screen does not make all else small.
function reach_of({places}, of_trial) {
  const object = data.objects[of_trial.object], ppd = object.px_per_deg || 1;
  let most = 2;
  places.forEach((q, i) => { if (q !== -32768) most = Math.max(most, Math.abs(q / 10 - object.screen[i % 2] / 2) / ppd); });
  return Math.min(1.05 * most, Math.max(...object.screen) / ppd);
}

const axis_colours = [colour_of(0), colour_of(5)];
const chosen_trial = () => Number(by_id('trial').value);

function draw_trace(width) {
  const box = by_id('trace'), trace = traces.get(chosen_trial());
  box.replaceChildren();
  marker_line = null;
  if (!trace) { box.append(element('p', {class: 'note'}, 'There is no trace of this trial: it has no gaze samples.')); return; }
  const samples = samples_of(trace), reach = reach_of(samples, trial);
  const frame = plot({width, height: Math.min(420, Math.max(300, 0.6 * width)), x: [0, trial.seconds || 8], y: [-reach, reach], x_label: 'time since onset / s', y_label: 'gaze from the middle / deg', label: 'Gaze trace'});
  const shade = {f: 'var(--fixation)', s: 'var(--saccade)', b: 'var(--blink)'};
  for (const [what, onset, duration] of trace.events) {
    const from = Math.max(frame.left, frame.px(onset)), to = Math.min(frame.right, frame.px(onset + duration));
    if (to > from) frame.svg.insertBefore(shape('rect', {x: from, width: to - from, y: frame.top, height: frame.floor - frame.top, fill: shade[what]}), frame.svg.firstChild);
  }
  for (const axis of [0, 1])
    frame.svg.append(shape('path', {d: gaze_path(samples, trial, axis, (t, v) => [frame.px(t), frame.py(Math.max(-reach, Math.min(reach, v)))]), fill: 'none', stroke: axis_colours[axis], 'stroke-width': 1.3}));
  if (samples.pupils.some(p => p)) {
    const d = samples.times.map((t, i) => (samples.pupils[i] ? frame.px(t).toFixed(1) + ',' + (frame.floor - 60 * samples.pupils[i]).toFixed(1) : '')).filter(Boolean).join(' ');
    frame.svg.append(shape('polyline', {points: d, fill: 'none', stroke: 'var(--soft)', 'stroke-width': 0.8}));
  }
  marker_line = shape('line', {x1: frame.left, x2: frame.left, y1: frame.top, y2: frame.floor, class: 'mark'});
  frame.svg.append(marker_line);
  frame_of_trace = frame;
  box.append(frame.svg, element('p', {class: 'note'}, 'Blue: to the right. Orange: up. Grey line: pupil, from 0 to its largest. Shaded: fixations blue, saccades orange, blinks grey.'));
  if (trial) draw_time();
}

// All traces at once, each drawn when it comes into sight; one that is pressed is shown above.
function draw_all_traces() {
  const box = by_id('all_traces');
  if (box.childElementCount) return;
  const sight = new IntersectionObserver(found => {
    for (const {target, isIntersecting} of found) {
      if (!isIntersecting) continue;
      sight.unobserve(target);
      const index = Number(target.dataset.trial), of_trial = data.trials[index], samples = samples_of(traces.get(index)), reach = reach_of(samples, of_trial);
      const svg = shape('svg', {viewBox: '0 0 160 48', height: 48, preserveAspectRatio: 'none', 'aria-hidden': 'true'});
      for (const axis of [0, 1])
        svg.append(shape('path', {d: gaze_path(samples, of_trial, axis, (t, v) => [160 * t / (of_trial.seconds || 8), 24 - 23 * Math.max(-1, Math.min(1, v / reach))]), fill: 'none', stroke: axis_colours[axis], 'stroke-width': 1, 'vector-effect': 'non-scaling-stroke'}));
      target.prepend(svg);
    }
  });
  for (const index of traces.keys()) {
    const t = data.trials[index], button = element('button', {type: 'button', 'data-trial': index, 'aria-pressed': index === chosen_trial()}, `${t.label}: ${short(t.keys.filter(k => data.by.includes(k[0])))}` + (t.excluded ? ' (excluded)' : ''));
    button.addEventListener('click', () => { stop(); by_id('trial').value = String(index); load_trial(); by_id('trials').scrollIntoView(); });
    box.append(button);
    sight.observe(button);
  }
}

function load_trial() {
  trial = data.trials[chosen_trial()];
  angles = {times: numbers_of(trial.times, Float32Array), angles: numbers_of(trial.angles, Float32Array)};
  view.load(data.objects[trial.object], trial.object);
  by_id('time').max = trial.seconds || 8;
  by_id('time').value = trial.seconds || 8;
  const q = trial.quality;
  by_id('trial_caption').replaceChildren(element('b', {}, `${trial.label}: ${words(trial.keys.filter(k => data.by.includes(k[0])))}.`),
      (trial.excluded ? ' Excluded: ' + trial.excluded : '') + (data.objects[trial.object].mesh ? ' Circles turn with the surface; their' : ' Circles are fixations on the screen; their') + ' area is the duration; dashed ones are not counted.' + (trial.areas === undefined ? '' : ' Dashed outlines are areas of the screen.'));
  const facts = [['accuracy of the validation / deg', digits(q.accuracy)], ['error at the drift check / deg', digits(q.drift)], ['RMS-S2S / deg', digits(q.rms)],
       ['SD / deg', digits(q.sd)], ['samples lost without blinks', percent(q.lost)], ['lost in blinks', percent(q.blinked)], ['rate / Hz', digits(q.rate, 5)],
       ['refreshes, missed', `${q.refreshes}, ${q.missed}`], ['fixations', trial.fixations.length]];
  by_id('trial_facts').replaceChildren(element('table', {}, element('caption', {class: 'only_read'}, 'Data quality of the trial'),
      element('tbody', {}, ...facts.map(([name, value]) => element('tr', {}, element('th', {scope: 'row', class: 'text'}, name), element('td', {}, String(value)))))));
  for (const button of by_id('all_traces').children) button.setAttribute('aria-pressed', Number(button.dataset.trial) === chosen_trial());
  draw_trace(trace_width);
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
  responsive(by_id('trace_box'), width => { trace_width = width; draw_trace(width); });
  const number = n => n.toLocaleString('en');
  by_id('traces_shown').textContent = (traces.size === data.trials.length ? `Each of the ${number(data.trials.length)} trials can be chosen here`
      : `${number(traces.size)} of ${number(data.trials.length)} trials have a trace; the others have no gaze samples`) +
      `. Traces are thinned to at most ${digits(data.trace_hz)} samples a second.`;
  by_id('all_traces_box').querySelector('summary').textContent = `All ${number(traces.size)} traces at once`;
  by_id('all_traces_box').hidden = traces.size === 0;
  by_id('all_traces_box').addEventListener('toggle', draw_all_traces);
} else by_id('trials').hidden = true;

