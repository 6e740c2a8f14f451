// What the window needs of the browser, before it runs and while it does: Module is what emscripten's script and main.cpp
// call. Files are in the memory of the page: what comes into /saved becomes a download, and what is to be found again at
// the next visit is copied into the browser's storage.
const canvas = document.getElementById('canvas');
const say = text => { document.getElementById('words').textContent = text; };
const stop = why => say(`Tyndall has stopped (${why.message ?? why}): load the page again, and take a smaller picture if memory was short.`);
addEventListener('error', event => stop(event));

// ---- what is missing ---------------------------------------------------------------------------------------------
const simd = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
const exceptions = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11];
const runs = code => typeof WebAssembly == 'object' && WebAssembly.validate(new Uint8Array(code));

function memory() {
  try {
    return new WebAssembly.Memory({initial: @INITIAL_PAGES@, maximum: @MAXIMUM_PAGES@, shared: true});
  } catch {
    return null;
  }
}

// A sentence; '': the page has all that it needs.
function missing() {
  // The window's own: emscripten's script gets the same, and a second one would take another second.
  if (!canvas.getContext('webgl2', {alpha: false, antialias: false, depth: false, stencil: false}))
    return 'Tyndall draws with WebGL 2, which this browser does not offer: allow it to use the graphics card in its ' +
        'settings, or take a newer browser.';
  if (!runs(simd) || !runs(exceptions))
    return 'Tyndall computes with WebAssembly\'s SIMD and exceptions, which this browser does not have: take Chrome or ' +
        'Edge 95, Firefox 100, Safari 16.4, or a newer one.';
  if (!crossOriginIsolated)
    return 'Tyndall renders with threads, which browsers give only to pages that come over https, or from this machine, ' +
        'and that may use a service worker: open the page there, in a window that is not private.';
  Module.wasmMemory = memory();
  return Module.wasmMemory ? '' :
      'Tyndall wants 256 MB of memory, which this browser does not give: close other pages, and load this one again.';
}

// The next load of the page goes through the service worker, which makes it an isolated one.
async function isolate() {
  const workers = crossOriginIsolated ? null : navigator.serviceWorker;
  if (!workers || workers.controller || !await workers.register('isolate.js').catch(() => null)) return;
  await workers.ready;
  location.reload();
  await new Promise(() => {});
}

// The program, compiled on other threads while the rest goes on.
async function compile() {
  const answer = await fetch('tyndall_page.wasm');
  if (!answer.ok) throw Error(`tyndall_page.wasm: ${answer.status} ${answer.statusText}`);
  const type = answer.headers.get('Content-Type'), streams = type == 'application/wasm' && WebAssembly.compileStreaming;
  return streams ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

// ---- files -------------------------------------------------------------------------------------------------------
const saved = '/saved', state = '/home/.local/state/tyndall', preferences = '/home/.config/tyndall/window.txt';
const tab = Date.now().toString(36) + Math.random().toString(36).slice(2);
const storage = (() => {
  try {
    return localStorage;
  } catch { // the user has forbidden it: nothing is found again
    return {};
  }
})();
const stored = new Map(); // files of the browser's storage, by name, and their traces when they were copied
const seen = new Map();   // files in `saved`, and their traces; those that were given to the user have given = true

const traceOf = file => {
  const status = FS.stat(file);
  return status.size + ' ' + +status.mtime;
};
const namesIn = folder => FS.analyzePath(folder).exists ? FS.readdir(folder).filter(name => !name.startsWith('.')) : [];

// Edits that were not saved belong to a tab as long as it has its lock, and then to the next one that is opened.
async function takeOver() {
  await navigator.locks.request('tyndall', async () => {
    await new Promise(held => navigator.locks.request('tyndall ' + tab, () => (held(), new Promise(() => {}))));
    const alive = new Set((await navigator.locks.query()).held.map(lock => lock.name));
    let count = 0;
    for (const key of Object.keys(storage).sort()) {
      const [ours, owner, name] = key.split(' ');
      if (ours != 'tyndall' || !name || alive.has(`tyndall ${owner}`)) continue;
      const text = storage[key];
      delete storage[key];
      storage[`tyndall ${tab} unsaved-${++count}.json`] = text;
    }
  });
}

function unpackStorage() {
  for (const folder of [saved, state, preferences.replace(/\/[^/]*$/, '')]) FS.mkdirTree(folder);
  for (const key of Object.keys(storage)) {
    const [ours, owner, name] = key.split(' ');
    const file = owner == 'preferences' ? preferences : owner == tab ? `${state}/${name}` : '';
    if (ours != 'tyndall' || !file) continue;
    FS.writeFile(file, storage[key]);
    stored.set(key, traceOf(file));
  }
}

function store() {
  const files = new Map(namesIn(state).filter(name => /^unsaved-\d+\.json$/.test(name)).map(
      name => [`tyndall ${tab} ${name}`, `${state}/${name}`]));
  if (FS.analyzePath(preferences).exists) files.set('tyndall preferences', preferences);
  for (const [key, file] of files) {
    const trace = traceOf(file);
    if (stored.get(key) == trace) continue;
    stored.set(key, trace);
    try {
      storage[key] = FS.readFile(file, {encoding: 'utf8'});
    } catch (error) { // the edits are too long for it
      console.warn(`${file} is not kept: ${error.message}`);
    }
  }
  for (const key of stored.keys())
    if (!files.has(key)) delete storage[key], stored.delete(key);
}

// Gives the user what was saved, once it is no longer written to.
function giveFiles() {
  for (const name of namesIn(saved)) {
    const trace = traceOf(`${saved}/${name}`), before = seen.get(name);
    if (before?.trace == trace && !before.given) {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([FS.readFile(`${saved}/${name}`)]));
      link.download = name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    }
    seen.set(name, {trace, given: before?.trace == trace});
  }
}

async function openFiles(files) {
  const names = [];
  for (const file of files) {
    const name = file.name.replaceAll('/', '_');
    FS.writeFile(`${saved}/${name}`, new Uint8Array(await file.arrayBuffer()));
    seen.set(name, {trace: traceOf(`${saved}/${name}`), given: true});
    names.push(name);
  }
  const scenes = names.filter(name => name.endsWith('.json')); // the others are their textures
  for (const name of scenes.length ? scenes : names) Module.open(`${saved}/${name}`);
}

// A file of the page's folder that is fetched when it is read.
function offer(name, size) {
  let bytes = null;
  const node = FS.createDataFile('/assets/textures', name, new Uint8Array(0), true, false);
  const contents = () => {
    if (bytes) return bytes;
    const request = new XMLHttpRequest();
    request.open('GET', 'textures/' + name, false);
    request.overrideMimeType('text/plain; charset=x-user-defined');
    request.send();
    return bytes = Uint8Array.from(request.responseText, letter => letter.charCodeAt(0));
  };
  Object.defineProperties(node, {contents: {get: contents}, usedBytes: {get: () => size}});
}

// ---- what emscripten's script and main.cpp call --------------------------------------------------------------------
let compiled = null; // a promise
var Module = {
  canvas, pasted: '', tell: say,
  print: text => console.log(text),
  printErr: text => console.warn(text),
  scene: () => {
    try {
      return decodeURIComponent(location.hash.slice(1));
    } catch { // a % that is none of the address's
      return location.hash.slice(1);
    }
  },
  copy: text => {
    Module.pasted = text;
    navigator.clipboard?.writeText(text).catch(error => console.warn('clipboard: ' + error.message));
  },
  onAbort: stop,
  preRun: [
    () => {
      ENV.HOME = '/home';
      unpackStorage();
      FS.mkdirTree('/assets/textures');
      for (const [name, size] of [@TEXTURES@]) offer(name, size);
    }
  ],
  instantiateWasm: (imports, done) => {
    compiled.then(async module => done(await WebAssembly.instantiate(module, imports), module)).catch(stop);
    return {};
  },
  onRuntimeInitialized: () => {
    setInterval(() => (store(), giveFiles()), 500);
    addEventListener('pagehide', store);
  },
};

// ---- keys, fingers, and files that are dropped -----------------------------------------------------------------------
addEventListener('keydown', event => { // those that browsers do something else with
  const chord = (event.ctrlKey || event.metaKey) && /^[abdkopqsyz+=0-]$/i.test(event.key);
  if (chord || /^F([12]|11)$/.test(event.key)) event.preventDefault();
}, true);
addEventListener('paste', event => { Module.pasted = event.clipboardData.getData('text'); });
addEventListener('hashchange', () => location.reload());
canvas.addEventListener('contextmenu', event => event.preventDefault());
canvas.addEventListener('pointerdown', event => {
  canvas.focus();
  if (event.pointerType == 'mouse') canvas.setPointerCapture(event.pointerId); // also outside of the page
});
canvas.addEventListener('webglcontextlost', () => say('The browser has taken the graphics away: load the page again.'));
addEventListener('dragover', event => event.preventDefault());
addEventListener('drop', event => {
  event.preventDefault(), event.stopImmediatePropagation();
  if (Module.open) openFiles(event.dataTransfer.files);
}, true);

// One finger is the mouse with its left button. Two pan as with its middle button, and zoom as its wheel.
const touch = {fingers: 0, x: 0, y: 0, span: 0, button: -1};
const mouse = (type, button = 0) =>
    canvas.dispatchEvent(new MouseEvent(type, {clientX: touch.x, clientY: touch.y, button, bubbles: true}));
function press(button) {
  if (touch.button == button) return;
  if (touch.button >= 0) mouse('mouseup', touch.button);
  touch.button = button;
  if (button >= 0) mouse('mousemove'), mouse('mousedown', button);
}
function onTouch(event) {
  event.preventDefault(), event.stopImmediatePropagation();
  const [a, b] = event.touches;
  if (!a) {
    if (touch.fingers == 1) press(0); // a tap
    press(-1), touch.fingers = 0;
    return;
  }
  const x = b ? (a.clientX + b.clientX) / 2 : a.clientX, y = b ? (a.clientY + b.clientY) / 2 : a.clientY;
  const span = b ? Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY) : 0;
  if (event.touches.length != touch.fingers) { // the place jumps: a new gesture
    if (touch.button >= 0) press(-1);
    Object.assign(touch, {fingers: event.touches.length, x, y, span});
    return;
  }
  const moves = touch.button >= 0 || Math.hypot(x - touch.x, y - touch.y) >= 4; // else it is a tap, or a zoom alone
  if (moves) press(b ? 1 : 0), Object.assign(touch, {x, y});
  if (moves || b) mouse('mousemove');
  if (!b) return;
  const notches = Math.log(touch.span / span) / Math.log(0.9);
  touch.span = span;
  canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -100 * notches, clientX: x, clientY: y, bubbles: true, cancelable: true}));
}
for (const type of ['touchstart', 'touchmove', 'touchend', 'touchcancel'])
  canvas.addEventListener(type, onTouch, {capture: true, passive: false});

// ---- begin -----------------------------------------------------------------------------------------------------------
(async () => {
  await isolate();
  compiled = compile();
  const why = missing();
  if (why) return say(why);
  await takeOver();
  const script = document.createElement('script');
  script.src = 'tyndall_page.js';
  script.onerror = () => say('tyndall_page.js cannot be loaded: the page\'s folder is not whole.');
  document.body.append(script);
})().catch(stop);
