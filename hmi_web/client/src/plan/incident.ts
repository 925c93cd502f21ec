// Incidents in words: what happened, what was decided, how much of the plan that kept.

import type { Incident, IncidentAlarm } from '../lib/protocol';
import { bare, short } from '../lib/format';

const KINDS: Record<string, string> = {
  level: 'Level not as expected',
  position: 'Something stands elsewhere',
  timeout: 'Action not finished in time',
  refused: 'Action could not start',
  new_goal: 'New goal',
  changed_demand: 'Changed demand',
  failed_actuator: 'Actuator without effect',
  failed_sensor: 'Sensor failed',
  leak: 'Leak',
  lost_runtime: 'Runtime lost',
  program_fault: 'Program fault',
  operator: 'By the operator',
};

const DECISIONS: Record<string, string> = {
  open: 'being decided',
  go_on: 'plan goes on',
  repair: 'plan repaired',
  replan: 'new plan',
  safe_stop: 'safe stop',
};

export type Tone = 'plain' | 'active' | 'alarm';

// A word that this page does not know is shown as it came.
export function kindText(incident: Incident): string {
  return KINDS[incident.kind] ?? incident.kind;
}

export function decisionText(incident: Incident): string {
  return DECISIONS[incident.decision] ?? incident.decision;
}

export function decisionTone(incident: Incident): Tone {
  if (incident.decision === 'safe_stop') return 'alarm';
  return incident.decision === 'open' ? 'active' : 'plain';
}

// "decided in 4.2 ms; 7 of 11 actions kept"
export function effortText(incident: Incident): string {
  if (incident.decision === 'open') return '';
  const parts: string[] = [];
  if (typeof incident.decision_ms === 'number') parts.push(`decided in ${short(incident.decision_ms)} ms`);
  const remaining = incident.remaining ?? 0;
  if (remaining > 0 && incident.decision !== 'safe_stop') {
    parts.push(`${incident.kept ?? 0} of ${remaining} actions kept`);
  }
  if (incident.restarts) parts.push(`planning overtaken ${incident.restarts} times`.replace(/ 1 times$/, ' once'));
  return parts.join('; ');
}

// "invariant of load v1 f1 level8: level of a2 within 0.2 of 2 (1.7), scan 812"
export function alarmText(alarm: IncidentAlarm): string {
  const value = alarm.sensor ? ` (${short(alarm.value)})` : '';
  return `${alarm.kind} of ${bare(alarm.action)}: ${alarm.condition}${value}, scan ${alarm.scan}`;
}
