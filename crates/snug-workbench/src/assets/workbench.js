// The workbench: asks the server for models, and shows what it tells. What is on screen stands in the address.
const one = name => document.querySelector(`[data-${name}]`);
const show = (name, text) => { one(name).textContent = text; };
const element = (tag, text, name) => {
  const made = document.createElement(tag);
  made.textContent = text;
  if (name) made.className = name;
  return made;
};
const address = () => new URLSearchParams(location.search);
const state = {
  effects: (address().get('effects') || '').split(',').filter(Boolean),
  given: address().has('effects'),
  tightening: address().get('tightening') || one('tightening').value,
  before: null,
  // Of each effect what it promises beside the present model, and what it did beside the one before.
  shares: new Map(),
  texts: new Map(),
  was: new Map(),
};
const session = sessionStorage.getItem('snug-session') || crypto.randomUUID();
sessionStorage.setItem('snug-session', session);

const remember = () => {
  const query = new URLSearchParams({ effects: state.effects.join(','), tightening: state.tightening });
  history.replaceState(null, '', '?' + query.toString().replaceAll('%2C', ','));
};

const fault = sentence => {
  const place = one('fault');
  place.textContent = sentence || '';
  place.hidden = !sentence;
};

const GONE = 'The workbench does not answer. Is it still running? Nothing is lost: this page tries again by itself.';

const ask = async (path, body) => {
  try {
    const answer = await fetch(path, body && { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify({ session, ...body }) });
    if (answer.ok) return answer.status === 202 ? {} : await answer.json();
    const text = await answer.text();
    try { fault(JSON.parse(text).sentence); } catch { fault(text); }
  } catch { fault(GONE); }
  return null;
};

// Switches: what is in the model first, then by promise.
const items = () => [...one('switches').children];
const check = () => items().forEach(item =>
  item.querySelector('button').setAttribute('aria-checked', String(state.effects.includes(item.dataset.effect))));
const sort = () => {
  const focused = document.activeElement, key = item => state.effects.includes(item.dataset.effect) ? 2 : state.shares.get(item.dataset.effect) ?? 0;
  const sorted = items().sort((a, b) => key(b) - key(a));
  if (sorted.every((item, i) => item === items()[i])) return;
  one('switches').append(...sorted);
  focused?.focus?.({ preventScroll: true });
};
const promise = ({ effect, share, shown }) => {
  const item = items().find(item => item.dataset.effect === effect), was = state.was.get(effect);
  state.shares.set(effect, share);
  state.texts.set(effect, shown);
  item.querySelector('[data-promise]').textContent = `promises ${shown}` + (was && was !== shown ? `, was ${was}` : '');
  item.querySelector('[data-fill]').style.width = 100 * share + '%';
};

const ladder = rungs => {
  const largest = Math.max(...rungs.map(rung => rung.error || 0));
  one('ladder').replaceChildren(...rungs.map((rung, i) => {
    const row = document.createElement('li'), bar = element('span', '', 'track'), fill = element('span', '', 'fill');
    fill.style.width = 100 * (rung.error || 0) / largest + '%';
    bar.append(fill);
    row.append(element('span', rung.name, 'name'), element('span', rung.shown, 'value'), bar);
    if (i === rungs.length - 1) row.setAttribute('aria-current', 'step');
    return row;
  }));
};

const sizes = all => {
  items().forEach(item => item.querySelector('[data-sizes]').textContent = '');
  one('found').replaceChildren();
  for (const { effect, sizes } of all) {
    const item = items().find(item => item.dataset.effect === effect);
    if (!item) continue;
    item.querySelector('[data-sizes]').replaceChildren(...sizes.map(size => element('span', size, 'size')));
    one('found').append(element('dt', item.querySelector('strong').textContent), ...sizes.map(size => element('dd', size)));
    item.querySelector('[data-promise]').textContent = 'in the model';
    item.querySelector('[data-fill]').style.width = '0';
  }
};

const hear = {
  fitting(event) {
    if (event.effects.join() !== state.told) state.was = new Map(state.texts);
    state.told = event.effects.join();
    state.effects = event.effects;
    state.steps = [];
    check();
    remember();
    document.body.classList.add('fitting');
    show('tested', event.tested);
    show('steps', '');
    performance.mark('fitting');
  },
  // The number on screen is where the solver stands.
  step(event) {
    show('error', event.shown);
    if (state.steps.at(-1) !== event.shown) state.steps.push(event.shown);
    show('steps', state.steps.slice(-8).join(' → '));
  },
  fitted(event) {
    document.body.classList.remove('fitting');
    fault('');
    state.effects = event.effects;
    state.before = event.before;
    check();
    remember();
    show('error', event.shown);
    show('says', event.says);
    show('tested', event.tested);
    show('change', event.error_before ? `${event.step}: error ${event.error_before} → ${event.shown} (${event.took})` : 'Nothing yet.');
    sizes(event.sizes);
    ladder(event.ladder);
    one('undo').disabled = !event.can_undo;
    one('redo').disabled = !event.can_redo;
    look();
  },
  promises(event) { event.shares.forEach(promise); },
  ranked() { sort(); },
  failed(event) { document.body.classList.remove('fitting'); fault(event.sentence); state.fault = event.sentence; },
};

// One tightening: curves, residual, and its own numbers.
let looked = 0;
const look = async () => {
  const number = ++looked;
  const query = new URLSearchParams({ number: state.tightening, effects: state.effects.join(',') });
  if (state.before) query.set('before', state.before.join(','));
  const answer = await ask('/api/tightening?' + query);
  if (!answer || number !== looked) return;
  one('tightening').value = state.tightening;
  const { heading, place, error, error_before: before } = answer.told;
  show('heading', `${heading} · ${place} · error ${before === error ? '' : before + ' → '}${error}`);
  one('facts').replaceChildren(...answer.told.facts.map(texts => {
    const row = document.createElement('tr');
    row.append(...texts.map((text, i) => {
      const cell = element(i ? 'td' : 'th', i ? text[0] : text);
      if (i) cell.append(element('span', text[1], 'spread'));
      else cell.scope = 'row';
      return cell;
    }));
    return row;
  }));
  draw(answer);
};
const draw = ({ panels, example }) => {
  const viewer = viewers[0], view = state.shown === state.tightening ? viewer.view : null;
  viewer.data.examples[0] = example;
  viewer.panels.forEach((panel, i) => {
    if (JSON.stringify(panel.spec) !== JSON.stringify(panels[i])) viewer.panels[i] = new Panel(panel.host, panels[i], viewer);
    panel.host.previousElementSibling.textContent = panels[i].title;
  });
  viewer.choose(0);
  viewer.view = view;
  viewer.draw();
  state.shown = state.tightening;
};
const turnTo = number => { state.tightening = number; remember(); look(); };

items().forEach(item => item.querySelector('button').addEventListener('click', () => {
  const name = item.dataset.effect, has = state.effects.includes(name);
  const effects = has ? state.effects.filter(other => other !== name) : [...state.effects, name];
  state.effects = effects;
  check();
  ask('/api/change', { kind: 'choose', effects: effects.join(',') });
}));
one('tightening').addEventListener('change', event => turnTo(event.target.value));
document.querySelectorAll('[data-worse]').forEach(button => button.addEventListener('click', () => {
  const options = [...one('tightening').options], count = options.length;
  const at = options.findIndex(option => option.value === state.tightening);
  turnTo(options[(at + Number(button.dataset.worse) + count) % count].value);
}));
one('undo').addEventListener('click', () => ask('/api/change', { kind: 'undo' }));
one('redo').addEventListener('click', () => ask('/api/change', { kind: 'redo' }));
one('save').addEventListener('click', async () => {
  const answer = await ask('/api/save', { effects: state.effects.join(',') });
  if (answer) show('saved', answer.sentence);
});

// Listens; where the server is gone, again after a while, with the model that is on screen.
const listen = () => {
  const query = new URLSearchParams({ session });
  if (state.given || state.effects.length) query.set('effects', state.effects.join(','));
  const events = new EventSource('/api/events?' + query);
  events.onmessage = message => {
    const event = JSON.parse(message.data);
    hear[event.kind]?.(event);
    state.given = true;
  };
  events.onerror = () => {
    events.close();
    fault(GONE);
    setTimeout(listen, 1000);
  };
};
listen();
