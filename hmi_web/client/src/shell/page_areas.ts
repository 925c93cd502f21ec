// Where the panels of the page stand (grid-template-areas), by what the cell has: a panel that would stay empty for ever
// takes no room. `narrow` from 760 px on, `wide` from 1180 px on: columns of 1.9, 1.1 and 1.9 parts.

export interface Presence {
  plant: boolean; // something to draw
  pictures: boolean; // that a mission shows of its plan
  plan: boolean; // a supervisor plans for the cell
  levels: boolean; // values drawn over time
  monitors: boolean; // formulas that the scan watches
}

export interface PageAreas {
  single: string;
  narrow: string;
  wide: string;
}

const quoted = (rows: string[][]): string => rows.map((row) => `'${row.join(' ')}'`).join(' ');

export function pageAreas({ plant, pictures, plan, levels, monitors }: Presence): PageAreas {
  const single = ['synoptic', 'pictures', 'plan', 'incidents', 'sfc', 'trend', 'state', 'replans', 'monitors', 'scan', 'tags'].filter(
    (area) =>
      (area !== 'synoptic' || plant) &&
      (area !== 'pictures' || pictures) &&
      (!['plan', 'incidents', 'state', 'replans'].includes(area) || plan) &&
      (area !== 'trend' || levels) &&
      (area !== 'monitors' || monitors),
  );
  const above = [...(plant ? [['synoptic', 'synoptic']] : []), ...(pictures ? [['pictures', 'pictures']] : [])];
  // Over all columns below the rest.
  const below = (columns: number) => (monitors ? [Array<string>(columns).fill('monitors')] : []);
  const beside = above.map((row) => [...row, 'sfc']);
  if (plan) {
    return {
      single: quoted(single.map((area) => [area])),
      narrow: quoted([
        ...above, ['plan', 'plan'], ['incidents', 'incidents'],
        ...(levels ? [['sfc', 'trend']] : []), ['sfc', 'state'], ['sfc', 'scan'], ['replans', 'tags'], ...below(2),
      ]),
      wide: quoted([
        ...beside, ['plan', 'plan', 'sfc'], ['incidents', 'incidents', 'sfc'],
        levels ? ['trend', 'state', 'tags'] : ['state', 'state', 'tags'], ['replans', 'scan', 'tags'], ...below(3),
      ]),
    };
  }
  return {
    single: quoted(single.map((area) => [area])),
    narrow: quoted([...above, ['sfc', 'scan'], ['sfc', 'tags'], ...(levels ? [['trend', 'trend']] : []), ...below(2)]),
    wide: quoted([...beside, above.length > 0 ? ['scan', 'scan', 'tags'] : ['sfc', 'scan', 'tags'], ...(levels ? [['trend', 'trend', 'tags']] : []), ...below(3)]),
  };
}
