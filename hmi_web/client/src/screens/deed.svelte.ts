// What somebody does with a part: one request, whatever is pressed meanwhile, with a name of its own, so that the server does it
// once even where it is asked again.

import { own, sentences } from '../access/api';
import type { Session } from '../access/session.svelte';
import type { Part } from './parts';
import { pathOf } from './screens';
import { t } from './texts';

const TOLD_MS = 2_500; // how long "written" stands

// Those under way. Who leaves a screen and comes back finds them as they are.
const underWay = new Map<string, Deed>();

export function deedOf(session: Session, screen: string, part: string): Deed {
  return underWay.get(`${screen}/${part}`) ?? new Deed(session, screen);
}

export class Deed {
  state = $state<'idle' | 'pending' | 'done' | 'refused'>('idle');
  problem = $state('');
  private timer = 0;

  constructor(
    private readonly session: Session,
    private readonly screen: string,
  ) {}

  // '' = done, else why not. `part`: as somebody has seen it; one that writes something else by now writes nothing.
  async write(part: Part, value: string, confirmed = false): Promise<string> {
    if (this.state === 'pending') return '';
    const { key, write, confirm } = part;
    window.clearTimeout(this.timer);
    this.state = 'pending';
    this.problem = '';
    const once = [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    underWay.set(`${this.screen}/${key}`, this);
    const reply = await this.session.ask<unknown>('POST', `${pathOf(this.screen)}/write`, { part: key, value, once, confirmed, writes: write, question: confirm });
    underWay.delete(`${this.screen}/${key}`);
    // Nobody has answered, and who has not may have obeyed.
    this.problem = reply.ok ? '' : reply.status === 0 ? own(t('notKnown')) : sentences(reply.problems);
    this.state = reply.ok ? 'done' : 'refused';
    if (reply.ok) this.timer = window.setTimeout(() => (this.state = this.state === 'done' ? 'idle' : this.state), TOLD_MS);
    return this.problem;
  }

  forget(): void {
    if (this.state === 'refused') this.state = 'idle';
    this.problem = '';
  }
}
