// Asks now and then again for as long as the next turn is wanted: each waits for the answer to the one before, so
// that a slow server is not asked faster. A turn says after how many ms the next one comes, or null for the last.
//
//   $effect(() => askAgain(async (signal) => { await look(signal); return 1_000; }));
//
// What is returned ends it; the signal aborts the question that is under way. A turn does not throw.
export function askAgain(turn: (signal: AbortSignal) => Promise<number | null>): () => void {
  const stop = new AbortController();
  let timer = 0;
  async function go(): Promise<void> {
    const rest = await turn(stop.signal);
    if (rest !== null && !stop.signal.aborted) timer = window.setTimeout(() => void go(), rest);
  }
  void go();
  return () => {
    stop.abort();
    window.clearTimeout(timer);
  };
}
