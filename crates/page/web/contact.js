// Section 4.4 of the Handbook of Contact Mechanics to play with: one contact, pressed and sheared by hand.

import { Host } from './host.js';
import { drawSprings, read } from './inside.js';
import { Plot } from './plots.js';
import { colours, paint } from './theme.js';
import { words } from './units.js';

/** Profiles with their numbers (name, unit, smallest, largest, first) and f(r). */
const PROFILES = {
  paraboloid: { numbers: { radius: ['m', 1e-4, 1e-1, 1e-3] }, f: (r, { radius }) => r * r / (2 * radius) },
  cone: { numbers: { slope: ['', 1e-3, 0.3, 0.02] }, f: (r, { slope }) => slope * r },
  flat: { numbers: { radius: ['m', 1e-6, 1e-3, 3e-5] }, f: (r, { radius }) => (r < radius ? 0 : NaN) },
  sphere: { numbers: { radius: ['m', 1e-4, 1e-1, 1e-3] }, f: (r, { radius }) => (r < radius ? radius - Math.sqrt(radius * radius - r * r) : NaN) },
  truncated_cone: { numbers: { flat: ['m', 1e-6, 1e-4, 2e-5], slope: ['', 1e-3, 0.3, 0.02] }, f: (r, { flat, slope }) => Math.max(0, r - flat) * slope },
  truncated_paraboloid: { numbers: { flat: ['m', 1e-6, 1e-4, 2e-5], radius: ['m', 1e-4, 1e-1, 1e-3] }, f: (r, { flat, radius }) => Math.max(0, r * r - flat * flat) / (2 * radius) },
};
const COMMON = { 'largest d': ['m', 1e-8, 1e-5, 1e-6], E: ['Pa', 1e9, 1e12, 2.1e11], ν: ['', 0, 0.49, 0.3], μ: ['', 0.02, 1, 0.3] };

const element = (name, attributes = {}, ...inner) => {
  const made = Object.assign(document.createElement(name), attributes);
  made.append(...inner);
  return made;
};

export function contactPage(place, fail) {
  const now = { profile: 'paraboloid', values: Object.fromEntries(Object.entries(COMMON).map(([name, it]) => [name, it[3]])), d: 0, u: 0 };
  let host;
  let sheet;
  let way = [];
  let parts;

  const head = (text, id, tall) => element('div', { className: 'picture' }, element('h2', { textContent: text }), element(tall ? 'div' : 'canvas', tall ? { id, className: 'plot' } : { id }));

  function build() {
    const pad = element('canvas', { id: 'pad', tabIndex: 0 });
    pad.setAttribute('role', 'application');
    pad.setAttribute('aria-label', 'Press and shear the contact: arrow keys change d and u');
    const select = element('select', { ariaLabel: 'Profile' }, ...Object.keys(PROFILES).map((name) => new Option(name.replaceAll('_', ' '), name)));
    select.onchange = () => {
      now.profile = select.value;
      knobs();
      hold(null);
    };
    select.value = now.profile;
    const clear = element('button', { textContent: 'Untouched again', onclick: () => hold([0, 0]) });
    const loop = element('button', { textContent: 'Press and oscillate', onclick: () => oscillate() });
    parts = {
      pad, knobs: element('div'), moves: element('div'), equations: element('table', { className: 'equations' }),
    };
    const left = element('section', { className: 'column' },
      element('div', { className: 'picture' }, element('h2', { textContent: 'Drag: d downwards, u sideways' }), pad),
      element('div', { className: 'row' }, clear, loop),
      element('div', { className: 'picture' }, parts.moves),
      element('div', { className: 'picture' }, element('label', {}, 'Profile ', select), parts.knobs),
      element('div', { className: 'picture' }, element('h2', { textContent: 'Equations' }), parts.equations));
    const right = element('section', { className: 'column' },
      head('Row of springs, pressed and sheared (Figure 4.2); p and τ', 'row44'),
      head('Profile f(r) and its one-dimensional image g(x)', 'profile44'),
      head('Tangential force over displacement', 'loop44', true),
      head('Surface displacement u(r)', 'surface44'));
    place.replaceChildren(left, right);
    right.querySelector('#row44').style.height = '260px';
    parts.row = right.querySelector('#row44');
    parts.row.after(document.querySelector('#drive .legend').cloneNode(true));
    parts.profile = right.querySelector('#profile44');
    parts.surface = right.querySelector('#surface44');
    parts.loop = new Plot(right.querySelector('#loop44'), { way: true, label: '' });
    const drag = (event) => {
      const box = pad.getBoundingClientRect();
      const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
      move(Math.min(1, y * 1.3 - 0.15) * now.values['largest d'], (2 * x - 1) * reach());
    };
    pad.onpointerdown = (event) => {
      pad.setPointerCapture(event.pointerId);
      drag(event);
    };
    pad.onpointermove = (event) => { if (event.buttons) event.getCoalescedEvents?.().length ? event.getCoalescedEvents().forEach(drag) : drag(event); };
    pad.onkeydown = (event) => {
      const [dd, du] = { ArrowDown: [1, 0], ArrowUp: [-1, 0], ArrowRight: [0, 1], ArrowLeft: [0, -1] }[event.key] ?? [0, 0];
      if (!dd && !du) return;
      event.preventDefault();
      move(Math.min(now.values['largest d'], now.d + dd * now.values['largest d'] / 25), now.u + du * reach() / 40);
    };
    knobs();
  }

  /** Largest displacement of the pad: 1.5 times that at which the contact slips. */
  const reach = () => 1.5 * (sheet?.pressed.gross_slip_displacement_m || now.values['largest d']);

  function slider(name, [unit, low, high], value, changed) {
    const log = low > 0 && high / low > 20;
    const to = (x) => (log ? low * (high / low) ** x : low + (high - low) * x);
    const from = (v) => (log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
    const range = element('input', { type: 'range', min: 0, max: 1, step: 0.001, value: from(value), ariaLabel: name });
    const told = element('output', { textContent: words(value, unit) });
    range.oninput = () => {
      const chosen = +to(+range.value).toPrecision(3);
      told.textContent = words(chosen, unit);
      changed(chosen);
    };
    return element('label', { className: 'slider' }, element('span', { textContent: name }), range, told);
  }

  function knobs() {
    const { numbers } = PROFILES[now.profile];
    for (const [name, it] of Object.entries(numbers)) now.values[name] ??= it[3];
    const all = { ...numbers, ...COMMON };
    parts.knobs.replaceChildren(...Object.entries(all).map(([name, it]) => slider(name, it, now.values[name], (value) => {
      now.values[name] = value;
      hold(name === 'largest d' ? null : [Math.min(now.d, now.values['largest d']), now.u]);
    })));
  }

  function moves() {
    const most = now.values['largest d'];
    parts.moves.replaceChildren(
      slider('d', ['m', 0, most], Math.max(0, now.d), (d) => move(d, now.u, true)),
      slider('u', ['m', -reach(), reach()], now.u, (u) => move(now.d, u, true)));
  }

  let holding = false;
  let stale = false;

  /** Makes the contact anew, untouched, and moves it: to a point, or by default to half of gross slip. */
  async function hold(to) {
    if (holding) {
      stale = true;
      return;
    }
    holding = true;
    const { values } = now;
    const { numbers } = PROFILES[now.profile];
    const profile = { [now.profile]: Object.fromEntries(Object.keys(numbers).map((name) => [name, values[name]])) };
    const material = { youngs_modulus: values.E, poisson_ratio: values.ν };
    const scenario = {
      stickslip: 1, title: 'Contact', materials: { indenter: material, base: material },
      bodies: { base: { x: 'fixed' }, indenter: { x: 'fixed' } },
      contacts: { contact: { between: ['base', 'indenter'], materials: ['base', 'indenter'], profile, friction: values.μ, normal: { indentation: values['largest d'] } } },
      run: { duration: 1 },
    };
    const loaded = await host.call('load', { text: JSON.stringify(scenario) });
    const held = loaded.error ? loaded : await host.call('hold', { contact: 0, d: values['largest d'] });
    holding = false;
    fail(held.error ?? '');
    if (stale) {
      stale = false;
      hold(to);
      return;
    }
    if (held.error) return;
    sheet = JSON.parse(held.text);
    way = [[0, 0, 0, 0, 0]];
    Object.assign(now, { d: 0, u: 0 });
    const [d, u] = to ?? [values['largest d'], 0.5 * sheet.pressed.gross_slip_displacement_m];
    await move(d, 0);
    await move(d, u);
  }

  let pressing = false;
  let points = [];

  /** Moves on a straight path, in pieces so that the loop shows what happens on the way. */
  async function move(d, u, keeps) {
    const pieces = Math.max(1, Math.ceil(60 * Math.max(Math.abs(d - now.d) / now.values['largest d'], Math.abs(u - now.u) / reach())));
    for (let k = 1; k <= pieces; k += 1) points.push([now.d + (d - now.d) * k / pieces, now.u + (u - now.u) * k / pieces]);
    Object.assign(now, { d, u });
    if (pressing) return;
    pressing = true;
    while (points.length) {
      const sent = points;
      points = [];
      const answer = await host.call('press', { points: sent });
      if (answer.error || answer.stale) {
        fail(answer.error ?? '');
        break;
      }
      fail('');
      way.push(...answer.way);
      if (way.length > 20_000) way.splice(0, 5000);
      parts.inside = read(answer.inside);
      redraw();
    }
    pressing = false;
    if (!keeps) moves();
  }

  /** Two cycles of u at the largest indentation. */
  async function oscillate() {
    const most = now.values['largest d'];
    const amplitude = 0.75 * sheet.pressed.gross_slip_displacement_m;
    await move(-0.1 * most, now.u);
    await move(-0.1 * most, 0);
    way = way.slice(-1);
    await move(most, 0);
    for (let k = 1; k <= 200; k += 1) {
      await move(most, amplitude * Math.sin(2 * Math.PI * k / 100));
      await new Promise(requestAnimationFrame);
    }
  }

  function redraw() {
    const { inside } = parts ?? {};
    if (!inside || place.hidden) return;
    drawSprings(parts.row, inside);
    drawPad();
    drawProfile(inside);
    drawSurface(inside);
    const column = (k) => Float64Array.from(way, (it) => it[k]);
    parts.loop.show({ x: { name: 'u', unit: 'm', values: column(1) }, ys: [{ name: 'F_x', unit: 'N', values: column(3) }] });
    parts.loop.to(way.length - 1);
    equations(inside);
  }

  function drawPad() {
    paint(parts.pad, (g, width, height) => {
      const palette = colours();
      const most = now.values['largest d'];
      const [px, py] = [(u) => (u / reach() + 1) / 2 * width, (d) => (d / most + 0.15) / 1.3 * height];
      // Where an untouched contact slips: |u| = κd.
      g.fillStyle = palette.grid;
      const slip = sheet.pressed.gross_slip_displacement_m;
      g.beginPath();
      g.moveTo(px(0), py(0));
      g.lineTo(px(slip), py(most));
      g.lineTo(px(-slip), py(most));
      g.fill();
      g.strokeStyle = palette.faint;
      g.beginPath();
      g.moveTo(0, py(0));
      g.lineTo(width, py(0));
      g.moveTo(px(0), 0);
      g.lineTo(px(0), height);
      g.stroke();
      g.strokeStyle = palette.series[0];
      g.lineWidth = 1.5;
      g.beginPath();
      way.forEach(([d, u], k) => (k ? g.lineTo(px(u), py(d)) : g.moveTo(px(u), py(d))));
      g.stroke();
      g.fillStyle = palette.series[4];
      g.beginPath();
      g.arc(px(now.u), py(now.d), 6, 0, 7);
      g.fill();
      g.fillStyle = palette.text;
      g.textAlign = 'left';
      g.fillText('open', 6, py(0) - 5);
      g.fillText(`d = ${words(most, 'm', 3)}`, 6, py(most) - 4);
      g.textAlign = 'right';
      g.fillText(`u = ${words(reach(), 'm', 3)}`, width - 6, py(0) - 5);
      g.textAlign = 'center';
      g.fillText('|u| < κd', width / 2, py(0.55 * most));
    });
  }

  /** Curves over the diameter, from their values on one side. `low` and `most` are the ends of the scale. */
  function curves(canvas, list, span, [low, most], tell) {
    paint(canvas, (g, width, height) => {
      const palette = colours();
      const [px, py] = [(x) => width / 2 + x / span * (width / 2 - 10), (y) => height - 14 - (y - low) / (most - low) * (height - 50)];
      g.strokeStyle = palette.grid;
      g.beginPath();
      g.moveTo(0, py(0));
      g.lineTo(width, py(0));
      g.moveTo(width / 2, 0);
      g.lineTo(width / 2, height);
      g.stroke();
      list.forEach(({ points: of, colour, name, dash }, n) => {
        g.strokeStyle = palette.series[colour];
        g.setLineDash(dash ?? []);
        g.lineWidth = 2;
        g.beginPath();
        const whole = [...of.map(([x, y]) => [-x, y]).reverse(), ...of];
        whole.forEach(([x, y], k) => (k ? g.lineTo(px(x), py(y)) : g.moveTo(px(x), py(y))));
        g.stroke();
        g.setLineDash([]);
        g.fillStyle = palette.series[colour];
        g.textAlign = 'left';
        g.fillText(name, 8, 16 + 16 * n);
      });
      tell(g, palette, px, py, width, height);
    });
  }

  function drawProfile(inside) {
    const { f } = PROFILES[now.profile];
    const span = 1.25 * sheet.pressed.contact_radius_m;
    const most = Math.max(now.values['largest d'] * 1.2, 1e-30);
    const steps = Array.from({ length: 81 }, (_, k) => span * k / 80);
    const of = (points) => points.filter(([, y]) => Number.isFinite(y) && y <= most * 1.3);
    const g = sheet.normal.map((row) => [row.contact_radius_m, row.indentation_m]);
    if (now.profile === 'flat') g.splice(0, g.length, [0, 0], [now.values.radius, 0], [now.values.radius, most]);
    curves(parts.profile, [
      { points: of(steps.map((r) => [r, f(r, now.values)])), colour: 0, name: `f(r) = ${sheet.constants.f ?? ''}` },
      { points: of(g), colour: 1, name: `g(x) = ${sheet.constants.g ?? ''}` },
    ], span, [0, most], (c, palette, px, py, width) => {
      if (!(inside.d > 0)) return;
      c.strokeStyle = palette.text;
      c.setLineDash([3, 3]);
      c.beginPath();
      c.moveTo(px(-inside.a), py(inside.d));
      c.lineTo(px(inside.a), py(inside.d));
      c.lineTo(px(inside.a), py(0));
      c.stroke();
      c.setLineDash([]);
      c.fillStyle = palette.text;
      c.textAlign = 'right';
      c.fillText(`g(a) = d at a = ${words(inside.a, 'm', 3)}`, width - 8, 16);
    });
  }

  function drawSurface({ fields, u }) {
    const points = [...fields.r].map((r, k) => [r, fields.u[k]]).filter(([, y]) => Number.isFinite(y));
    const values = points.map(([, y]) => y).concat(0, u);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const edge = 0.08 * (high - low) || 1e-30;
    const name = `u(r) of the surfaces, in the centre ${words(points[0]?.[1] ?? 0, 'm', 3)}`;
    curves(parts.surface, [{ points, colour: 3, name }], points.at(-1)?.[0] || 1, [low - edge, high + edge], () => {});
  }

  function equations(inside) {
    const { constants, pressed } = sheet;
    const { μ } = now.values;
    const limit = μ * inside.normal;
    const slip = constants.stick_slope * Math.max(0, inside.d);
    const peak = [...inside.fields.tau].filter(Number.isFinite).reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    const share = (value, whole) => (whole > 0 ? words(value / whole, '', 4) : '–');
    const rows = [
      ['(4.13)', '1/E* = (1−ν₁²)/E₁ + (1−ν₂²)/E₂', `E* = ${words(constants.normal_modulus_Pa, 'Pa')}`],
      ['(4.13)', '1/G* = (2−ν₁)/(4G₁) + (2−ν₂)/(4G₂)', `G* = ${words(constants.tangential_modulus_Pa, 'Pa')}`],
      ['(4.20)', `g(x) = |x| ∫₀^|x| f′(r)/√(x²−r²) dr = ${constants.g ?? ''}`, `g(a) = ${words(Math.max(0, inside.d), 'm')}`],
      ['(4.26)', 'g(a) = d', `a = ${words(inside.a, 'm')}`],
      ['(4.26)', 'F_N = 2E* ∫₀^a (d − g) dx', `F_N = ${words(inside.normal, 'N')}`],
      ['(4.22)', 'a spring sticks while |G* Δx (u − p)| < μE* Δx (d − g)', `${inside.springs.state.filter((state) => state === 1).length} of ${inside.springs.state.filter((state) => state > 0).length} stick`],
      ['(4.28)', 'u_c = κd, κ = μE*/G*', `u_c = ${words(slip, 'm')}`],
      ['(4.27)', 'stick radius c; in a first loading u = κ[d − g(c)]', `c = ${words(inside.c, 'm')}`],
      ['(4.38)', 'F_x = μ[F_N(a) − F_N(c)] in a first loading; in general Σ over the springs', `F_x = ${words(inside.force, 'N')}`],
      ['(4.37)', 'F_x/(μF_N) over u/u_c', `${share(inside.force, limit)} at ${share(inside.u, slip)}`],
      ['(4.25)', 'p(r), τ(r) from the line loads', `p(0) = ${now.profile === 'cone' && inside.d > 0 ? '∞' : words(inside.fields.p[0] ?? 0, 'Pa', 3)}, τ ≤ ${words(peak, 'Pa', 3)}`],
      ['(4.40)', 'W = ∫ friction · slip over all springs and the whole history', `W = ${words(inside.work, 'J')}`],
    ];
    parts.equations.replaceChildren(...rows.map((row) => element('tr', {}, ...row.map((text) => element('td', { textContent: text })))));
    parts.equations.title = pressed ? constants.similarity : '';
  }

  return {
    /** What a link contains. */
    state: () => ({ profile: now.profile, values: now.values, to: [now.d, now.u] }),
    take({ profile, values, to }) {
      if (!(profile in PROFILES)) throw new Error('The link names an unknown profile.');
      Object.assign(now, { profile, to: to.map(Number) });
      for (const [name, value] of Object.entries(values)) if (Number.isFinite(value)) now.values[name] = value;
    },
    title: () => `${now.profile.replaceAll('_', ' ')}: d = ${words(now.d, 'm', 3)}, u = ${words(now.u, 'm', 3)}, E = ${words(now.values.E, 'Pa', 3)}, μ = ${now.values.μ}`,
    async open() {
      if (!parts) {
        build();
        host = new Host();
        await hold(now.to);
      }
      redraw();
    },
    redraw() {
      parts?.loop.restyle();
      redraw();
    },
  };
}
