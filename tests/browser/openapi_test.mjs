// `stepwright hmi --openapi` is what the published schema of OpenAPI 3.1 says: --server PROGRAM --modules FOLDER.

import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const given = Object.fromEntries([...Array(2).keys()].map((i) => [process.argv[2 + 2 * i].slice(2), process.argv[3 + 2 * i]]));
const { Validator } = await import(pathToFileURL(join(given.modules, '@seriousme/openapi-schema-validator/index.js')).href);

async function faults(document) {
  const { valid, errors } = await new Validator().validate(document);
  return valid ? [] : errors;
}

const document = JSON.parse(execFileSync(given.server, ['hmi', '--openapi'], { encoding: 'utf8' }));
const found = await faults(structuredClone(document));
if (found.length > 0) throw new Error(JSON.stringify(found, null, 1));
delete document.info.title;
if ((await faults(document)).length === 0) throw new Error('the schema finds no fault in a document without a title');
console.log(`ok: ${Object.keys(document.paths).length} paths`);
