// node --experimental-websocket page.mjs TYNDALL FOLDER SHOTS [NAME...]: the page in FOLDER, used in a headless Chromium as a
// user would; screenshots go to SHOTS. TYNDALL is a native program, which must find the same. NAME: only these tests.
import {execFileSync, spawnSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync} from 'node:fs';

import {latency, seconds, serve, startBrowser} from './browser.mjs';

const [tyndall, folder, shots, ...names] = process.argv.slice(2);
const assets = new URL('../../assets', import.meta.url).pathname;
const site = await serve(folder), browser = await startBrowser();
const address = what => `${site}?log#${what}`;

function expect(what, found, wanted = true) {
  if (found !== wanted) throw Error(`${what}: found ${JSON.stringify(found)}, expected ${JSON.stringify(wanted)}`);
}
const centre = ({x0, y0, x1, y1}) => [(x0 + x1) / 2, (y0 + y1) / 2];
const widget = (page, name) => page.until(name, () => page.widgets.get(name));

// Drops files, as a user does from a folder: [name, bytes].
const drop = (page, ...files) => page.evaluate(`(() => {
  const list = new DataTransfer();
  for (const [name, text] of ${JSON.stringify(files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]))})
    list.items.add(new File([Uint8Array.from(atob(text), c => c.charCodeAt(0))], name));
  Module.canvas.dispatchEvent(new DragEvent('drop', {dataTransfer: list, bubbles: true, cancelable: true}));
})()`);
// Opens the page, waits for a whole picture, and closes it after use.
async function withPage(what, use) {
  const page = await browser.open(address(what));
  await page.settled();
  await use(page);
  await page.close();
}
const memory = page => page.evaluate('Module.wasmMemory.buffer.byteLength / 1e6');
const hashOf = png => readFileSync(png, 'latin1').match(/"image_hash": ?"([0-9a-f]+)"/)[1];

// Waits for a download, and returns its file.
async function download(page, name, act) {
  await page.call('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: shots});
  rmSync(`${shots}/${name}`, {force: true});
  await act();
  await page.until(name, () => existsSync(`${shots}/${name}`), 90);
  return `${shots}/${name}`;
}

const tests = {
  async opens() {
    for (const scene of ['cornell-box', 'showroom']) {
      const page = await browser.open(address(scene)), first = await page.picture();
      console.log(`${scene}: first picture after ${first[0].toFixed(2)} s, a whole one after ${(await page.settled())[0].toFixed(2)} s`);
      expect('isolated', await page.evaluate('crossOriginIsolated'));
      expect('words', await page.words(), '');
      await seconds(8), await page.shot(`${shots}/${scene}.jpg`);
      await page.close();
    }
  },

  drags: () => withPage('showroom', async page => {
    for (const name of ['gold.fuzz', 'glass.refractive_index', 'Fog.density']) {
      const {x0, y0, x1, value} = await widget(page, name), from = page.lines.length;
      await page.drag(x0 + 5, y0 + 8, x1 - 5, y0 + 8);
      const {count, median} = latency(page.frames(from));
      console.log(`${name}: ${count} edits shown, median ${median} ms; ${value} -> ${page.widgets.get(name).value}`);
      expect(name + ' shows many edits', count > 15);
      expect(name + ' has changed', page.widgets.get(name).value != value);
      await page.shot(`${shots}/drag-${name}.png`);
    }
    const from = page.lines.length;
    await page.drag(400, 300, 580, 360);
    const {count, median} = latency(page.frames(from));
    console.log(`camera: ${count} edits shown, median ${median} ms`);
    expect('camera shows many edits', count > 15);
    await page.shot(`${shots}/drag-camera.png`);
  }),

  async snapshot() {
    const page = await browser.open(address('cornell-smoke'));
    await page.settled();
    const file = await download(page, 'cornell-smoke-001.png', () => page.control('p'));
    const spp = readFileSync(file, 'latin1').match(/"spp": ?(\d+)/)[1];
    execFileSync(tyndall, ['render', file, '--spp', spp, '-o', `${shots}/again.png`], {stdio: 'ignore'});
    expect('hash of the snapshot, rendered again', hashOf(file), hashOf(`${shots}/again.png`));
    await page.close();

    await withPage('cornell-box', async page => {
      await drop(page, ['mine.png', readFileSync(file)]);
      await page.until('the snapshot\'s scene', () => page.said(/^message .*mine\.png/));
    });
  },

  saves: () => withPage('cornell-box', async page => {
    const file = await download(page, 'cornell-box.json', async () => {
      await page.control('s'), await seconds(1), await page.key('Enter', 'Enter', 13);
    });
    execFileSync(tyndall, ['inspect', file], {stdio: 'ignore'});
  }),

  drops: () => withPage('cornell-box', async page => {
    const from = page.lines.length;
    await drop(page, ['mine.json', readFileSync(assets + '/scenes/quads.json')]);
    await page.until('the message', () => page.said(/^message .*opened mine\.json/, from));
    await page.picture(from), await seconds(2), await page.shot(`${shots}/dropped.png`);
    await drop(page, ['bad.json', '{"camera": 1}']);
    await page.until('what is wrong', () => page.said(/^message .*found no "tyndall"/, from));
  }),

  async links() {
    const page = await browser.open(address('showroom'));
    await page.settled();
    const {x0, y0} = await widget(page, 'gold.fuzz');
    await page.drag(x0 + 5, y0 + 8, x0 + 60, y0 + 8, 5);
    const copied = async from => {
      await from.command('copy a link');
      return from.until('a link', () => from.evaluate('Module.pasted'));
    };
    const link = await copied(page), fuzz = page.widgets.get('gold.fuzz').value;
    expect('a link', /#z=[\w-]{100,}$/.test(link));
    await page.close();
    const other = await browser.open(address(link.split('#')[1]));
    await other.picture();
    expect('fuzz of the linked scene', (await widget(other, 'gold.fuzz')).value, fuzz);
    expect('its own link', await copied(other), link);
    await other.close();
    await withPage('earth', async page => {
      await seconds(2), await page.shot(`${shots}/earth.png`);
    });
  },

  async tabs() {
    const page = await browser.open(address('showroom'));
    await page.settled();
    const {x0, y0} = await widget(page, 'gold.fuzz');
    await page.drag(x0 + 5, y0 + 8, x0 + 60, y0 + 8, 5);
    const edited = page.widgets.get('gold.fuzz').value;
    await seconds(2);
    const beside = await browser.open(address('showroom'));
    await beside.settled();
    expect('the other tab has edits of its own', (await widget(beside, 'gold.fuzz')).value != edited);
    await beside.close(), await page.close();
    const later = await browser.open(address('showroom'));
    await later.until('the edits', () => later.said(/^message .*restored the edits/));
    await later.until('their value', () => later.widgets.get('gold.fuzz')?.value == edited);
    await later.control('z'), await seconds(2);
    await later.close();
  },

  async preferences() {
    const page = await browser.open(address('cornell-box'));
    await page.settled();
    await page.command('dark or light theme');
    await seconds(2), await page.close();
    const later = await browser.open(address('cornell-box'));
    await later.settled();
    await later.shot(`${shots}/light.png`);
    expect('the storage', /theme light/.test(await later.evaluate('localStorage["tyndall preferences"]')));
    await later.command('dark or light theme');
    await seconds(2), await later.close();
  },

  looks_closer: () => withPage('showroom', async page => {
    await page.click(...centre(await widget(page, 'tab.Scenes')));
    await page.until('the scenes', () => [...page.widgets.keys()].some(name => name.includes('cornell-box')), 10);
    await seconds(4), await page.shot(`${shots}/scenes.png`);
    await page.command('inspect pixels'), await page.mouse('mouseMoved', 450, 350);
    await seconds(1), await page.shot(`${shots}/inspector.png`);
    await page.command('split view');
    await page.until('both halves', () => page.frames().at(-1)[2] > 2);
    await seconds(2), await page.shot(`${shots}/split.png`);
  }),

  resizes: () => withPage('cornell-box', async page => {
    const resize = (width, height, deviceScaleFactor) => page.call('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor, mobile: false});
    for (const [width, height, density] of [[900, 600, 1], [700, 500, 2], [1280, 720, 1]]) {
      await resize(width, height, density);
      await page.until('the size', () => page.said(new RegExp(`^size ${width * density} ${height * density}`)));
      await seconds(1), await page.shot(`${shots}/size-${width}x${height}@${density}.png`);
    }
  }),

  async wrong_scenes() {
    const said = (what, input) => spawnSync(tyndall, ['inspect', what], {input}).stderr.toString().trim().replace(/^tyndall: /, '');
    const bad = '{"camera": 1}', link = 'the page\'s address: found a part of a link, or a changed one, expected a link that Tyndall has copied';
    const cases = {nonsense: said('nonsense'), [bad]: said('-', bad).replace(/^[^:]*/, 'the page\'s address'), 'z=AAAA': link};
    for (const [what, sentence] of Object.entries(cases)) {
      const page = await browser.open(address(what));
      const words = await page.until('words', async () => /found/.test(await page.words()) && page.words());
      expect('the sentence', words, sentence);
      await page.close();
    }
  },

  async missing() {
    const lacks = {
      'WebGL 2': 'HTMLCanvasElement.prototype.getContext = () => null',
      'SIMD': 'WebAssembly.validate = () => false',
      'threads': 'Object.defineProperty(window, "crossOriginIsolated", {value: false}); Object.defineProperty(navigator, "serviceWorker", {value: undefined})',
      'memory': 'WebAssembly.Memory = class { constructor() { throw RangeError("none"); } }',
    };
    for (const [what, source] of Object.entries(lacks)) {
      const page = await browser.open('about:blank');
      await page.call('Page.addScriptToEvaluateOnNewDocument', {source});
      await page.go(address('cornell-box'));
      const words = await page.until('words', async () => (await page.words()).includes(what) && page.words(), 20);
      console.log(`without ${what}: ${words}`);
      await page.close();
    }
  },

  touches: () => withPage('showroom', async page => {
    await page.call('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 2});
    const gesture = async (name, count, points) => {
      const from = page.lines.length;
      await page.touch('touchStart', ...points(0));
      for (let k = 1; k <= 20; ++k) await page.touch('touchMove', ...points(k)), await seconds(0.03);
      await page.touch('touchEnd'), await seconds(1);
      const submits = page.lines.slice(from).filter(([, line]) => line.startsWith('submit ')).length;
      expect(`${name}: edits`, submits >= count);
      await page.shot(`${shots}/touch-${name}.png`);
    };
    await gesture('orbit', 3, k => [[400 + 5 * k, 300]]);
    await gesture('zoom', 3, k => [[400 - 3 * k, 300], [500 + 3 * k, 300]]);
    await gesture('pan', 3, k => [[400, 300 + 4 * k], [500, 300 + 4 * k]]);
    const {x0, y0, value} = await widget(page, 'gold.fuzz');
    await gesture('slider', 3, k => [[x0 + 8 + 4 * k, y0 + 10]]);
    expect('fuzz has changed', page.widgets.get('gold.fuzz').value != value);
  }),

  hides: () => withPage('cornell-box', async page => {
    const hide = hidden => page.evaluate(`Object.defineProperty(document, 'hidden', {value: ${hidden}, configurable: true});
        document.dispatchEvent(new Event('visibilitychange'))`);
    await hide(true), await seconds(1);
    const from = page.lines.length, before = page.frames().at(-1)[2];
    await seconds(8), await hide(false);
    const after = (await page.picture(from))[2];
    console.log(`a tab with ${before} samples a pixel has ${after} when it is seen again`);
    expect('a hidden tab takes no samples', after <= before + 4);
    await page.until('more samples', () => page.frames().at(-1)[2] > after, 10);
  }),

  memory: () => withPage('cornell-box', async page => {
    const scenes = execFileSync(tyndall, ['scenes']).toString().match(/^[a-z][\w-]*/gm).slice(0, 20), sizes = [];
    for (const scene of scenes) {
      const from = page.lines.length;
      await drop(page, [scene + '.json', readFileSync(`${assets}/scenes/${scene}.json`)]);
      await page.until(scene, () => page.said(new RegExp(`^message .*${scene}`), from));
      await page.settled(from), await page.drag(400, 300, 450, 320, 10);
      sizes.push(Math.round(await memory(page)));
    }
    console.log(`memory after each of ${sizes.length} scenes, MB: ${sizes.join(' ')}`);
    expect('memory below 1 GB', sizes.at(-1) < 1000);
  }),
};

mkdirSync(shots, {recursive: true});
let failures = 0;
for (const [name, test] of Object.entries(tests)) {
  if (names.length && !names.includes(name)) continue;
  const start = performance.now();
  try {
    await test();
    console.log(`${name}: passed in ${((performance.now() - start) / 1000).toFixed(0)} s`);
  } catch (error) {
    ++failures;
    console.log(`${name}: FAILED: ${error.message}`);
  }
}
await browser.end();
process.exit(failures ? 1 : 0);
