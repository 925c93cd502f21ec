// Where the panels of the page stand (grid-template-areas), by what the cell has: a panel that would stay empty for ever
// takes no room. `narrow` from 760 px on, `wide` from 1180 px on: columns of 1.9, 1.1 and 1.9 parts.

export interface Presence {
  plant: boolean; // something to draw
  pictures: boolean; // that a mission shows of its plan
  plan: boolean; // a supervisor plans for the cell
  levels: boolean; // values drawn over time
  monitors: boolean; // formulas that the scan watches
  sequence: boolean; // the program has charts; one that is planned always has
}

export interface PageAreas {
  single: string;
  narrow: string;
  wide: string;
}

const quoted = (rows: string[][]): string => rows.map((row) => `'${row.join(' ')}'`).join(' ');

export function pageAreas({ plant, pictures, plan, levels, monitors, sequence }: Presence): PageAreas {
  // What a mission shows of its plan has the plan and its buttons at its side, not below the plant.
  const [first, second] = pictures ? ['plan', 'synoptic'] : ['synoptic', 'plan'];
  const single = ['pictures', first, second, 'incidents', 'sfc', 'trend', 'state', 'replans', 'monitors', 'scan', 'tags'].filter(
    (area) =>
      (area !== 'synoptic' || plant) &&
      (area !== 'pictures' || pictures) &&
      (!['plan', 'incidents', 'state', 'replans'].includes(area) || plan) &&
      (area !== 'trend' || levels) &&
      (area !== 'monitors' || monitors),
  );
  const above = plant ? [['synoptic', 'synoptic']] : [];
  // Over all columns above and below the rest.
  const across = (area: string, columns: number, there: boolean) => (there ? [Array<string>(columns).fill(area)] : []);
  const top = (columns: number) => across('pictures', columns, pictures);
  const below = (columns: number) => across('monitors', columns, monitors);
  const both = (rows: string[][], planned: string[]) => (pictures ? [planned, ...rows] : [...rows, planned]);
  const beside = above.map((row) => [...row, 'sfc']);
  if (plan) {
    return {
      single: quoted(single.map((area) => [area])),
      narrow: quoted([
        ...top(2), ...both(above, ['plan', 'plan']), ['incidents', 'incidents'],
        ...(levels ? [['sfc', 'trend']] : []), ['sfc', 'state'], ['sfc', 'scan'], ['replans', 'tags'], ...below(2),
      ]),
      wide: quoted([
        ...top(3), ...both(beside, ['plan', 'plan', 'sfc']), ['incidents', 'incidents', 'sfc'],
        levels ? ['trend', 'state', 'tags'] : ['state', 'state', 'tags'], ['replans', 'scan', 'tags'], ...below(3),
      ]),
    };
  }
  // Without a chart the program needs no more room than its buttons.
  if (!sequence) {
    return {
      single: quoted(single.map((area) => [area])),
      narrow: quoted([...top(2), ...above, ['sfc', 'tags'], ['scan', 'tags'], ...across('trend', 2, levels), ...below(2)]),
      wide: quoted([
        ...top(3), ...(plant ? [['synoptic', 'synoptic', 'sfc'], ['synoptic', 'synoptic', 'scan'], ['tags', 'tags', 'tags']] : [['sfc', 'tags', 'tags'], ['scan', 'tags', 'tags']]),
        ...across('trend', 3, levels), ...below(3),
      ]),
    };
  }
  return {
    single: quoted(single.map((area) => [area])),
    narrow: quoted([...top(2), ...above, ['sfc', 'scan'], ['sfc', 'tags'], ...(levels ? [['trend', 'trend']] : []), ...below(2)]),
    wide: quoted([...top(3), ...beside, plant ? ['scan', 'scan', 'tags'] : ['sfc', 'scan', 'tags'], ...(levels ? [['trend', 'trend', 'tags']] : []), ...below(3)]),
  };
}
