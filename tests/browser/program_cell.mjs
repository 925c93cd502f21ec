// A cell without a plant that runs a program in all languages: runtime, link and the page's server as real processes, in a
// folder of its own.

import { cellWithFiles } from './cell_folder.mjs';
import { DRAWN, TEXT } from './program_sources.mjs';

export async function startProgramCell(program) {
  const cell = await cellWithFiles(program, 'program', { domain: 68, files: { 'main.st': TEXT, 'logic.xml': DRAWN } });
  // Compiles and loads the program, with further options of the compiler.
  cell.load = (...options) => {
    cell.run('compile', cell.file('main.st'), cell.file('logic.xml'), '-o', cell.file('main.swb'), ...options);
    cell.download('main.swb');
  };
  return cell.runs(() => cell.load());
}
