import { mount } from 'svelte';

import './app.css';
import App from './App.svelte';
import { appearance } from './lib/appearance.svelte';
import { ignoreHeldKey, ignoreStrayClicks } from './lib/double_click';
import { language } from './lib/language.svelte';

const target = document.getElementById('app');
appearance.start();
ignoreStrayClicks(window);
window.addEventListener('keydown', ignoreHeldKey);
// In its language from the beginning.
if (target) void language.start().then(() => mount(App, { target }));
