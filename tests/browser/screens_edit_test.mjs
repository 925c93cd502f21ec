// Drawing screens, further: lines and pipes by points, handles, turning, order; a start for each role; and what goes wrong
// meanwhile: names and files that cannot be, a screen that is removed, a session that ends, an answer that is lost.

import { leadOverPage } from './page_run.mjs';
import { addsUsers, asks, claims, dialog, dialogIsGone, isAccessible, logsIn, PASSWORD } from './people.mjs';
import { KEEPS_RECORDS, LEVEL_ALARM, startMixer } from './recipe_cell.mjs';
import { adds, editor, field, item, places, says } from './screen_editor.mjs';
import { check, fitsEachLook, options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'screens-edit-');
const button = (page, name) => editor(page).getByRole('button', { name, exact: true });
const placeOf = (page, key) => item(page, key).getAttribute('transform');
const pointsOf = (page, key) => item(page, key).locator('polyline').first().getAttribute('points');
const order = (page) => page.locator('[data-item]').evaluateAll((all) => all.map((one) => one.dataset.item).join(' '));
const complains = (page, words) =>
  waitFor(page, `the editor complains: ${words}`, (wanted) => document.querySelector('[data-testid=editor-problem]')?.innerText.includes(wanted), words);
const isShown = (page, name) =>
  waitFor(page, `the page shows ${name}`, (wanted) => document.querySelector('[data-testid=screen]')?.dataset.screen === wanted, name);

const goes = (page, name) => page.getByRole('navigation', { name: 'Screens' }).getByRole('button', { name, exact: true }).click();

// A place of the drawing in the window.
async function at(page, x, y) {
  const box = await page.getByTestId('canvas').boundingBox();
  return [box.x + (x * box.width) / 800, box.y + (y * box.width) / 800];
}
async function drags(page, selector, dx, dy) {
  const box = await page.locator(selector).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const scale = (await page.getByTestId('canvas').boundingBox()).width / 800;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx * scale, y + dy * scale, { steps: 4 });
  await page.mouse.up();
}

// Before there is a screen: what somebody ticks in the overview is drawn, stays over a reload, and never goes for something else.
async function picksLines(page) {
  const ticked = () => page.locator('[data-testid=tag-groups] input:checked').evaluateAll((all) => all.map((one) => one.closest('dt').title).join(' '));
  await until('three are drawn to begin with', async () => (await ticked()).split(' ').length === 3);
  const free = page.locator('[data-testid=tag-groups] input:not(:checked)');
  for (let k = 0; k < 3; k++) {
    await free.first().click();
    await until('a line is ticked', async () => (await ticked()).split(' ').length === 4 + k);
  }
  const six = await ticked();
  await free.first().click();
  await waitFor(page, 'a seventh is refused in words', () => document.querySelector('[data-testid=lines-full]').innerText.includes('6 lines are drawn'));
  check((await ticked()) === six, 'and takes nothing away');
  await page.reload();
  await until('after a reload the same are drawn', async () => (await ticked()) === six);
  await shot(page, 'overview');
}

async function drawsLines(page) {
  await page.getByRole('button', { name: 'Draw a screen' }).click();
  await editor(page).getByLabel('Name', { exact: true }).fill('Line');
  await adds(page, 'tank');
  await places(page, { x: 60, y: 60 });
  await adds(page, 'pipeline');
  await says(page, 'changed');
  for (const [x, y] of [[181, 198], [299, 202], [302, 289]]) await page.mouse.click(...(await at(page, x, y)));
  await page.mouse.dblclick(...(await at(page, 400, 291)));
  check((await placeOf(page, 'p2')) === 'translate(180 200)', 'a pipe begins where it was clicked, on the grid');
  check((await pointsOf(page, 'p2')) === '0,0 120,0 120,90 220,90', 'and goes through all points');
  await page.locator('[data-symbol-kind=line]').focus();
  await page.keyboard.press('Enter');
  await waitFor(page, 'a line that is begun takes the keys', () => document.activeElement?.dataset.testid === 'canvas');
  for (const key of ['Space', 'ArrowRight', 'ArrowRight', 'Space', 'ArrowUp', 'Space', 'Backspace', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Enter']) await page.keyboard.press(key);
  check((await pointsOf(page, 'p3')) === '0,0 20,0 20,20', `with the keys it is drawn, and a point taken back (${await pointsOf(page, 'p3')})`);
  await adds(page, 'line');
  await page.mouse.click(...(await at(page, 700, 400)));
  await page.keyboard.press('Escape');
  check((await page.locator('[data-item]').count()) === 3, 'one point is no line');
}

async function sizesAndTurns(page) {
  await item(page, 'p1').click();
  await shot(page, 'handles');
  await drags(page, '[data-grip=nw] .hit', -31, -18);
  check((await placeOf(page, 'p1')) === 'translate(30 40)', 'a handle takes its edges with it');
  check((await field(page, 'Width').inputValue()) === '150' && (await field(page, 'Height').inputValue()) === '180', 'and the others stay');
  await item(page, 'p1').focus();
  await page.keyboard.press('Control+ArrowRight');
  await page.keyboard.press('Control+Shift+ArrowUp');
  await until('with the keys it grows by the grid, and shrinks by one', async () => `${await field(page, 'Width').inputValue()} ${await field(page, 'Height').inputValue()}` === '160 179');
  await item(page, 'p2').focus();
  await drags(page, '[data-between="1"] .hit', 0, 40);
  check((await pointsOf(page, 'p2')) === '0,0 60,40 120,0 120,90 220,90', `a line is bent where it is taken (${await pointsOf(page, 'p2')})`);
  await page.getByRole('button', { name: 'Without point 2' }).click();
  await page.getByRole('button', { name: 'One more behind point 4' }).click();
  check((await pointsOf(page, 'p2')) === '0,0 120,0 120,90 220,90 260,90', 'points come and go with the keys, too');
  await page.getByLabel('Point 5, x').fill('420');
  await page.getByLabel('Point 5, x').press('Tab');
  check((await pointsOf(page, 'p2')).endsWith('240,90'), 'and are placed');
  await shot(page, 'points');
  await isAccessible(page, 'the editor with a line');
  await item(page, 'p2').focus();
  await page.keyboard.press('r');
  check((await pointsOf(page, 'p2')) === '90,0 90,120 0,120 0,220 0,240', 'a line is turned with its points');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('PageDown');
  check((await order(page)) === 'p2 p1 p3', 'to the back');
  await waitFor(page, 'what was sent there keeps the focus', () => document.activeElement?.dataset.item === 'p2');
  await page.keyboard.press('Shift+PageUp');
  check((await order(page)) === 'p1 p2 p3', 'and one forward');
}

// Without Shift: by a finger, or with the keys.
async function choosesSeveral(page) {
  await page.keyboard.press('Escape');
  await button(page, 'Choose several').click();
  await item(page, 'p1').click();
  await item(page, 'p3').focus();
  await page.keyboard.press('Space');
  check((await page.locator('[data-item][data-chosen=true]').count()) === 2, 'what is pressed comes to what is chosen');
  await page.keyboard.press('Space');
  check((await page.locator('[data-item][data-chosen=true]').count()) === 1, 'and leaves it again');
  await button(page, 'Choose several').click();
}

async function namesIt(page) {
  const name = editor(page).getByLabel('Name', { exact: true });
  for (const wrong of ['../secret', 'a/b', '..', 'Mischer 🙂']) {
    await name.fill(wrong);
    await button(page, 'Save').click();
    await complains(page, 'letter or a digit at both ends');
  }
  await name.fill('Line');
  await button(page, 'Save').focus();
  await page.keyboard.press('Enter');
  await says(page, 'Saved as version 1.');
  check((await page.getByTestId('editor-problem').innerText()) === '', 'a name that can be is taken');
}

// Whoever has saved by a key goes on with the keys.
async function copiesWithKeys(page) {
  check(await button(page, 'Save').evaluate((one) => one === document.activeElement), 'Save keeps the focus');
  await page.keyboard.press('Control+a');
  await until('and Ctrl+A means the symbols', async () => (await page.locator('[data-item][data-chosen=true]').count()) === 3);
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Control+v');
  await page.keyboard.press('Control+v');
  const places = await page.locator('[data-item]').evaluateAll((all) => all.map((one) => one.getAttribute('transform')));
  check(places.length === 9 && new Set(places).size === 9, `what is pasted twice lies in two places (${places.join(' ')})`);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await until('and goes again', async () => (await page.locator('[data-item]').count()) === 3);
}

// What stays marked in a field that was left is not what is meant.
async function copiesFromAnywhere(page) {
  const count = () => page.locator('[data-item]').count();
  await item(page, 'p1').focus();
  await field(page, 'x').focus();
  await page.keyboard.press('Tab');
  await waitFor(page, 'a field that is reached by Tab has its text marked', () => String(getSelection()) !== '');
  await button(page, 'Save').focus();
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Control+v');
  await until('what is chosen in the drawing is copied all the same', async () => (await count()) === 4);
  await button(page, 'Cut').click();
  await until('and cut', async () => (await count()) === 3);
  check((await button(page, 'Copy').getAttribute('aria-disabled')) === 'true', 'nothing is chosen then');
  await button(page, 'Copy').focus();
  await page.keyboard.press('Enter');
  await button(page, 'Paste').click();
  await until('what is not there to be copied leaves what was', async () => (await count()) === 4);
  await page.keyboard.press('Control+z');
  await item(page, 'p3').focus();
  await button(page, 'Copy').click();
  await button(page, 'Paste').click();
  await until('the button copies as the keys do', async () => (await count()) === 4);
  for (let k = 0; k < 3; k++) await button(page, 'Undo').click();
  await until('and all goes again', async () => (await count()) === 3 && !(await page.getByTestId('editor-told').innerText()).includes('changed'));
}

// A button that goes away with what it was about leaves the keys to the drawing.
async function undoesWhatAButtonDid(page) {
  const count = () => page.locator('[data-item]').count();
  const ofChosen = (name) => page.getByTestId('properties').getByRole('button', { name, exact: true });
  const isOnCanvas = (what) => waitFor(page, `${what}: the keys mean the drawing`, () => document.activeElement?.dataset.testid === 'canvas');
  for (const press of [(one) => one.click(), (one) => one.focus().then(() => page.keyboard.press('Enter'))]) {
    await button(page, 'Save').focus();
    await page.keyboard.press('Control+a');
    await press(ofChosen('Remove'));
    await until('all are removed', async () => (await count()) === 0);
    await isOnCanvas('after Remove');
    await page.keyboard.press('Control+z');
    await until('Ctrl+Z brings them back', async () => (await count()) === 3);
  }
  await page.keyboard.press('Control+a');
  await ofChosen('Group').click();
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Control+v');
  await until('a group is pasted', async () => (await count()) === 6);
  await page.keyboard.press('Control+z');
  await until('and goes', async () => (await count()) === 3);
  await isOnCanvas('after that');
  await page.keyboard.press('Control+z');
  await until('and the group, too', async () => !(await page.getByTestId('editor-told').innerText()).includes('changed'));
}

// What one may see and another may not, and where each begins.
async function choosesStarts(page) {
  const put = async (name, svg) => check((await asks(page, 'PUT', `/api/screens/${name}`, { svg, version: 0 })).status === 200, `${name} is drawn`);
  await put('All', '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100"><g data-part="navigate" data-go="Service" data-label="Service"><rect width="90" height="40"/></g><g data-part="navigate" data-go="Line"><rect x="100" width="90" height="40"/></g><text x="10" y="80" data-text="Main.batches">-</text></svg>');
  await put('Service', '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100" data-least="engineer"><rect width="90" height="40"/></svg>');
  check((await asks(page, 'PUT', '/api/screen-start', { screen: 'All' })).status === 200, 'everybody begins with All');
  await item(page, 'p1').focus();
  await page.keyboard.press('Escape');
  const starts = page.getByTestId('starts');
  await until('the editor knows it', () => starts.innerText().then((text) => text.includes('now All')));
  await starts.getByLabel('operators', { exact: true }).click();
  await says(page, 'Pages open with Line.');
  await until('and Line is that of operators', () => starts.getByLabel('operators', { exact: true }).isChecked());
  await shot(page, 'starts');
  await button(page, 'Close').click();
}

async function eachBeginsElsewhere(page) {
  await logsIn(page, 'olga');
  await page.goto(page.url().split('#')[0]);
  await isShown(page, 'Line');
  await goes(page, 'All');
  await isShown(page, 'All');
  check(await page.getByTestId('screen').getByRole('button', { name: 'Service' }).isDisabled(), 'what leads to a screen for others leads nowhere');
  await page.evaluate(() => (location.hash = 'screen=Service'));
  await waitFor(page, 'an address that is not for her is told', () => document.querySelector('[data-testid=screen-missing]')?.innerText.includes('Service'));
  await isShown(page, 'Line');
  check((await asks(page, 'GET', '/api/screens/Service')).status === 404, 'and the server shows nothing of it');
  await logsIn(page, 'vera');
  await page.goto(page.url().split('#')[0]);
  await isShown(page, 'All');
}

// What stays as it is costs nothing, however often the server has something to say.
async function restsWhileNothingChanges(page) {
  await waitFor(page, 'the value is there', () => document.querySelector('[data-testid=screen-drawing] text')?.textContent === '3');
  const changes = await page.evaluate(async () => {
    let count = 0;
    const watcher = new MutationObserver((records) => (count += records.length));
    watcher.observe(document.querySelector('[data-testid=screen-drawing]'), { subtree: true, childList: true, attributes: true, characterData: true });
    // Ten signs of life of the cell.
    const time = () => document.querySelector('header')?.innerText ?? '';
    for (let seen = 0, before = time(); seen < 10; ) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      if (time() === before) continue;
      before = time();
      seen += 1;
    }
    watcher.disconnect();
    return count;
  });
  check(changes === 0, `what has not changed is not touched (${changes})`);
}

async function bringsWhatCannotBe(page) {
  await logsIn(page, 'emil');
  await goes(page, 'Line');
  await isShown(page, 'Line');
  await page.getByRole('button', { name: 'Edit', exact: true }).click();
  const brings = (name, text) => editor(page).locator('input[type=file]').setInputFiles({ name, mimeType: 'image/svg+xml', buffer: Buffer.from(text) });
  await brings('Word.svg', '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 90">\n<g data-part="button" data-key="p1" data-write="Main.level" data-value="abc" data-label="Go"><rect width="60" height="40"/></g></svg>');
  await waitFor(page, 'a part that can never write is told with its line', () => {
    const words = document.querySelector('[data-testid=editor-doubts]')?.innerText ?? '';
    return words.includes('Line 2') && words.includes('cannot write abc to Main.level');
  });
  await brings('Large.svg', `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><!--${'x'.repeat(5 << 20)}--></svg>`);
  await complains(page, 'larger than 2 MiB');
  await brings('Many.svg', `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">${'<text data-text="Main.level">-</text>'.repeat(5_000)}</svg>`);
  await complains(page, 'Many.svg:');
  check(/2,?000/.test(await page.getByTestId('editor-problem').innerText()), 'of 5,000 symbols it is told how many there may be');
  const entities = Array.from({ length: 9 }, (_, k) => `<!ENTITY e${k + 1} "${`&e${k};`.repeat(10)}">`).join('');
  await brings('Bomb.svg', `<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY e0 "boom">${entities}]><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><text>&e9;</text></svg>`);
  await until('entities that grow are refused, or stay as they are written', async () => {
    const told = `${await page.getByTestId('editor-problem').innerText()} ${await page.getByTestId('editor-told').innerText()}`;
    return told.includes('Bomb') && (await page.getByTestId('canvas').textContent()).length < 1_000;
  });
  await shot(page, 'refused');
}

async function isRemovedMeanwhile(page) {
  await button(page, 'Close').click();
  await page.keyboard.press('Shift');
  await button(page, 'Leave without saving').click();
  await goes(page, 'Line');
  await isShown(page, 'Line');
  await page.getByRole('button', { name: 'Edit', exact: true }).click();
  await item(page, 'p1').waitFor();
  await adds(page, 'lamp');
  check((await asks(page, 'DELETE', '/api/screens/Line?version=1')).status === 200, 'somebody removes the screen that is being drawn');
  await button(page, 'Save').click();
  await waitFor(page, 'who saves then is told so', () => document.querySelector('[data-testid=conflict]')?.innerText.includes('has removed the screen'));
  await shot(page, 'removed');
  await dialog(page).getByRole('button', { name: 'Bring the screen back with mine' }).click();
  await dialogIsGone(page, 'and brings it back');
  await says(page, 'Saved as version 4.');
  check((await page.locator('[data-item]').count()) === 4, 'with all that was drawn');
}

// A button that writes nothing is saved, and nobody takes it for one that does.
async function tellsWhatDoesNothing(page) {
  await adds(page, 'button');
  await field(page, 'Label').fill('Halt');
  check((await page.locator('[data-idle]').count()) === 0, 'while it is drawn it is not complained of');
  await button(page, 'Save').click();
  await says(page, 'Saved as version 6.');
  const idle = page.locator('[data-idle]');
  check(/^Button Halt at \d+, \d+ writes nothing/.test(await idle.innerText()), 'once it is saved it is named');
  check((await page.locator('[data-testid=editor-doubts]').count()) === 0, 'once');
  await page.keyboard.press('Escape');
  await idle.getByRole('button').click();
  await waitFor(page, 'and the way leads to what is missed', () => document.activeElement?.labels?.[0]?.innerText === 'Writes');
  const { json } = await asks(page, 'POST', '/api/screen-check', { svg: (await asks(page, 'GET', '/api/screens/Line')).json.svg });
  check(json.warnings.some(({ code, message }) => code === 'C0647' && message.includes("'Halt' writes nothing")), 'the server says so, too');
  await button(page, 'Close').click();
  const dead = page.getByTestId('screen').getByRole('button', { name: 'Halt' });
  await until('the page shows that it does nothing', async () => (await dead.isDisabled()) && (await dead.evaluate((one) => getComputedStyle(one).borderTopStyle)) === 'dashed');
  await page.getByRole('button', { name: 'Edit', exact: true }).click();
  await item(page, 'p1').waitFor();
}

async function sessionEnds(page) {
  await adds(page, 'motor');
  check((await page.locator('[data-item]').count()) === 5, 'something more is drawn');
  await page.getByTestId('log-out').click();
  await waitFor(page, 'who has logged out draws nothing', () => document.querySelector('[data-testid=screen-editor]') === null);
  await logsIn(page, 'emil');
  await says(page, 'What you had not saved is here again.');
  check((await page.locator('[data-item]').count()) === 5, 'and nothing is lost');
  await button(page, 'Save').click();
  await says(page, 'Saved as version 5.');
  await tellsWhatDoesNothing(page);
  await fitsEachLook(page, [['dark', 1440], ['light', 360]], (look) => shot(page, look));
  await page.setViewportSize({ width: 1440, height: 900 });
  await button(page, 'Close').click();
}

// However small it is drawn, a part has its words and its value within its border.
async function smallPartsAreWhole(page) {
  await waitFor(page, 'a small set point has its value inside', () => {
    const button = document.querySelector('[data-part-key=small] button');
    const [outer, value] = [button, button?.querySelector('b')].map((one) => one?.getBoundingClientRect());
    return value?.height > 0 && value.top >= outer.top && value.bottom <= outer.bottom && button.scrollHeight <= button.clientHeight;
  });
  const lines = await page.locator('[data-part-key=pair] button').evaluateAll((all) =>
    all.flatMap((one) => {
      const walker = document.createTreeWalker(one, NodeFilter.SHOW_TEXT);
      const counts = [];
      for (let text = walker.nextNode(); text; text = walker.nextNode()) {
        const range = document.createRange();
        range.selectNodeContents(text);
        counts.push(range.getClientRects().length);
      }
      return counts;
    }),
  );
  check(lines.length > 0 && lines.every((count) => count === 1), `no word of a small pair is broken (${lines.join(' ')})`);
  await shot(page, 'small-parts');
}

const LONG = 'As long as the soaking of the whole of the batch in the mixer takes';
const chosen = (page, what, wanted) =>
  waitFor(page, `${what}: ${wanted}`, (words) => [...document.querySelectorAll('[data-part-key] [aria-pressed=true]')].map((one) => one.innerText).join(', ') === words, wanted);

// Values are what their type says, not how they are written.
async function choicesSayWhatHolds(page) {
  await chosen(page, 'each choice marks its value', 'Waits, Rests, Short');
  const said = (key) => page.locator(`[data-part-key=${key}]`).innerText();
  check((await said('turned')).includes('runs') && (await said('pair')).includes('stands'), 'a feedback may be turned round');
  check((await said('named')).includes('batches in a row'), 'a part without a label is called by the comment of the declaration');
  await page.locator('[data-part-key=stir]').getByRole('button', { name: 'Stirs' }).click();
  await page.locator('[data-part-key=soak]').getByRole('button', { name: LONG }).click();
  await chosen(page, 'and the new ones', `Mixes, Stirs, ${LONG}`);
  await page.locator('[data-part-key=stir]').getByRole('button', { name: 'Rests' }).click();
  await page.locator('[data-part-key=soak]').getByRole('button', { name: 'Short' }).click();
  await chosen(page, 'and those before', 'Waits, Rests, Short');
}

async function longWordsAreCut(page) {
  const cut = await page.locator('[data-part-key=long]').evaluate((part) => {
    const [button, words] = [part.querySelector('button'), part.querySelector('.clamped')];
    return { inside: words.getBoundingClientRect().bottom <= button.getBoundingClientRect().bottom, isCut: words.scrollHeight > words.clientHeight, title: part.title };
  });
  check(cut.inside && cut.isCut && cut.title === LONG, `long words end within their button, and are whole in its title (${JSON.stringify(cut)})`);
}

async function losesAnAnswer(page) {
  const setPoint = (key, more, place) => `<g data-part="setpoint" data-key="${key}" ${more} data-from="0" data-to="100"><rect ${place}/></g>`;
  const choice = (key, variable, values, y) => `<g data-part="choice" data-key="${key}" data-write="${variable}" data-values="${values}"><rect x="200" y="${y}" width="300" height="44"/></g>`;
  const parts = setPoint('level', 'data-label="Level" data-write="Main.level"', 'width="160" height="44"')
    + setPoint('small', 'data-write="Main.batches_before" data-unit="pieces"', 'x="200" width="120" height="44"')
    + '<g data-part="startstop" data-key="pair" data-write="Main.stir" data-on="Main.stir"><rect x="400" width="130" height="44"/></g>'
    + setPoint('named', 'data-write="Main.batches"', 'y="80" width="160" height="44"')
    + choice('phase', 'Main.phase', 'Waiting=Waits;Phase#Mixing=Mixes', 80) + choice('stir', 'Main.stir', 'FALSE=Rests;TRUE=Stirs', 140) + choice('soak', 'Main.soak', `T#30000ms=Short;T#2m=${LONG}`, 200)
    + '<g data-part="startstop" data-key="turned" data-write="Main.stir" data-on="!Main.stir"><rect y="260" width="260" height="44"/></g>'
    + `<g data-part="button" data-key="long" data-label="${LONG}" data-write="Main.stir" data-value="FALSE"><rect x="300" y="260" width="120" height="44"/></g>`;
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 450">${parts}</svg>`;
  check((await asks(page, 'PUT', '/api/screens/Set', { svg, version: 0 })).status === 200, 'a set point is drawn');
  await goes(page, 'Set');
  await isShown(page, 'Set');
  await smallPartsAreWhole(page);
  await choicesSayWhatHolds(page);
  await longWordsAreCut(page);
  await page.route('**/write', (route) => route.abort('connectionreset'));
  await page.locator('[data-part-key=level] button').first().click();
  await dialog(page).getByLabel('New value').fill('33');
  await page.keyboard.press('Enter');
  await waitFor(page, 'who gets no answer is told that nobody knows', () => document.querySelector('dialog')?.innerText.includes('it may have been written or not'));
  await shot(page, 'no-answer');
  await page.unroute('**/write');
  await dialog(page).getByRole('button', { name: 'Write' }).click();
  await dialogIsGone(page, 'the next time there is an answer');
  await waitFor(page, 'and the value', () => document.querySelector('[data-part-key=level]')?.innerText.includes('33'));
  check((await asks(page, 'DELETE', '/api/screens/Set?version=1')).status === 200, 'somebody removes the screen that is looked at');
  await waitFor(page, 'the page says so, and shows another one', () => document.querySelector('[data-testid=screen-missing]')?.innerText.includes('Set'));
  await isShown(page, 'All');
}

await leadOverPage(given, {
  name: 'screens-edit',
  start: () => startMixer(given.server, { 'alarms.toml': LEVEL_ALARM }, KEEPS_RECORDS),
  expected: [400, 401, 403, 404, 409, 413],
  steps: async (page, mixer) => {
    await claims(page, await mixer.setupToken());
    await addsUsers(page);
    check((await asks(page, 'POST', '/api/users', { name: 'vera', role: 'viewer', password: PASSWORD })).status === 200, 'vera is a user');
    await logsIn(page, 'emil');
    await picksLines(page);
    await drawsLines(page);
    await sizesAndTurns(page);
    await choosesSeveral(page);
    await namesIt(page);
    await copiesWithKeys(page);
    await copiesFromAnywhere(page);
    await undoesWhatAButtonDid(page);
    await choosesStarts(page);
    await eachBeginsElsewhere(page);
    await restsWhileNothingChanges(page);
    await bringsWhatCannotBe(page);
    await isRemovedMeanwhile(page);
    await sessionEnds(page);
    await losesAnAnswer(page);
  },
});
