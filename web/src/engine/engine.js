// The page's side of the drawing engine: asks the worker, and tells what it says as events.

/** More processors than this draw little faster. */
const MOST_THREADS = 8;

export class Engine extends EventTarget {
  #worker;
  #waiting = new Map(); // promises of answers, by number
  #number = 0;
  #moves = 0;
  #stops = 0;
  #signals = null; // Int32Array [moves, stops] that a picture being drawn looks at

  /**
   * Makes an engine that draws on a canvas, which is its own from then on.
   * @param {HTMLCanvasElement} canvas
   * @param {{base?: string, threads?: number}} options base: where worker.js and the modules lie; threads: at most
   */
  static async create(canvas, { base = './', threads = undefined } = {}) {
    const engine = new Engine(), at = new URL(base, document.baseURI).href;
    const isolated = globalThis.crossOriginIsolated === true && typeof SharedArrayBuffer === 'function';
    const cores = Math.min(navigator.hardwareConcurrency || 1, MOST_THREADS);
    const count = isolated ? Math.max(1, Math.min(threads ?? cores, cores)) : 1;
    const shared = isolated ? new SharedArrayBuffer(8) : null;
    engine.#signals = shared && new Int32Array(shared);
    engine.#worker = new Worker(new URL('worker.js', at), { type: 'module', name: 'drypoint' });
    engine.#worker.onmessage = ({ data }) => engine.#hear(data);
    engine.#worker.onerror = (event) => engine.#fail(event.message || 'the worker could not be read');
    const offscreen = canvas.transferControlToOffscreen();
    const info = await engine.#ask('begin', { base: at, threads: count, canvas: offscreen, shared }, [offscreen]);
    const { options, presets, shapes, textures, version, simd } = info;
    engine.info = { version, threads: count, isolated, simd };
    Object.assign(engine, { options, presets, shapes, textures });
    return engine;
  }

  #hear({ answer, value, error, stopped, event, detail }) {
    if (event) {
      if (event === 'state') this.state = detail;
      this.dispatchEvent(new CustomEvent(event, { detail }));
      return;
    }
    const promise = this.#waiting.get(answer);
    this.#waiting.delete(answer);
    if (!promise) return;
    if (error === undefined) promise.resolve(value);
    else promise.reject(Object.assign(new Error(error), { stopped: stopped === true }));
  }

  #fail(text) {
    const error = new Error('The drawing engine has failed: ' + text);
    for (const promise of this.#waiting.values()) promise.reject(error);
    this.#waiting.clear();
    this.dispatchEvent(new CustomEvent('message', { detail: { text: error.message, kind: 'error' } }));
  }

  #ask(name, extra, transfer = []) {
    const number = ++this.#number;
    return new Promise((resolve, reject) => {
      this.#waiting.set(number, { resolve, reject });
      this.#worker.postMessage({ name, number, moves: this.#moves, stops: this.#stops, ...extra }, transfer);
    });
  }

  #call(name, ...args) {
    this.#move();
    return this.#ask(name, { args });
  }

  /** Counts a move; a full picture that is being drawn is given up. */
  #move() {
    this.#moves = (this.#moves + 1) | 0;
    if (this.#signals) Atomics.store(this.#signals, 0, this.#moves);
  }

  #tell(name, ...args) {
    this.#move();
    this.#worker.postMessage({ name, args, moves: this.#moves, stops: this.#stops });
  }

  /** The last 'state': command, options, words, effective, model. */
  state = null;

  /** Opens files, or a generated shape. The old model stays if that fails. */
  open(what) {
    const files = what.files && Array.from(what.files);
    return this.#call('open', files ? { files } : { shape: what.shape });
  }
  /** Sets options by name; null takes one away. Rejects with the program's message, and nothing is changed then. */
  set(values) { return this.#call('set', values); }
  /** Takes a state's `options` back. */
  restore(words) { return this.#call('restore', words); }

  /** Moves of the camera, in shares of the picture's height. */
  turn(right, down) { this.#tell('turn', right, down); }
  pan(right, down) { this.#tell('pan', right, down); }
  zoom(factor, right = 0, down = 0) { this.#tell('zoom', factor, right, down); }
  /** Turns and zooms about what is seen at a point from now on; shares of the picture's size, from its upper left. */
  focus(x, y) { this.#tell('focus', x, y); }
  fit() { return this.#call('fit'); }
  view(name) { return this.#call('view', name); }
  project(orthographic) { return this.#call('project', orthographic); }
  /** The picture's size, px. */
  resize(width, height) { return this.#call('resize', width, height); }

  /** Stops reading, drawing and saving, where memory can be shared; what is begun elsewhere is finished. */
  cancel() {
    this.#stops = (this.#stops + 1) | 0;
    if (this.#signals) Atomics.store(this.#signals, 1, this.#stops);
    this.#worker.postMessage({ name: 'cancel', args: [], moves: this.#moves, stops: this.#stops });
  }

  /** A file of the picture, as the program writes it. */
  save(kind, { width, height }) { return this.#ask('save', { args: [kind, { width, height }] }); }
  /** The last full picture, and a hash of its bytes (FNV-1a, 64 bits). */
  pixels() { return this.#ask('pixels', { args: [] }); }

  close() { this.#worker.terminate(); }
}
