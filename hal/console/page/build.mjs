// SPDX-License-Identifier: Apache-2.0
// Builds the page: flatc's accessors and the colours of all figures (hal/palette.csv) into
// generated/, then dist/ (index.html, app.js, app.css).
//
//   node build.mjs [generate] [--out FOLDER]
//   node build.mjs demo --package FOLDER --organs FOLDER [--out FOLDER]
//
// demo: the page of demo/ as one file, index.html, which needs no server. The package is
// stylet-wasm as hal/hosts/browser builds it; the organs are liver.organ, wall.organ and gel.organ,
// with desktop.txt, the state in which hal/hosts/c/examples/insert.c leaves the liver.
// Names in dist/ never change and nothing in it depends on time, machine or folder, so a build of
// the same sources gives the same bytes. Needs flatc on PATH and `npm install --no-save` done.
import {execFileSync} from 'node:child_process';
import {cpSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
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
  writeFileSync(join(out, 'palette.ts'), palette());
}

// Each name's colours on light and on dark ground, and its dash.
function palette() {
  const [, ...rows] = readFileSync(join(kPage, '../../palette.csv'), 'utf8').trim().split('\n')
                          .filter((line) => !line.startsWith('#'))
                          .map((line) => line.split(','));
  const strokes = rows.filter(([, , dark]) => dark).map(([name, colour, dark, dash]) => {
    const lengths = dash === '' ? '' : dash.replaceAll(' ', ', ');
    return `  ${name}: {colour: '${colour}', dark: '${dark}', dash: [${lengths}]},\n`;
  });
  return '// Made by build.mjs of hal/palette.csv.\n' +
      `export const kFigureStrokes = {\n${strokes.join('')}};\n`;
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

// All of the demo in one file: what a page may load where it was opened from a folder is itself.
async function bundleDemo(stylet, organs, out) {
  const root = join(kPage, 'demo');
  const kept = join(root, 'organs');  // not committed
  rmSync(kept, {recursive: true, force: true});
  cpSync(organs, kept, {recursive: true});
  const built = await build({
    root,
    configFile: false,
    logLevel: 'warn',
    base: './',
    resolve: {alias: [{find: /^stylet-wasm(?=$|\/)/, replacement: resolve(stylet)}]},
    worker: {format: 'iife'},
    assetsInclude: ['**/*.organ'],
    build: {
      write: false,
      target: 'es2022',
      modulePreload: false,
      cssCodeSplit: false,
      assetsInlineLimit: 100_000_000,
      chunkSizeWarningLimit: 10_000,
      rollupOptions: {output: {banner: notices(), inlineDynamicImports: true}},
    },
  });
  const files = [built].flat().flatMap(({output}) => output);
  const script = files.find(({type}) => type === 'chunk').code.replaceAll('</script', '<\\/script');
  const style = files.find(({fileName}) => fileName.endsWith('.css')).source;
  const page = files.find(({fileName}) => fileName.endsWith('.html')).source
                   .replace(/<script [^>]*><\/script>/, '')
                   .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style}</style>`)
                   .replace('</body>', () => `<script type="module">${script}</script></body>`);
  mkdirSync(out, {recursive: true});
  writeFileSync(join(out, 'index.html'), page);
}

const words = process.argv.slice(2);
const folder = (option, other) => {
  const at = words.indexOf(option);
  if (at < 0 && other === undefined) throw new Error(`expected ${option} FOLDER`);
  return at < 0 ? other : resolve(words[at + 1]);
};
generate();
if (words[0] === 'demo') {
  await bundleDemo(
      folder('--package'), folder('--organs'), folder('--out', join(kPage, 'dist-demo')));
} else if (words[0] !== 'generate') {
  await bundle(folder('--out', join(kPage, 'dist')));
}
