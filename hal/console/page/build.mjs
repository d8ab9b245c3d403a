// SPDX-License-Identifier: Apache-2.0
// Builds the page: flatc's accessors into generated/, then dist/ (index.html, app.js, app.css).
//
//   node build.mjs [generate] [--out FOLDER]
//
// Names in dist/ never change and nothing in it depends on time, machine or folder, so a build of
// the same sources gives the same bytes. Needs flatc on PATH and `npm install --no-save` done.
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'vite';

const kPage = dirname(fileURLToPath(import.meta.url));
const kSchemas = ['../console.fbs', '../../../kernel/schema/organ.fbs'];
const kBundled = ['three', 'uplot', 'flatbuffers'];

function generate() {
  const out = join(kPage, 'generated');
  mkdirSync(out, {recursive: true});
  execFileSync('flatc', ['--ts', '-o', out, ...kSchemas.map((file) => join(kPage, file))]);
}

// What the licences of the bundled libraries ask for: their notices, in full.
function notices() {
  const one = (name) => {
    const folder = join(kPage, 'node_modules', name);
    const {version, license} = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
    const file = name === 'flatbuffers' ? 'LICENSE.txt' : 'LICENSE';
    const text = readFileSync(join(folder, file), 'utf8').replace(/\r/g, '').trim();
    return `---- ${name} ${version} (${license}) ----\n\n${text}`;
  };
  return `/*!
Stylet console. SPDX-License-Identifier: Apache-2.0
Built by hal/console/page/build.mjs, with these libraries:

${kBundled.map(one).join('\n\n')}
*/`;
}

async function bundle(out) {
  await build({
    root: kPage,
    configFile: false,
    logLevel: 'warn',
    base: './',
    build: {
      outDir: out,
      emptyOutDir: true,
      target: 'es2021',
      modulePreload: false,
      assetsInlineLimit: 0,
      chunkSizeWarningLimit: 2000,
      rollupOptions: {
        output: {
          banner: notices(),
          entryFileNames: 'app.js',
          assetFileNames: 'app.[ext]',
          inlineDynamicImports: true,
        },
      },
    },
  });
}

const words = process.argv.slice(2);
const at = words.indexOf('--out');
generate();
if (words[0] !== 'generate') await bundle(at < 0 ? join(kPage, 'dist') : resolve(words[at + 1]));
