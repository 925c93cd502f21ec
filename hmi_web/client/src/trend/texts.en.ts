export default {
  levels: 'Levels',
  trend: 'Trend',
  nothing: 'nothing recorded yet',
  since: 'recorded since {time}',
  legend: 'legend',
  truth: 'true level of the simulation',
  levelsOverTime: 'levels over time',
  valuesOverTime: 'values over time',
} as const;
