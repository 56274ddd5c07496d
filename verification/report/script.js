// Filters the table of claims. The page is complete without it.
'use strict';
(() => {
  const element = (id) => document.getElementById(id);
  const rows = Array.from(element('claim-table').tBodies[0].rows);
  const text = element('filter-text');
  const group = element('filter-group');
  const reference = element('filter-reference');
  const failing = element('filter-failing');

  const update = () => {
    const words = text.value.toLowerCase().split(/\s+/);
    let shown = 0;
    for (const row of rows) {
      const content = row.textContent.toLowerCase();
      const show = words.every((word) => content.includes(word)) &&
          (!group.value || row.dataset.group === group.value) &&
          (!reference.value || row.dataset.reference === reference.value) &&
          (!failing.checked || row.dataset.pass === 'false');
      row.hidden = !show;
      if (show) ++shown;
    }
    element('filter-count').textContent =
        `${shown} of ${rows.length} claims shown`;
    document.body.dataset.shown = shown;
  };

  const form = element('filters');
  // index.html#filter=WORDS opens the page with the table filtered.
  const start = /^#filter=(.*)$/.exec(location.hash);
  if (start) text.value = decodeURIComponent(start[1]);
  form.addEventListener('input', update);
  form.addEventListener('submit', (event) => event.preventDefault());
  form.hidden = false;
  update();

  // On paper everything is open and nothing is filtered.
  addEventListener('beforeprint', () => {
    for (const row of rows) row.hidden = false;
    for (const part of document.querySelectorAll('details')) part.open = true;
  });
  addEventListener('afterprint', update);
  document.body.dataset.ready = 'true';
})();
