// The exports of the engine as functions of texts and arrays.

export class Engine {
  static async of(module) {
    const engine = new Engine();
    engine.e = (await WebAssembly.instantiate(module, {})).exports;
    return engine;
  }

  put(text) {
    const bytes = new TextEncoder().encode(text);
    const at = this.e.buffer(bytes.length);
    new Uint8Array(this.e.memory.buffer, at, bytes.length).set(bytes);
  }

  get() {
    const { e } = this;
    return new TextDecoder().decode(new Uint8Array(e.memory.buffer, e.buffer_ptr(), e.buffer_len()));
  }

  /** Loads a scenario; returns the message of an error, or nothing. */
  load(text) {
    this.put(text);
    const failed = this.e.load();
    const said = this.get();
    if (failed) return said;
    this.names = said.split('\n');
    return undefined;
  }

  begin(snapshots) {
    return this.e.begin(snapshots) ? this.get() : undefined;
  }

  go(looks) {
    return this.e.go(looks);
  }

  /** Copies of the columns of the last run, by name. */
  columns() {
    const rows = this.e.rows();
    const of = (_, k) => new Float64Array(this.e.memory.buffer, this.e.column(k), rows).slice();
    return Object.fromEntries(this.names.map((name, k) => [name, of(name, k)]));
  }

  text(name) {
    this.e[name]();
    return this.get();
  }

  /** The answer of an export in the buffer, or its error. */
  asked(name, ...args) {
    this.put('');
    return this.e[name](...args) ? { error: this.get() } : { text: this.get() };
  }

  inside(contact, index) {
    const at = this.e.inside(contact, index);
    const { buffer } = this.e.memory;
    const [springs, radii, knots] = new Float64Array(buffer, at, 15).slice(12);
    if (!(springs >= 0)) return null;
    return new Float64Array(buffer, at, 15 + 6 * springs + 5 * radii + 2 * knots).slice();
  }

  step(until, input, value) {
    const at = this.e.step(until, input, value);
    if (!at) return { error: this.get() };
    const [count] = new Float64Array(this.e.memory.buffer, at, 1);
    return new Float64Array(this.e.memory.buffer, at + 8, count).slice();
  }
}
