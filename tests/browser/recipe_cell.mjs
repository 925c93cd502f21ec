// A mixer without a plant: runtime, link and the page's server as real processes, in a folder of its own.

import { cellWithFiles } from './cell_folder.mjs';

export const PROGRAM = `
TYPE
  Phase : (Waiting, Mixing) := Waiting;
END_TYPE
PROGRAM Mixer
  VAR
    phase : Phase;
    level : REAL := 12.5;
    batches : INT := 3; // batches in a row
    stir : BOOL := FALSE;
    soak : TIME := T#30s;
    soaking : TON;
    total : REAL;
    before : REAL := 12.5;
    batches_before : INT := 3;
    torn : DINT;
  END_VAR
  // Level and batches come and go together: a scan that sees only one of them new has seen half of a recipe.
  IF (level <> before) <> (batches <> batches_before) THEN
    torn := torn + 1;
  END_IF;
  before := level;
  batches_before := batches;
  soaking(IN := stir, PT := soak);
  IF stir THEN phase := Mixing; ELSE phase := Waiting; END_IF;
  total := level * INT_TO_REAL(batches);
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cycle : Mixer;
  END_RESOURCE
END_CONFIGURATION
`;

const RECIPES = `
[[tag]]
name = "Main.level"
type = "REAL"
min = 0
max = 100
unit = "%"
comment = "how full the mixer is to be"

[[tag]]
name = "Main.batches"
type = "INT"
min = 1
max = 20
comment = "batches in a row"

[[tag]]
name = "Main.stir"
type = "BOOL"
comment = "stirs while it soaks"

[[tag]]
name = "Main.soak"
type = "TIME"
min = 0
max = 600
comment = "before it is drained"
`;

export const LEVEL_ALARM = `
[[alarm]]
name = "level.high"
source = "Main.level"
when = "high"
limit = 50
priority = "high"
text = "The mixer is too full"
`;

// Lines of a mixer that has the file alarms.toml.
export const KEEPS_RECORDS = '[history]\nfolder = "history"\nalarms = "alarms.toml"\n';

// `files`: more of them beside the configuration, by name, or others in place of those above; `more`: lines of its [hmi].
export async function startMixer(program, files = {}, more = '') {
  const cell = await cellWithFiles(program, 'recipes', {
    domain: 67,
    files: { 'recipes.toml': RECIPES, 'main.st': PROGRAM, ...files },
    more: `recipes = "recipes.toml"\n${more}`,
  });
  Object.assign(cell, {
    recipes: cell.file('state/recipes'),
    // A runtime that was killed begins empty.
    startAgain: async () => {
      await cell.startRuntime();
      cell.download('main.swb');
    },
  });
  return cell.runs(() => {
    cell.run('compile', cell.file('main.st'), '-o', cell.file('main.swb'));
    cell.download('main.swb');
  });
}
