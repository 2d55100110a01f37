// The pictures of the README: `node scripts/shots.mjs`, after `npm run build`. Small enough for the tree.

import { chromium } from 'playwright-core';

import { here } from './run.mjs';
import { serve } from './serve.mjs';

const ARGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const SHOTS = [
  { file: 'light.png', width: 1200, height: 720, colorScheme: 'light', play: topple },
  { file: 'dark.png', width: 1200, height: 720, colorScheme: 'dark', play: bend },
  { file: 'phone.png', width: 390, height: 844, colorScheme: 'light', play: (page) => page.waitForTimeout(3000) },
];

/** The snowman topples, at two iterations a step beside the converged solution. */
async function topple(page) {
  await page.fill('#iterations-a-field', '2');
  await page.press('#iterations-a-field', 'Enter');
  await page.click('#reset');
  await page.waitForFunction(() => Number(document.getElementById('step')?.textContent) > 150);
}

/** A beam that bends, at one iteration a step beside the converged solution. */
async function bend(page) {
  await page.selectOption('#body', 'beam');
  await page.fill('#iterations-a-field', '1');
  await page.press('#iterations-a-field', 'Enter');
  await page.click('#reset');
  await page.waitForTimeout(4000);
}

const server = await serve(here('dist'), 0);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ARGS });
for (const { file, width, height, colorScheme, play } of SHOTS) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForSelector('#loading', { state: 'hidden' });
  await play(page);
  await page.screenshot({ path: here(`shots/${file}`) });
  await page.close();
}
await browser.close();
server.close();
