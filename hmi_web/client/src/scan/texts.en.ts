export default {
  scan: 'Scan',
  state: 'State',
  cellTime: 'Cell time',
  p50: 'Scan p50',
  p99: 'Scan p99',
  max: 'Scan max',
  overruns: 'Overruns',
  speed: 'Speed',
  realTime: '{factor} × real time',
  trace: 'Trace',
  waiting: 'clock stands still for the supervisor',
  more: 'Tasks, I/O and links',
} as const;
