// Tests of the page: node test.mjs ENGINE.wasm PAGE.html RESULTS PROGRAM, with CHROMIUM naming a browser.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { once } from 'node:events';
import { createServer } from 'node:http';
import { join, resolve } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { Engine } from './engine.js';

const [wasm, page, results, program] = process.argv.slice(2);
const chromium = process.env.CHROMIUM;
const pictures = fileURLToPath(new URL('pictures', import.meta.url));
mkdirSync(pictures, { recursive: true });
const names = readdirSync(results).filter((name) => statSync(join(results, name)).isDirectory());
const scenario = (name) => readFileSync(join(results, name, 'scenario.json'), 'utf8');
const module = new WebAssembly.Module(readFileSync(wasm));
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

test('the engine imports nothing and has at most twenty functions', (t) => {
  t.diagnostic(`page: ${(statSync(page).size / 1e6).toFixed(2)} MB`);
  assert.equal(WebAssembly.Module.imports(module).length, 0);
  const functions = WebAssembly.Module.exports(module).filter(({ kind }) => kind === 'function');
  assert.ok(functions.length <= 20, functions.map(({ name }) => name).join());
});

for (const name of names) {
  test(`${name} has the bits of the program`, async () => {
    const engine = await Engine.of(module);
    assert.equal(engine.load(scenario(name)), undefined);
    const rows = engine.e.run();
    const summary = JSON.parse(readFileSync(join(results, name, 'summary.json')));
    assert.equal(rows, summary.tables['trace.csv'].rows);
    assert.equal(engine.text('hash'), summary.tables['trace.csv'].sha256);
    const [told, kept] = [JSON.parse(engine.text('summary')), summary].map(({ timing, files, tables, steady_motion, warnings, notes, ...rest }) => rest);
    assert.deepEqual(told, kept);
  });
}

test('a run in parts has the bits of a whole one, with snapshots', async () => {
  const [one, other] = [await Engine.of(module), await Engine.of(module)];
  const tree = JSON.parse(scenario('three_ball_stage'));
  tree.run.cycles *= 20;
  const text = JSON.stringify(tree);
  one.load(text);
  one.e.run();
  other.load(text);
  other.begin(50);
  let parts = 0;
  for (; other.go(1n) < 1; parts += 1);
  assert.ok(parts > 3, `${parts}`);
  assert.equal(one.text('hash'), other.text('hash'));
  const inside = other.inside(0, 49);
  assert.ok(Math.abs(inside[0] - 0.4) < 1e-12);
  assert.equal(inside.length, 15 + 6 * inside[12] + 5 * inside[13] + 2 * inside[14]);
  assert.equal(other.inside(0, 50), null);
  assert.equal(other.inside(7, 0), null);
});

test('a broken scenario has the message of check', async () => {
  const engine = await Engine.of(module);
  const text = scenario('quickstart').replace('"friction": 0.2', '"friction": -0.2');
  const file = join(pictures, 'scenario.json');
  writeFileSync(file, text);
  let said = '';
  try {
    execFileSync(program, ['check', file], { encoding: 'utf8', stdio: 'pipe' });
  } catch (failure) {
    said = failure.stdout + failure.stderr;
  }
  assert.match(said, /friction/);
  const told = engine.load(text);
  assert.ok(said.replaceAll(file, 'scenario.json').includes(told.trim()), `${told}\n---\n${said}`);
});

test('a contact in the hand has the forces of Hertz and Cattaneo', async () => {
  const engine = await Engine.of(module);
  engine.load(scenario('quickstart'));
  const { text } = engine.asked('hold', 0, 1e-7);
  const { constants, pressed } = JSON.parse(text);
  assert.equal(engine.asked('press', 1e-7, 0).error, undefined);
  const u = 0.4 * pressed.gross_slip_displacement_m;
  engine.asked('press', 1e-7, u);
  const [, d, , normal, force, a, c] = engine.inside(0, -2);
  const near = (value, known) => assert.ok(Math.abs(value / known - 1) < 1e-12, `${value} ${known}`);
  near(a, Math.sqrt(5e-4 * d));
  near(normal, 4 / 3 * constants.normal_modulus_Pa * Math.sqrt(5e-4) * d ** 1.5);
  near(c / a, Math.sqrt(1 - 0.4));
  near(force, 0.2 * normal * (1 - 0.6 ** 1.5));
});

test('a motion by hand follows its input', async () => {
  const engine = await Engine.of(module);
  engine.load(scenario('controlled'));
  const { text } = engine.asked('live');
  const input = text.split('\n').indexOf('drive');
  const foot = engine.names.indexOf('foot.x_m');
  const row = engine.step(1e-3, input, 2e-7);
  assert.equal(row[foot], 2e-7);
  assert.match(engine.step(2e-3, input, 1).error, /expected/);
});

const skip = chromium ? false : 'no Chromium';
let browser;
let playwright;

async function open(address, options = {}) {
  playwright ??= (await import('playwright-core')).chromium;
  browser ??= await playwright.launch({ executablePath: chromium, args: ['--no-sandbox', '--disable-quic', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run'] });
  const context = await browser.newContext({ viewport: { width: 1280, height: 1000 }, ...options });
  const tab = await context.newPage();
  const asked = [];
  tab.on('request', (request) => asked.push(request.url()));
  tab.on('pageerror', (error) => { throw error; });
  await tab.goto(address);
  await tab.waitForFunction(() => document.documentElement.dataset.drawn, null, { timeout: 20_000 });
  return { tab, asked, context };
}

const local = `file://${resolve(page)}`;
const drawn = (tab) => tab.evaluate(() => +document.documentElement.dataset.drawn);
const trouble = (tab) => tab.evaluate(() => document.documentElement.dataset.error);
const link = (text) => `${local}#s=${deflateRawSync(Buffer.from(text)).toString('base64url')}`;

test('opens from a file and from a server, and asks for nothing else', { skip }, async (t) => {
  const times = [];
  for (let k = 0; k < 3; k += 1) {
    const { tab, asked, context } = await open(local);
    times.push(await drawn(tab));
    assert.ok(asked.every((url) => url.startsWith('file:') || url.startsWith('blob:') || url.startsWith('data:')), asked.join());
    assert.equal(await trouble(tab), undefined);
    await context.close();
  }
  t.diagnostic(`first picture after ${median(times)} ms`);
  const server = createServer((_, answer) => answer.setHeader('content-type', 'text/html').end(readFileSync(page))).listen(0, '127.0.0.1');
  await once(server, 'listening');
  const { tab, asked, context } = await open(`http://127.0.0.1:${server.address().port}/`);
  assert.equal(asked.filter((url) => url.startsWith('http')).length, 1);
  assert.equal(await trouble(tab), undefined);
  await context.close();
  server.close();
});

test('a slider draws anew', { skip }, async (t) => {
  const { tab, context } = await open(`${local}#quickstart`);
  const times = await tab.evaluate(async () => {
    const slider = document.querySelector('input[data-path="contacts.ball.friction"]');
    slider.closest('details').open = true;
    const frames = [];
    let last = performance.now();
    let on = true;
    const frame = (now) => {
      frames.push(now - last);
      last = now;
      if (on) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    const all = [];
    for (let k = 0; k < 40; k += 1) {
      const runs = document.documentElement.dataset.runs;
      const begun = performance.now();
      slider.value = 300 + 10 * k;
      slider.dispatchEvent(new Event('input'));
      while (document.documentElement.dataset.runs === runs) await new Promise((done) => setTimeout(done, 1));
      all.push(performance.now() - begun);
      await new Promise((done) => setTimeout(done, 30));
    }
    on = false;
    return { all, frames: Math.max(...frames.slice(2)) };
  });
  t.diagnostic(`10 001 rows and two plots: median ${median(times.all).toFixed(0)} ms, longest frame ${times.frames.toFixed(0)} ms`);
  assert.equal(times.all.length, 40);
  await context.close();
});

test('plays', { skip }, async (t) => {
  const { tab, context } = await open(`${local}#quickstart`);
  await tab.click('#period');
  await tab.waitForTimeout(3000);
  const frames = await tab.evaluate(() => window.stickslip.page.frames);
  t.diagnostic(`${((frames.length - 1) / (frames.at(-1) - frames[0]) * 1000).toFixed(1)} frames a second`);
  const [before, after] = [frames[0], frames.at(-1)];
  assert.ok(after > before);
  await context.close();
});

test('hostile links and scenarios are refused in words', { skip }, async () => {
  const texts = {
    '#s=%%%': /link|damaged|no scenario/,
    '#s=AAAA': /damaged|scenario/,
    '#s=<img onerror=alert(1)>': /no scenario/,
  };
  for (const [fragment, expected] of Object.entries(texts)) {
    const { tab, context } = await open(local + fragment);
    assert.match(await trouble(tab), expected, fragment);
    await context.close();
  }
  for (const [text, expected] of [['{"stickslip": 1,', /scenario\.json/], ['[1]', /JSON object/], [' '.repeat(3e6), /1 MB/], ['{"stickslip":1,"title":"<img src=x onerror=\'document.title=1\'>","bodies":{}}', /./]]) {
    const { tab, context } = await open(link(text));
    assert.match(await trouble(tab), expected, text.slice(0, 40));
    assert.notEqual(await tab.title(), '1');
    await context.close();
  }
});

test('a link gives the same run', { skip }, async () => {
  const { tab, context } = await open(link(scenario('p1')));
  assert.equal(await trouble(tab), undefined);
  await tab.waitForFunction(() => document.getElementById('hash').textContent);
  const known = JSON.parse(readFileSync(join(results, 'p1', 'summary.json'))).tables['trace.csv'].sha256;
  assert.equal(await tab.textContent('#hash'), known);
  await context.close();
});

test('a run of a million periods can be cancelled, and 10⁶ springs', { skip }, async () => {
  const long = JSON.parse(scenario('quickstart'));
  long.run.duration = 1e4;
  const { tab, context } = await open(local);
  await tab.evaluate((text) => {
    const file = new File([text], 'long.json');
    const data = new DataTransfer();
    data.items.add(file);
    window.dispatchEvent(new DragEvent('drop', { dataTransfer: data }));
  }, JSON.stringify(long));
  await tab.waitForSelector('#busy:not([hidden])');
  await tab.waitForTimeout(1500);
  const part = await tab.evaluate(() => document.getElementById('progress').value);
  assert.ok(part > 0 && part < 1, `${part}`);
  await tab.click('#cancel');
  // The last finished run is there again, and so is its engine.
  await tab.waitForFunction(() => /Cancelled/.test(document.getElementById('note').textContent));
  await tab.click('#steady');
  await tab.waitForFunction(() => /153/.test(document.getElementById('orbit').textContent));
  const slow = JSON.parse(scenario('quickstart'));
  slow.contacts.ball.engine = { springs: { count: 1_000_000 } };
  await tab.evaluate((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], 'slow.json'));
    window.dispatchEvent(new DragEvent('drop', { dataTransfer: data }));
  }, JSON.stringify(slow));
  // The page answers all the time.
  for (let k = 0; k < 10; k += 1) {
    const before = Date.now();
    await tab.evaluate(() => 1);
    // A page that hangs would not answer before its engine is done.
    assert.ok(Date.now() - before < 10_000);
    await tab.waitForTimeout(100);
  }
  if (await tab.isVisible('#busy')) await tab.click('#cancel');
  await tab.selectOption('#scenarios', 'p1');
  await tab.waitForFunction(() => document.getElementById('title').textContent.length && !document.documentElement.dataset.error && document.title.includes('stickslip'));
  await context.close();
});

test('keyboard alone, narrow and dark', { skip }, async () => {
  const { tab, context } = await open(local);
  await tab.focus('#timeline');
  await tab.keyboard.press('ArrowRight');
  assert.match(await tab.textContent('#event'), /·/);
  await tab.keyboard.press('End');
  await tab.focus('#play');
  await tab.keyboard.press('Enter');
  assert.equal(await tab.getAttribute('#play', 'aria-label'), 'Pause');
  await tab.keyboard.press('Enter');
  const field = 'input[aria-label="contacts.ball.friction, value"]';
  await tab.focus(field);
  for (const [typed, shown] of [['abc', true], ['0.1', false]]) {
    await tab.fill(field, typed);
    await tab.keyboard.press('Enter');
    await tab.waitForFunction((wanted) => !document.getElementById('error').hidden === wanted, shown);
  }
  await tab.waitForFunction(() => /170/.test(document.getElementById('key').textContent));
  assert.equal(await tab.evaluate(() => document.activeElement.ariaLabel), 'contacts.ball.friction, value');
  await tab.focus('#view-contact');
  await tab.keyboard.press('Enter');
  await tab.waitForSelector('#pad');
  await tab.focus('#pad');
  for (let k = 0; k < 10; k += 1) await tab.keyboard.press('ArrowRight');
  await tab.waitForTimeout(300);
  await tab.screenshot({ path: join(pictures, 'contact.png'), fullPage: true });
  await context.close();
  for (const name of ['quickstart', 'three_ball_stage', 'walking_drive', 'bounce', 'fretting_sphere', 'impact_drive']) {
    for (const scheme of ['light', 'dark']) {
      const shot = await open(`${local}#${name}`, { colorScheme: scheme });
      await shot.tab.waitForTimeout(1500);
      await shot.tab.evaluate(() => window.stickslip.seek(window.stickslip.page.duration * 0.43));
      await shot.tab.waitForTimeout(300);
      await shot.tab.screenshot({ path: join(pictures, `${name}-${scheme}.png`), fullPage: true });
      await shot.context.close();
    }
  }
  const narrow = await open(`${local}#quickstart`, { viewport: { width: 390, height: 840 } });
  await narrow.tab.waitForTimeout(1200);
  const wide = await narrow.tab.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide}`);
  await narrow.tab.screenshot({ path: join(pictures, 'narrow.png'), fullPage: true });
  await narrow.tab.click('#view-contact');
  await narrow.tab.waitForTimeout(800);
  assert.ok(await narrow.tab.evaluate(() => document.documentElement.scrollWidth) <= 390);
  await narrow.tab.screenshot({ path: join(pictures, 'narrow-contact.png'), fullPage: true });
  await narrow.context.close();
});

test('a body is pushed by hand', { skip }, async () => {
  const { tab, context } = await open(`${local}#quickstart`);
  const box = await tab.locator('#scene').boundingBox();
  const spot = await tab.evaluate(() => {
    const canvas = document.getElementById('scene');
    return [canvas.clientWidth / 2 - 60, 60];
  });
  await tab.mouse.move(box.x + spot[0], box.y + spot[1]);
  await tab.mouse.down();
  await tab.mouse.move(box.x + spot[0] + 120, box.y + spot[1], { steps: 5 });
  await tab.waitForTimeout(1200);
  await tab.screenshot({ path: join(pictures, 'pushed.png') });
  assert.match(await tab.textContent('#note'), /push/);
  assert.equal(await trouble(tab), undefined);
  await tab.mouse.up();
  await tab.keyboard.press('Escape');
  await tab.waitForFunction(() => document.getElementById('note').hidden);
  await context.close();
});

test('leave', { skip }, async () => { await browser?.close(); });
