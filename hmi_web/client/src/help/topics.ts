// The panels that have a help: the areas of the page's grid, one for each. What it says is in texts.*.ts: `shows_<topic>`,
// and where there is something to say `colours_<topic>` and `keys_<topic>`.

export const TOPICS = [
  'synoptic', 'sfc', 'plan', 'incidents', 'trend', 'state', 'replans', 'scan', 'tags', 'monitors', 'result',
  'alarms', 'history', 'recipes', 'faults', 'screen', 'overview', 'screen-editor', 'scan-details', 'program-details', 'change-details',
  'plan-floor', 'automaton', 'arms', 'floor', 'vehicles', 'mission', 'gantt', 'goals',
] as const;

export type Topic = (typeof TOPICS)[number];

export function topicOf(area: string): Topic | null {
  return TOPICS.find((topic) => topic === area) ?? null;
}
