// The client's own modules for tests of its logic: bundled from the sources as the build does, without a browser.

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

// `client`: the folder in which the client is built. `names`: modules below its src, without their ending.
export async function load(client, names) {
  const { buildSync } = createRequire(join(client, 'package.json'))('esbuild');
  const folder = mkdtempSync(join(tmpdir(), 'hmi-modules-'));
  try {
    const entry = join(folder, 'entry.ts');
    writeFileSync(entry, names.map((name) => `export * from ${JSON.stringify(join(client, 'src', name))};`).join('\n'));
    const outfile = join(folder, 'modules.mjs');
    buildSync({ entryPoints: [entry], outfile, bundle: true, format: 'esm', logLevel: 'warning' });
    return await import(pathToFileURL(outfile).href);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
