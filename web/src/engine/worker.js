// The worker: owns the WebAssembly module and the canvas, and draws.
//
// Messages in: {name, number, args, moves}. `number`: an answer is wanted, {answer: number, value | error}. `moves`: how
// many moves the page has made, this one included. Messages out: {event, detail}.
//
// Moves change the camera at once, and are drawn once all messages that wait are read: the newest camera wins. Pictures
// are drafts while something moves; the full one follows when nothing has moved for a while, and is given up when the
// page counts another move in `signals`, memory that both threads share. Without such memory (a page that is not
// isolated) a picture that is begun is finished.
//
// Of large models drafts are of fewer triangles: another worker, of this same file, simplifies them (draft.js).
//
// When the module is out of memory, or fails, a new one takes the place of it: options, camera and the bytes of the last
// model are taken over.

import { deflate, encodePng } from './png.js';

const SETTLED = 150; // ms after the last move
const SLOW = 60, FAST = 22; // ms: drafts that take longer are drawn worse, and those that do not, better
const READ_SHARE = 0.5; // of the progress of opening: bytes into memory; the rest is for the model's reader
const SLOW_CHANGE = 100; // ms: where the full picture takes longer, a draft of changed options comes first
const FULL = 0, ONE_SAMPLE = 1, HALF = 2; // viewer/picture.h
const DRAFT_FROM = 150000; // polygons: from there on drafts are of a simplified model

let create, options; // the module's function, and what it is called with
let module, scratch; // the module that runs, and a byte in its memory
let canvas, context, half; // half: a smaller canvas, for drafts
let signals; // Int32Array [moves, stops] of shared memory, or null
let moves = 0, stops = 0; // that have been read here
let opened = null; // {names, files: [{name, at, size}], shape}: what the module has open
let stateText = ''; // options of the last state
let size = { width: 1280, height: 800 };
let quality = ONE_SAMPLE; // of drafts
let drawn = null; // quality of what is on the canvas, and it is of the present state
let fullTime = 0; // ms, of the last full picture
let timer = 0, scheduled = false, lastMove = 0;
let work = null; // what is told of progress
let said = []; // messages of the module since the last call
let lastSaid = ''; // so that a warning is not said again with every change
let simplifier = null; // the worker that simplifies
let simplified = 0; // number of the model that it has, or had

const post = (event, detail = {}) => postMessage({ event, detail });

// ------- the module -------

const text = (at) => module.UTF8ToString(at);

/** The module's memory. A view of one that threads have let grow ends too early until the module itself looks. */
function heap() {
  if (options.threads > 1) module.stringToUTF8('', scratch, 1);
  return module.HEAPU8;
}

/** Calls with a string in the module's memory. */
function withText(string, call) {
  if (string === null || string === undefined) return call(0);
  const bytes = module.lengthBytesUTF8(string) + 1, at = module._malloc(bytes) >>> 0;
  if (!at) throw new Error('out of memory');
  module.stringToUTF8(string, at, bytes);
  try {
    return call(at);
  } finally {
    if (module) module._free(at);
  }
}

/** Tells what was said, and throws the last of it if `answer` is that of a failure. False: it was stopped. */
function settle(answer, what) {
  const all = said.splice(0);
  if (answer === 2) return false;
  const failure = answer ? all.pop() || what + ' failed' : '';
  for (const one of all) {
    if (one !== lastSaid)
      post('message', { text: one.replace(/^warning: /, ''), kind: one.startsWith('warning: ') ? 'warning' : 'note' });
    lastSaid = one;
  }
  if (answer) throw new Error(failure);
  return true;
}

function tellProgress(fraction) {
  const now = performance.now();
  if (work && now - work.told > 60) {
    work.told = now;
    post('progress', { what: work.what, fraction: fraction < 0 ? -1 : work.from + (1 - work.from) * fraction });
  }
  if (!signals) return 0;
  if (Atomics.load(signals, 1) !== stops) return 1;
  return work && work.movable && Atomics.load(signals, 0) !== moves ? 1 : 0;
}

/** Does something that may take long, of which progress is told. */
function working(what, movable, call, from = 0) {
  work = { what, movable, from, told: performance.now() };
  try {
    return call();
  } finally {
    work = null;
    post('idle');
  }
}

const saved = { pieces: [], picture: null, results: null, wanted: null, at: 0 };

/** A block of the module's memory, copied. */
const copyOf = (at, bytes) => heap().slice(at, at + bytes);

/** What the browser makes of bytes, which takes time: named in a first pass, taken in a second. */
function result(kind, bytes, sizeAt, extra) {
  const k = saved.at++;
  if (!saved.results) {
    saved.wanted.push({ kind, bytes, ...extra });
    return 0;
  }
  const made = saved.results[k], at = module._malloc(made.length) >>> 0;
  if (!at) return 0;
  heap().set(made, at);
  new Uint32Array(heap().buffer, sizeAt, 1)[0] = made.length;
  return at;
}

function hooks() {
  return {
    print: () => {},
    printErr: (line) => said.push(String(line).replace(/^drypoint: /, '')),
    tellProgress,
    tellBytes: (at, bytes) => saved.pieces.push(copyOf(at, bytes)),
    tellPicture: (at, width, height, dpi) => {
      saved.picture = { rgba: copyOf(at, 4 * width * height), width, height, dpi };
    },
    tellDeflated: (at, bytes, sizeAt) =>
      result('deflate', saved.results ? null : copyOf(at, bytes), sizeAt, {}),
    tellEncoded: (at, width, height, sizeAt) =>
      result('png', saved.results ? null : copyOf(at, 4 * width * height), sizeAt, { width, height }),
  };
}

async function begin() {
  module = await create({ ...options, ...hooks() });
  scratch = module._malloc(1) >>> 0;
  module._web_begin(options.threads);
  module._web_resize(size.width, size.height);
}

/** Runs `call`; a module that fails in it is replaced. */
async function safely(call) {
  try {
    return await call();
  } catch (error) {
    if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
    await restart(error);
    throw new Error(
      'The drawing engine ran out of memory or failed and was started again' + (opened ? '.' : '; open the model again.') +
      ' (' + error.message + ')');
  }
}

async function restart() {
  const before = module, last = opened, words = stateText;
  before?.PThread?.terminateAllThreads();
  module = null;
  opened = null;
  drawn = null;
  simplified = 0;
  said = [];
  await begin();
  try {
    if (last) {
      for (const f of last.files) f.data = before.HEAPU8.slice(f.at, f.at + f.size);
      await openModels(last.names, last.files, 0);
      restore(words);
    }
  } catch (error) {
    opened = null;
  }
  told();
}

// ------- state -------

/** Posts the state, when it is another. */
function told() {
  const state = JSON.parse(text(module._web_state()));
  stateText = state.options;
  if (!opened) state.model = null;
  post('state', state);
}

/** The next picture is another; where pictures take long, a draft comes first. */
function changed() {
  drawn = null;
  if (fullTime > SLOW_CHANGE) lastMove = performance.now();
  told();
  schedule();
}

function restore(words) {
  module._web_begin_changes();
  settle(withText(words, (at) => module._web_restore(at)), 'The options');
  settle(module._web_accept(), 'The change');
}

function set(values) {
  module._web_begin_changes();
  for (const [name, value] of Object.entries(values))
    settle(withText(name, (n) => withText(value === null || value === undefined ? null : String(value),
                                          (v) => module._web_change(n, v))), 'The change');
  working('reading', false, () => settle(module._web_accept(), 'The change'));
}

// ------- opening -------

const MODEL = /\.(stl|ply|obj|off|glb|gltf)$/i;
const outOfMemory = (name, bytes) =>
  new Error(`${name}: out of memory for ${(bytes / 1e6).toFixed(0)} MB; the old model stays`);

/** Room for a file in the module's memory. */
function room(name, bytes) {
  const at = module._malloc(Math.max(bytes, 1)) >>> 0;
  if (!at) throw outOfMemory(name, bytes);
  return at;
}

/** Reads a file straight into the module's memory, where its bytes lie once. */
async function load(file) {
  if (file.data) {
    const bytes = new Uint8Array(file.data), at = room(file.name, bytes.length);
    heap().set(bytes, at);
    return { name: file.name, at, size: bytes.length };
  }
  const at = room(file.name, file.size), reader = file.stream().getReader();
  let read = 0;
  const reading = { what: 'reading', from: 0, told: performance.now() };
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (read + value.length > file.size) throw new Error(`${file.name} has changed; open it again`);
      heap().set(value, at + read);
      read += value.length;
      work = reading; // pictures are drawn in between
      if (tellProgress(READ_SHARE * read / file.size)) throw new Stopped();
    }
  } catch (error) {
    module._free(at);
    throw error instanceof DOMException ? new Error(`${file.name} cannot be read: ${error.message}`) : error;
  } finally {
    work = null;
  }
  return { name: file.name, at, size: file.size };
}

class Stopped extends Error {
  constructor() { super('stopped'); }
}

/** Opens models; `files` lie beside each other. */
async function openModels(names, files) {
  const loaded = [];
  for (const f of files) {
    const one = await load(f);
    if (withText(one.name, (n) => module._web_file(n, one.at, one.size))) throw outOfMemory(one.name, one.size);
    loaded.push(one);
  }
  const answer = working('reading', false, () =>
    withText(names.join('\n'), (at) => module._web_open(at)), files.length ? READ_SHARE : 0);
  if (!settle(answer, 'Opening')) throw new Stopped();
  opened = { names, files: loaded };
}

async function open(what) {
  if (what.shape) {
    await openModels(['shape:' + what.shape], []);
  } else {
    const files = [...what.files], names = files.map((f) => f.name).filter((n) => MODEL.test(n));
    const extra = /\.(mtl|bin|png|jpe?g|webp|txt|md)$/i;
    if (!names.length) names.push(...files.map((f) => f.name).filter((n) => !extra.test(n)));
    if (!names.length) throw new Error('There is no model among these files: STL, PLY, OBJ, OFF, glTF and GLB are read');
    await openModels(names, files);
  }
  quality = ONE_SAMPLE;
  fullTime = 0;
  changed();
  return JSON.parse(text(module._web_state())).model;
}

// ------- drawing -------

/** Draws when all messages that wait are read. */
const turnstile = new MessageChannel();
turnstile.port1.onmessage = () => {
  scheduled = false;
  safely(drawNow).catch((error) => post('message', { text: error.message, kind: 'error' }));
};

function schedule() {
  if (scheduled) return;
  scheduled = true;
  turnstile.port2.postMessage(0);
}

const isMoving = () => performance.now() - lastMove < SETTLED;

function drawNow() {
  clearTimeout(timer);
  if (!opened || drawn === FULL) return;
  if (!isMoving()) return draw(FULL);
  draw(quality);
  if (drawn !== FULL) timer = setTimeout(schedule, Math.max(SETTLED - (performance.now() - lastMove), 1) + 2);
}

function draw(how) {
  const call = () => module._web_draw(how);
  const answer = how === FULL ? working('drawing', true, call) : call();
  if (!settle(answer, 'Drawing')) { // a move, whose message comes, or cancelled: a draft stays, then
    drawn = null;
    const cancelled = signals && Atomics.load(signals, 1) !== stops;
    if (!cancelled) return;
    stops = Atomics.load(signals, 1);
    draw(HALF);
    post('frame', { ms: 0, draft: true, full: false, cancelled: true, segments: 0, ...size, threads: options.threads, simplified: false });
    return;
  }
  const frame = new Float64Array(heap().buffer, module._web_frame() >>> 0, 9);
  const [width, height, ms, segments, threads, simple, number, polygons, moving] = frame;
  show(width, height);
  const full = how === FULL;
  drawn = how;
  if (full) fullTime = ms;
  else adapt(ms);
  post('frame', { ms, draft: !full, full, segments, width, height, threads, simplified: !full && simple === 1 });
  if (full && polygons > DRAFT_FROM && !moving && simplified !== number) simplify(number);
}

/** Drafts get worse when they are slow, and better when they are fast. */
function adapt(ms) {
  if (ms > SLOW && quality < HALF) quality++;
  else if (ms < FAST && quality > ONE_SAMPLE) quality--;
}

function pixels(width, height) {
  const at = module._web_pixels() >>> 0, bytes = 4 * width * height;
  return options.threads > 1
    ? new Uint8ClampedArray(copyOf(at, bytes).buffer) // an ImageData may not lie in shared memory
    : new Uint8ClampedArray(heap().buffer, at, bytes);
}

function show(width, height) {
  if (canvas.width !== size.width || canvas.height !== size.height)
    canvas.width = size.width, canvas.height = size.height;
  const image = new ImageData(pixels(width, height), width, height);
  if (width === size.width && height === size.height) {
    context.putImageData(image, 0, 0);
    return;
  }
  if (!half || half.width !== width || half.height !== height) half = new OffscreenCanvas(width, height);
  half.getContext('2d').putImageData(image, 0, 0);
  context.globalCompositeOperation = 'copy';
  context.drawImage(half, 0, 0, size.width, size.height);
}

// ------- the simplified model -------

function endSimplifier() {
  simplifier?.terminate();
  simplifier = null;
}

/** Has model `number` simplified by another worker, and takes what it makes if the model is still the same. */
function simplify(number) {
  simplified = number;
  endSimplifier();
  simplifier = new Worker(self.location.href, { type: 'module', name: 'drypoint draft' });
  simplifier.onmessage = ({ data }) => {
    queue = queue.then(() => takeDraft(number, data)).finally(endSimplifier);
  };
  simplifier.onerror = () => endSimplifier();
  queue = queue.then(() => sendMesh(number));
}

function sendMesh(number) {
  if (!simplifier || simplified !== number || module._web_mesh()) return endSimplifier();
  const [positions, vertices, indices, triangles, groups] = new Float64Array(heap().buffer, module._web_mesh_parts() >>> 0, 5);
  const mesh = {
    positions: new Float32Array(copyOf(positions, 12 * vertices).buffer),
    indices: new Uint32Array(copyOf(indices, 12 * triangles).buffer),
    groups: new Uint16Array(copyOf(groups, 2 * triangles).buffer),
  };
  module._web_mesh_free();
  simplifier.postMessage({ name: 'simplify', mesh }, [mesh.positions.buffer, mesh.indices.buffer, mesh.groups.buffer]);
}

/** A copy in the module's memory, which it frees; 0: memory is out. */
function given(array) {
  const at = module._malloc(array.byteLength) >>> 0;
  if (at) heap().set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
  return at;
}

function takeDraft(number, { error, mesh }) {
  if (error) post('message', { text: 'While it moves, this large model is drawn whole, which may be slow: what would simplify it is not there.', kind: 'note' });
  if (error || simplified !== number) return;
  const parts = [mesh.positions, mesh.indices, mesh.groups].map(given);
  if (parts.every((at) => at))
    module._web_draft(parts[0], mesh.positions.length / 3, parts[1], mesh.indices.length / 3, parts[2]);
  else
    parts.forEach((at) => module._free(at));
  quality = ONE_SAMPLE;
}

// ------- saving -------

async function save(kind, { width, height }) {
  const once = () => {
    saved.pieces = [], saved.picture = null, saved.at = 0;
    const answer = working('saving', false, () => withText(kind, (at) => module._web_save(at, width, height)));
    if (!settle(answer, 'Saving')) throw new Stopped();
  };
  saved.results = null, saved.wanted = [];
  try {
    once();
    if (saved.picture) return new Blob([await encodePng(saved.picture)], { type: 'image/png' });
    if (saved.wanted.length) {
      saved.results = await Promise.all(saved.wanted.map((w) =>
        w.kind === 'png' ? encodePng({ ...w, rgba: w.bytes }) : deflate(w.bytes)));
      once();
    }
    const types = { svg: 'image/svg+xml', pdf: 'application/pdf', eps: 'application/postscript', dxf: 'image/vnd.dxf', json: 'application/json' };
    return new Blob(saved.pieces, { type: types[kind] });
  } finally {
    saved.pieces = [], saved.picture = null, saved.results = null, saved.wanted = [];
  }
}

// ------- messages -------

function move(call) {
  if (!opened) return;
  call();
  settle(0);
  lastMove = performance.now();
  drawn = null;
  schedule();
}

const stateSoon = (() => { // states of moves are told ten times a second, and the last one always
  let waits = 0;
  return () => {
    if (!waits) waits = setTimeout(() => { waits = 0; if (module) told(); }, 100);
  };
})();

const calls = {
  open,
  set: (values) => { set(values); changed(); },
  restore: (words) => { working('reading', false, () => restore(words)); changed(); },
  turn: (right, down) => move(() => module._web_turn(right, down)),
  pan: (right, down) => move(() => module._web_pan(right, down)),
  zoom: (factor, right = 0, down = 0) => move(() => module._web_zoom(factor, right, down)),
  focus: (x, y) => { if (opened) module._web_focus(x, y); },
  fit: () => { module._web_fit(); changed(); },
  view: (name) => { settle(withText(name, (at) => module._web_view(at)), 'The view'); changed(); },
  project: (orthographic) => { module._web_project(orthographic ? 1 : 0); changed(); },
  resize: (width, height) => {
    size = { width: Math.max(1, Math.round(width)), height: Math.max(1, Math.round(height)) };
    module._web_resize(size.width, size.height);
    drawn = null;
    told();
    schedule();
  },
  cancel: () => {},
  save,
  pixels: () => {
    if (!opened) throw new Error('There is no picture yet');
    if (drawn !== FULL) lastMove = 0, draw(FULL);
    if (drawn !== FULL) throw new Stopped();
    return { width: size.width, height: size.height, data: pixels(size.width, size.height).slice(), hash: text(module._web_hash()) };
  },
  state: () => told(),
};
const MOVES = new Set(['turn', 'pan', 'zoom']);

let queue = Promise.resolve(); // calls are done one after the other, also those that wait for a file

async function run({ name, number, args }) {
  try {
    const value = await safely(() => calls[name](...args));
    if (MOVES.has(name)) stateSoon();
    if (number) postMessage({ answer: number, value });
  } catch (error) {
    said = [];
    post('idle');
    if (number) postMessage({ answer: number, error: error.message, stopped: error instanceof Stopped });
    if (!(error instanceof Stopped) && !number) post('message', { text: error.message, kind: 'error' });
  }
}

onmessage = ({ data }) => {
  if (data.name === 'simplify') { // this is the other worker
    import('./draft.js').then(({ simplify }) => simplify(data.mesh)).then(
      (mesh) => postMessage({ mesh }, [mesh.positions.buffer, mesh.indices.buffer, mesh.groups.buffer]),
      (error) => postMessage({ error: error.message }));
    return;
  }
  if (data.name === 'begin') {
    queue = start(data);
    return;
  }
  queue = queue.then(() => {
    moves = data.moves ?? moves, stops = data.stops ?? stops;
    return run(data);
  });
};

async function start({ base, threads, number, canvas: given, shared }) {
  try {
    canvas = given;
    context = canvas.getContext('2d');
    signals = shared ? new Int32Array(shared) : null;
    const many = threads > 1, file = many ? 'drypoint-threads' : 'drypoint';
    create = (await import(new URL(file + '.mjs', base).href)).default;
    const locate = (name) => new URL(name, base).href;
    options = { locateFile: locate, threads, poolSize: 2 * (threads - 1), mainScriptUrlOrBlob: locate(file + '.mjs') };
    await begin();
    const info = JSON.parse(text(module._web_info()));
    info.threads = threads;
    postMessage({ answer: number, value: info });
    told();
  } catch (error) {
    postMessage({ answer: number, error: 'The drawing engine could not be started: ' + error.message });
  }
}
