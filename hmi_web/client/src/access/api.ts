// The server's API (`stepwright hmi --openapi`) as functions that never throw: an answer, or sentences that say why not.

import { t } from './texts';

export interface Problem {
  code: string;
  message: string;
  hint?: string;
  file?: string; // what it is about: a file, "goal", or a value of a recipe ("values.NAME")
  line?: number; // of the text that it is about
  column?: number;
}

// `body`: all that a refusal says.
export type Reply<T> = { ok: true; data: T } | { ok: false; status: number; problems: Problem[]; body?: unknown };

export type Method = 'GET' | 'POST' | 'PUT' | 'DELETE';

function problemsOf(value: unknown, status: number): Problem[] {
  const list = (value as { problems?: Problem[] } | null)?.problems;
  return Array.isArray(list) && list.length > 0 ? list : [{ code: '', message: refusal(status) }];
}

export async function ask<T>(method: Method, path: string, csrf: string, body?: unknown, signal?: AbortSignal): Promise<Reply<T>> {
  const headers: Record<string, string> = {};
  if (csrf !== '') headers['X-CSRF-Token'] = csrf;
  if (body !== undefined) headers['Content-Type'] = 'application/json';
  try {
    const response = await fetch(path, {
      method,
      headers,
      credentials: 'same-origin',
      cache: 'no-store',
      ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      ...(signal ? { signal } : {}),
    });
    const value: unknown = await response.json().catch(() => null);
    if (!response.ok) return { ok: false, status: response.status, problems: problemsOf(value, response.status), body: value };
    return { ok: true, data: value as T };
  } catch {
    return { ok: false, status: 0, problems: [{ code: '', message: own(t('noServer')) }] };
  }
}

// The server speaks English. What the page says itself is in its language; there are few such sentences.
const ownSentences = new Set<string>();

export function own(sentence: string): string {
  ownSentences.add(sentence);
  return sentence;
}

// Of an answer that does not say why.
export function refusal(status: number): string {
  return own(t('refused', { status: String(status) }));
}

// For the attribute `lang` of an element with sentences of either.
export function languageOf(sentence: string): 'en' | undefined {
  return ownSentences.has(sentence) ? undefined : 'en';
}

export function sentences(problems: Problem[]): string {
  return problems.map(({ message, hint }) => (hint ? `${message}: ${hint}` : message)).join('; ');
}
