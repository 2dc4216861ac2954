// One panel: signals of one unit over time, with a cursor, a legend that hides and shows, and a drag that zooms.
class Panel {
  constructor(host, spec, viewer) {
    Object.assign(this, { host, spec, viewer, hidden: new Set(), drag: null });
    host.textContent = '';
    host.classList.add('panel');
    host.tabIndex = 0;
    host.setAttribute('role', 'group');
    host.setAttribute('aria-label', spec.title + ', interactive');
    this.svg = host.appendChild(document.createElementNS('http://www.w3.org/2000/svg', 'svg'));
    this.legend = host.appendChild(document.createElement('p'));
    this.legend.className = 'legend';
    this.outputs = spec.series.map((series, i) => this.toggle(series, i));
    if (spec.residual) this.explainBand();
    this.listen();
  }

  explainBand() {
    const key = this.legend.appendChild(document.createElement('span')), swatch = document.createElement('span');
    key.className = 'key';
    swatch.className = 'swatch c-band';
    key.append(swatch, ' 95 % of the noise');
  }

  toggle(series, i) {
    const button = this.legend.appendChild(document.createElement('button'));
    const swatch = document.createElement('span'), output = document.createElement('output');
    button.type = 'button';
    button.className = 'toggle';
    button.setAttribute('aria-pressed', 'true');
    swatch.className = 'swatch ' + series.class;
    button.append(swatch, ' ' + series.label + ' ', output);
    button.addEventListener('click', () => {
      this.hidden.has(i) ? this.hidden.delete(i) : this.hidden.add(i);
      button.setAttribute('aria-pressed', String(!this.hidden.has(i)));
      this.draw();
    });
    return output;
  }

  listen() {
    const svg = this.svg;
    svg.addEventListener('pointermove', event => {
      if (this.drag) this.drag[1] = this.timeAt(event);
      this.viewer.point(this.timeAt(event));
    });
    svg.addEventListener('pointerdown', event => {
      this.viewer.point(this.timeAt(event));
      if (event.pointerType === 'mouse') {
        this.drag = [this.timeAt(event), this.timeAt(event)];
        svg.setPointerCapture(event.pointerId);
      }
    });
    svg.addEventListener('pointerup', () => {
      const drag = this.drag;
      this.drag = null;
      if (drag && Math.abs(this.px(drag[1]) - this.px(drag[0])) > 6) this.viewer.zoom(Math.min(...drag), Math.max(...drag));
      else this.overlay();
    });
    svg.addEventListener('pointercancel', () => { this.drag = null; this.overlay(); });
    svg.addEventListener('pointerleave', () => this.drag || this.viewer.point(null));
    svg.addEventListener('dblclick', () => this.viewer.zoom());
  }

  timeAt(event) {
    const box = this.svg.getBoundingClientRect();
    const [low, high] = this.viewer.range();
    const share = (event.clientX - box.left - this.left) / (this.width - this.left - 10);
    return low + Math.min(1, Math.max(0, share)) * (high - low);
  }

  px(time) {
    const [low, high] = this.viewer.range();
    return this.left + (time - low) / (high - low) * (this.width - this.left - 10);
  }

  py(value) { return 8 + (this.top - value) / (this.top - this.low) * (this.height - 48); }

  // The vertical range of what is visible, with some room.
  fit(signals, times, band) {
    const [from, to] = this.viewer.range();
    let low = Infinity, high = -Infinity;
    signals.forEach((signal, i) => signal && !this.hidden.has(i) && signal.forEach((value, j) => {
      if (value === null || times[j] < from || times[j] > to) return;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }));
    if (band) { low = Math.min(low, -band); high = Math.max(high, band); }
    if (low > high) [low, high] = [0, 1];
    const room = 0.05 * (high - low) || 0.1 * Math.abs(high) || 0.5;
    this.low = low - room;
    this.top = high + room;
  }

  draw() {
    const { signals, times, noise, unit } = this.viewer.shown(this);
    const band = this.spec.residual ? noise : null;
    this.width = Math.max(240, this.host.clientWidth);
    this.height = Math.round(Math.min(300, Math.max(210, 0.52 * this.width)));
    this.fit(signals, times, band);
    const { list: rows, power } = ticks(this.low, this.top, 5), { list: columns } = ticks(...this.viewer.range(), this.width < 400 ? 4 : 6);
    this.left = 32 + 6.4 * Math.max(...rows.map(row => row[1].length));
    const { width, height, left } = this, bottom = height - 40, right = width - 10, middle = (8 + bottom) / 2;
    const id = 'clip-' + this.viewer.name + this.viewer.panels.indexOf(this);
    let inside = '';
    if (band) inside += `<g class="bars c-band"><rect x="${left}" y="${this.py(band)}" width="${right - left}" height="${this.py(-band) - this.py(band)}"/></g>`;
    const grid = columns.map(([at]) => `M${this.px(at)} 8V${bottom}`).concat(rows.map(([at]) => `M${left} ${this.py(at)}H${right}`));
    inside += `<path class="grid" d="${grid.join('')}"/>`;
    signals.forEach((signal, i) => {
      if (signal && !this.hidden.has(i)) inside += `<path class="line ${this.spec.series[i].class}" d="${this.path(signal, times)}"/>`;
    });
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.svg.setAttribute('height', height);
    this.svg.innerHTML = `<clipPath id="${id}"><rect x="${left}" y="8" width="${right - left}" height="${bottom - 8}"/></clipPath><g clip-path="url(#${id})">${inside}</g>`
      + columns.map(([at, text]) => `<text x="${this.px(at)}" y="${bottom + 15}" text-anchor="middle">${text}</text>`).join('')
      + rows.map(([at, text]) => `<text x="${left - 6}" y="${this.py(at) + 4}" text-anchor="end">${text}</text>`).join('')
      + `<text class="axis" x="${(left + right) / 2}" y="${height - 6}" text-anchor="middle">${this.spec.time ?? "time since the window's start"} [${unit}]</text>`
      + `<text class="axis" x="12" y="${middle}" text-anchor="middle" transform="rotate(-90 12 ${middle})">${scaledLabel(this.spec.axis, power)}</text><g></g>`;
    this.overlay();
  }

  // One point beyond either end of the view is kept, so that lines run to the edge.
  path(signal, times) {
    const [from, to] = this.viewer.range();
    let path = '', broken = true;
    for (let j = 0; j < times.length; j++) {
      if (times[j + 1] < from || times[j - 1] > to) continue;
      if (signal[j] === null) { broken = true; continue; }
      path += (broken ? 'M' : 'L') + this.px(times[j]).toFixed(1) + ' ' + this.py(signal[j]).toFixed(1);
      broken = false;
    }
    return path;
  }

  // What moves with the pointer: the cursor, the dragged range, and the values beside the legend.
  overlay() {
    const { signals, times } = this.viewer.shown(this), cursor = this.viewer.cursor, bottom = this.height - 40;
    let marks = '';
    if (this.drag) {
      const [from, to] = [this.px(Math.min(...this.drag)), this.px(Math.max(...this.drag))];
      marks += `<rect class="drag" x="${from}" y="8" width="${to - from}" height="${bottom - 8}"/>`;
    }
    if (cursor !== null) {
      const x = this.px(times[cursor]);
      marks += `<path class="cursor" d="M${x} 8V${bottom}"/>`;
      signals.forEach((signal, i) => {
        if (signal && !this.hidden.has(i) && signal[cursor] !== null)
          marks += `<g class="dots ${this.spec.series[i].class}"><circle cx="${x}" cy="${this.py(signal[cursor])}" r="3.5"/></g>`;
      });
    }
    this.svg.lastElementChild.innerHTML = marks;
    this.outputs.forEach((output, i) => { output.textContent = cursor === null ? '' : shown(signals[i]?.[cursor]); });
  }
}
