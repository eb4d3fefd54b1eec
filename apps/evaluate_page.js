'use strict';
(() => {
  const table = document.getElementById('grasps');
  if (!table) return;
  const body = table.tBodies[0];
  let rows = Array.from(body.rows);
  const element = (tag, properties, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  };
  const search = element('input', {type: 'search', id: 'filter-text', size: 32});
  const choice = element('select', {id: 'filter-verdict'});
  const verdicts = Array.from(new Set(rows.map((row) => row.dataset.verdict)));
  for (const [value, name] of [['', 'all'], ...verdicts.map((verdict) => [verdict, verdict]),
                               ['differs', 'claim differs']]) {
    choice.append(element('option', {value}, name));
  }
  const count = element('output', {id: 'filter-count'});
  // Rows that are shown at once, as in evaluate_page.css.
  let limit = 500;
  const all = element('button', {type: 'button', id: 'filter-all'}, 'Show all');
  const controls = element('p', {className: 'filter'},
      element('label', {}, 'Text ', search), element('label', {}, 'Verdict ', choice), count, all);
  table.parentNode.before(controls);

  const texts = new Map();
  const textOf = (row) => {
    if (!texts.has(row)) {
      texts.set(row, Array.from(row.cells, (cell) => cell.textContent).join(' ').toLowerCase());
    }
    return texts.get(row);
  };
  const isFound = (row, words, verdict) =>
    (verdict === '' || (verdict === 'differs' ? row.dataset.differs === 'true'
                                              : row.dataset.verdict === verdict)) &&
    words.every((word) => textOf(row).includes(word));
  const filter = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter((word) => word !== '');
    let found = 0;
    for (const row of rows) row.hidden = !isFound(row, words, choice.value) || ++found > limit;
    count.textContent = ` ${found} of ${rows.length} grasps` + (found > limit ? `, first ${limit} shown` : '');
    all.hidden = found <= limit;
  };
  all.addEventListener('click', () => {
    limit = Infinity;
    filter();
  });
  search.addEventListener('input', filter);
  choice.addEventListener('change', filter);
  filter();
  table.classList.add('managed');

  const heads = Array.from(table.tHead.rows[0].cells);
  const valueOf = (row, column, number) => {
    const text = row.cells[column].textContent;
    if (!number) return text;
    const value = parseFloat(text);
    return Number.isNaN(value) ? null : value;
  };
  const sort = (column) => {
    const head = heads[column];
    const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
    const number = head.classList.contains('number');
    const keyed = rows.map((row, place) => [valueOf(row, column, number), place, row]);
    const collator = new Intl.Collator('en', {numeric: true});
    keyed.sort(([a, i], [b, j]) => {
      if (number && (a === null || b === null)) return (a === null) - (b === null) || i - j;
      return sign * (number ? a - b : collator.compare(a, b)) || i - j;
    });
    rows = keyed.map(([, , row]) => row);
    const sorted = document.createDocumentFragment();
    for (const row of rows) sorted.append(row);
    filter();
    body.append(sorted);
    for (const other of heads) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
  };
  heads.forEach((head, column) => {
    const button = element('button', {type: 'button'}, ...head.childNodes);
    button.addEventListener('click', () => sort(column));
    head.append(button);
  });
})();
