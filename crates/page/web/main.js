// The page: a scenario, its run, and what moves.

import { contactPage } from './contact.js';
import { Host, unpacked } from './host.js';
import { drawMemory, drawSprings, drawStates, read } from './inside.js';
import { pack, unpack } from './link.js';
import { picture } from './picture.js';
import { Plot } from './plots.js';
import { results } from './results.js';
import { Scene } from './scene.js';
import { set, sliders } from './sliders.js';
import { dark } from './theme.js';
import { Timeline } from './timeline.js';
import { plain, unitOf, words } from './units.js';

/** Number of snapshots of the slip memories in a run. */
const SNAPSHOTS = 600;
/** Rows above which the page asks for fewer. */
const MOST_ROWS = 200_000;
/** Time for which an unfinished run is left alone before a newer one takes its place, ms. */
const PATIENCE = 120;

const $ = (id) => document.getElementById(id);
const scenes = JSON.parse($('scenes').textContent);
const meanings = unpacked('words').json();
const page = { tree: null, about: null, columns: null, rows: 0, t: 0, playing: false, contact: 0, original: null };

let busy = 0;
const host = new Host((part) => { $('progress').value = part; });

// What is said to the user.

function fail(text) {
  $('error').textContent = text;
  $('error').hidden = !text;
  if (text) {
    document.documentElement.dataset.error = text;
    document.documentElement.dataset.drawn ??= Math.round(performance.now());
  } else {
    delete document.documentElement.dataset.error;
  }
}

function note(text) {
  $('note').textContent = text;
  $('note').hidden = !text;
}

function watch(promise) {
  const begun = performance.now();
  const mine = ++busy;
  const timer = setInterval(() => {
    if (mine !== busy) return;
    $('busy').hidden = false;
    $('elapsed').textContent = `${((performance.now() - begun) / 1000).toFixed(0)} s`;
  }, 300);
  return promise.finally(() => {
    clearInterval(timer);
    if (mine === busy) {
      $('busy').hidden = true;
      $('progress').removeAttribute('value');
    }
  });
}

$('cancel').onclick = async () => {
  host.restart();
  // The last finished run is made anew, for the new engine knows nothing of it.
  if (page.text) await take(page.text, page.original);
  note('Cancelled. This is the last finished run.');
};

// A run.

let since = 0;
let flying = 0;
let next = false;

/** Runs the present scenario; the newest request wins. */
function run() {
  if (flying && performance.now() - since < PATIENCE) {
    next = true;
    return;
  }
  next = false;
  since = performance.now();
  const mine = ++flying;
  launch().finally(() => {
    if (mine === flying) flying = 0;
    if (next) run();
  });
  setTimeout(() => next && run(), PATIENCE + 1);
}

/** The text of a scenario with fewer rows if it asks for very many, and a remark about that. */
function thinned(tree) {
  const { duration, cycles } = tree.run ?? {};
  const [span, every] = [duration ?? cycles * slowest(tree), tree.output?.every];
  if (!(typeof span === 'number' && typeof every === 'number' && span / every > MOST_ROWS)) return [JSON.stringify(tree, null, 1), ''];
  const fewer = span / 20_000;
  const remark = `Rows every ${words(fewer, 's')} instead of ${words(every, 's')}: the scenario asks for more than ${MOST_ROWS.toLocaleString('en')} rows. The motion is the same.`;
  return [JSON.stringify({ ...tree, output: { ...tree.output, every: fewer } }, null, 1), remark];
}

async function launch(fresh = false) {
  stopLive();
  const [text, remark] = thinned(page.tree);
  const answer = await watch(host.call('run', { text, snapshots: SNAPSHOTS }));
  if (answer.stale) return;
  fail(answer.error ?? '');
  if (answer.error) return;
  note(remark);
  page.text = text;
  page.columns = answer.columns;
  page.rows = answer.columns.time_s.length;
  page.duration = page.columns.time_s[page.rows - 1] || 1;
  page.summary = answer.summary;
  page.time = answer.time;
  if (fresh) begin();
  show(answer);
}

/** A new scenario: lists, sliders and names. */
function begin() {
  const { about } = page;
  document.title = `${about.title} · stickslip`;
  view();
  const shown = Math.min(page.contact, about.contacts.length - 1);
  page.contact = Math.max(0, shown);
  $('contact').replaceChildren(...about.contacts.map((name, k) => new Option(name, k, k === page.contact, k === page.contact)));
  const choices = about.contacts.flatMap((name) => [['u_m', 'fx_N'], ['d_m', 'fn_N']].map((pair) => pair.map((end) => `${name}.${end}`)).filter((pair) => pair.every((it) => it in page.columns)));
  const bodies = Object.keys(about.scenario.bodies ?? {}).flatMap((body) => ['x', 'z'].map((axis) => [`${body}.${axis}_m`, `${body}.v${axis}_m_s`]).filter((pair) => pair.every((name) => name in page.columns)));
  page.pairs = [...choices, ...bodies];
  $('axes').replaceChildren(...page.pairs.map(([x, y], k) => new Option(`${plain(y)} over ${plain(x)}`, k)));
  page.pair = page.pairs[0];
  scene.load(about);
  const hasFree = scene.bodies.some((body) => about.scenario.bodies[body].x === 'free');
  $('hint').textContent = `${hasFree ? 'Drag a free body to push it by hand. ' : ''}${about.contacts.length > 1 ? 'Click a contact to look inside.' : ''}`;
  sliders($('sliders'), about, change, type);
}

function change(path, value) {
  set(page.tree, path, value);
  run();
}

/** A typed value: refused beside its field, or the new middle of its slider. */
async function type(path, value, field) {
  const tree = structuredClone(page.tree);
  set(tree, path, value);
  const { original } = page;
  const refused = await take(JSON.stringify(tree, null, 1), original);
  field.setAttribute('aria-invalid', !!refused);
  field.title = refused ?? '';
}

const column = (name) => ({ name: plain(name), unit: unitOf(name), values: page.columns[name] });

/** Columns over time: displacements of bodies that move, or the heights, or whatever there is. */
function curves() {
  const names = scene.bodies.map((body) => `${body}.x_m`).filter((name) => name in page.columns);
  const moving = names.filter((name) => page.columns[name].some((value) => value !== page.columns[name][0]));
  const used = moving.length ? moving : Object.keys(page.columns).filter((name) => name.endsWith('z_m')).slice(0, 2);
  return used.length ? used : Object.keys(page.columns).slice(1, 2);
}

function show({ events, summary }) {
  const begun = performance.now();
  scene.scale(page.columns);
  page.curves = curves();
  plots.staircase.show({ x: { ...column('time_s'), name: 'time' }, ys: page.curves.map(column) });
  if (page.pair) plots.loop.show({ x: column(page.pair[0]), ys: [column(page.pair[1])] });
  timeline.load(events, page.duration);
  const step = summary.steps?.steady?.step_m ?? summary.steps?.last_m;
  $('key').textContent = step === undefined ? '' : ` · step ${words(step, 'm')}`;
  const why = (summary.steps?.why ?? []).concat(summary.error ? [summary.error] : []);
  $('why').replaceChildren(...(why.length ? why : ['No drive periods are evaluated in this scenario.']).map((text) => Object.assign(document.createElement('p'), { textContent: text })));
  const rest = structuredClone(summary);
  if (rest.steps) delete rest.steps.why;
  results($('results'), rest, page.about);
  $('orbit').replaceChildren();
  $('sha').textContent = summary.scenario_sha256;
  $('hash').textContent = '';
  seek(Math.min(page.t, page.duration));
  document.documentElement.dataset.drawn ??= Math.round(performance.now());
  document.documentElement.dataset.runs = `${+(document.documentElement.dataset.runs ?? 0) + 1}`;
  page.shown = performance.now() - begun;
  clearTimeout(page.idle);
  page.idle = setTimeout(settle, 250);
}

/** What takes longer, once the numbers stay as they are. */
async function settle() {
  const hash = await host.call('hash');
  if (typeof hash === 'string') $('hash').textContent = hash;
  const { contact } = page;
  const found = page.about.contacts.length ? await host.call('states', { contact, count: SNAPSHOTS }) : {};
  if (found.states && contact === page.contact) {
    page.states = found.states;
    drawStates($('states'), page.states, page.t / page.duration);
  }
}

// The present moment.

function rowAt(t) {
  const times = page.columns.time_s;
  let [low, high] = [0, page.rows - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

let looking = false;
let again = false;

async function look() {
  if (!page.about?.contacts.length || live.on) return;
  if (looking) {
    again = true;
    return;
  }
  looking = true;
  const index = Math.round((page.t / page.duration) * (SNAPSHOTS - 1));
  const numbers = await host.call('inside', { contact: page.contact, index });
  looking = false;
  if (numbers instanceof Float64Array && !live.on) drawInside(read(numbers));
  if (again) {
    again = false;
    look();
  }
}

function drawInside(inside) {
  page.inside = inside;
  drawSprings($('springs'), inside);
  drawMemory($('memory'), inside);
}

function seek(t) {
  page.t = t;
  if (!page.columns) return;
  const row = rowAt(t);
  scene.draw((name) => page.columns[name]?.[row]);
  plots.staircase.to(row);
  if (page.pair) plots.loop.to(row);
  timeline.draw(t);
  if (page.states) drawStates($('states'), page.states, t / page.duration);
  $('now').textContent = words(t, 's', 5);
  look();
}

const scene = new Scene($('scene'));
const plots = {
  staircase: new Plot($('staircase'), { label: 'displacement', pick: (t) => seek(Math.max(0, Math.min(page.duration, t))) }),
  loop: new Plot($('loop'), { way: true, label: '' }),
};
const timeline = new Timeline($('timeline'), $('event'), (t) => seek(t), ({ t, source }) => {
  const at = (name, unit) => words(page.columns[`${source}.${name}`]?.[rowAt(t)] ?? NaN, unit, 3);
  return { u: at('u_m', 'm'), f: at('fx_N', 'N').replace('−', ''), n: at('fn_N', 'N') };
});

// Playing.

/** Simulated seconds per second. */
const SPEEDS = [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1];
$('speed').replaceChildren(...SPEEDS.map((speed) => new Option(speed === 1 ? 'real time' : `1 : ${1 / speed}`, speed, speed === 0.01, speed === 0.01)));
const rate = () => +$('speed').value;

function play(until = page.duration) {
  if (!page.columns) return;
  if (page.t >= until) page.t = 0;
  page.playing = true;
  $('play').textContent = '❚❚';
  $('play').setAttribute('aria-label', 'Pause');
  let last = performance.now();
  const mine = (page.play = (page.play ?? 0) + 1);
  page.frames = [];
  const frame = (now) => {
    if (!page.playing || mine !== page.play) return;
    page.frames.push(now);
    const t = page.t + (Math.max(0, now - last) / 1000) * rate();
    last = now;
    seek(Math.min(t, until));
    if (t >= until) pause();
    else requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

function pause() {
  page.playing = false;
  $('play').textContent = '▶';
  $('play').setAttribute('aria-label', 'Play');
}

/** The longest period of the waveforms that is below a time, s; NaN without one. */
function slowest(tree, below = Infinity) {
  const forms = Object.values(tree.waveforms ?? {}).flatMap((form) => Object.values(form));
  const known = forms.map((form) => form?.period ?? 1 / form?.frequency).filter((value) => typeof value === 'number' && value < below);
  return known.length ? Math.max(...known) : NaN;
}

/** Period of the drive, or a tenth of the run. */
const period = () => slowest(page.tree, page.duration) || page.duration / 10;

$('play').onclick = () => (page.playing ? pause() : play());
$('period').onclick = () => {
  const span = period();
  const from = page.t + span > page.duration * (1 + 1e-9) ? Math.max(0, page.duration - span) : page.t;
  seek(from);
  // About four seconds for a period.
  $('speed').value = SPEEDS.findLast((speed) => speed <= span / 4) ?? SPEEDS[0];
  play(Math.min(page.duration, from + span));
};

// A body pushed by hand: a run whose force is an input.

const live = { on: false, contact: 0 };

async function startLive(body, at) {
  pause();
  const tree = structuredClone(page.tree);
  const force = 1.5 * (scene.friction || scene.force);
  tree.waveforms = { ...tree.waveforms, hand: { input: { initial: 0, range: [-force, force], interpolation: 'linear' } } };
  tree.loads = [...(tree.loads ?? []), { on: body, x: { follows: 'hand' } }];
  fail('');
  page.states = null;
  drawStates($('states'), null);
  Object.assign(live, { on: true, body, from: at, to: at, force, t: 0, rows: [], names: null });
  note(`You push ${body} by hand, with at most ${words(force, 'N', 3)}. Let go and press Escape to come back to the run.`);
  const loaded = await host.call('load', { text: JSON.stringify(tree) });
  const begun = loaded.error ? loaded : await host.call('live');
  if (begun.error || begun.stale) {
    fail(begun.error ?? '');
    live.on = false;
    return;
  }
  live.input = begun.text.split('\n').indexOf('hand');
  let last = performance.now();
  const tick = async (now) => {
    if (!live.on) return;
    live.t += Math.max(1e-3, Math.min(0.05, (now - last) / 1000)) * rate();
    last = now;
    const pull = Math.max(-1, Math.min(1, (live.to[0] - live.from[0]) / 140)) * live.force;
    const answer = await host.call('step', { until: live.t, input: live.input, value: pull, contact: page.contact });
    if (!live.on) return;
    if (answer.error || answer.stale) {
      fail(answer.error ?? '');
      stopLive();
      return;
    }
    showLive(answer);
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

function showLive({ row, inside }) {
  const index = (name) => live.names.get(name);
  live.names ??= new Map(page.about.columns.map((name, k) => [name, k]));
  const value = (name) => (index(name) === undefined ? undefined : row[index(name)]);
  const pulled = Math.abs(live.to[0] - live.from[0]) > 2;
  scene.draw(value, pulled ? { from: live.from, to: live.to } : null);
  if (inside) drawInside(read(inside));
  live.rows.push(row);
  if (live.rows.length > 6000) live.rows.splice(0, 1000);
  if (live.rows.length % 6 === 0 && page.pair) {
    const of = (name) => ({ name: plain(name), unit: unitOf(name), values: Float64Array.from(live.rows, (it) => it[index(name)]) });
    plots.loop.still();
    plots.staircase.still();
    plots.loop.show({ x: of(page.pair[0]), ys: [of(page.pair[1])] });
    const time = { name: 'time', unit: 's', values: Float64Array.from(live.rows, (it) => it[0]) };
    plots.staircase.show({ x: time, ys: page.curves.map(of) });
  }
  $('now').textContent = words(live.t, 's', 5);
}

function stopLive() {
  if (!live.on) return;
  live.on = false;
  note('');
}

function point(event) {
  const box = $('scene').getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

$('scene').onpointerdown = (event) => {
  if (!page.about) return;
  const at = point(event);
  const hit = scene.at(...at);
  if (hit?.contact) {
    choose(page.about.contacts.indexOf(hit.contact));
  } else if (hit?.body && page.about.scenario.bodies[hit.body].x === 'free') {
    $('scene').setPointerCapture(event.pointerId);
    if (live.on && live.body === hit.body) Object.assign(live, { from: at, to: at });
    else startLive(hit.body, at);
  }
};
$('scene').onpointermove = (event) => {
  if (live.on && event.buttons) live.to = point(event);
};
$('scene').onpointerup = () => { live.to = live.from; };
$('scene').onkeydown = (event) => {
  const push = { ArrowRight: 70, ArrowLeft: -70 }[event.key];
  if (!push || !page.about) return;
  const body = scene.bodies.find((it) => page.about.scenario.bodies[it].x === 'free');
  if (!body) return;
  const { x, y } = scene.boxes[body];
  if (!live.on) startLive(body, [x, y]);
  live.to = [live.from[0] + push, live.from[1]];
  event.preventDefault();
};
$('scene').onkeyup = () => { if (live.on) live.to = live.from; };
addEventListener('keydown', (event) => {
  if (event.key === 'Escape' && live.on) {
    stopLive();
    fail('');
    run();
  }
  if (event.key === ' ' && event.target === document.body) {
    event.preventDefault();
    $('play').click();
  }
});

// Choices and tools.

function choose(contact) {
  page.contact = contact;
  $('contact').value = contact;
  page.states = null;
  const name = page.about.contacts[contact];
  const pair = page.pairs.findIndex(([x]) => x === `${name}.u_m` || x === `${name}.d_m`);
  if (pair >= 0) {
    page.pair = page.pairs[pair];
    $('axes').value = pair;
    plots.loop.show({ x: column(page.pair[0]), ys: [column(page.pair[1])] });
  }
  seek(page.t);
  settle();
}

$('contact').onchange = () => choose(+$('contact').value);
$('axes').onchange = () => {
  page.pair = page.pairs[+$('axes').value];
  plots.loop.show({ x: column(page.pair[0]), ys: [column(page.pair[1])] });
  plots.loop.to(rowAt(page.t));
};
$('reset').onclick = () => {
  take(JSON.stringify(page.original));
};
$('steady').onclick = async () => {
  const answer = await watch(host.call('steady'));
  if (answer.stale) return;
  const place = $('orbit');
  if (answer.error) {
    place.replaceChildren(Object.assign(document.createElement('p'), { textContent: answer.error }));
    return;
  }
  const { unknowns, untold, defects, ...report } = JSON.parse(answer.text);
  results(place, report, page.about);
};

async function copy(text, told) {
  try {
    await navigator.clipboard.writeText(text);
    note(told);
  } catch {
    // Without a clipboard the text can be copied by hand.
    prompt('Copy:', text);
  }
}

$('link').onclick = async () => {
  const fragment = $('drive').hidden ? await pack(JSON.stringify(solo.state()), 'c') : await pack(JSON.stringify(page.tree));
  history.replaceState(null, '', fragment);
  await copy(location.href, 'The link is copied. It contains the numbers that you see.');
};
$('json').onclick = () => copy(`${JSON.stringify(page.tree, null, 2)}\n`, 'The scenario is copied.');
for (const kind of ['png', 'svg']) $(kind).onclick = () => picture(kind, $('drive').hidden ? solo.title() : `${page.about?.title} · ${words(page.t, 's', 5)}`, document.querySelector('main:not([hidden])'));

/** Takes the text of a scenario; an invalid one leaves the page as it is, and is answered with its error. */
async function take(text, original) {
  let answer = await watch(host.call('load', { text }));
  if (answer.error && /^\s*\{/.test(text)) {
    // It may only have too many rows. Errors are those of the text as it is.
    try {
      const [fewer, remark] = thinned(JSON.parse(text));
      const other = remark ? await watch(host.call('load', { text: fewer })) : answer;
      if (other.about) answer = other;
    } catch {
      // The engine has said what is wrong.
    }
  }
  if (answer.stale) return undefined;
  if (answer.error) {
    fail(answer.error);
    return answer.error;
  }
  page.about = { ...answer.about, words: await meanings };
  page.original = original ?? page.about.scenario;
  page.tree = structuredClone(page.about.scenario);
  await launch(true);
  return undefined;
}

$('open').onclick = () => $('file').click();
$('file').onchange = async () => { if ($('file').files[0]) take(await $('file').files[0].text()); };
addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('drop');
});
addEventListener('dragleave', () => document.body.classList.remove('drop'));
addEventListener('drop', async (event) => {
  event.preventDefault();
  document.body.classList.remove('drop');
  const file = event.dataTransfer.files[0];
  if (file) take(await file.text());
});

$('scenarios').replaceChildren(...scenes.map(({ name }) => new Option(name.replaceAll('_', ' '), name)));
$('choice').hidden = scenes.length < 2;
$('scenarios').onchange = () => {
  pause();
  view('drive');
  take(scenes.find(({ name }) => name === $('scenarios').value).text);
};

const solo = contactPage($('solo'), fail);
/** Shows one of the two views, or the present one with its title. */
function view(which = $('drive').hidden ? 'contact' : 'drive') {
  for (const name of ['drive', 'contact']) $(`view-${name}`).setAttribute('aria-pressed', name === which);
  $('drive').hidden = which !== 'drive';
  $('solo').hidden = which !== 'contact';
  $('title').textContent = which === 'contact' ? 'Contact: section 4.4' : page.about?.title ?? 'stickslip';
  $('choice').hidden = which === 'contact' || scenes.length < 2;
  if (which === 'contact') solo.open();
}
for (const which of ['drive', 'contact']) $(`view-${which}`).onclick = () => {
  pause();
  view(which);
};

dark.addEventListener('change', () => {
  Object.values(plots).forEach((plot) => plot.restyle());
  timeline.base = null;
  if (page.columns) show({ events: timeline.events.map(({ t, source, kind }) => `${t},${source},${kind}`).join('\n'), summary: page.summary });
  solo.redraw();
});
addEventListener('resize', () => {
  timeline.base = null;
  if (page.columns) seek(page.t);
  solo.redraw();
});
addEventListener('hashchange', () => start());

async function start() {
  if (location.hash.startsWith('#s=')) {
    try {
      await take(await unpack(location.hash));
      $('scenarios').selectedIndex = -1;
      return;
    } catch (fault) {
      fail(fault.message);
    }
  }
  const named = scenes.find(({ name }) => `#${name}` === location.hash);
  if (location.hash.startsWith('#c=')) {
    try {
      solo.take(JSON.parse(await unpack(location.hash, 'c')));
    } catch (fault) {
      fail(fault.message);
    }
    view('contact');
  }
  if (location.hash === '#contact') view('contact');
  if (named ? named.name !== $('scenarios').value || !page.about : !page.about && scenes.length) {
    const first = named ?? scenes.find(({ name }) => name === 'quickstart') ?? scenes[0];
    $('scenarios').value = first.name;
    const said = document.documentElement.dataset.error;
    await take(first.text);
    if (said) fail(said);
  }
}

window.stickslip = { page, seek, host };
start();
