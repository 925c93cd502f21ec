// How the page looks: bright or dark, and in which colours. app.css has the colours for what the document's element says
// in `data-theme` and `data-colours`. Whoever draws on a canvas reads `version` and draws again.

import { recall, remember } from './remembered';

export const THEMES = ['system', 'light', 'dark'] as const;
export const COLOURS = ['standard', 'distinct'] as const;
export type Theme = (typeof THEMES)[number];
export type Colours = (typeof COLOURS)[number];

const THEME_KEY = 'stepwright.theme';
const COLOURS_KEY = 'stepwright.colours';

class Appearance {
  theme = $state<Theme>('system');
  colours = $state<Colours>('standard');
  // Grows whenever colours have changed.
  version = $state(0);

  start(): void {
    this.theme = THEMES.find((one) => one === recall(THEME_KEY)) ?? 'system';
    this.colours = COLOURS.find((one) => one === recall(COLOURS_KEY)) ?? 'standard';
    this.system().addEventListener('change', () => this.show());
    this.show();
  }

  choose(theme: Theme, colours: Colours): void {
    this.theme = theme;
    this.colours = colours;
    remember(THEME_KEY, theme);
    remember(COLOURS_KEY, colours);
    this.show();
  }

  private system(): MediaQueryList {
    return window.matchMedia('(prefers-color-scheme: dark)');
  }

  private show(): void {
    const { dataset } = document.documentElement;
    dataset.theme = this.theme !== 'system' ? this.theme : this.system().matches ? 'dark' : 'light';
    dataset.colours = this.colours;
    this.version += 1;
  }
}

export const appearance = new Appearance();
