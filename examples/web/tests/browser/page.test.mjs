// The page in a real Chromium, by its real controls.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';

import { chromium } from 'playwright-core';

import { here } from '../../scripts/run.mjs';
import { serve } from '../../scripts/serve.mjs';
import golden from '../../page/src/golden.json' with { type: 'json' };

const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';
// Software rendering: there is no graphics card where CI runs.
const ARGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** The names of the golden scenes. */
const LINES = readFileSync(here('../cases/golden.txt'), 'utf8').trim().split('\n');
const SCENES = [...new Set(LINES.map((line) => line.split(' ').slice(0, 2).join(' ')))];

let server, browser, page, address;
const complaints = [];

async function open(options = {}) {
  const opened = await browser.newPage({ viewport: { width: 1200, height: 780 }, ...options });
  opened.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !/GPU stall|swiftshader/i.test(message.text())) complaints.push(message.text());
  });
  opened.on('pageerror', (error) => complaints.push(error.message));
  opened.on('request', (request) => {
    if (!request.url().startsWith(address) && !request.url().startsWith('data:')) complaints.push(`asked for ${request.url()}`);
  });
  await opened.goto(address);
  await opened.waitForSelector('#loading', { state: 'hidden' });
  return opened;
}

before(async () => {
  server = await serve(here('dist'), 0);
  address = `http://127.0.0.1:${server.address().port}/`;
  browser = await chromium.launch({ executablePath: CHROMIUM, args: ARGS });
  page = await open();
});

after(async () => {
  await browser?.close();
  server?.close();
  assert.deepEqual(complaints, [], 'no errors, warnings or foreign requests');
});

const text = (selector) => page.textContent(selector);
const steps = async () => Number(await text('#step'));
const picture = () => page.locator('#view').screenshot();
/** What the right legend says of the distance between both bodies, in per cent of their size. */
const apart = async () => Number(/([\d.e+-]+) % apart/.exec(await text('#says-b'))[1]);
const number = async (id, value) => {
  await page.fill(`#${id}-field`, String(value));
  await page.press(`#${id}-field`, 'Enter');
  await page.locator(`#${id}-field`).blur();
};
const until = async (what, condition, seconds = 20) => {
  const end = Date.now() + 1000 * seconds;
  while (!(await condition())) {
    assert.ok(Date.now() < end, `${what}: not within ${seconds} s`);
    await page.waitForTimeout(50);
  }
};
const pause = async () => {
  if ((await text('#play')) === 'Pause') await page.click('#play');
};
/** Steps one by one, so that both bodies are where they are on any machine. */
const press = async (times) => {
  for (let k = 0; k < times; k++) await page.click('#once');
};

test('a body moves: step by step, other pixels', async () => {
  await until('steps', async () => (await steps()) > 10);
  const [first, at] = [await picture(), await steps()];
  await until('more steps', async () => (await steps()) > at + 10);
  assert.notDeepEqual(await picture(), first);
  await pause();
  const [still, hash] = [await picture(), await text('#hash')];
  await page.waitForTimeout(300);
  assert.deepEqual(await picture(), still, 'paused, the picture stands');
  await page.click('#once');
  assert.notEqual(await text('#hash'), hash);
});

test('dragging moves it, and where it is pinned it stays', async () => {
  await page.click('#reset');
  await pause();
  const hash = await text('#hash');
  const box = await page.locator('#view').boundingBox();
  const at = [box.x + box.width * 0.25, box.y + box.height * 0.4];
  const drag = async () => {
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0] - 60, at[1] - 140, { steps: 4 });
    for (let k = 0; k < 31; k++) await page.keyboard.press('.');
  };
  await page.locator('#view').focus();
  const before = await picture();
  await drag();
  await page.mouse.up();
  const dragged = await text('#hash');
  assert.notDeepEqual(await picture(), before);

  await page.click('#reset');
  await page.locator('#view').focus();
  for (let k = 0; k < 31; k++) await page.keyboard.press('.');
  assert.notEqual(await text('#hash'), dragged, 'without the hand it goes elsewhere');
  assert.notEqual(dragged, hash);

  await page.click('#reset');
  await page.click('#pin');
  assert.equal(await page.getAttribute('#pin', 'aria-pressed'), 'true');
  await page.mouse.click(...at);
  await page.click('#pin');
  await page.locator('#view').focus();
  for (let k = 0; k < 31; k++) await page.keyboard.press('.');
  const pinned = await text('#hash');
  await page.click('#unpin');
  await page.click('#reset');
  await page.locator('#view').focus();
  for (let k = 0; k < 31; k++) await page.keyboard.press('.');
  assert.notEqual(await text('#hash'), pinned);
});

test('throw and drop do what they say; the keyboard does, too', async () => {
  await page.click('#reset');
  await pause();
  await press(5);
  const fallen = await text('#hash');
  await page.click('#reset');
  await page.click('#throw');
  await press(5);
  const thrown = await text('#hash');
  assert.notEqual(thrown, fallen);
  await page.click('#drop');
  assert.equal(await steps(), 0);
  await page.locator('#view').focus();
  await page.keyboard.press('r');
  await page.keyboard.press('t');
  for (let k = 0; k < 5; k++) await page.keyboard.press('.');
  assert.equal(await text('#hash'), thrown, 'the same keys, the same bits');
  await page.keyboard.press('r');
  await page.keyboard.press('g');
  for (let k = 0; k < 4; k++) await page.keyboard.press('ArrowUp');
  for (let k = 0; k < 5; k++) await page.keyboard.press('.');
  assert.notEqual(await text('#hash'), fallen, 'the keyboard holds it');
  await page.keyboard.press('g');
  await page.keyboard.press(' ');
  assert.equal(await text('#play'), 'Pause');
});

test('every control changes what it says, and the bits that follow', async () => {
  await pause();
  const run = async () => {
    await page.selectOption('#body', 'cube');
    await page.selectOption('#mode', 'budget');
  };
  /** Thrown and spinning, so that all settings matter. */
  const moved = async () => {
    await page.click('#throw');
    await press(6);
  };
  const numbers = { 'iterations-a': 2, 'sweeps-a': 1, 'iterations-b': 3, 'sweeps-b': 4, young: 5e4, poisson: 0.2, density: 300, beta: 0.01, dt: 5, gravity: 3 };
  const choices = { 'start-a': 'zero', 'start-b': 'galerkin-2', 'preconditioner-a': 'factor', 'preconditioner-b': 'two-level' };
  await run();
  await moved();
  const usual = await text('#hash');
  for (const [id, value] of Object.entries(numbers)) {
    await run();
    const said = await text(`#says-${id}`);
    await number(id, value);
    assert.notEqual(await text(`#says-${id}`), said, id);
    assert.equal(Number(await page.inputValue(`#${id}-field`)), value);
    await moved();
    if (!id.endsWith('-b') && id !== 'sweeps-a') assert.notEqual(await text('#hash'), usual, id);
    await page.selectOption('#body', 'snowman');
  }
  for (const [id, value] of Object.entries(choices)) {
    await run();
    const said = await text(`#says-${id}`);
    await page.selectOption(`#${id}`, value);
    assert.notEqual(await text(`#says-${id}`), said, id);
    await moved();
    if (!id.endsWith('-b')) assert.notEqual(await text('#hash'), usual, id);
    await page.selectOption('#body', 'snowman');
  }
  const slider = page.locator('#iterations-a');
  await slider.focus();
  const said = await text('#says-iterations-a');
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await text('#says-iterations-a'), said);
  for (const body of ['cube', 'beam', 'tower', 'snowman']) {
    const before = await text('#says-body');
    await page.selectOption('#body', body);
    assert.notEqual(await text('#says-body'), before, body);
  }
});

test('absurd settings are refused with words, and nothing changes', async () => {
  await page.selectOption('#body', 'cube');
  await pause();
  const absurd = {
    'iterations-a': [['1e9', /iterations 1000000000 must be at most/], ['-3', /whole number/], ['2.5', /whole number/]],
    young: [['0', /Young's modulus 0 must be positive/], ['-5', /positive/], ['lots', /not a number/]],
    poisson: [['0.5', /Poisson's ratio 0.5/], ['7', /below 0.5/]],
    density: [['0', /density 0 must be positive/]],
    beta: [['-1', /must be finite and not negative/]],
    dt: [['0', /time step 0 must be positive/], ['', /not a number/]],
    gravity: [['1e300', /finite/]],
  };
  for (const [id, tries] of Object.entries(absurd)) {
    for (const [value, message] of tries) {
      const said = await text(`#says-${id}`);
      await number(id, value);
      const refused = page.locator('.control', { has: page.locator(`#${id}`) }).locator('.refused');
      assert.match(await refused.textContent(), message, `${id} = ${value}`);
      assert.equal(await text(`#says-${id}`), said);
      assert.equal(await page.getAttribute(`#${id}-field`, 'aria-invalid'), 'true');
    }
    await page.selectOption('#body', 'snowman');
    await page.selectOption('#body', 'cube');
    assert.equal(await page.getAttribute(`#${id}-field`, 'aria-invalid'), null);
  }
  const at = await steps();
  await press(2);
  assert.equal(await steps(), at + 2, 'it steps on');
});

test('the error falls when iterations rise', async () => {
  await page.selectOption('#body', 'beam');
  await page.selectOption('#mode', 'converged');
  await pause();
  const errors = [];
  for (const iterations of [1, 10, 60]) {
    await page.click('#reset');
    await number('iterations-a', iterations);
    await press(60);
    errors.push(await apart());
  }
  assert.ok(errors[0] > 2 * errors[1] && errors[1] > 2 * errors[2], errors.join(' > '));
});

test('this browser gives the committed bits', async () => {
  await page.click('#check');
  await until('a verdict', async () => /gives|did not/.test(await text('#verdict')), 60);
  assert.equal(
    await text('#verdict'),
    `This browser gives the committed bits: ${golden.hashes.at(-1)[1]} after ${golden.steps} steps, and those of all ${SCENES.length} golden scenes, with both modules.`,
  );
  assert.deepEqual(await page.locator('#scenes li').allTextContents(), SCENES.map((name) => `${name}: the same`));
});

test('both modules give the same bits on the page, and the mark appears', async () => {
  const marks = [];
  for (const module of ['plain', 'simd']) {
    await page.selectOption('#module', module);
    await page.selectOption('#body', 'cube');
    await page.selectOption('#mode', 'single');
    await page.click('#reset');
    if ((await text('#play')) === 'Play') await page.click('#play');
    await until('the mark', async () => /after 300 steps/.test(await text('#mark')), 60);
    marks.push(await text('#mark'));
    await pause();
  }
  assert.equal(marks[0], marks[1]);
});

test('an hour ahead: finite, and no memory is lost', async () => {
  await page.selectOption('#body', 'cube');
  await page.selectOption('#mode', 'single');
  await page.click('#ahead-hour');
  await until('an hour', async () => /steps in/.test(await text('#passed')), 120);
  const passed = await text('#passed');
  assert.match(passed, /^540,000 steps in .* All positions are finite, .* memory grew by 0 bytes\.$/);
});

test('5,184 tetrahedra at the default budget leave a frame its time', async () => {
  await page.selectOption('#body', 'tower');
  await page.selectOption('#mode', 'single');
  await page.click('#reset');
  if ((await text('#play')) === 'Play') await page.click('#play');
  await page.waitForTimeout(2500);
  const milliseconds = Number(/([\d.]+) ms a step/.exec(await text('#says-a'))[1]);
  const share = milliseconds * (150 / 60);
  console.log(`tower: ${milliseconds} ms a step, ${share.toFixed(1)} ms of a frame's 16.7`);
  assert.ok(share < 16.7, `${share} ms`);
  await pause();
});

test('on a phone the page fits, and a finger drags', async () => {
  const phone = await open({ viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, colorScheme: 'dark' });
  const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} pixels wide`);
  for (const id of ['play', 'drop', 'throw', 'pin']) {
    const { height } = await phone.locator(`#${id}`).boundingBox();
    assert.ok(height >= 40, `${id} is ${height} high`);
  }
  await phone.tap('#theme');
  assert.equal(await phone.getAttribute('html', 'data-theme'), 'light');

  await phone.locator('#view').evaluate((canvas) => {
    canvas.dataset.pointers = '';
    for (const type of ['pointerdown', 'pointermove', 'pointerup']) {
      canvas.addEventListener(type, (event) => (canvas.dataset.pointers += `${type} ${event.pointerType};`));
    }
  });
  const devices = await phone.context().newCDPSession(phone);
  const finger = (type, ...points) =>
    devices.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x: Math.round(x), y: Math.round(y) })) });
  const holding = () => phone.locator('#view').evaluate((canvas) => canvas.classList.contains('holding'));
  /** Whether a finger that comes down there takes hold of the body. */
  const holds = async (at) => {
    await finger('touchStart', at);
    const held = await holding();
    await finger('touchEnd');
    return held;
  };
  const steps = async (count) => {
    for (let k = 0; k < count; k++) await phone.keyboard.press('.');
  };
  if ((await phone.textContent('#play')) === 'Pause') await phone.tap('#play');
  await phone.tap('#reset');
  await phone.locator('#view').focus();
  const box = await phone.locator('#view').boundingBox();
  // The highest place in the left half where there is a body, and one above it where there is none.
  const column = [...Array(40).keys()].map((k) => [box.x + box.width * 0.25, box.y + (box.height * (k + 1)) / 41]);
  let top = 0;
  while (top < column.length && !(await holds(column[top]))) top += 1;
  assert.ok(top > 6 && top < column.length, `nothing to hold, or no room above it: ${top}`);
  const [from, to] = [column[top + 1], column[top - 5]];
  await phone.tap('#reset');
  await phone.locator('#view').focus();
  await steps(31);
  const untouched = await phone.textContent('#hash');
  await phone.tap('#reset');
  await phone.locator('#view').focus();
  await finger('touchStart', from);
  assert.ok(await holding(), 'the finger holds it');
  for (let k = 1; k <= 4; k++) await finger('touchMove', [from[0], from[1] + ((to[1] - from[1]) * k) / 4]);
  await steps(31);
  await finger('touchEnd');
  assert.ok(!(await holding()), 'and lets go');
  assert.notEqual(await phone.textContent('#hash'), untouched);
  assert.ok(await holds(to), 'the body is where the finger went, and where nothing was');
  const pointers = await phone.getAttribute('#view', 'data-pointers');
  assert.match(pointers, /pointerdown touch;(pointermove touch;)+pointerup touch;/);
  assert.ok(!pointers.includes('mouse'), 'no mouse had a hand in it');
  await phone.close();
});
