// Waits for the tightenings, then shows the workbench at the same address, or why there is none.
'use strict';
const sentence = document.querySelector('[data-sentence]');
const told = new EventSource(document.querySelector('[data-root]').dataset.root + '/api/reading');
told.onmessage = message => {
  const event = JSON.parse(message.data);
  if (event.kind !== 'reading') { told.close(); location.reload(); return; }
  sentence.textContent = event.sentence;
};
told.onerror = () => { sentence.textContent = 'The workbench does not answer. Is it still running? This page tries again.'; };
