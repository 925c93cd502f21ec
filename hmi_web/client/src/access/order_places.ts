// The locations between which orders of a fleet go, as its supervisor says them (supervisor/doc/goals.md). Read with doubt.

export function locationsOf(form: unknown): string[] {
  const locations = (form as { locations?: unknown } | null)?.locations;
  if (!Array.isArray(locations)) return [];
  return [...new Set(locations.filter((each): each is string => typeof each === 'string' && each !== ''))].sort((a, b) => a.localeCompare(b, undefined, { numeric: true }));
}
