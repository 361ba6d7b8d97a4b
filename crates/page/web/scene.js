// The bodies of a scenario from the side, with their contacts and forces. Motions are magnified.

import { colours, paint } from './theme.js';
import { words } from './units.js';

/** The lower and the upper body of a contact: the ground is always below. */
const ends = ({ between: [first, second] }) => (second === 'ground' ? [second, first] : [first, second]);

/** Levels of the bodies: what carries a body is below it. */
function levels(scenario) {
  const bodies = Object.keys(scenario.bodies ?? {});
  const contacts = Object.values(scenario.contacts ?? {});
  const links = Object.values(scenario.springs ?? {}).concat(Object.values(scenario.stacks ?? {}), Object.values(scenario.actuators ?? {}));
  const level = Object.fromEntries(bodies.map((name) => [name, 0]));
  for (let round = 0; round < bodies.length; round += 1) {
    for (const [under, over] of contacts.map(ends)) {
      if (over in level) level[over] = Math.max(level[over], (level[under] ?? -1) + 1);
    }
  }
  const grounded = [...contacts, ...links].some(({ between }) => between?.includes('ground'));
  return { bodies, contacts, links: links.filter((link) => Array.isArray(link.between)), level, grounded };
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
  }

  load(about) {
    const { scenario } = about;
    this.about = about;
    this.scenario = scenario;
    Object.assign(this, levels(scenario));
    this.names = Object.keys(scenario.contacts ?? {});
  }

  /** Scales by the motion of a run. */
  scale(columns) {
    let most = 0;
    this.columns = columns;
    for (const body of this.bodies) {
      for (const name of [`${body}.x_m`, `${body}.z_m`]) {
        const column = columns[name];
        if (!column) continue;
        // Long travel wraps around, so the swing within a part of the run counts.
        const part = Math.max(2, Math.floor(column.length / 20));
        for (let from = 0; from + part <= column.length; from += part) {
          let [low, high] = [Infinity, -Infinity];
          for (let k = from; k < from + part; k += 1) {
            low = Math.min(low, column[k]);
            high = Math.max(high, column[k]);
          }
          most = Math.max(most, high - low);
        }
      }
    }
    this.most = most || 1e-9;
    const of = (suffix) => this.names.reduce((peak, name) => (columns[`${name}.${suffix}`] ?? []).reduce((a, b) => Math.max(a, Math.abs(b)), peak), 0);
    this.friction = of('fx_N');
    this.force = Math.max(this.friction, of('fn_N')) || 1;
    this.start = Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, column[0]]));
  }

  /** Draws a row: a function from the name of a column to its value. */
  draw(row, pull) {
    if (!this.scenario) return;
    paint(this.canvas, (g, width, height) => {
      const palette = colours();
      const value = (name) => row(name) ?? 0;
      const rows = Math.max(...Object.values(this.level), 0) + 1;
      const floor = this.grounded || this.bodies.length < 2 ? 18 : 0;
      const gap = (height - 30 - floor) / rows;
      const tall = Math.min(64, gap * 0.55);
      const crowd = Math.max(...Object.values(this.level).map((level, _, all) => all.filter((other) => other === level).length));
      const amplitude = Math.min(width * 0.1, 44, (0.18 * (width - 40)) / crowd);
      const magnified = amplitude / this.most;
      const boxes = {};
      for (let level = 0; level < rows; level += 1) {
        const here = this.bodies.filter((body) => this.level[body] === level);
        here.forEach((body, k) => {
          const wide = (width - 40) / here.length - (here.length > 1 ? amplitude : 0) - 24;
          const size = Math.min(wide, level === rows - 1 || here.length > 1 ? width * 0.5 : width * 0.8);
          const x0 = 20 + (k + 0.5) * ((width - 40) / here.length);
          const y0 = height - floor - 22 - (level + 0.5) * gap;
          const [dx, dz] = ['x_m', 'z_m'].map((name) => value(`${body}.${name}`) * magnified);
          // What travels far comes back on the other side.
          const span = width * 0.5;
          const wrapped = Math.abs(dx) > span / 2 ? ((((dx + span / 2) % span) + span) % span) - span / 2 : dx;
          const pitch = (value(`${body}.pitch_rad`) - (this.start[`${body}.pitch_rad`] ?? 0)) * Math.min(4000, 0.06 / 1e-9 * this.most);
          boxes[body] = { x: x0 + wrapped, y: y0 - Math.max(-gap / 5, Math.min(gap * 0.4, dz)), wide: size, tall, pitch: Math.max(-0.15, Math.min(0.15, pitch)), far: dx !== wrapped };
        });
      }
      boxes.ground = { x: width / 2, y: height - floor / 2, wide: width, tall: floor || 8, pitch: 0 };
      this.boxes = boxes;
      if (floor) {
        g.fillStyle = palette.grid;
        g.fillRect(0, height - floor, width, floor);
        g.fillStyle = palette.text;
        g.textAlign = 'left';
        g.fillText('ground', 8, height - 5);
      }
      for (const { between: [one, other] } of this.links) this.zigzag(g, palette, boxes[one], boxes[other]);
      for (const body of this.bodies) {
        const { x, y, wide, tall: high, pitch } = boxes[body];
        g.save();
        g.translate(x, y);
        g.rotate(-pitch);
        g.fillStyle = palette.body;
        g.strokeStyle = palette.edge;
        g.lineWidth = 1.5;
        g.beginPath();
        g.roundRect(-wide / 2, -high / 2, wide, high, 5);
        g.fill();
        g.stroke();
        g.fillStyle = palette.text;
        g.textAlign = 'left';
        g.fillText(body, -wide / 2 + 8, 4);
        g.restore();
      }
      this.names.forEach((name) => this.contact(g, palette, name, value));
      g.fillStyle = palette.text;
      g.textAlign = 'left';
      g.fillText(`motion × ${(+(magnified / 3780).toPrecision(2)).toLocaleString('en')}`, 8, 16);
      g.textAlign = 'right';
      g.fillText(`longest arrow ${words(this.force, 'N', 3)}`, width - 8, 16);
      if (pull) this.arrow(g, palette.series[2], [pull.from[0], pull.from[1]], [pull.to[0], pull.to[1]]);
    });
  }

  /** A contact: a cap below the upper body, coloured by its state, with the forces on the upper body. */
  contact(g, palette, name, value) {
    const { between, at } = this.scenario.contacts[name];
    const [under, over] = ends({ between });
    const [low, high] = [this.boxes[under], this.boxes[over]];
    if (!low || !high) return;
    const siblings = this.names.filter((other) => ends(this.scenario.contacts[other]).join() === [under, over].join());
    const places = siblings.map((other) => this.scenario.contacts[other].at?.[over]?.x ?? 0);
    const widest = Math.max(...places.map(Math.abs));
    const k = siblings.indexOf(name);
    const x = widest > 0
      ? high.x + ((at?.[over]?.x ?? 0) / widest) * high.wide * 0.36
      : (siblings.length > 1 ? high.x + ((k + 0.5) / siblings.length - 0.5) * high.wide * 0.8 : (high.wide < low.wide ? high.x : low.x));
    const top = high.y + high.tall / 2;
    const bottom = low.y - low.tall / 2;
    const middle = (top + bottom) / 2;
    const radius = Math.max(6, Math.min(26, (bottom - top) * 0.9));
    g.fillStyle = palette.contact[value(`${name}.state`)] ?? palette.faint;
    g.beginPath();
    g.moveTo(x - radius * 0.8, top);
    g.quadraticCurveTo(x, bottom + (bottom - top) * 0.9, x + radius * 0.8, top);
    g.fill();
    this.spots = this.spots ?? {};
    this.spots[name] = { x, y: middle, radius: Math.max(10, radius * 0.7) };
    const long = 46 / this.force;
    // Channels are forces on the second body.
    const fx = (over === between[1] ? 1 : -1) * value(`${name}.fx_N`);
    const fn = value(`${name}.fn_N`);
    this.arrow(g, palette.series[4], [x, middle], [x + fx * long, middle]);
    this.arrow(g, palette.text, [x, middle], [x, middle - fn * long]);
    g.fillStyle = palette.text;
    g.textAlign = 'left';
    const { count } = this.scenario.contacts[name];
    g.fillText(count > 1 ? `${name} × ${count}` : name, x + radius + 2, bottom - 3);
  }

  arrow(g, colour, [x, y], [tx, ty]) {
    const length = Math.hypot(tx - x, ty - y);
    if (length < 1.5) return;
    const angle = Math.atan2(ty - y, tx - x);
    const head = Math.min(8, length * 0.6);
    g.strokeStyle = g.fillStyle = colour;
    g.lineWidth = 2;
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(tx - head * 0.8 * Math.cos(angle), ty - head * 0.8 * Math.sin(angle));
    g.stroke();
    g.beginPath();
    g.moveTo(tx, ty);
    for (const side of [-0.4, 0.4]) g.lineTo(tx - head * Math.cos(angle + side), ty - head * Math.sin(angle + side));
    g.fill();
  }

  zigzag(g, palette, one, other) {
    if (!one || !other) return;
    const [x1, y1, x2, y2] = [one.x, one.y, other.x, other.y];
    const length = Math.hypot(x2 - x1, y2 - y1) || 1;
    const [nx, ny] = [-(y2 - y1) / length, (x2 - x1) / length];
    g.strokeStyle = palette.faint;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x1, y1);
    for (let k = 1; k < 12; k += 1) {
      const share = k / 12;
      const side = k < 3 || k > 9 ? 0 : k % 2 ? 7 : -7;
      g.lineTo(x1 + (x2 - x1) * share + nx * side, y1 + (y2 - y1) * share + ny * side);
    }
    g.lineTo(x2, y2);
    g.stroke();
  }

  /** The free body, or the contact, at a point of the canvas. */
  at(x, y) {
    for (const [name, spot] of Object.entries(this.spots ?? {})) {
      if (name in (this.scenario.contacts ?? {}) && Math.hypot(x - spot.x, y - spot.y) < spot.radius) return { contact: name };
    }
    for (const body of this.bodies) {
      const box = this.boxes?.[body];
      if (box && Math.abs(x - box.x) < box.wide / 2 && Math.abs(y - box.y) < box.tall / 2) return { body };
    }
    return null;
  }
}
