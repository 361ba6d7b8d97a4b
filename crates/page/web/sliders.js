// A slider and a field for every number of the scenario, grouped by what they belong to.

import { field, words } from './units.js';

/** Number of positions of a slider. */
const FINE = 1000;

/** The place of a path such as `loads[0].x` in an object. */
export function steps(path) {
  return [...path.matchAll(/\["((?:[^"\\]|\\.)*)"\]|\[(\d+)\]|([^.[\]]+)/g)].map(([, quoted, index, key]) => (quoted !== undefined ? JSON.parse(`"${quoted}"`) : index !== undefined ? +index : key));
}

export function set(tree, path, value) {
  const way = steps(path);
  const last = way.pop();
  way.reduce((here, key) => (here[key] ??= {}), tree)[last] = value;
}

/** From a position of the slider to a value and back: by ratio where the value has a size, straight where the schema has both ends. */
function course({ value, range: [low, high] }) {
  if (value === 0 || (low !== null && high !== null && high / (low || 1e-9) < 50)) {
    const from = low ?? -(high ?? 1);
    const to = high ?? 1;
    if (value === 0 && (low === null || high === null)) return null;
    return { to: (x) => from + (to - from) * x, from: (v) => (v - from) / (to - from) };
  }
  const sense = Math.sign(value);
  const size = Math.abs(value);
  const [least, most] = sense > 0 ? [low, high] : [high, low];
  let from = size / 5;
  let to = size * 5;
  if (most !== null && Math.abs(most) < to) to = Math.abs(most);
  if (least !== null && Math.abs(least) > from && Math.sign(least) === sense) from = Math.abs(least);
  if (!(to > from)) return null;
  const ratio = Math.log(to / from);
  return { to: (x) => sense * +(from * Math.exp(ratio * x)).toPrecision(4), from: (v) => Math.log(Math.abs(v) / from) / ratio };
}

const element = (name, attributes = {}, ...inner) => {
  const made = Object.assign(document.createElement(name), attributes);
  made.append(...inner);
  return made;
};

/**
 * @param {HTMLElement} place
 * @param {object} about what the engine says of the scenario
 * @param {(path: string, value: number) => void} change
 * @param {(path: string, value: number | string, field: HTMLElement) => void} type a value is typed
 */
export function sliders(place, about, change, type) {
  const groups = new Map();
  for (const number of about.numbers) {
    const way = steps(number.path);
    const group = way[0] === 'loads' ? 'loads' : way.slice(0, 2).join(' · ');
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push([number, way]);
  }
  const order = (name) => ['waveforms', 'contacts', 'loads', 'bodies', 'springs', 'stacks'].findIndex((head) => name.startsWith(head)) + 1 || 9;
  const open = new Set([...place.querySelectorAll('details[open]')].map((it) => it.dataset.group));
  const parts = [...groups].sort(([a], [b]) => order(a) - order(b)).map(([group, numbers], index) => {
    const rows = numbers.map(([number, way]) => {
      const name = (way[0] === 'loads' ? way.slice(1) : way.slice(2)).join(' ').replaceAll('_', ' ');
      const path = course(number);
      const text = element('input', { type: 'text', value: field(number.value, number.unit), spellcheck: false, ariaLabel: `${number.path}, value` });
      const range = element('input', { type: 'range', min: 0, max: FINE, step: 1, ariaLabel: number.path, title: number.text });
      range.dataset.path = number.path;
      if (path) {
        range.value = Math.round(FINE * path.from(number.value));
        range.setAttribute('aria-valuetext', words(number.value, number.unit));
        range.oninput = () => {
          const value = path.to(range.value / FINE);
          text.value = field(value, number.unit);
          range.setAttribute('aria-valuetext', text.value);
          change(number.path, value);
        };
      } else {
        range.disabled = true;
      }
      // A number without a unit has the unit that stood in the field.
      const unit = text.value.replace(/^[-+0-9.e]+/, '').trim();
      text.onchange = () => {
        const written = text.value.trim();
        const bare = written !== '' && Number.isFinite(+written);
        type(number.path, bare && !unit ? +written : bare ? `${written} ${unit}` : written, text);
      };
      return element('label', { className: 'slider', title: number.text }, element('span', { textContent: name }), range, text);
    });
    const details = element('details', { open: open.size ? open.has(group) : index < 2 }, element('summary', { textContent: group }), ...rows);
    details.dataset.group = group;
    return details;
  });
  // Who types goes on where they are.
  const { activeElement } = document;
  const label = place.contains(activeElement) ? activeElement.ariaLabel : null;
  place.replaceChildren(...parts);
  if (label) [...place.querySelectorAll('input')].find((it) => it.ariaLabel === label)?.focus();
}
