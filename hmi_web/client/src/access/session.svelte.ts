// Who has logged in here, and what this person may do. The server decides; the page only leaves out what would be refused.

import { getContext, setContext } from 'svelte';

import type { PlantFault } from '../faults/faults';
import type { Topic } from '../help/topics';
import { ask, sentences, type Method, type Reply } from './api';

export type Role = 'none' | 'viewer' | 'operator' | 'engineer' | 'administrator';

const RANK: Record<Role, number> = { none: 0, viewer: 1, operator: 2, engineer: 3, administrator: 4 };

// What is open over the page.
export type Dialog =
  | { kind: 'login' | 'password' | 'users' | 'audit' }
  | { kind: 'goal' }
  | { kind: 'abort' | 'stop' | 'hold' | 'resume' | 'start' | 'order' }
  // `places`: of the floor; one of them may be blocked as a whole.
  | { kind: 'block'; places?: string[] }
  | { kind: 'unblock' | 'return'; name: string }
  | { kind: 'force'; tag: string; type: string; value: string }
  | { kind: 'fault'; deed: 'set' | 'clear'; fault: PlantFault }
  | { kind: 'alarm'; deed: 'shelve' | 'suppress' | 'remove'; alarm: string; text: string; most: number }
  | { kind: 'help'; topic: Topic; title: string }
  // `done` is told the recipe to be shown then.
  | { kind: 'recipe'; deed: 'edit' | 'load' | 'remove'; name: string; done: (name: string) => void };

interface SessionAnswer {
  user: string;
  role: Role;
  csrf: string;
  setup_needed: boolean;
  wall?: string[];
}

export class Session {
  // False until the server has said who we are.
  known = $state(false);
  user = $state('');
  role = $state<Role>('none');
  setupNeeded = $state(false);
  // Panels of a display on the wall, as the server says; of a page that is one: it never acts, whoever has logged in here.
  wall = $state.raw<string[]>([]);
  readonly isWall: boolean;
  dialog = $state<Dialog | null>(null);
  // Somebody was logged in here and is not any more, without having logged out.
  ended = $state(false);
  private leaving = false;
  private csrf = '';
  private onChange: () => void = () => {};

  // `onChange` is called whenever somebody else looks than before.
  constructor(onChange?: () => void, isWall = false) {
    this.isWall = isWall;
    if (onChange) this.onChange = onChange;
  }

  may(role: Role): boolean {
    return RANK[this.role] >= RANK[role] && !(this.isWall && RANK[role] > RANK.viewer);
  }

  // Subprotocols for the WebSocket: a header of its own it cannot send.
  protocols(): string[] {
    return this.csrf === '' ? [] : [`csrf.${this.csrf}`];
  }

  open(dialog: Dialog): void {
    this.dialog = dialog;
  }

  close(): void {
    this.dialog = null;
  }

  async refresh(): Promise<void> {
    const reply = await ask<SessionAnswer>('GET', '/api/session', '');
    if (reply.ok) return this.take(reply.data);
    // A server without an API shows everything and does nothing.
    if (reply.status === 404) this.take({ user: '', role: 'viewer', csrf: '', setup_needed: false });
  }

  // Asks for something that changes something; '' = done, else why not.
  async act(method: Method, path: string, body?: unknown): Promise<string> {
    const reply = await this.ask(method, path, body);
    return reply.ok ? '' : sentences(reply.problems);
  }

  async ask<T>(method: Method, path: string, body?: unknown): Promise<Reply<T>> {
    const reply = await ask<T>(method, path, this.csrf, body);
    if (!reply.ok && reply.status === 401 && path !== '/api/session' && path !== '/api/session/password') await this.refresh();
    return reply;
  }

  async logIn(name: string, password: string): Promise<string> {
    return this.enter('POST', '/api/session', { name, password });
  }

  async claim(token: string, name: string, password: string): Promise<string> {
    return this.enter('POST', '/api/setup', { token, name, password });
  }

  async logOut(): Promise<string> {
    this.leaving = true;
    const problem = await this.enter('DELETE', '/api/session');
    this.leaving = false;
    if (problem === '') await this.refresh();
    return problem;
  }

  private async enter(method: Method, path: string, body?: unknown): Promise<string> {
    const reply = await this.ask<SessionAnswer>(method, path, body);
    if (!reply.ok) return sentences(reply.problems);
    this.take(reply.data);
    return '';
  }

  private take(answer: SessionAnswer): void {
    const other = !this.known || this.user !== answer.user || this.csrf !== answer.csrf || this.role !== answer.role;
    this.ended = answer.user === '' && !this.leaving && (this.ended || this.user !== '');
    this.known = true;
    this.user = answer.user;
    this.role = answer.role;
    this.csrf = answer.csrf;
    this.setupNeeded = answer.setup_needed;
    this.wall = answer.wall ?? [];
    if (!other) return;
    if (answer.role === 'none' || answer.user === '') this.dialog = null;
    this.onChange();
  }
}

const KEY = Symbol('session');

export function provideSession(session: Session): Session {
  return setContext(KEY, session);
}

export function currentSession(): Session {
  return getContext<Session>(KEY);
}
