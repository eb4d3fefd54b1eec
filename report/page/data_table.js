'use strict';
(() => {
  const table = document.querySelector('table.data');
  if (!table) return;
  const body = table.tBodies[0];
  const heads = Array.from(table.tHead.rows[0].cells);
  const collator = new Intl.Collator('en', {numeric: true});
  const part = 500;  // kFirstRows of data_table.h
  const total = Number(table.dataset.count);
  let limit = part;  // largest number of rows in the document
  const element = (tag, properties, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  };

  const search = element('input', {type: 'search', id: 'filter-text', size: 28});
  const controls = element('p', {className: 'filter'}, element('label', {}, 'Text ', search));
  const filters = [];
  heads.forEach((head, column) => {
    if (!head.dataset.filter) return;
    const choice = element('select', {id: 'filter-' + head.dataset.filter},
                           element('option', {value: ''}, 'all'));
    const name = head.textContent.charAt(0).toUpperCase() + head.textContent.slice(1) + ' ';
    const label = element('label', {hidden: true}, name, choice);
    controls.append(label);
    filters.push({column, choice, label, values: new Set()});
  });
  const count = element('output', {id: 'filter-count'});
  const all = element('button', {type: 'button', id: 'filter-all'}, 'Show all');
  controls.append(count, all);
  table.parentNode.before(controls);

  // Rows in the order of the page. Those after the first part are text until they are required.
  const rows = [];
  const rest = document.getElementById(table.id + '-rest');
  const texts = rest ? rest.textContent.split('<tbody>').slice(1).map((text) => text.split('</tbody>')[0]) : [];
  const valueOf = (row, column) => {
    const cell = row.cells[column];
    return cell.dataset.value ?? cell.textContent;
  };
  const addOption = (filter, value) => {
    if (value === '' || value === '–' || filter.values.has(value)) return;
    filter.values.add(value);
    filter.choice.append(element('option', {value}, value));
    filter.label.hidden = filter.values.size < 2;
  };
  const add = (list) => {
    for (const row of list) {
      for (const filter of filters) addOption(filter, valueOf(row, filter.column));
      if (row.dataset.also && filters.length) addOption(filters[0], row.dataset.also);
      rows.push({row, place: rows.length, text: ''});
    }
  };
  const readPart = () => {
    const template = document.createElement('template');
    template.innerHTML = '<table><tbody>' + texts.shift() + '</tbody></table>';
    add(Array.from(template.content.querySelectorAll('tr')));
  };
  const readAll = () => {
    while (texts.length) readPart();
  };
  const readSoon = () => {
    if (!texts.length) return;
    setTimeout(() => {
      if (texts.length) readPart();
      readSoon();
    }, 10);
  };
  add(Array.from(body.rows));

  let order = rows;
  const isFound = (each, words) => {
    for (const {column, choice} of filters) {
      if (choice.value !== '' && valueOf(each.row, column) !== choice.value &&
          !(choice === filters[0].choice && each.row.dataset.also === choice.value)) return false;
    }
    if (!words.length) return true;
    each.text ||= Array.from(each.row.cells, (cell) => cell.textContent).join(' ').toLowerCase();
    return words.every((word) => each.text.includes(word));
  };
  const report = (found) => {
    count.textContent = ` ${found} of ${total} ${table.dataset.noun}` + (found > limit ? `, first ${limit} shown` : '');
    all.hidden = found <= limit;
  };
  const show = () => {
    readAll();
    const words = search.value.toLowerCase().split(/\s+/).filter((word) => word !== '');
    const found = order.filter((each) => isFound(each, words));
    body.replaceChildren(...found.slice(0, limit).map((each) => each.row));
    report(found.length);
  };
  all.addEventListener('click', () => {
    limit = Infinity;
    show();
  });
  search.addEventListener('input', show);
  for (const {choice} of filters) choice.addEventListener('change', show);

  const sort = (column) => {
    readAll();
    const head = heads[column];
    const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
    const isNumber = head.classList.contains('number');
    const keyOf = (row) => {
      const value = valueOf(row, column);
      if (!isNumber) return value === '–' ? null : value;
      const number = parseFloat(value);
      return Number.isNaN(number) ? null : number;
    };
    const compare = isNumber ? (a, b) => a - b : collator.compare;
    const keyed = order.map((each, place) => [keyOf(each.row), place, each]);
    // Missing values are last in both directions.
    keyed.sort(([a, i], [b, j]) => {
      if (a === null || b === null) return (a === null) - (b === null) || i - j;
      return sign * compare(a, b) || i - j;
    });
    order = keyed.map(([, , each]) => each);
    for (const other of heads) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
    show();
  };
  heads.forEach((head, column) => {
    if (!head.textContent) return;
    const button = element('button', {type: 'button'}, ...head.childNodes);
    button.addEventListener('click', () => sort(column));
    head.append(button);
  });

  const showRow = (each) => {
    limit = Math.max(limit, part * Math.ceil((each.place + 1) / part));
    show();
    for (const other of rows) other.row.classList.toggle('target', other === each);
    each.row.scrollIntoView({block: 'center'});
  };
  const follow = () => {
    const link = /^#([^=]+)=(.+)$/.exec(location.hash);
    if (!link) return;
    readAll();
    const target = rows.find(({row}) => row.id.slice(row.id.indexOf('=') + 1) === link[2]);
    if (!target) return;
    const step = {before: -1, after: 1}[link[1]] ?? 0;
    for (let i = target.place + step; step !== 0 && i >= 0 && i < rows.length; i += step) {
      const next = rows[i].row.querySelector('a[href]');
      if (next) return location.replace(next.getAttribute('href'));
    }
    showRow(target);
  };
  report(total);
  window.addEventListener('hashchange', follow);
  follow();
  readSoon();
})();
