// Plots: curves over time, and curves of one quantity over another, with a trace that grows while the motion plays.

import uPlot from 'uplot';
import { colours } from './theme.js';
import { scaled } from './units.js';

const largest = (arrays) => {
  let most = 0;
  for (const array of arrays) for (const value of array) if (Math.abs(value) > most) most = Math.abs(value);
  return most;
};

/** A curve of any x over y, drawn as it comes. */
function wayPath(u, s) {
  uPlot.orient(u, s, (series, xs, ys, sx, sy, px, py, left, top, width, height) => {
    const context = u.ctx;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    context.beginPath();
    for (let k = 0; k < xs.length; k += 1) {
      const x = px(xs[k], sx, width, left);
      const y = py(ys[k], sy, height, top);
      if (k) context.lineTo(x, y);
      else context.moveTo(x, y);
    }
    context.strokeStyle = series.stroke(u, s);
    context.lineWidth = 1.5 * devicePixelRatio;
    context.stroke();
    context.restore();
  });
  return null;
}

export class Plot {
  /**
   * @param {HTMLElement} place
   * @param {{ way?: boolean, label: string }} form `way`: x need not ascend
   */
  constructor(place, form) {
    this.place = place;
    this.form = form;
    this.trace = document.createElement('canvas');
    this.trace.className = 'trace';
    new ResizeObserver(() => this.fit()).observe(place);
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.place;
    const inner = height - this.legend;
    if (this.plot && width && (this.plot.width !== width || this.plot.height !== inner)) {
      this.plot.setSize({ width, height: inner });
      this.retrace();
    }
  }

  /** @param {{ x: {name, unit, values}, ys: {name, unit, values}[] }} data */
  show({ x, ys }) {
    const shape = [x.name, ...ys.map((y) => y.name)].join();
    const of = { x: scaled(largest([x.values]), x.unit), y: scaled(largest(ys.map((y) => y.values)), ys[0]?.unit ?? '') };
    this.of = of;
    this.data = this.form.way ? [null, ...ys.map((y) => [x.values, y.values])] : [x.values, ...ys.map((y) => y.values)];
    if (this.plot && this.shape === shape) {
      this.plot.setData(this.data);
    } else {
      this.build(shape, x, ys);
    }
    this.retrace();
  }

  build(shape, x, ys) {
    this.plot?.destroy();
    this.shape = shape;
    this.legend = ys.length > 1 ? 26 : 0;
    const palette = colours();
    const axis = (key) => ({
      stroke: palette.text,
      grid: { stroke: palette.grid, width: 1 },
      ticks: { stroke: palette.grid, width: 1 },
      label: '',
      size: key === 'y' ? 58 : 40,
      labelSize: 18,
      labelGap: 0,
      font: '12px system-ui, sans-serif',
      labelFont: '12px system-ui, sans-serif',
      values: (_, splits) => splits.map((value) => `${+(value * this.of[key].factor).toPrecision(5)}`.replace('-', '−')),
    });
    const label = (key, name) => () => `${name}${this.of[key].unit ? ` (${this.of[key].unit})` : ''}`;
    const yName = ys.length === 1 ? ys[0].name : this.form.label;
    const axes = [axis('x'), axis('y')];
    axes[0].label = label('x', x.name);
    axes[1].label = label('y', yName);
    const pad = (_, low, high) => {
      const edge = 0.04 * (high - low || Math.abs(high) || 1);
      return [low - edge, high + edge];
    };
    const options = {
      mode: this.form.way ? 2 : 1,
      width: this.place.clientWidth || 400,
      height: (this.place.clientHeight || 240) - this.legend,
      legend: { show: ys.length > 1, live: false },
      cursor: { drag: { x: true, y: !!this.form.way }, points: { show: false } },
      scales: { x: { time: false, range: this.form.way ? pad : undefined }, y: { range: pad } },
      axes,
      series: [
        {},
        ...ys.map((y, k) => ({
          label: y.name,
          stroke: palette.series[k % 6],
          width: 1.5,
          points: { show: false },
          ...(this.form.way ? { paths: wayPath, facets: [{ scale: 'x', auto: true }, { scale: 'y', auto: true }] } : {}),
        })),
      ],
      hooks: { draw: [() => this.retrace()] },
    };
    if (!this.form.way) delete options.scales.x.range;
    this.plot = new uPlot(options, this.data, this.place);
    this.plot.over.append(this.trace);
    if (this.form.pick) {
      this.plot.over.addEventListener('click', (event) => {
        this.form.pick(this.plot.posToVal(event.offsetX, 'x'));
      });
    }
  }

  /** Rebuilds the plot, for another theme. */
  restyle() {
    this.shape = null;
  }

  /** Shows the motion up to a row: a growing trace, and a mark. */
  to(row) {
    this.row = row;
    if (!this.plot || !this.data || row === undefined) return;
    const { plot, trace } = this;
    const { clientWidth: width, clientHeight: height } = plot.over;
    const ratio = devicePixelRatio || 1;
    const context = trace.getContext('2d');
    if (trace.width !== Math.round(width * ratio) || trace.height !== Math.round(height * ratio) || row < this.drawn) {
      trace.width = Math.round(width * ratio);
      trace.height = Math.round(height * ratio);
      this.drawn = 0;
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const palette = colours();
    if (this.form.way) {
      const [xs, ys] = this.data[1];
      const at = (k) => [plot.valToPos(xs[k], 'x'), plot.valToPos(ys[k], 'y')];
      const from = Math.max(this.drawn, row - 4000);
      context.strokeStyle = palette.series[1];
      context.lineWidth = 2.5;
      context.beginPath();
      context.moveTo(...at(from));
      for (let k = from + 1; k <= row; k += 1) context.lineTo(...at(k));
      context.stroke();
      this.mark(at(row));
    } else {
      this.mark([plot.valToPos(this.data[0][row], 'x'), null]);
    }
    this.drawn = row;
  }

  mark([x, y]) {
    if (!this.dot) {
      this.dot = document.createElement('i');
      this.dot.className = 'mark';
    }
    if (this.dot.parentNode !== this.plot.over) this.plot.over.append(this.dot);
    this.dot.classList.toggle('line', y === null);
    this.dot.style.transform = `translate(${x}px, ${y ?? 0}px)`;
  }

  retrace() {
    this.drawn = Infinity;
    if (this.row !== undefined && this.plot) this.to(Math.min(this.row, (this.form.way ? this.data[1][0] : this.data[0]).length - 1));
  }

  /** Takes trace and mark away. */
  still() {
    this.row = undefined;
    this.dot?.remove();
    this.trace.width = 0;
  }
}
