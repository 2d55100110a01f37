// Four live plots over the last seconds.

import uPlot from 'uplot';

import { element } from './controls.js';

const KEPT = 400;

/** Colours of the page, as they are now. */
export const colour = (name) => {
  const probe = element('span', { style: `color: var(--${name}); display: none` });
  document.body.append(probe);
  const found = getComputedStyle(probe).color;
  probe.remove();
  return found;
};

const short = (value) => {
  const size = Math.abs(value);
  if (value === 0) return '0';
  return size >= 1e4 || size < 1e-2 ? value.toExponential(0).replace('e+', 'e') : String(Number(value.toPrecision(3)));
};

/** A plot: title, unit, and lines, each with a colour and perhaps dashes. */
class Plot {
  constructor(figure, { title, lines }) {
    this.figure = figure;
    this.title = title;
    this.lines = lines;
    this.clear();
    this.draw();
    new ResizeObserver(() => this.plot.setSize(this.size)).observe(figure);
  }

  get size() {
    return { width: Math.max(60, this.figure.clientWidth - 6), height: Math.max(60, this.figure.clientHeight - 26) };
  }

  clear() {
    this.data = Array.from({ length: this.lines.length + 1 }, () => []);
    this.plot?.setData(this.data);
  }

  /** Anew, in the colours of the theme. */
  draw() {
    this.plot?.destroy();
    const keys = this.lines.map(({ name, tone }) => element('i', { style: `color: var(--${tone})` }, name));
    const caption = element('figcaption', {}, `${this.title}: `);
    keys.forEach((key, k) => caption.append(k ? ', ' : '', key));
    this.figure.replaceChildren(caption);
    const axis = { stroke: colour('soft'), grid: { stroke: colour('line'), width: 1 }, ticks: { show: false }, font: '11px system-ui' };
    const series = this.lines.map(({ name, tone, dash }) => ({ label: name, stroke: colour(tone), width: 1.5, dash, points: { show: false }, spanGaps: true }));
    this.plot = new uPlot(
      {
        ...this.size,
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), high > low || high > 0 ? high * 1.08 : 1] } },
        axes: [
          { ...axis, size: 22, space: 60, values: (_, ticks) => ticks.map((t) => `${short(t)} s`) },
          { ...axis, size: 46, space: 26, values: (_, ticks) => ticks.map(short) },
        ],
        series: [{}, ...series],
      },
      this.data,
      this.figure,
    );
  }

  add(time, values) {
    this.data[0].push(time);
    values.forEach((value, k) => this.data[k + 1].push(value));
    if (this.data[0].length > KEPT) this.data.forEach((column) => column.shift());
  }

  show() {
    this.plot.setData(this.data);
  }
}

const figure = (name) => document.getElementById(`plot-${name}`);
const A = { tone: 'a' };
const B = { tone: 'b' };
const DASHED = [4, 3];

export class Plots {
  constructor() {
    this.error = new Plot(figure('error'), {
      title: 'Left from right, % of size',
      lines: [{ ...A, name: 'distance' }],
    });
    this.energy = new Plot(figure('energy'), {
      title: 'Energy, J',
      lines: [
        { ...A, name: 'total' },
        { ...A, name: 'kinetic', dash: DASHED },
        { tone: 'third', name: 'elastic' },
        { ...B, name: 'total right' },
      ],
    });
    this.momentum = new Plot(figure('momentum'), {
      title: 'Momentum',
      lines: [
        { ...A, name: 'N·s' },
        { ...B, name: 'right' },
        { ...A, name: 'N·m·s', dash: DASHED },
        { ...B, name: 'right', dash: DASHED },
      ],
    });
    this.time = new Plot(figure('time'), {
      title: 'Time a step, ms',
      lines: [
        { ...A, name: 'left' },
        { ...B, name: 'right' },
      ],
    });
  }

  get all() {
    return [this.error, this.energy, this.momentum, this.time];
  }

  redraw() {
    this.all.forEach((plot) => plot.draw());
  }

  clear() {
    this.all.forEach((plot) => plot.clear());
  }

  show() {
    this.all.forEach((plot) => plot.show());
  }
}
