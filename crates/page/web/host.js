// An engine in a worker: calls as promises, the newest run only, and a cancel that always works.

/* global WORKER */

let compiled;

/** What an element of the page contains: base64 of something gzipped. */
export function unpacked(id) {
  const text = document.getElementById(id).textContent;
  let packed = Uint8Array.fromBase64?.(text);
  if (!packed) {
    const binary = atob(text);
    packed = new Uint8Array(binary.length);
    for (let k = 0; k < binary.length; k += 1) packed[k] = binary.charCodeAt(k);
  }
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream, { headers: { 'content-type': 'application/wasm' } });
}

/** Compiles the engine that the page contains. */
export function compile() {
  compiled ??= WebAssembly.compileStreaming(unpacked('engine'));
  return compiled;
}

export class Host {
  /** @param {(part: number) => void} progress receives the part of a run that is done */
  constructor(progress = () => {}) {
    this.progress = progress;
    this.waiting = new Map();
    this.number = 0;
    this.start();
  }

  start() {
    const url = URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' }));
    this.worker = new Worker(url);
    const { worker } = this;
    this.ready = compile().then((module) => worker.postMessage({ module }));
    worker.onmessage = ({ data }) => {
      if ('progress' in data) return this.progress(data.progress);
      const resolve = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      resolve?.(data.answer);
      if (data.answer?.fatal) this.restart();
      return undefined;
    };
  }

  async call(name, args) {
    await this.ready;
    const id = ++this.number;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.worker.postMessage({ id, name, args });
    });
  }

  /** Ends whatever the engine does, and begins anew without a scenario. */
  restart() {
    this.worker.terminate();
    const answers = [...this.waiting.values()];
    this.waiting.clear();
    answers.forEach((resolve) => resolve({ stale: true }));
    this.start();
  }
}
