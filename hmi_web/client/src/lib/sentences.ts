// Sentences of the server and of the supervisor, which speak English, in the language of the page: those that are known. Pure.

// What is in the groups of a pattern stays as it is: names, formulas, times.
export type Sentences<Key extends string> = readonly (readonly [RegExp, Key])[];

// null: it is none of these.
export function known<Key extends string>(sentence: string, table: Sentences<Key>, say: (key: Key, values: Record<string, string>) => string): string | null {
  for (const [pattern, key] of table) {
    const found = pattern.exec(sentence);
    if (found) return say(key, { ...found.groups });
  }
  return null;
}
