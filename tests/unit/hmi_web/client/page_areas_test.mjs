// Where the panels of the page stand, for every kind of cell.
//
//   node --test page_areas_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const page = await load(process.env.CLIENT, ['shell/page_areas', 'shell/wall']);

const COLUMNS = { single: 1, narrow: 2, wide: 3 };

const PARTS = ['plant', 'pictures', 'plan', 'levels', 'monitors', 'sequence'];
const cells = Array.from({ length: 2 ** PARTS.length }, (_, bits) => Object.fromEntries(PARTS.map((part, k) => [part, (bits >> k) % 2 === 1])));

const panelsOf = ({ plant, pictures, plan, levels, monitors }) =>
  [
    ...(plant ? ['synoptic'] : []),
    ...(pictures ? ['pictures'] : []),
    ...(plan ? ['plan', 'incidents', 'state', 'replans'] : []),
    ...(levels ? ['trend'] : []),
    ...(monitors ? ['monitors'] : []),
    'sfc', 'scan', 'tags',
  ].sort();

const gridOf = (text) => [...text.matchAll(/'([^']*)'/g)].map(([, row]) => row.split(' '));

// A browser drops the whole template if one area is no rectangle.
function isRectangle(grid, area) {
  const cellsOf = grid.flatMap((row, y) => row.flatMap((name, x) => (name === area ? [[x, y]] : [])));
  const [xs, ys] = [cellsOf.map(([x]) => x), cellsOf.map(([, y]) => y)];
  const [width, height] = [xs, ys].map((all) => Math.max(...all) - Math.min(...all) + 1);
  return cellsOf.length === width * height;
}

test('Page_WhenTheCellIsOfAnyKind_ThenEachOfItsPanelsHasARectangleAndNoOtherOneHas', () => {
  for (const cell of cells) {
    const areas = page.pageAreas(cell);
    for (const [form, columns] of Object.entries(COLUMNS)) {
      const grid = gridOf(areas[form]);
      const what = `${form} ${JSON.stringify(cell)}: ${areas[form]}`;
      assert.ok(grid.every((row) => row.length === columns), what);
      assert.deepEqual([...new Set(grid.flat())].sort(), panelsOf(cell), what);
      for (const area of panelsOf(cell)) assert.ok(isRectangle(grid, area), `${area} in ${what}`);
    }
  }
});

test('Wall_WhenNobodyHasChosenPanels_ThenItShowsWhatTheCellHasAndNothingEmpty', () => {
  const nothing = { screen: '', plant: false, plan: false, levels: false, alarms: true };
  const shown = (has) => page.usualPanels({ ...nothing, ...has }).join();
  assert.equal(shown({}), 'overview', 'which has alarms, tags and a trend');
  assert.equal(shown({ screen: 'Mixer', plant: true }), 'alarms,screen:Mixer', 'what people have drawn comes before what is made of the plant');
  assert.equal(shown({ plant: true, plan: true, levels: true }), 'alarms,synoptic,plan,trend');
  assert.equal(shown({ plant: true, levels: true, alarms: false }), 'synoptic,trend');
});
