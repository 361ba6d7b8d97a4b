// Puts the page into one file: node build.mjs ENGINE.wasm DEFINITIONS.md OUT.html [NAME=SCENARIO.json …]
// The definitions are those of docs; the scenarios are resolved ones, as in results folders.

import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const [engine, definitions, out, ...scenes] = process.argv.slice(2);
const here = (name) => new URL(name, import.meta.url);
const bundle = async (entry, define = {}) => {
  const { outputFiles } = await build({
    entryPoints: [here(entry).pathname], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022', define, legalComments: 'eof', charset: 'utf8',
  });
  return outputFiles[0].text;
};
const worker = await bundle('worker.js');
const script = await bundle('main.js', { WORKER: JSON.stringify(worker) });
const style = readFileSync(here(import.meta.resolve('uplot/dist/uPlot.min.css')), 'utf8') + await bundle('style.css');
const list = scenes.map((scene) => {
  const [name, file] = scene.split('=');
  return { name, text: readFileSync(file, 'utf8') };
});
const safe = (text) => text.replaceAll('</', '<\\/').replaceAll('<!--', '<\\!--');
// What the results mean, as in `stickslip explain`.
const words = {};
for (const file of ['summary.json', 'steady.json']) {
  const part = readFileSync(definitions, 'utf8').split(`\n## ${file}\n`)[1].split('\n## ')[0];
  for (const [, name, text] of part.matchAll(/^\| `([^`]+)` \| (.*) \|$/gm)) words[name] ??= text.replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replaceAll('`', '');
}
/** Packs as small as there is a program for it. */
function packed(file) {
  try {
    return execFileSync('zopfli', ['--i5', '-c', file], { maxBuffer: 1 << 26 });
  } catch {
    return gzipSync(readFileSync(file), { level: 9 });
  }
}
const parts = {
  STYLE: style,
  SCENES: safe(JSON.stringify(list)),
  WORDS: gzipSync(JSON.stringify(words), { level: 9 }).toString('base64'),
  ENGINE: packed(engine).toString('base64'),
  SCRIPT: safe(script),
};
const page = readFileSync(here('index.html'), 'utf8').replace(/\/\*([A-Z]+)\*\//g, (_, name) => parts[name]);
writeFileSync(out, page);
console.log(`${out}: ${(page.length / 1e6).toFixed(2)} MB, of which the engine ${(parts.ENGINE.length / 1e6).toFixed(2)} MB`);
