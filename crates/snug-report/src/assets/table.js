// Tables: sorted by a column's head and, where their section has a filter, filtered by words and outcome.
document.querySelectorAll('[data-sortable]').forEach(table => {
  const body = table.tBodies[0], heads = [...table.tHead.rows[0].cells];
  const order = new Intl.Collator('en', { numeric: true });
  const key = (row, column) => {
    const cell = row.cells[column];
    if (cell.dataset.v !== undefined) return Number(cell.dataset.v);
    return cell.querySelector('.missing') ? null : cell.textContent.trim();
  };
  // Missing values stay last, whichever way the column runs.
  const compare = (a, b, sign) => {
    if (a === null || b === null) return (a === null) - (b === null);
    return sign * (typeof a === 'number' && typeof b === 'number' ? a - b : order.compare(a, b));
  };
  heads.forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.addEventListener('click', () => {
      const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      heads.forEach(other => other.removeAttribute('aria-sort'));
      head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      const rows = [...body.rows].map(row => [key(row, column), row]);
      rows.sort((a, b) => compare(a[0], b[0], sign));
      body.append(...rows.map(row => row[1]));
    });
  });
  const section = table.closest('section');
  const filter = section.querySelector('[data-filter]'), outcome = section.querySelector('[data-outcome]');
  if (!filter) return;
  const texts = new Map([...body.rows].map(row => [row, row.textContent.toLowerCase()]));
  const apply = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of body.rows) {
      const keep = words.every(word => texts.get(row).includes(word)) && (!outcome.value || row.dataset.selected === outcome.value);
      row.hidden = !keep;
      count += keep;
    }
    section.querySelector('[data-shown]').textContent = `${count} of ${body.rows.length} shown`;
  };
  filter.addEventListener('input', apply);
  outcome.addEventListener('change', apply);
  apply();
});
