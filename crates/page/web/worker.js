// The engine in a thread of its own. It answers one call after another; a newer run takes the place of an unfinished one.

import { Engine } from './engine.js';

/** Longest time of a part of a run without looking for messages, ms. */
const PART = 30;
/** Time after which a run tells how far it is, ms. */
const QUIET = 200;

let engine;
let ready;
let run = 0;
const looked = new MessageChannel();
const resumed = [];
looked.port1.onmessage = () => resumed.shift()?.();

/** Lets waiting messages in. */
const breathe = () => new Promise((resume) => {
  resumed.push(resume);
  looked.port2.postMessage(0);
});

const calls = {
  /** Loads a scenario and tells what there is to say about it. */
  load({ text }) {
    run += 1;
    const error = engine.load(text);
    return error ? { error } : { about: JSON.parse(engine.text('about')) };
  },

  /** Loads a scenario and runs it. */
  async run({ text, snapshots }) {
    const mine = ++run;
    const begun = performance.now();
    const error = engine.load(text) ?? engine.begin(snapshots);
    if (error) return { error };
    let looks = 4n;
    let told = begun;
    for (;;) {
      const before = performance.now();
      const done = engine.go(looks);
      const now = performance.now();
      if (done >= 1) break;
      looks = now - before < PART / 2 ? looks * 2n : now - before > PART && looks > 1n ? looks / 2n : looks;
      if (now - told > QUIET) {
        told = now;
        postMessage({ progress: done });
      }
      await breathe();
      if (mine !== run) return { stale: true };
    }
    const columns = engine.columns();
    return {
      columns,
      events: engine.text('events'),
      summary: JSON.parse(engine.text('summary') || '{}'),
      time: performance.now() - begun,
    };
  },

  inside({ contact, index }) {
    return engine.inside(contact, index);
  },

  /** Spring states of a contact in all snapshots. */
  async states({ contact, count }) {
    const mine = run;
    const all = [];
    for (let k = 0; k < count; k += 1) {
      const inside = engine.inside(contact, k);
      if (!inside) break;
      const springs = inside[12];
      all.push(Uint8Array.from({ length: springs }, (_, i) => inside[15 + 6 * i + 3]));
      if (k % 16 === 15) {
        await breathe();
        if (mine !== run) return { stale: true };
      }
    }
    return { states: all };
  },

  hash: () => engine.text('hash'),
  steady: () => engine.asked('steady'),
  hold: ({ contact, d }) => engine.asked('hold', contact, d),
  live: () => engine.asked('live'),

  /** Moves the contact in the hand along points and returns what it is like at the last one, and the forces on the way. */
  press({ points }) {
    const way = [];
    for (const [d, u] of points) {
      const { error } = engine.asked('press', d, u);
      if (error) return { error };
      const inside = engine.inside(0, -2);
      way.push([inside[1], inside[2], inside[3], inside[4], inside[9]]);
    }
    return { inside: engine.inside(0, -2), way };
  },

  /** Advances the motion by hand. */
  step({ until, input, value, contact }) {
    const row = engine.step(until, input, value);
    return row.error ? row : { row, inside: engine.inside(contact, -1) };
  },
};

onmessage = async ({ data: { id, name, args, module } }) => {
  if (module) {
    ready = Engine.of(module).then((made) => { engine = made; });
    return;
  }
  let answer;
  try {
    await ready;
    answer = await calls[name](args ?? {});
  } catch (fault) {
    answer = { error: `the engine stopped: ${fault.message ?? fault}`, fatal: true };
  }
  const buffers = [];
  const collect = (it) => {
    if (ArrayBuffer.isView(it)) buffers.push(it.buffer);
    else if (it && typeof it === 'object') Object.values(it).forEach(collect);
  };
  if (answer && (answer.columns || answer.inside || answer.states || ArrayBuffer.isView(answer))) collect(answer);
  postMessage({ id, answer }, buffers);
};
