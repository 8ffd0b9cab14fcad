// Tables: one column per factor, heads that stay and sort, a filter, and what is shown as a CSV file.
//
// A column is {name, of, text, long, digits, show, scale}: `of` gives a row's cell, which is a text, a number, null, or an
// estimate {v, lo, hi, absent}. text: words, else numbers; long: whole sentences; digits: significant ones; show: how a
// number is written, else with these digits; scale: what numbers are multiplied by (100 for "/ %").

const text_column = (name, of, more = {}) => ({name, of, text: true, ...more});
const number_column = (name, of, more = {}) => ({name, of, ...more});
const p_column = (name, of) => ({name, of, show: p_text});
// What is said beside p of a difference within observers.
const evidence_columns = (prefix, of) => [
  number_column(prefix + 'effect size', r => of(r).effect), number_column(prefix + 'Bayes factor', r => of(r).bf), p_column(prefix + 'p of equivalence', r => of(r).eq)];
const mm_column = (name, of) => ({name, of, show: mm_text});
const share_column = (name, of) => ({name: name + ' / %', of, scale: 100});

// One column for each column of keys that any row has; "all" where a row has none of it.
function factor_columns(rows, keys_of) {
  const names = [];
  for (const row of rows) for (const [name] of keys_of(row)) if (!names.includes(name)) names.push(name);
  const differ = names.filter(name => new Set(rows.map(row => (keys_of(row).find(key => key[0] === name) || [name, 'all'])[1]).filter(value => value !== 'all')).size > 1);
  if (differ.length) names.splice(0, names.length, ...differ);
  names.sort((a, b) => (data.by.indexOf(a) + 1 || 1e9) - (data.by.indexOf(b) + 1 || 1e9));
  return names.map(name => text_column(name, row => (keys_of(row).find(key => key[0] === name) || [name, 'all'])[1]));
}

const is_estimate = cell => cell !== null && typeof cell === 'object';
const scaled = (column, value) => (value === null || value === undefined ? null : value * (column.scale || 1));

// A cell's text, and what stands below it: the interval, or why there is no value.
function cell_texts(column, cell) {
  if (cell === null || cell === undefined) return ['n/a', ''];
  const number = value => (column.show || (v => digits(v, column.digits)))(scaled(column, value));
  if (is_estimate(cell)) {
    if (cell.v === null || cell.v === undefined) return ['n/a', cell.absent || ''];
    const text = estimate_text({v: scaled(column, cell.v), ...(cell.lo === undefined ? {} : {lo: scaled(column, cell.lo), hi: scaled(column, cell.hi)})}, column.digits);
    const end = text.indexOf(' [');
    return end < 0 ? [text, ''] : [text.slice(0, end), text.slice(end + 1)];
  }
  return [typeof cell === 'number' && !column.text ? number(cell) : String(cell), ''];
}

// What a column is sorted by; nothing comes last.
function sort_value(column, cell) {
  if (cell === null || cell === undefined) return null;
  const value = is_estimate(cell) ? cell.v : cell;
  return value === undefined || value === 'n/a' || value === '' ? null : value;
}
const in_words = new Intl.Collator('en', {numeric: true});
function compared(a, b) {
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return in_words.compare(String(a), String(b));
}

const breakable = text => pieces_of(text).flatMap((piece, i) => (i ? [element('wbr'), piece] : [piece]));

function csv_field(value) {
  const text = value === null || value === undefined ? 'n/a' : String(value);
  return /[",\r\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
}

// Of rows among all of a table. Estimates take three columns: the value, and both ends of its interval.
function csv_of(columns, rows, all) {
  const wide = columns.map(column => all.some(row => is_estimate(column.of(row))));
  const head = columns.flatMap((column, i) => (wide[i] ? [column.name, column.name + ' low', column.name + ' high'] : [column.name]));
  const exact = (column, value) => (typeof value === 'number' && column.scale ? Number(scaled(column, value).toPrecision(9)) : value);
  const lines = rows.map(row => columns.flatMap((column, i) => {
    const cell = column.of(row);
    if (!wide[i]) return [exact(column, cell)];
    return is_estimate(cell) ? [cell.v, cell.lo, cell.hi].map(v => exact(column, v)) : [exact(column, cell), null, null];
  }));
  return [head, ...lines].map(line => line.map(csv_field).join(',') + '\r\n').join('');
}

function save_text(text, file) {
  const link = element('a', {href: URL.createObjectURL(new Blob([text], {type: 'text/csv;charset=utf-8'})), download: file});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// `name` is that of the CSV file; `title` says what the table is to those who cannot see its place.
function table({name, title, columns, rows, note}) {
  const body = element('tbody'), heads = [], count = element('output', {'aria-live': 'polite'});
  const filter = element('input', {type: 'search', 'aria-label': 'Filter rows of: ' + title, placeholder: 'Filter rows', spellcheck: 'false'});
  let by = -1, down = false, shown = rows;
  const class_of = column => [column.text ? 'text' : '', column.long ? 'long' : ''].join(' ').trim();
  const lines = new Map();
  for (const row of rows) {
    const texts = columns.map(column => cell_texts(column, column.of(row)));
    const line = element('tr', {}, ...columns.map((column, i) => {
      const cell = element(i === 0 && column.text ? 'th' : 'td', i === 0 && column.text ? {scope: 'row', class: class_of(column)} : column.text ? {class: class_of(column)} : {}, ...(column.text ? breakable(texts[i][0]) : [texts[i][0]]));
      if (texts[i][1]) cell.append(element('small', texts[i][0] === 'n/a' ? {class: 'why'} : {}, texts[i][1]));
      return cell;
    }));
    lines.set(row, {line, found_by: texts.flat().join(' ').toLowerCase()});
  }
  const show = () => {
    const wanted = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    shown = rows.filter(row => wanted.every(word => lines.get(row).found_by.includes(word)));
    if (by >= 0) {
      const value = row => sort_value(columns[by], columns[by].of(row));
      const missing = row => (value(row) === null ? 1 : 0);
      shown = shown.slice().sort((a, b) => missing(a) - missing(b) || (missing(a) ? 0 : (down ? -1 : 1) * compared(value(a), value(b))));
    }
    body.replaceChildren(...shown.map(row => lines.get(row).line));
    heads.forEach((head, i) => head.setAttribute('aria-sort', i !== by ? 'none' : down ? 'descending' : 'ascending'));
    count.textContent = wanted.length ? `${shown.length} of ${rows.length} rows, those with "${wanted.join('" and "')}"` : rows.length === 1 ? '1 row' : `${rows.length} rows`;
  };
  columns.forEach((column, i) => {
    const button = element('button', {type: 'button', title: 'Sort by this column'}, ...breakable(column.name));
    // Up, down, and as it was.
    button.addEventListener('click', () => {
      if (by !== i) { by = i; down = false; } else if (!down) down = true; else { by = -1; down = false; }
      show();
    });
    // Words get as much room as lets them be broken into three or four lines at the most.
    const longest = column.text && !column.long ? Math.max(0, ...rows.map(row => String(column.of(row) ?? '').length)) : 0;
    heads.push(element('th', {scope: 'col', ...(class_of(column) ? {class: class_of(column)} : {}), ...(longest ? {style: `--room: ${Math.min(16, Math.ceil(longest / 3) + 2)}ch; --room-on-paper: ${Math.min(9, longest)}ch`} : {})}, button));
  });
  filter.addEventListener('input', show);
  const save = element('button', {type: 'button', 'aria-label': `Save as CSV what is shown of: ${title}`}, 'Save as CSV');
  save.addEventListener('click', () => save_text(csv_of(columns, shown, rows), name + '.csv'));
  show();
  return element('div', {class: 'table', id: 'table_' + name},
                 element('div', {class: 'tools'}, element('label', {}, filter), save, count),
                 element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': title},
                         element('table', {}, element('caption', {class: 'only_read'}, title),
                                 element('thead', {}, element('tr', {}, ...heads)), body)),
                 ...(note ? [element('p', {class: 'note'}, note)] : []));
}
