// A viewer: one tightening at a time, all panels under one cursor and one zoom. Where there is nothing to choose from,
// the chooser and the facts beside the panels are missing.
class Viewer {
  constructor(root, data) {
    Object.assign(this, { root, data, name: root.dataset.viewer, number: 0, view: null, cursor: null });
    this.choice = root.querySelector('[data-choice]');
    this.panels = [...root.querySelectorAll('[data-panel]')].map((host, i) => new Panel(host, data.panels[i], this));
    this.choice?.addEventListener('change', () => this.choose(Number(this.choice.value)));
    root.querySelectorAll('[data-step]').forEach(button => button.addEventListener('click', () => this.step(Number(button.dataset.step))));
    root.addEventListener('keydown', event => this.key(event));
    let width = 0;
    new ResizeObserver(() => {
      if (root.clientWidth !== width) { width = root.clientWidth; this.draw(); }
    }).observe(root);
    this.choose(0);
  }

  choose(number) {
    this.take(number);
    this.draw();
  }

  take(number) {
    this.number = number;
    this.view = this.cursor = null;
    const example = this.data.examples[number];
    let sample = 0;
    this.times = example.steps.map(step => (sample += step) * example.step);
    if (this.choice) this.describe(example);
  }

  describe(example) {
    this.choice.value = String(this.number);
    this.root.querySelector('[data-current]').textContent = example.heading;
    if (!example.facts) return;
    this.root.querySelector('[data-note]').textContent = example.note;
    this.root.querySelector('[data-facts]').replaceChildren(...example.facts.map(texts => {
      const row = document.createElement('tr');
      texts.forEach((text, i) => {
        const cell = row.appendChild(document.createElement(i ? 'td' : 'th'));
        cell.textContent = text;
        if (i === 2) cell.className = 'interval';
        if (!i) cell.scope = 'row';
      });
      return row;
    }));
  }

  step(by) {
    const count = this.data.examples.length;
    this.choose((this.number + by + count) % count);
  }

  range() { return this.view || [this.times[0], this.times.at(-1)]; }

  shown(panel) {
    const { signals, noise, unit } = this.data.examples[this.number];
    return { signals: signals[this.panels.indexOf(panel)] || [], times: this.times, noise, unit };
  }

  draw() { this.panels.forEach(panel => panel.draw()); }

  zoom(from, to) {
    this.view = from === undefined ? null : [from, to];
    this.draw();
    this.root.dispatchEvent(new Event('zoomed'));
  }

  // Puts the cursor at the sample next to a time.
  point(time) {
    this.cursor = time === null ? null : this.nearest(time);
    this.panels.forEach(panel => panel.overlay());
  }

  nearest(time) {
    let low = 0, high = this.times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      this.times[middle] < time ? low = middle : high = middle;
    }
    return time - this.times[low] < this.times[high] - time ? low : high;
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('select,input')) return;
    const [from, to] = this.range(), width = to - from;
    const middle = this.cursor === null ? (from + to) / 2 : this.times[this.cursor];
    const first = this.times[0], last = this.times.at(-1);
    const actions = {
      n: () => this.step(1),
      p: () => this.step(-1),
      ArrowRight: () => this.point(Math.min(to, middle + width / 150)),
      ArrowLeft: () => this.point(Math.max(from, middle - width / 150)),
      '+': () => this.zoom(Math.max(first, middle - width / 4), Math.min(last, middle + width / 4)),
      '-': () => this.zoom(Math.max(first, middle - width), Math.min(last, middle + width)),
      Escape: () => this.zoom(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }
}

document.documentElement.classList.add('script');
const viewers = [...document.querySelectorAll('[data-viewer]')].map(root =>
  new Viewer(root, JSON.parse(document.getElementById(root.dataset.viewer || 'viewer-data').textContent)));
const chooser = viewers.find(viewer => viewer.choice && !viewer.name);
document.querySelectorAll('[data-example]').forEach(link =>
  link.addEventListener('click', () => chooser.choose(Number(link.dataset.example))));
// A printed page shows the panels at the paper's width.
addEventListener('beforeprint', () => viewers.forEach(viewer => viewer.draw()));
