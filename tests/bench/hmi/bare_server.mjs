// A server of its own with a page that is told one value: prints its address. Whoever starts it ends it.

import { servePage } from './baseline_page.mjs';

const { url, set } = await servePage('pushed');
process.stdout.write(`${url}\n`);
let value = 0;
setInterval(() => set(++value), 100);
