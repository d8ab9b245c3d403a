// SPDX-License-Identifier: Apache-2.0
// Chromium without a screen, without a graphics card and without network beyond this machine, and
// what a test asks of a page. SwiftShader draws WebGL and nothing else, as it does by itself where
// there is no card; told to draw by SwiftShader throughout, it takes 25 ms more a picture.
import {chromium, type Browser, type Page} from 'playwright-core';

declare global {
  interface Window {
    stylet: import('./page_hook').Hook;
  }
}

export async function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: kChromium,
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--enable-unsafe-swiftshader',
      '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',
    ],
  });
}

export interface Opened {
  page: Page;
  errors: string[];   // of the console, and exceptions
  foreign: string[];  // requests to any other host
}

// On the page before it runs: it takes the machine for one with a graphics card, and lets the
// shader deform the surface, although SwiftShader still draws.
const kAsWithCard = `
  const own = WebGL2RenderingContext.prototype.getParameter;
  const kRenderer = 0x9246;  // UNMASKED_RENDERER_WEBGL
  WebGL2RenderingContext.prototype.getParameter = function(name) {
    return name === kRenderer ? 'a card' : own.call(this, name);
  };`;

export interface How {
  card?: boolean;
  width?: number;
  height?: number;
  dark?: boolean;
  still?: boolean;
  touch?: boolean;
}

// Opens the page and waits until it shows a frame of an organ.
export async function open(browser: Browser, url: string, how: How = {}): Promise<Opened> {
  const context = await browser.newContext({
    viewport: {width: how.width ?? 1280, height: how.height ?? 720},
    colorScheme: how.dark ? 'dark' : 'light',
    reducedMotion: how.still ? 'reduce' : 'no-preference',
    hasTouch: how.touch ?? false,
  });
  context.setDefaultTimeout(120000);
  const page = await context.newPage();
  if (how.card) await page.addInitScript(kAsWithCard);
  const [errors, foreign]: string[][] = [[], []];
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('request', (request) => {
    const at = new URL(request.url());
    if (!['127.0.0.1', ''].includes(at.hostname)) foreign.push(request.url());
  });
  await page.goto(url, {waitUntil: 'commit'});
  return {page, errors, foreign};
}

export const shown = (page: Page) =>
    page.waitForFunction(() => Boolean(window.stylet?.store.organ && window.stylet.store.frame));

// Moves the scrub bar as a hand does, and waits for the frame.
export async function scrub(page: Page, tick: number): Promise<void> {
  await page.evaluate((to) => {
    const bar = document.querySelector<HTMLInputElement>('.scrub');
    if (bar === null) throw new Error('no scrub bar');
    bar.value = String(to);
    bar.dispatchEvent(new Event('input'));
  }, tick);
  await page.waitForFunction((to) => window.stylet.store.frame?.tick === to, tick);
}

// The exact text that the pointer is told.
export const exactOf = async(page: Page, name: string): Promise<string> =>
    (await page.locator(`[data-value=${name}]`).getAttribute('title')) ?? '';

export const valueOf = async(page: Page, name: string): Promise<string> =>
    (await page.locator(`[data-value=${name}]`).textContent()) ?? '';
