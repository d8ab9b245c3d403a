// SPDX-License-Identifier: Apache-2.0
// dist/ is what a fresh build of the sources gives, byte for byte, and carries its licences.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';

test('dist equals a fresh build', () => {
  const fresh = mkdtempSync(join(tmpdir(), 'stylet-page-'));
  try {
    const done = spawnSync(process.execPath, [join(kPage, 'build.mjs'), '--out', fresh]);
    assert.equal(done.status, 0, String(done.stderr));
    const names = readdirSync(join(kPage, 'dist')).sort();
    assert.deepEqual(readdirSync(fresh).sort(), names);
    for (const name of names) {
      const [kept, made] =
          [join(kPage, 'dist'), fresh].map((folder) => readFileSync(join(folder, name)));
      assert.ok(kept.equals(made), `dist/${name} is not what the sources give: npm run build`);
    }
  } finally {
    rmSync(fresh, {recursive: true});
  }
});

test('the types hold', () => {
  const tsc = join(kPage, 'node_modules/typescript/bin/tsc');
  const done = spawnSync(process.execPath, [tsc, '--noEmit'], {cwd: kPage});
  assert.equal(done.status, 0, String(done.stdout));
});

test('notices of all bundled libraries are in app.js', () => {
  const script = readFileSync(join(kPage, 'dist/app.js'), 'utf8');
  for (const words of ['three.js authors', 'Leon Sorokin', 'Apache License']) {
    assert.ok(script.includes(words), words);
  }
});

test('nothing in dist is loaded from elsewhere', () => {
  const page = readFileSync(join(kPage, 'dist/index.html'), 'utf8');
  assert.deepEqual(
      [...page.matchAll(/(?:src|href)="([^"]+)"/g)].map((m) => m[1]).sort(),
      ['./app.css', './app.js', 'data:,']);
  assert.ok(!/url\(|@import/.test(readFileSync(join(kPage, 'dist/app.css'), 'utf8')));
});
