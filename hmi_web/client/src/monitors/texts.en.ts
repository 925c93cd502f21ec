export default {
  monitors: 'Monitors',
  failedOf: '{failed} of {total} failed',
  monitor: 'Monitor',
  formula: 'Formula',
  verdict: 'Verdict',
  undecided: 'watching',
  satisfied: 'satisfied',
  failed: 'failed',
  left: 'Steps to go',
  state: 'State',
  since: 'Scans in it',
} as const;
