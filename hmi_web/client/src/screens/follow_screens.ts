// The screens of the cell, asked for again and again: others draw, too, and what they have saved is shown soon.

import { ask } from '../access/api';
import { askAgain } from '../lib/asking';
import { LIST, type ScreenList } from './screens';

const EVERY_MS = 5_000;

// `take` gets the list at first, and whenever it has changed. What is returned ends it.
export function followScreens(take: (list: ScreenList) => void): () => void {
  let last = '';
  return askAgain(async (signal) => {
    const reply = await ask<ScreenList>('GET', LIST, '', undefined, signal);
    const text = reply.ok ? JSON.stringify(reply.data) : last;
    if (reply.ok && text !== last) take(reply.data);
    last = text;
    return EVERY_MS;
  });
}
