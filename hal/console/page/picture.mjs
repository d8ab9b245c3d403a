// SPDX-License-Identifier: Apache-2.0
// A picture of the console's page at a place in a recording, without a screen.
//
//   node picture.mjs URL FILE.png SHARE VIEW [PRESET]
//
// SHARE of the recording's length, 0 to 1; VIEW trainee, teacher, engineer or report; PRESET the
// text of a button that chooses the point of view. CHROMIUM names another program than Debian's.
import {chromium} from 'playwright-core';

const kPatienceMs = 120000;
const [url, file, share, view, preset] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader'],
});
try {
  const page =
      await browser.newPage({viewport: {width: 1100, height: 680}, reducedMotion: 'reduce'});
  page.setDefaultTimeout(kPatienceMs);
  await page.goto(`${url}#${view}`, {waitUntil: 'commit'});
  await page.waitForFunction(() => window.stylet?.store.organ && window.stylet.store.frame);
  if (preset !== undefined) await page.getByText(preset, {exact: true}).click();
  const tick = await page.evaluate((part) => {
    const bar = document.querySelector('.scrub');
    bar.value = String(Math.round(part * Number(bar.max)));
    bar.dispatchEvent(new Event('input'));
    return Number(bar.value);
  }, Number(share));
  await page.waitForFunction((t) => window.stylet.store.frame.tick === t, tick);
  await page.waitForFunction(() => window.stylet.store.rows.length > 100);
  await page.waitForTimeout(1500);  // plots are drawn at most so often
  await page.screenshot({path: file, timeout: kPatienceMs});
} finally {
  await browser.close();
}
