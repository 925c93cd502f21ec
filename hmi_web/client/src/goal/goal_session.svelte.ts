// What the dialog of goals knows and asks of the server: the words once, what holds now again and again, and at most one
// what-if of its own.

import { sentences, type Problem } from '../access/api';
import type { Session } from '../access/session.svelte';
import type { WhatIf } from './what_if';
import { readOutlook, readWords, type GoalWords, type Outlook } from './words';

const CALM_MS = 1_000;
const EAGER_MS = 250; // while a what-if is being planned

const newId = () => Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) => byte.toString(16).padStart(2, '0')).join('');

export class GoalSession {
  known = $state(false);
  words = $state.raw<GoalWords | null>(null);
  noForm = $state(''); // why there is none
  outlook = $state.raw<Outlook | null>(null);
  private asked = $state('');
  private hasForm = false; // the mission tells of its goals in words
  private closed = false;

  constructor(private readonly session: Session) {}

  // Of our own question; null before there is any.
  get whatIf(): WhatIf | null {
    const told = this.outlook?.whatIf;
    return this.asked !== '' && told?.id === this.asked ? told : null;
  }

  // A mission without a form knows no outlook either, until somebody has asked it something: the server would answer that there is none.
  get hasOutlook(): boolean {
    return this.hasForm || this.asked !== '';
  }

  get planning(): boolean {
    return this.asked !== '' && (this.whatIf === null || this.whatIf.state === 'planning');
  }

  async open(): Promise<void> {
    const form = await this.session.ask<unknown>('GET', '/api/plan/goal-form');
    this.hasForm = form.ok;
    const words = form.ok ? readWords(form.data) : sentences(form.problems);
    if (typeof words === 'string') this.noForm = words;
    else this.words = words;
    await this.look();
    this.known = true;
    while (!this.closed) {
      await new Promise((resolve) => setTimeout(resolve, this.planning ? EAGER_MS : CALM_MS));
      if (!this.closed && !document.hidden) await this.look();
    }
  }

  close(): void {
    this.closed = true;
    if (this.planning) void this.cancel();
  }

  // None = it is being planned; else why not.
  async ask(goal: string): Promise<Problem[]> {
    const id = newId();
    const reply = await this.session.ask('POST', '/api/plan/what-if', { goal, id });
    if (!reply.ok) return reply.problems;
    this.asked = id;
    await this.look();
    return [];
  }

  async cancel(): Promise<void> {
    await this.session.ask('POST', '/api/plan/what-if/cancel', { id: this.asked });
  }

  forget(): void {
    this.asked = '';
  }

  private async look(): Promise<void> {
    if (!this.hasOutlook) return;
    const reply = await this.session.ask<unknown>('GET', '/api/plan/outlook');
    if (reply.ok) this.outlook = readOutlook(reply.data);
  }
}
