import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig, type Rollup } from 'vite';

const TRANSLATION = /texts\.(de|fr|es)\.ts$/;

// Whether the page cannot begin without the module.
function isInFirstLoad(id: string, infoOf: Rollup.GetModuleInfo, seen = new Set<string>()): boolean {
  const info = infoOf(id);
  if (!info || seen.has(id)) return false;
  seen.add(id);
  return info.isEntry || info.importers.some((importer) => isInFirstLoad(importer, infoOf, seen));
}

export default defineConfig({
  plugins: [svelte()],
  build: {
    target: 'es2022',
    // The page's policy allows no inline resource: every asset stays a file.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    rollupOptions: {
      output: {
        // Of each other language the texts of the first load in one piece; those of a panel that comes later come with it.
        manualChunks: (id, { getModuleInfo }) => {
          const [, code] = TRANSLATION.exec(id) ?? [];
          return code && isInFirstLoad(id.replace(TRANSLATION, 'texts.ts'), getModuleInfo) ? `texts-${code}` : undefined;
        },
      },
    },
  },
});
