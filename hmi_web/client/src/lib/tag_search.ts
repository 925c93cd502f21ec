// Finding a name by parts of it, of its description or group, in any order. Pure.

export interface Named {
  name: string;
  type: string;
  words: string; // what is said of it
}

// Names that begin so first, then those that have it in their name, then those of which it is said.
export function found(names: readonly Named[], text: string, most: number): Named[] {
  const parts = text.replace(/^!/, '').toLowerCase().split(/\s+/).filter((part) => part !== '');
  const rank = ({ name }: Named) => {
    const low = name.toLowerCase();
    const last = low.slice(low.lastIndexOf('.') + 1);
    if (parts.length === 0) return 0;
    if (parts.every((part) => last.startsWith(part) || low.startsWith(part))) return 0;
    return parts.every((part) => low.includes(part)) ? 1 : 2;
  };
  return names
    .filter(({ name, words }) => parts.every((part) => `${name} ${words}`.toLowerCase().includes(part)))
    .map((each) => ({ each, rank: rank(each) }))
    .sort((a, b) => a.rank - b.rank)
    .slice(0, most)
    .map(({ each }) => each);
}

// What somebody means who has typed that and nothing more: the name, its last part or what people call it as a whole, else all that
// have its parts.
export function meantBy(names: readonly Named[], text: string): Named[] {
  const wanted = text.trim().toLowerCase();
  if (wanted === '') return [];
  const whole = names.filter(({ name }) => name.toLowerCase() === wanted);
  if (whole.length > 0) return whole;
  const called = names.filter(({ name, words }) => words.toLowerCase() === wanted || name.toLowerCase().endsWith(`.${wanted}`));
  return called.length > 0 ? called : found(names, text, Infinity);
}
