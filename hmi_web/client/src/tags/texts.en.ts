export default {
  tags: 'Tags',
  count: '{shown} of {total}',
  all: 'All',
  search: 'Search tags by name or address',
  searchHint: 'name or address',
  values: 'tag values',
  tag: 'Tag',
  address: 'Address',
  type: 'Type',
  value: 'Value',
  set: 'Set',
  setOne: 'Set {name}',
} as const;
