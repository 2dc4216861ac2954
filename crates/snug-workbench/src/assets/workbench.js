// The workbench: asks the server for models, and shows what it tells. What is on screen stands in the address.
const one = name => document.querySelector(`[data-${name}]`);
const show = (name, text) => { one(name).textContent = text; };
const element = (tag, text, name) => {
  const made = document.createElement(tag);
  made.textContent = text;
  if (name) made.className = name;
  return made;
};
// What addresses of this page's workbench begin with.
const { root } = document.querySelector('[data-root]').dataset;
const address = () => new URLSearchParams(location.search);
const state = {
  effects: (address().get('effects') || '').split(',').filter(Boolean),
  given: address().has('effects'),
  tightening: address().get('tightening') || one('tightening').value,
  before: null,
  // What is looked at more closely, the model to hold the present one against, the effect whose signature is shown.
  group: address().get('group') || '',
  stretch: address().has('from_s') ? [Number(address().get('from_s')), Number(address().get('to_s'))] : null,
  cell: address().get('cell') || '',
  rival: address().has('rival') ? address().get('rival') : null,
  signature: null,
  // Numbers set by hand; none where they are as fitted.
  values: null,
  // Of each effect what it promises beside the present model, and what it did beside the one before.
  shares: new Map(),
  texts: new Map(),
  was: new Map(),
};
const session = sessionStorage.getItem('snug-session') || crypto.randomUUID();
sessionStorage.setItem('snug-session', session);

// What is looked at more closely, as the server takes it.
const closer = () => ({
  ...(state.group && { group: state.group }),
  ...(state.stretch && { from_s: state.stretch[0], to_s: state.stretch[1] }),
  ...(state.cell && { cell: state.cell }),
});

const remember = () => {
  const query = new URLSearchParams({ effects: state.effects.join(','), tightening: state.tightening, ...closer() });
  if (state.rival !== null) query.set('rival', state.rival);
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
    const answer = await fetch(root + path, body && { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify({ session, ...body }) });
    if (answer.ok) return answer.status === 202 ? {} : await answer.json();
    const text = await answer.text();
    try { fault(JSON.parse(text).sentence); } catch { fault(text); }
  } catch { fault(GONE); }
  return null;
};

// What somebody wishes waits until the server knows this page: earlier it would be nobody's.
let isKnown;
const known = new Promise(done => { isKnown = done; });
const wish = async change => {
  await known;
  return ask('/api/change', change);
};

// Switches: what is in the model first, then by promise.
const items = () => [...one('switches').children];
const check = () => items().forEach(item => {
  const has = state.effects.includes(item.dataset.effect);
  item.querySelector('.switch').setAttribute('aria-checked', String(has));
  // What is in the model would leave nothing.
  item.querySelector('[data-signature]').hidden = has;
});
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
    const isLast = i === rungs.length - 1, name = element(isLast ? 'span' : 'button', rung.name, 'name');
    if (isLast) row.setAttribute('aria-current', 'step');
    else {
      Object.assign(name, { type: 'button', title: 'back to this model' });
      name.addEventListener('click', () => wish({ kind: 'back', rung: i }));
    }
    row.append(name, element('span', rung.shown, 'value'), bar);
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

// Numbers that were set by hand give way to the fitted ones.
const letGo = () => {
  state.values = null;
  show('by-hand', '');
};

const hear = {
  fitting(event) {
    if (event.effects.join() !== state.told) state.was = new Map(state.texts);
    state.told = event.effects.join();
    // The same model told anew, as after a closer look, leaves numbers that were set by hand.
    if (event.effects.join() !== state.effects.join()) letGo();
    state.effects = event.effects;
    state.steps = [];
    check();
    remember();
    document.body.classList.add('fitting');
    if (one('error').textContent === '…') show('error', event.begins);
    show('tested', event.tested);
    show('evidence', '');
    delete one('tested').dataset.state;
    show('steps', '');
    items().forEach(item => { item.querySelector('[data-real]').textContent = ''; });
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
    one('usable').textContent = '';
    pinned();
    look();
    force();
  },
  promises(event) { event.shares.forEach(promise); },
  // Nothing moves away from under a pointer: what it points at is sorted once it has gone.
  ranked() {
    if (one('switches').matches(':hover')) state.isUnsorted = true;
    else sort();
  },
  // Promises of another part are no promises of before.
  closer(event) { show('closer', event.sentence); state.was.clear(); },
  usable(event) { show('usable', event.sentence); },
  from_here(event) { show('by-hand', event.sentence); },
  // Whether an effect that was added is real, once tightenings have said so that it was not fitted to.
  tested(event) {
    const place = items().find(item => item.dataset.effect === event.effect)?.querySelector('[data-real]');
    if (place) Object.assign(place, { textContent: event.short, title: event.sentence }).dataset.state = event.state;
    if (!event.is_last) return;
    show('tested', event.sentence);
    show('evidence', event.evidence ?? '');
    one('tested').dataset.state = event.state;
  },
  failed(event) { document.body.classList.remove('fitting'); fault(event.sentence); state.fault = event.sentence; },
};

// One tightening: curves, residual, and its own numbers.
let looked = 0;
const look = async () => {
  const number = ++looked;
  const query = new URLSearchParams({ number: state.tightening, effects: state.effects.join(',') });
  if (state.before) query.set('before', state.before.join(','));
  if (state.rival !== null) query.set('rival', state.rival);
  if (state.signature && !state.effects.includes(state.signature)) query.set('signature', state.signature);
  if (state.values) query.set('values', state.values.join(','));
  const answer = await ask('/api/tightening?' + query);
  if (!answer || number !== looked) return;
  one('tightening').value = state.tightening;
  const { heading, place, error, error_before: before, rival, by_hand: byHand } = answer.told;
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
  against(rival, error);
  if (state.values) show('by-hand', `By hand: error ${byHand}, as fitted ${error}.`);
  else sliders(answer.told.numbers);
  state.perSecond = answer.example.step / answer.told.interval_s;
  draw(answer);
};
// The same once more while something is dragged: one request at a time, the last one always.
let asking = false, again = false;
const follow = async () => {
  if (asking) { again = true; return; }
  asking = true;
  do { again = false; await look(); } while (again);
  asking = false;
};

// The missing force of all tightenings, over time and over displacement and velocity; asked for once as long as the model stays.
let forced = 0, forcedBy = '';
const force = async () => {
  const model = [state.effects, one('error').textContent, state.before].join();
  if (model === forcedBy) return;
  forcedBy = model;
  const number = ++forced;
  try {
    const query = new URLSearchParams({ effects: state.effects.join(',') });
    if (state.before) query.set('before', state.before.join(','));
    const answer = await fetch(root + '/api/force?' + query);
    if (number !== forced) return;
    if (answer.ok) { one('force').innerHTML = await answer.text(); choosableCells(); }
    else forcedBy = '';
  } catch { forcedBy = ''; /* That the workbench is gone is said where its events end. */ }
};

// A cell of the map is a way in: with the pointer, or with arrows and Enter.
const cells = () => [...one('force').querySelectorAll('[data-cell]')];
const cellsOf = map => [...map.querySelectorAll('[data-cell]')];
const choosableCells = () => {
  // A rig without a measured angle has no map.
  one('cells-say').hidden = !cells().length;
  // The map is there twice, for wide screens and for narrow ones.
  new Set(cells().map(cell => cell.closest('svg'))).forEach(map => {
    map.setAttribute('role', 'group');
    cellsOf(map).forEach((cell, i) => {
      cell.setAttribute('role', 'button');
      cell.setAttribute('tabindex', i ? '-1' : '0');
      cell.setAttribute('aria-label', `rank by the samples where ${cell.textContent}`);
    });
  });
  chosenCell();
};
const chosenCell = () => cells().forEach(cell => cell.setAttribute('aria-pressed', String(cell.dataset.cell === state.cell)));
const towards = (cell, key) => {
  const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
  const from = cell.getBoundingClientRect();
  const along = other => {
    const to = other.getBoundingClientRect(), right = to.x - from.x, down = to.y - from.y;
    const ahead = x * right + y * down;
    return ahead > 1 ? ahead + 3 * Math.abs(x ? down : right) : Infinity;
  };
  return cellsOf(cell.closest('svg')).map(other => [along(other), other]).reduce((near, next) => next[0] < near[0] ? next : near, [Infinity, cell])[1];
};
one('force').addEventListener('click', event => {
  const key = event.target.closest('[data-cell]')?.dataset.cell;
  if (key) lookCloser({ cell: key === state.cell ? '' : key, stretch: null });
});
one('force').addEventListener('keydown', event => {
  const cell = event.target.closest('[data-cell]');
  if (!cell) return;
  if (event.key === 'Enter' || event.key === ' ') cell.dispatchEvent(new MouseEvent('click', { bubbles: true }));
  else if (event.key.startsWith('Arrow')) {
    const next = towards(cell, event.key);
    cell.setAttribute('tabindex', '-1');
    next.setAttribute('tabindex', '0');
    next.focus();
  } else return;
  event.preventDefault();
});

// Sliders: a number of the present model each. They stay where the same numbers are told anew, and with them the focus.
let rows = [];
const sliders = numbers => {
  one('as-fitted').disabled = one('from-here').disabled = true;
  if (rows.map(row => row.name).join() !== numbers.map(number => number.name).join()) {
    rows = numbers.map(({ name }, i) => slider(name, i));
    one('sliders').replaceChildren(...rows.map(row => row.place));
  }
  numbers.forEach((number, i) => rows[i].tell(number));
};
const slider = (name, i) => {
  const place = element('label', '', 'slider'), range = document.createElement('input'), output = element('output', '');
  const rail = element('span', '', 'rail'), track = element('span', '', 'interval'), mark = element('span', '', 'mark');
  const row = { name, place };
  const say = () => {
    output.textContent = `${shown(row.factor * Number(range.value))} ${row.unit}`;
    range.setAttribute('aria-valuetext', output.textContent);
  };
  row.tell = ({ unit, factor, value, low, high, interval }) => {
    const share = at => Math.min(1, Math.max(0, (at - low) / (high - low || 1)));
    Object.assign(row, { unit, factor, value });
    Object.assign(range, { type: 'range', min: low, max: high, step: 'any', value });
    track.hidden = !interval;
    if (interval) Object.assign(track.style, { left: 100 * share(interval[0]) + '%', width: 100 * (share(interval[1]) - share(interval[0])) + '%' });
    mark.style.left = 100 * share(value) + '%';
    say();
  };
  range.addEventListener('input', () => {
    state.values ??= rows.map(row => row.value);
    state.values[i] = Number(range.value);
    say();
    one('as-fitted').disabled = one('from-here').disabled = false;
    follow();
  });
  rail.append(track, mark);
  place.append(element('span', name, 'name'), output, range, rail);
  return row;
};

// The rival: another model, drawn and told beside the present one.
const name = effects => effects.length ? effects.map(effect =>
  items().find(item => item.dataset.effect === effect)?.querySelector('strong').textContent ?? effect).join(' + ') : 'no effect';
const pinned = () => {
  const has = state.rival !== null;
  one('pin').textContent = has ? 'Let the rival go' : 'Pin as rival';
  one('pin').setAttribute('aria-pressed', String(has));
  one('rival').hidden = one('rival-column').hidden = !has;
  if (has) show('rival-name', `A: ${name(state.effects)}. B, pinned: ${name(state.rival.split(',').filter(Boolean))}.`);
};
const against = (rival, here) => {
  if (!rival) return;
  show('rival-says', `Error of A ${one('error').textContent}, of B ${rival.error}; in this tightening ${here} and ${rival.error_here}.`);
  one('rival-sizes').replaceChildren(...rival.sizes.map(size => element('li', `B: ${size}`)));
};

const take = (viewer, { panels, example }, view) => {
  viewer.data.examples[0] = example;
  viewer.panels.forEach((panel, i) => {
    if (JSON.stringify(panel.spec) !== JSON.stringify(panels[i])) viewer.panels[i] = new Panel(panel.host, panels[i], viewer);
    panel.host.previousElementSibling.textContent = panels[i].title;
  });
  viewer.take(0);
  viewer.view = view;
  viewer.draw();
};
const draw = answer => {
  const [curves, step] = viewers, isSame = state.shown === state.tightening;
  const brushed = state.stretch && state.shown === undefined ? state.stretch.map(at => at * state.perSecond) : null;
  take(curves, answer, isSame ? curves.view : brushed);
  zoomed();
  if (answer.step) take(step, answer.step, isSame ? step.view : null);
  step.root.hidden = !answer.step;
  state.shown = state.tightening;
};
const turnTo = number => {
  state.tightening = number;
  letGo();
  remember();
  look();
};

// A closer look: at a group, at the stretch that is zoomed to, or at a cell of the map.
const among = () => [...one('tightening').options].filter(option => !option.hidden);
const choosable = () => {
  for (const option of one('tightening').options) option.hidden = option.disabled = state.group !== '' && !option.dataset.groups.includes(`|${state.group}|`);
  one('group').value = state.group;
  const isAll = !state.group && !state.stretch && !state.cell;
  one('everything').hidden = isAll;
  if (isAll) show('closer', '');
  chosenCell();
};
const lookCloser = change => {
  Object.assign(state, change);
  choosable();
  if (!among().some(option => option.value === state.tightening)) state.tightening = among()[0].value;
  remember();
  wish({ kind: 'closer', ...closer() });
};
const zoomed = () => { one('brush').disabled = one('alone').disabled = !viewers[0].view; };
const shownStretch = () => viewers[0].view.map(at => at / state.perSecond);
// Another workbench, with the model and the tightening of this one.
const moveTo = other => {
  const query = new URLSearchParams({ effects: state.effects.join(','), tightening: state.tightening });
  location.assign(`${other || '/'}?${query.toString().replaceAll('%2C', ',')}`);
};

items().forEach(item => item.querySelector('.switch').addEventListener('click', () => {
  const name = item.dataset.effect, has = state.effects.includes(name);
  const effects = has ? state.effects.filter(other => other !== name) : [...state.effects, name];
  state.effects = effects;
  letGo();
  check();
  wish({ kind: 'choose', effects: effects.join(',') });
}));
one('switches').addEventListener('pointerleave', () => {
  if (state.isUnsorted) sort();
  state.isUnsorted = false;
});
one('tightening').addEventListener('change', event => turnTo(event.target.value));
document.querySelectorAll('[data-worse]').forEach(button => button.addEventListener('click', () => {
  const options = among(), count = options.length;
  const at = options.findIndex(option => option.value === state.tightening);
  turnTo(options[(at + Number(button.dataset.worse) + count) % count].value);
}));
items().forEach(item => item.querySelector('[data-signature]').addEventListener('click', () => {
  state.signature = state.signature === item.dataset.effect ? null : item.dataset.effect;
  items().forEach(other => other.querySelector('[data-signature]').setAttribute('aria-pressed', String(other.dataset.effect === state.signature)));
  look();
}));
one('group').addEventListener('change', event => lookCloser({ group: event.target.value }));
one('brush').addEventListener('click', () => lookCloser({ stretch: shownStretch(), cell: '' }));
one('everything').addEventListener('click', () => lookCloser({ group: '', stretch: null, cell: '' }));
one('alone').addEventListener('click', () => {
  const [from, to] = shownStretch().map(at => Number(Math.max(0, at).toPrecision(6)));
  moveTo(`/stretch/${from}/${to}`);
});
one('whole').hidden = !root;
one('whole').addEventListener('click', () => moveTo(''));
viewers[0].root.addEventListener('zoomed', zoomed);
one('as-fitted').addEventListener('click', () => { letGo(); look(); });
one('from-here').addEventListener('click', () => {
  const values = state.values.join(',');
  letGo();
  wish({ kind: 'fit_from', number: Number(state.tightening), values });
});
one('pin').addEventListener('click', () => {
  state.rival = state.rival === null ? state.effects.join(',') : null;
  remember();
  pinned();
  look();
});
one('results').addEventListener('click', async () => {
  one('results').disabled = true;
  show('links', 'Making report and recording of this model …');
  const answer = await ask('/api/results', { effects: state.effects.join(',') });
  one('results').disabled = false;
  show('links', '');
  for (const link of answer?.links ?? []) {
    const anchor = element('a', link.split('/').pop());
    Object.assign(anchor, { href: root + link, target: '_blank' });
    if (link.endsWith('.mcap')) anchor.download = 'recording.mcap';
    one('links').append(anchor, ' ');
  }
});
one('undo').addEventListener('click', () => wish({ kind: 'undo' }));
one('redo').addEventListener('click', () => wish({ kind: 'redo' }));
one('save').addEventListener('click', async () => {
  const answer = await ask('/api/save', { effects: state.effects.join(',') });
  if (answer) show('saved', answer.sentence);
});

// Listens; where the server is gone, again after a while, with the model that is on screen.
const listen = () => {
  const query = new URLSearchParams({ session, ...closer() });
  if (state.given || state.effects.length) query.set('effects', state.effects.join(','));
  const events = new EventSource(root + '/api/events?' + query);
  events.onmessage = message => {
    const event = JSON.parse(message.data);
    hear[event.kind]?.(event);
    state.given = true;
    isKnown();
  };
  events.onerror = () => {
    events.close();
    fault(GONE);
    setTimeout(listen, 1000);
  };
};
choosable();
pinned();
listen();
