// The attributes of operator parts, as the server reads them (hmi_web/doc/screens.md). Pure.

import { isWriting } from '../parts';
import { attribute, type FieldName, type Params } from './template';

// The field without which it does nothing; null: it has all.
export function missedOf(kind: string, p: Params): FieldName | null {
  if (kind === 'navigate') return p.go ? null : 'go';
  if (!isWriting(kind)) return null;
  if (!p.write) return 'write';
  if (kind === 'button') return p.literal ? null : 'literal';
  if (kind === 'choice') return (p.values ?? '').split(';').filter((each) => each.trim() !== '').length > 1 ? null : 'values';
  return !['setpoint', 'slider'].includes(kind) || Number(p.from ?? NaN) < Number(p.to ?? NaN) ? null : 'to';
}
// One that is not complete is none yet: it can be saved all the same, and writes nothing.
export const isComplete = (kind: string, p: Params): boolean => missedOf(kind, p) === null;

export function partAttributes(kind: string, p: Params, key: string): string {
  if (!isComplete(kind, p)) return '';
  const own = attribute('data-part', kind) + attribute('data-label', p.label);
  if (kind === 'navigate') return own + attribute('data-go', p.go);
  if (!isWriting(kind)) return own + attribute('data-tags', p.tags) + (kind === 'trend' ? attribute('data-minutes', p.minutes) : '');
  const least = p.least === 'engineer' ? attribute('data-least', p.least) : '';
  const written = own + attribute('data-key', key) + attribute('data-write', p.write) + attribute('data-confirm', p.confirm) + least;
  switch (kind) {
    case 'button':
      return written + attribute('data-value', p.literal);
    case 'choice':
      return written + attribute('data-values', p.values);
    case 'startstop':
      return written + attribute('data-stop', p.stop) + attribute('data-on', p.on);
    case 'switch':
      return written;
    default:
      return written + attribute('data-from', p.from) + attribute('data-to', p.to) + attribute('data-step', p.step) + attribute('data-unit', p.unit);
  }
}
