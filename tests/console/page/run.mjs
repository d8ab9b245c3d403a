// SPDX-License-Identifier: Apache-2.0
// Bundles tests of the console's page (TypeScript) and runs them with node's own test runner.
//
//   node run.mjs NAME...        NAME.test.ts beside this file
//
// Prints a line that begins with "skipped:" where npm's packages or chromium are not installed.
import {spawnSync} from 'node:child_process';
import {existsSync, mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const page = join(here, '../../../hal/console/page');
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const needsBrowser = ['browser', 'speed', 'program'];
const names = process.argv.slice(2);

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(0);
}

if (!existsSync(join(page, 'node_modules/esbuild'))) {
  skip(`no npm packages: run npm install --no-save in hal/console/page`);
}
if (spawnSync('flatc', ['--version']).status !== 0) skip('flatc is not installed');
if (names.some((name) => needsBrowser.includes(name)) && !existsSync(chromium)) {
  skip(`${chromium} is not there; CHROMIUM names another`);
}
const missing = ['stylet', 'stylet-organ', 'stylet-snapshot'].find(
    (program) => !existsSync(join(process.env.STYLET_BIN ?? '', program)));
if (names.includes('program') && missing) skip(`${missing} is not in STYLET_BIN`);
const require = createRequire(join(page, 'package.json'));
const {buildSync} = require('esbuild');
spawnSync(process.execPath, [join(page, 'build.mjs'), 'generate'], {stdio: 'inherit'});
// Beside the packages, so that what is not bundled is found.
const out = join(page, 'node_modules/.cache/tests', names.join('-'));
mkdirSync(out, {recursive: true});
const bundles = names.map((name) => {
  const outfile = join(out, `${name}.test.mjs`);
  buildSync({
    entryPoints: [join(here, `${name}.test.ts`)],
    outfile,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    logLevel: 'warning',
    nodePaths: [join(page, 'node_modules')],
    external: ['playwright-core', 'ws'],
    loader: {'.css': 'empty'},
    define: {kPage: JSON.stringify(page), kChromium: JSON.stringify(chromium)},
  });
  return outfile;
});
const done = spawnSync(process.execPath, ['--test', ...bundles], {stdio: 'inherit'});
process.exit(done.status ?? 1);
