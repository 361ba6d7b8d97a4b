// The inside of a contact: springs, pressures, and the memory curve. Pictures of the numbers of `Engine.inside`.

import { colours, paint } from './theme.js';
import { words } from './units.js';

/** The numbers by name. */
export function read(numbers) {
  if (!numbers) return null;
  const [t, d, u, normal, force, a, c, state, elastic, work, friction, kappa, springs, radii, knots] = numbers;
  let at = 15;
  const take = (count, width, names) => {
    const found = Object.fromEntries(names.map((name) => [name, new Float64Array(count)]));
    for (let k = 0; k < count; k += 1) names.forEach((name, n) => { found[name][k] = numbers[at + width * k + n]; });
    at += width * count;
    return found;
  };
  return {
    t, d, u, normal, force, a, c, state, elastic, work, friction, kappa,
    springs: take(springs, 6, ['x', 'length', 'stretch', 'state', 'normal', 'force']),
    fields: take(radii, 5, ['r', 'p', 'tau', 'u', 'state']),
    knots: take(knots, 2, ['h', 'p']),
  };
}

const greatest = (array, least = 0) => array.reduce((most, value) => (Number.isFinite(value) ? Math.max(most, Math.abs(value)) : most), least);

/**
 * The row of springs, pressed and sheared (Figure 4.2 of the handbook): the foot of each spring stays where it is stretched from, its
 * head is on the body above. Below it pressure and shear stress.
 */
export function drawSprings(canvas, inside) {
  paint(canvas, (g, width, height) => {
    const palette = colours();
    g.fillStyle = palette.text;
    if (!inside || !inside.springs.x.length || !(inside.a > 0)) {
      g.textAlign = 'center';
      g.fillText(!inside ? '' : inside.a > 0 ? 'This contact has no row of springs to show.' : 'open contact', width / 2, height / 2);
      return;
    }
    const { springs, fields, a, c, friction } = inside;
    const reach = Math.max(greatest(springs.x), a) || 1;
    const px = (x) => width / 2 + (x / reach) * (width / 2 - 16);
    const share = fields.r.length ? 0.5 : 0.8;
    const [top, bottom] = [34, height * share];
    const load = greatest(springs.normal.map((force, k) => force / springs.length[k])) || 1;
    const stretch = greatest(springs.stretch) || 1;
    const lean = Math.min(26, width / 16);
    g.fillStyle = palette.body;
    g.fillRect(0, bottom, width, 10);
    springs.x.forEach((x, k) => {
      const state = springs.state[k];
      const pressed = springs.normal[k] / springs.length[k] / load;
      const y = state ? top + 14 + pressed * (bottom - top) * 0.35 : top + 6;
      g.strokeStyle = palette.states[state];
      g.globalAlpha = state ? 1 : 0.35;
      g.lineWidth = springs.x.length > 150 ? 1 : 2;
      g.beginPath();
      g.moveTo(px(x), state ? bottom : bottom - 6);
      g.lineTo(px(x) + (springs.stretch[k] / stretch) * lean, y);
      g.stroke();
    });
    g.globalAlpha = 1;
    const span = (radius, y, name) => {
      if (!(radius > 0)) return;
      g.strokeStyle = g.fillStyle = palette.text;
      g.lineWidth = 1;
      g.beginPath();
      g.moveTo(px(-radius), y);
      g.lineTo(px(radius), y);
      for (const side of [-1, 1]) {
        g.moveTo(px(side * radius), y - 4);
        g.lineTo(px(side * radius), y + 4);
      }
      g.stroke();
      g.textAlign = 'center';
      g.fillText(`${name} = ${words(2 * radius, 'm', 3)}`, width / 2, y - 4);
    };
    span(a, 30, '2a');
    if (c > 0 && c < a * 0.9999) span(c, bottom + 26, '2c');
    if (!fields.r.length) return;
    // Pressures over the diameter, from the axis to both sides.
    const [low, high] = [height - 18, height * share + 44];
    const finite = fields.p.filter((p) => Number.isFinite(p)).sort();
    const most = Math.max(finite[Math.floor(0.98 * (finite.length - 1))] || 0, 1e-300);
    const shear = Math.max(friction, 1e-9) * most;
    const py = (value, size) => low - Math.max(-1.1, Math.min(1.1, value / size)) * (low - high) * 0.5 - (low - high) * 0.45;
    const curve = (values, size, colour, dash = []) => {
      g.strokeStyle = colour;
      g.lineWidth = 1.75;
      g.setLineDash(dash);
      g.beginPath();
      let on = false;
      for (let k = 1 - fields.r.length * 2; k < fields.r.length * 2; k += 2) {
        const n = (Math.abs(k) - 1) / 2;
        const [x, y] = [px(Math.sign(k) * fields.r[n]), py(values[n], size)];
        if (on) g.lineTo(x, y);
        else g.moveTo(x, y);
        on = Number.isFinite(y);
      }
      g.stroke();
      g.setLineDash([]);
    };
    g.strokeStyle = palette.grid;
    g.beginPath();
    g.moveTo(0, py(0, 1));
    g.lineTo(width, py(0, 1));
    g.stroke();
    const limit = fields.p.map((p) => p * friction);
    curve(limit, shear, palette.faint, [4, 3]);
    curve(limit.map((value) => -value), shear, palette.faint, [4, 3]);
    curve(fields.tau, shear, palette.series[1]);
    g.textAlign = 'left';
    g.fillStyle = palette.series[1];
    g.fillText(`shear stress τ, at most ${words(greatest(fields.tau), 'Pa', 3)}`, 8, height - 4);
    g.fillStyle = palette.text;
    g.textAlign = 'right';
    g.fillText(`- - ±μp, p ≤ ${words(most, 'Pa', 3)}`, width - 8, height - 4);
  });
}

/** The memory curve: rest positions p - u of the springs over the indentation h at which they touch. */
export function drawMemory(canvas, inside) {
  paint(canvas, (g, width, height) => {
    const palette = colours();
    g.fillStyle = palette.text;
    if (!inside || !inside.knots.h.length || !(inside.d > 0)) {
      g.textAlign = 'center';
      g.fillText(inside && inside.d > 0 ? 'A row of springs has no memory curve.' : 'open contact', width / 2, height / 2);
      return;
    }
    const { d, u, knots, kappa } = inside;
    const most = kappa * d || greatest(knots.p.map((p) => p - u)) || 1e-12;
    const px = (h) => 46 + (h / d) * (width - 60);
    const py = (p) => height / 2 - (p / most) * (height / 2 - 26);
    g.strokeStyle = palette.grid;
    g.strokeRect(46, 8, width - 60, height - 34);
    g.setLineDash([4, 3]);
    g.strokeStyle = palette.faint;
    for (const side of [-1, 1]) {
      g.beginPath();
      g.moveTo(px(0), py(side * most));
      g.lineTo(px(d), py(0));
      g.stroke();
    }
    g.setLineDash([]);
    g.strokeStyle = palette.series[0];
    g.lineWidth = 2;
    g.beginPath();
    knots.h.forEach((h, k) => (k ? g.lineTo(px(h), py(knots.p[k] - u)) : g.moveTo(px(h), py(knots.p[k] - u))));
    g.stroke();
    g.fillStyle = palette.text;
    g.textAlign = 'center';
    g.fillText(`h, indentation at which a spring touches, up to d = ${words(d, 'm', 3)}`, width / 2, height - 8);
    g.save();
    g.translate(14, height / 2);
    g.rotate(-Math.PI / 2);
    g.fillText(`p − u, within ±${words(most, 'm', 3)}`, 0, 0);
    g.restore();
  });
}

/** States of the springs of a contact over time: a picture with one column per snapshot. */
export function drawStates(canvas, states, share) {
  paint(canvas, (g, width, height) => {
    if (!states?.length || !states[0].length) return;
    const palette = colours();
    const rows = states[0].length;
    const picture = new OffscreenCanvas(states.length, rows);
    const inner = picture.getContext('2d');
    states.forEach((column, k) => {
      let from = 0;
      for (let i = 1; i <= rows; i += 1) {
        if (i < rows && column[i] === column[from]) continue;
        if (column[from]) {
          inner.fillStyle = palette.states[column[from]];
          inner.fillRect(k, from, 1, i - from);
        }
        from = i;
      }
    });
    g.imageSmoothingEnabled = false;
    g.drawImage(picture, 0, 0, width, height);
    if (share !== undefined) {
      g.fillStyle = palette.text;
      g.fillRect(share * width - 1, 0, 2, height);
    }
  });
}
