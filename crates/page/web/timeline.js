// Time: the events of a run as ticks, the present as a line.

import { colours, paint } from './theme.js';
import { words } from './units.js';

/** Colours of events by the state that follows; others are short ticks. */
const COLOUR = { 'gross slip': 3, 'breaks loose': 3, 'gross slip ends': 1, 'sticks again': 1, touch: 2, 'lift-off': 2 };

/** Why an event happened, from the values of its contact at that time. */
const WHY = {
  'gross slip': ({ u, f, n }) => `the last spring in the centre slipped: |F_x| = ${f} has reached μF_N, with F_N = ${n}, u = ${u}`,
  'breaks loose': ({ f, n }) => `the force has reached static friction: |F_x| = ${f} at F_N = ${n}; from now on kinetic friction acts`,
  'gross slip ends': ({ u }) => `the sliding velocity became zero at u = ${u}: the centre sticks, and slip begins again from the edge`,
  'sticks again': ({ u }) => `the sliding velocity became zero at u = ${u}: the contact sticks, and static friction counts again`,
  reversal: ({ u, f }) => `the motion turned at u = ${u}, |F_x| = ${f}: all springs stick, and slip begins again from the edge`,
  'loop closed': ({ u }) => `an inner loop has closed at u = ${u}: its reversals are forgotten`,
  'full stick': () => 'the contact grows so fast that no spring slips',
  'slip begins': () => 'the contact no longer grows fast enough: slip begins at the edge',
  touch: () => 'the bodies touch',
  'lift-off': () => 'the bodies part: the memory of the contact is empty',
  corner: () => 'the waveform has a corner: its velocity jumps',
  jump: () => 'the waveform jumps',
};

export class Timeline {
  /** `values` gives the values of the contact of an event as texts. */
  constructor(canvas, told, seek, values) {
    Object.assign(this, { canvas, told, seek, values, events: [], duration: 1, t: 0 });
    const go = (event) => {
      const share = Math.max(0, Math.min(1, event.offsetX / canvas.clientWidth));
      const near = this.near(share * this.duration);
      this.seek(near ? near.t : share * this.duration);
      this.tell(near);
    };
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
      canvas.onpointermove = (move) => {
        const share = Math.max(0, Math.min(1, move.offsetX / canvas.clientWidth));
        this.seek(share * this.duration);
      };
    };
    canvas.onpointerup = () => { canvas.onpointermove = null; };
    canvas.onkeydown = (event) => {
      const next = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      const jump = { Home: 0, End: this.duration }[event.key];
      if (jump !== undefined) this.seek(jump);
      else if (next && event.shiftKey) this.seek(Math.max(0, Math.min(this.duration, this.t + next * this.duration / 200)));
      else if (next) this.toEvent(next);
      else return;
      event.preventDefault();
    };
  }

  load(text, duration) {
    this.duration = duration;
    const lines = text ? text.split('\n') : [];
    this.events = lines.map((line) => {
      const [t, ...rest] = line.split(',');
      return { t: +t, kind: rest.pop(), source: rest.join(',') };
    });
    this.canvas.setAttribute('aria-valuemax', duration);
    this.base = null;
    this.tell(null);
  }

  toEvent(next) {
    const at = this.events.findIndex((event) => event.t > this.t + (next > 0 ? 1e-12 : -1e-12) * this.duration);
    let k = next > 0 ? at : (at < 0 ? this.events.length : at) - 1;
    while (next < 0 && k >= 0 && this.events[k].t >= this.t * (1 - 1e-12)) k -= 1;
    const event = this.events[k];
    if (!event) return;
    this.seek(event.t);
    this.tell(event);
  }

  /** The event beside a click, if one is within three pixels; gross slip before small ones. */
  near(t) {
    const within = (3 / this.canvas.clientWidth) * this.duration;
    const found = this.events.filter((event) => Math.abs(event.t - t) <= within);
    const weight = (event) => Math.abs(event.t - t) + (COLOUR[event.kind] === undefined ? within : 0);
    return found.sort((a, b) => weight(a) - weight(b))[0];
  }

  tell(event) {
    this.event = event;
    const why = event && WHY[event.kind]?.(this.values(event));
    this.told.textContent = event
      ? `${words(event.t, 's', 7)} · ${event.source}: ${event.kind}${why ? ` – ${why}` : ''}`
      : `${this.events.length} events: click one, or step through them with ← and →`;
  }

  draw(t) {
    this.t = t;
    if (this.event && this.event.t !== t) this.tell(null);
    this.canvas.setAttribute('aria-valuenow', t);
    this.canvas.setAttribute('aria-valuetext', words(t, 's', 5));
    paint(this.canvas, (g, width, height) => {
      const palette = colours();
      const ratio = devicePixelRatio || 1;
      if (!this.base || this.base.width !== Math.round(width * ratio)) {
        this.base = new OffscreenCanvas(Math.round(width * ratio), Math.round(height * ratio));
        const b = this.base.getContext('2d');
        b.scale(ratio, ratio);
        b.fillStyle = palette.grid;
        b.fillRect(0, height - 8, width, 3);
        const seen = new Set();
        for (const event of this.events) {
          const colour = COLOUR[event.kind];
          const x = Math.round((event.t / this.duration) * width * 2) / 2;
          const key = x * 10 + (colour ?? 0);
          if (seen.has(key)) continue;
          seen.add(key);
          b.fillStyle = colour === undefined ? palette.faint : palette.contact[colour];
          b.fillRect(x, colour === undefined ? height - 16 : 4, 1, colour === undefined ? 8 : height - 12);
        }
      }
      g.drawImage(this.base, 0, 0, width, height);
      g.fillStyle = palette.text;
      g.fillRect((t / this.duration) * width - 1, 0, 2, height);
    });
  }
}
