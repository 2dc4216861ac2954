'use strict';
// The list of tools, cut down to what is looked for.
const filter = document.querySelector('[data-filter]');
const rows = [...document.querySelectorAll('[data-tool]')];
filter.addEventListener('input', () => {
  const wanted = filter.value.trim().toLowerCase();
  for (const row of rows) row.hidden = !row.dataset.tool.toLowerCase().includes(wanted);
});
