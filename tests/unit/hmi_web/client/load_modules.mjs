// The client's own modules for tests of its logic: bundled from the sources as the build does, without a browser.

import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';

// State that components share ($state in a module) is plain variables here, and a component is a function that writes HTML.
function runes(esbuild, { compile, compileModule }) {
  return {
    name: 'runes',
    setup: (build) => {
      build.onLoad({ filter: /\.svelte\.ts$/ }, async ({ path }) => {
        const { code } = await esbuild.transform(readFileSync(path, 'utf8'), { loader: 'ts', target: 'es2022' });
        return { contents: compileModule(code, { filename: path, generate: 'server' }).js.code, loader: 'js' };
      });
      build.onLoad({ filter: /\.svelte$/ }, ({ path }) => {
        const { js } = compile(readFileSync(path, 'utf8'), { filename: path, generate: 'server', css: 'external' });
        return { contents: js.code, loader: 'js' };
      });
    },
  };
}

// A component is known by the name of its file, and is drawn by draw(); `x.svelte.ts` is a module as any other.
const isComponent = (path) => existsSync(path) && path.endsWith('.svelte');
const exported = (path) => (isComponent(path) ? `{ default as ${basename(path, '.svelte')} }` : '*');

// `client`: the folder in which the client is built. `names`: modules below its src, without their ending; components with it.
export async function load(client, names) {
  const from = createRequire(join(client, 'package.json'));
  const esbuild = from('esbuild');
  const folder = mkdtempSync(join(tmpdir(), 'hmi-modules-'));
  try {
    const modules = names.map((name) => `export ${exported(join(client, 'src', name))} from ${JSON.stringify(join(client, 'src', name))};`);
    const contents = [...modules, "export { render as draw } from 'svelte/server';"].join('\n');
    const outfile = join(folder, 'modules.mjs');
    await esbuild.build({
      stdin: { contents, resolveDir: client, loader: 'ts' },
      outfile,
      bundle: true,
      format: 'esm',
      platform: 'node',
      resolveExtensions: ['.ts', '.js'],
      plugins: [runes(esbuild, from('svelte/compiler'))],
      logLevel: 'warning',
    });
    return await import(pathToFileURL(outfile).href);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
