// The client's sources for tests that read them: files, tables of texts, templates, sentences in scripts.

import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const SOURCES = resolve(dirname(fileURLToPath(import.meta.url)), '../../../../hmi_web/client/src');
export const LANGUAGES = ['en', 'de', 'fr', 'es'];
const tools = createRequire(join(process.env.CLIENT, 'package.json'));

// Those of the given endings, as paths below src.
export function files(...endings) {
  return readdirSync(SOURCES, { recursive: true })
    .map(String)
    .filter((file) => endings.some((ending) => file.endsWith(ending)))
    .sort();
}

export function text(file) {
  return readFileSync(join(SOURCES, file), 'utf8');
}

// "plan/texts", "scan/detail_texts", ...
export function bundles() {
  return files('texts.en.ts').map((file) => file.replace(/\.en\.ts$/, ''));
}

// Key -> text or { one, other }.
export async function table(bundle, language) {
  const { code } = tools('esbuild').transformSync(text(`${bundle}.${language}.ts`), { loader: 'ts' });
  return (await import(`data:text/javascript;base64,${Buffer.from(code).toString('base64')}`)).default;
}

// The files that take texts from a bundle, with the name under which each has them.
export function usersOf(bundle) {
  return files('.ts', '.svelte').flatMap((file) =>
    [...text(file).matchAll(/import \{ t(?: as (\w+))? \} from '([^']*texts)';/g)]
      .filter(([, , path]) => relative(SOURCES, resolve(SOURCES, dirname(file), path)) === bundle)
      .map(([, alias]) => ({ file, name: alias ?? 't' })),
  );
}

export function template(file) {
  return tools('svelte/compiler').parse(text(file), { modern: true });
}

// Every string of a module, or of the script of a component, that is not the name of another module.
export function strings(file) {
  const ts = tools('typescript');
  const source = file.endsWith('.svelte') ? [...text(file).matchAll(/<script[^>]*>(.*?)<\/script>/gs)].map(([, script]) => script).join('\n') : text(file);
  const found = [];
  const visit = (node) => {
    if (ts.isImportDeclaration(node) || (ts.isCallExpression(node) && node.expression.kind === ts.SyntaxKind.ImportKeyword)) return;
    if (ts.isStringLiteralLike(node) || ts.isTemplateHead(node) || ts.isTemplateMiddle(node) || ts.isTemplateTail(node)) found.push(node.text);
    ts.forEachChild(node, visit);
  };
  visit(ts.createSourceFile('script.ts', source, ts.ScriptTarget.ES2022, true));
  return found;
}
