// A display on the wall: /#wall (hmi_web/doc/access.md). Pure.

// `hash`: of the page's address.
export const isWall = (hash: string): boolean => hash === '#wall';

const SCREEN = 'screen:';

// The screen that a panel is; '' for a panel of the page.
export const screenOf = (panel: string): string => (panel.startsWith(SCREEN) ? panel.slice(SCREEN.length) : '');

// What there is to be shown of a cell.
export interface Showable {
  screen: string; // the one that viewers begin with; '' if nobody has drawn any
  plant: boolean; // a picture of it
  plan: boolean; // a supervisor plans for the cell
  levels: boolean; // of the plant, over time
  alarms: boolean;
}

// What a display shows for which nobody has chosen panels: nothing that would stay empty.
export function usualPanels({ screen, plant, plan, levels, alarms }: Showable): string[] {
  const picture = screen !== '' ? `${SCREEN}${screen}` : plant ? 'synoptic' : '';
  const panels = [picture, plan ? 'plan' : '', levels ? 'trend' : ''].filter((panel) => panel !== '');
  // The overview has the alarms in it.
  return panels.length === 0 ? ['overview'] : [...(alarms ? ['alarms'] : []), ...panels];
}

// The area of the grid where a panel stands: names of screens are no names of areas.
export const areaOf = (panel: string, panels: readonly string[]): string => (screenOf(panel) === '' ? panel : `screen-${panels.indexOf(panel)}`);

// Where its panels stand, in their order (grid-template-areas): below each other, or two beside each other.
export function wallAreas(chosen: readonly string[]): { single: string; double: string } {
  const panels = chosen.map((panel) => areaOf(panel, chosen));
  const rows: string[] = [];
  for (let i = 0; i < panels.length; i += 2) rows.push(`'${panels[i] ?? ''} ${panels[i + 1] ?? panels[i] ?? ''}'`);
  return { single: panels.map((panel) => `'${panel}'`).join(' '), double: rows.join(' ') };
}
