// Incidents in words: what happened, what was decided, how much of the plan that kept.

import type { Incident, IncidentAlarm } from '../lib/protocol';
import { bare, short } from '../lib/format';
import { t } from './texts';

export type Tone = 'plain' | 'active' | 'alarm';

// A word that this page does not know is shown as it came.
export function kindText(incident: Incident): string {
  return t.word('kind', incident.kind);
}

export function decisionText(incident: Incident): string {
  return t.word('decision', incident.decision);
}

export function decisionTone(incident: Incident): Tone {
  if (incident.decision === 'safe_stop') return 'alarm';
  return incident.decision === 'open' ? 'active' : 'plain';
}

// "decided in 4.2 ms; 7 of 11 actions kept"
export function effortText(incident: Incident): string {
  if (incident.decision === 'open') return '';
  const parts: string[] = [];
  if (typeof incident.decision_ms === 'number') parts.push(t('decidedIn', { ms: short(incident.decision_ms) }));
  const remaining = incident.remaining ?? 0;
  if (remaining > 0 && incident.decision !== 'safe_stop') parts.push(t('kept', { kept: incident.kept ?? 0, remaining }));
  if (incident.restarts) parts.push(t('overtaken', { count: incident.restarts }));
  return parts.join('; ');
}

// "invariant of load v1 f1 level8: level of a2 within 0.2 of 2 (1.7), scan 812"
export function alarmText(alarm: IncidentAlarm): string {
  const value = alarm.sensor ? ` (${short(alarm.value)})` : '';
  return t('alarm', {
    kind: t.word('monitor', alarm.kind),
    action: bare(alarm.action),
    condition: `${alarm.condition}${value}`,
    scan: String(alarm.scan),
  });
}
