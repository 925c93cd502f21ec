// How many rows of a long list are on the page: of thousands nobody reads more than a few hundred, and a browser lays out all
// that there are. shell/MoreRows.svelte says how many there are beside them.

export const FIRST_ROWS = 200;
const MORE_ROWS = 400;

export class RowLimit {
  most = $state(FIRST_ROWS);

  more(): void {
    this.most += MORE_ROWS;
  }

  of<T>(rows: readonly T[]): readonly T[] {
    return rows.length <= this.most ? rows : rows.slice(0, this.most);
  }
}
