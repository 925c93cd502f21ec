// A bottle line without a plant whose program is changed: runtime, link and the page's server as real processes, in a folder of
// its own, and the programs that come after the first.

import { cellWithFiles } from './cell_folder.mjs';

const FIRST = `
PROGRAM Bottles
  VAR_EXTERNAL
    Count : DINT;
    Lamp : BOOL;
  END_VAR
  VAR
    limit : INT := 20;
    speed : INT := 3;
    ready : BOOL;
    label : STRING[20] := 'line 1';
  END_VAR
  (* one bottle a scan *)
  Count := Count + 1;
  ready := speed > 0;
  IF ready THEN
    Lamp := Count MOD 2 = 0;
  END_IF;
END_PROGRAM

PROGRAM Filler
  VAR
    fill : BOOL;
    go : BOOL;
  END_VAR
  INITIAL_STEP Waiting:
  END_STEP
  STEP Filling:
    fill(N);
  END_STEP
  TRANSITION begins FROM Waiting TO Filling := go;
  END_TRANSITION
  TRANSITION ends FROM Filling TO Waiting := NOT go;
  END_TRANSITION
END_PROGRAM

CONFIGURATION Plant
  VAR_GLOBAL
    Count : DINT;
    Lamp AT %QX0.0 : BOOL;
  END_VAR
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cycle : Bottles;
    PROGRAM Station WITH Cycle : Filler;
  END_RESOURCE
END_CONFIGURATION
`;

// Another type, a new and a lost variable, other lines, a step more.
const SECOND = FIRST.replace('speed : INT := 3;', 'speed : DINT := 4;')
  .replace('    label : STRING[20] := \'line 1\';\n', '    rejected : UINT;\n')
  .replace('Count MOD 2 = 0', 'Count MOD 3 = 0')
  .replace('  STEP Filling:', '  STEP Draining:\n  END_STEP\n  STEP Filling:')
  .replace('TO Waiting := NOT go;', 'TO Draining := NOT go;')
  .replace('END_PROGRAM\n\nCONFIGURATION', '  TRANSITION drained FROM Draining TO Waiting := TRUE;\n  END_TRANSITION\nEND_PROGRAM\n\nCONFIGURATION');

export const PROGRAMS = {
  first: FIRST,
  second: SECOND,
  // Ten scans of it can be seen.
  slow: SECOND.replace('INTERVAL := T#10ms', 'INTERVAL := T#300ms'),
  // Divides by zero in its fourth scan.
  trapping: FIRST.replace('limit : INT := 20;', 'limit : INT := 20;\n    scans : INT;\n    zero : INT;').replace(
    '  Count := Count + 1;',
    '  Count := Count + 1;\n  scans := scans + 1;\n  IF scans > 3 THEN\n    limit := limit / zero;\n  END_IF;',
  ),
  // Without the step that is active while the station fills.
  stepless: FIRST.replace(/Filling/g, 'Pouring'),
  // The lamp's output at another terminal.
  moved: FIRST.replace('%QX0.0', '%QX0.3'),
  wrong: FIRST.replace('ready := speed > 0;', 'ready := speeed > 0;').replace('go : BOOL;', 'go : BOOOL;'),
};

export async function startBottles(program) {
  const files = Object.fromEntries(Object.entries(PROGRAMS).map(([name, text]) => [`${name}.st`, text]));
  const cell = await cellWithFiles(program, 'change', { domain: 84, files });
  Object.assign(cell, {
    versions: cell.file('state/programs'),
    // Compiled as `name`.swb, with further options of the compiler.
    compile: (name, ...options) => cell.run('compile', cell.file(`${name}.st`), '-o', cell.file(`${name}.swb`), ...options),
    // Brought with the tool, past the server.
    change: (name) => cell.run('download', '--config', cell.config, cell.file(`${name}.swb`), '--change'),
  });
  return cell.runs(() => {
    cell.compile('first');
    cell.download('first.swb');
  });
}
