// A display on the wall: /#wall (hmi_web/doc/access.md). Pure.

// `hash`: of the page's address.
export const isWall = (hash: string): boolean => hash === '#wall';

// Where its panels stand, in their order (grid-template-areas): below each other, or two beside each other.
export function wallAreas(panels: readonly string[]): { single: string; double: string } {
  const rows: string[] = [];
  for (let i = 0; i < panels.length; i += 2) rows.push(`'${panels[i] ?? ''} ${panels[i + 1] ?? panels[i] ?? ''}'`);
  return { single: panels.map((panel) => `'${panel}'`).join(' '), double: rows.join(' ') };
}
