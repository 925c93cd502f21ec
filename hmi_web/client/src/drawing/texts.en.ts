export default {
  drawing: 'drawing of the plant',
  forced: 'Forced: {names}.',
  cannot: 'The drawing could not be fetched.',
  unbound: 'Bound to nothing in this cell: {names}',
  unread: 'No value of the plant: {reasons}.',
} as const;
