export default {
  drawing: 'drawing of the plant',
  forced: 'Forced: {names}.',
  cannot: 'The drawing could not be fetched.',
  unbound: 'Bound to nothing in this cell: {names}',
  unfilled: { one: 'Not filled in: the field {names} of a symbol.', other: 'Not filled in: the fields {names} of symbols.' },
  unread: 'No value of the plant: {reasons}.',
} as const;
