// A headless Chromium, over its own debugging protocol: opens pages, uses mouse, keys and fingers, and collects what the
// window writes into the console (see app/window/system/ui_log.h). Wants node 20 with --experimental-websocket.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';

export const seconds = s => new Promise(done => setTimeout(done, 1000 * s));
const now = () => performance.now() / 1000;

// Serves a folder as a host of plain files does. Returns its address.
export async function serve(folder) {
  const types = {html: 'text/html', js: 'text/javascript', wasm: 'application/wasm'};
  const server = createServer((request, answer) => {
    const path = new URL(request.url, 'http://localhost').pathname.replace(/\/$/, '/index.html');
    try {
      const bytes = readFileSync(folder + path);
      answer.writeHead(200, {'Content-Type': types[path.split('.').pop()] ?? 'application/octet-stream'}).end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise(done => server.listen(0, '127.0.0.1', done));
  server.unref();
  return `http://127.0.0.1:${server.address().port}/`;
}

// options: of Chromium, besides those that it needs here.
export async function startBrowser(...options) {
  const folder = mkdtempSync(tmpdir() + '/tyndall-page-');
  const chromium = spawn('chromium', [
    '--headless=new', '--no-sandbox', '--remote-debugging-port=0', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--window-size=1280,800', '--mute-audio', '--disable-background-networking', '--no-first-run',
    `--user-data-dir=${folder}`, ...options, 'about:blank'
  ], {stdio: ['ignore', 'ignore', 'pipe']});
  process.on('exit', () => chromium.kill());
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));
  const address = await new Promise((done, failed) => {
    let said = '';
    chromium.stderr.on('data', text => {
      said += text;
      const found = said.match(/ws:\/\/([^/]+)\//);
      if (found) done(found[1]);
    });
    chromium.on('exit', () => failed(Error('chromium ended: ' + said.slice(-2000))));
  });
  const end = async () => {
    chromium.removeAllListeners('exit'), chromium.kill();
    await new Promise(done => chromium.on('exit', done));
    for (let k = 0; k < 20; ++k) { // its children end a moment later
      try {
        return rmSync(folder, {recursive: true, force: true});
      } catch {
        await seconds(0.2);
      }
    }
  };
  return {open: url => Page.open(address, url), end};
}

export class Page {
  lines = [];          // [second since the page was asked for, text]
  widgets = new Map(); // name -> {x0, y0, x1, y1, value}
  problems = [];
  #waiting = new Map();
  #id = 0;

  static async open(address, url) {
    const page = new Page();
    const made = await (await fetch(`http://${address}/json/new?about:blank`, {method: 'PUT'})).json();
    page.address = address, page.id = made.id;
    page.socket = new WebSocket(made.webSocketDebuggerUrl);
    await new Promise(done => { page.socket.onopen = done; });
    page.socket.onmessage = ({data}) => page.#take(JSON.parse(data));
    for (const part of ['Runtime', 'Page', 'Log']) await page.call(part + '.enable');
    await page.call('Page.bringToFront');
    await page.go(url);
    return page;
  }
  async go(url) {
    this.start = now(), this.lines = [], this.widgets.clear();
    await this.call('Page.navigate', {url});
  }
  call(method, params = {}) {
    return new Promise((done, failed) => {
      this.#waiting.set(++this.#id, answer => answer.error ? failed(Error(`${method}: ${answer.error.message}`)) : done(answer.result));
      this.socket.send(JSON.stringify({id: this.#id, method, params}));
    });
  }
  async close() {
    this.socket.close();
    await fetch(`http://${this.address}/json/close/${this.id}`);
  }
  #take(message) {
    if (message.id) return this.#waiting.get(message.id)(message);
    if (message.method == 'Runtime.exceptionThrown')
      this.problems.push(JSON.stringify(message.params.exceptionDetails).slice(0, 1500));
    if (message.method != 'Runtime.consoleAPICalled') return;
    for (const line of message.params.args.map(part => String(part.value ?? part.description)).join(' ').split('\n')) {
      this.lines.push([now() - this.start, line]);
      const [, name, x0, y0, x1, y1, value] = line.match(/^widget (\S+) (\S+) (\S+) (\S+) (\S+) (.*)/) ?? [];
      if (name) this.widgets.set(name, {x0: +x0, y0: +y0, x1: +x1, y1: +y1, value});
    }
  }

  async evaluate(expression) {
    const {result, exceptionDetails} = await this.call('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  words() { return this.evaluate('document.getElementById("words")?.textContent ?? ""'); }
  async shot(file) {
    const {data} = await this.call('Page.captureScreenshot', file.endsWith('.jpg') ? {format: 'jpeg', quality: 75} : {format: 'png'});
    writeFileSync(file, Buffer.from(data, 'base64'));
  }
  async until(what, test, longest = 60) {
    for (const end = now() + longest; now() < end;) {
      const found = await test();
      if (found) return found;
      await seconds(0.05);
    }
    throw Error(`not seen in ${longest} s: ${what}; the page says "${await this.words()}"; last lines:\n` +
        [...this.lines.slice(-8).map(([, line]) => line), ...this.problems].join('\n'));
  }
  // [second, edit, samples a pixel, step, latency in ms, ms of the renderer] of the pictures shown since that line
  frames(from = 0) {
    return this.lines.slice(from).filter(([, line]) => line.startsWith('frame '))
        .map(([second, line]) => [second, ...line.split(' ').slice(1).map(Number)]);
  }
  said(pattern, from = 0) { return this.lines.slice(from).find(([, line]) => pattern.test(line))?.[1]; }
  picture(from = 0) { return this.until('a picture', () => this.frames(from)[0]); }
  settled(from = 0) { return this.until('a whole picture', () => this.frames(from).find(frame => frame[2] >= 1)); }

  mouse(type, x, y, buttons = 0) {
    const moves = type == 'mouseMoved';
    return this.call('Input.dispatchMouseEvent',
        {type, x, y, buttons, button: moves && !buttons ? 'none' : 'left', clickCount: moves ? 0 : 1});
  }
  async click(x, y) {
    await this.mouse('mouseMoved', x, y), await seconds(0.1);
    await this.mouse('mousePressed', x, y, 1), await seconds(0.1), await this.mouse('mouseReleased', x, y);
  }
  async drag(x0, y0, x1, y1, steps = 60) {
    await this.mouse('mouseMoved', x0, y0), await seconds(0.2);
    await this.mouse('mousePressed', x0, y0, 1);
    for (let k = 0; k <= steps; ++k) {
      await this.mouse('mouseMoved', x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps, 1);
      await seconds(0.033);
    }
    await this.mouse('mouseReleased', x1, y1), await seconds(1);
  }
  async key(key, code, number, modifiers = 0) {
    const text = modifiers == 0 && key.length == 1 ? key : undefined;
    await this.call('Input.dispatchKeyEvent', {type: text ? 'keyDown' : 'rawKeyDown', key, code, text, windowsVirtualKeyCode: number, modifiers});
    await seconds(0.15);
    await this.call('Input.dispatchKeyEvent', {type: 'keyUp', key, code, windowsVirtualKeyCode: number, modifiers});
    await seconds(0.15);
  }
  async control(letter) {
    const key = {key: 'Control', code: 'ControlLeft', windowsVirtualKeyCode: 17};
    await this.call('Input.dispatchKeyEvent', {type: 'rawKeyDown', modifiers: 2, ...key}), await seconds(0.15);
    await this.key(letter, 'Key' + letter.toUpperCase(), letter.toUpperCase().charCodeAt(0), 2);
    await this.call('Input.dispatchKeyEvent', {type: 'keyUp', ...key}), await seconds(0.15);
  }
  async type(text) {
    for (const letter of text) await this.key(letter, '', letter.toUpperCase().charCodeAt(0));
  }
  touch(type, ...points) {
    return this.call('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  }
  // By the palette: what it is called, as far as it is typed.
  async command(name) {
    await this.control('k'), await seconds(0.5);
    await this.type(name), await seconds(0.3);
    await this.key('Enter', 'Enter', 13), await seconds(0.3);
  }
}

// The median of the pictures' latencies, ms, each edit once.
export function latency(frames) {
  const edits = new Map();
  for (const frame of frames) if (!edits.has(frame[1])) edits.set(frame[1], frame[4]);
  const all = [...edits.values()].sort((a, b) => a - b);
  return {count: all.length, median: all[Math.floor(all.length / 2)]};
}
