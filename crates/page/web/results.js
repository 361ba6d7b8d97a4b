// Results of a run with their errors and meanings, and why the contacts slipped.

import { plain, unitOf, words } from './units.js';

/** Parts of the summary that are not results. */
const BESIDE = ['title', 'program', 'scenario_sha256', 'stepper', 'timing', 'files', 'tables', 'status', 'legend', 'counts'];

/** Errors stand beside the number they belong to. */
const ERROR = /_(error|uncertainty|bound)(?=_|$)/;

export function results(place, summary, about) {
  const rows = [];
  const sentences = [];
  const put = (path, here) => {
    for (const [key, value] of Object.entries(here)) {
      const way = [...path, key];
      if (path.length === 0 && BESIDE.includes(key)) continue;
      if (typeof value === 'number') {
        if (!ERROR.test(key) && !(/^error_/.test(key) && path.at(-1) !== 'energy')) {
          const unit = unitOf(key);
          const stem = key.slice(0, key.length - (unit ? /_(m_s2|m_s|rad_s|N_m|rad|Pa|Hz|[msNJWVA])$/.exec(key)[0].length : 0));
          const first = Object.entries(here).find(([other, size]) => typeof size === 'number' && unitOf(other) === unit && !ERROR.test(`_${other}`))?.[0] === key;
          const error = Object.entries(here).find(([other, size]) => typeof size === 'number' && unitOf(other) === unit && ((ERROR.test(other) && other.startsWith(`${stem}_`)) || (first && /^error(_|$)/.test(other))));
          rows.push({ way, value: words(value, unit), error: error ? `± ${words(error[1], unitOf(error[0]), 2)}` : '' });
        }
      } else if (typeof value === 'string') {
        if (/ /.test(value) && path.length === 0) sentences.push([way, value]);
        else if (/ /.test(value)) rows.push({ way, sentence: value });
        else rows.push({ way, value, error: '' });
      } else if (Array.isArray(value)) {
        if (value.length && value.every((it) => typeof it === 'string')) value.forEach((it) => sentences.push([way, it]));
        else if (value.length && value.length <= 3 && value.every((it) => typeof it === 'number')) rows.push({ way, value: value.map((it) => words(it, unitOf(key))).join(' … '), error: '' });
        else if (value.length <= 12) value.forEach((it, k) => it && typeof it === 'object' && put([...way, k], it));
      } else if (value && typeof value === 'object') {
        put(way, value);
      }
    }
  };
  put([], summary);
  const meaning = (way) => {
    const names = way.filter((key) => typeof key === 'string');
    for (let from = 0; from < names.length; from += 1) {
      const found = about.words[names.slice(from).join('.')];
      if (found) return found;
    }
    return '';
  };
  const groups = new Map();
  for (const row of rows) {
    const group = row.way.slice(0, 2).filter((_, k) => k < row.way.length - 1).join(' · ').replaceAll('_', ' ') || 'run';
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push(row);
  }
  const open = new Set([...place.querySelectorAll('details[open]')].map((it) => it.dataset.group));
  const known = place.querySelector('details');
  const tables = [...groups].map(([group, members]) => {
    const table = document.createElement('table');
    let before = '';
    for (const { way, value, error, sentence } of members) {
      const inner = way.slice(2, -1).map((key) => plain(String(key))).join(' · ');
      if (inner !== before) {
        table.insertRow().append(Object.assign(document.createElement('th'), { colSpan: 3, textContent: inner }));
        before = inner;
      }
      const row = table.insertRow();
      row.title = meaning(way);
      if (sentence) {
        row.append(Object.assign(document.createElement('td'), { colSpan: 3, className: 'sentence', textContent: sentence }));
        continue;
      }
      row.insertCell().textContent = plain(String(way.at(-1)));
      row.insertCell().textContent = value;
      row.insertCell().textContent = error;
    }
    const details = document.createElement('details');
    details.append(Object.assign(document.createElement('summary'), { textContent: group }), table);
    details.open = known ? open.has(group) : /steady|^run$|^steps$/.test(group);
    details.dataset.group = group;
    return details;
  });
  // Without a clock there is no speed of the computation.
  const text = sentences.filter(([, sentence]) => !sentence.includes('timing.')).map(([way, sentence]) => {
    const line = document.createElement('p');
    line.textContent = `${way.filter((key) => key !== 'text').map((key) => plain(String(key))).join(' · ')}: ${sentence}`;
    return line;
  });
  place.replaceChildren(...text, ...tables);
}
