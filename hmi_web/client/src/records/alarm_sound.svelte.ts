// A short tone every two seconds while an alarm waits to be acknowledged, unless whoever looks has muted it. Each person's choice is
// kept in this browser. A browser lets a page make sounds only after somebody has clicked on it.

import { recall, remember } from '../lib/remembered';
import type { Priority } from './records';

const EVERY_MS = 2_000;
const TONE_S = 0.25;
const HERTZ: Record<Priority, number> = { critical: 988, high: 784, medium: 587, low: 440 };

export class AlarmSound {
  muted = $state(false);
  private user = '';
  private context: AudioContext | null = null;
  private timer = 0;
  private priority: Priority | null = null;

  // Of whoever looks now; empty: nobody has logged in.
  setUser(user: string): void {
    this.user = user;
    this.muted = recall(this.key()) === 'muted';
  }

  mute(muted: boolean): void {
    this.muted = muted;
    remember(this.key(), muted ? 'muted' : 'on');
  }

  // The most urgent one that waits; null: none does.
  show(priority: Priority | null): void {
    this.priority = priority;
    if (priority === null) return this.end();
    if (this.timer !== 0) return;
    this.play();
    this.timer = window.setInterval(() => this.play(), EVERY_MS);
  }

  end(): void {
    window.clearInterval(this.timer);
    this.timer = 0;
  }

  private key(): string {
    return `stepwright.sound.${this.user}`;
  }

  private play(): void {
    if (this.muted || this.priority === null) return;
    try {
      this.context ??= new AudioContext();
      // Nobody has clicked yet: it is tried again with the next tone.
      if (this.context.state === 'suspended') void this.context.resume().catch(() => undefined);
      const now = this.context.currentTime;
      const tone = this.context.createOscillator();
      const loudness = this.context.createGain();
      tone.frequency.value = HERTZ[this.priority];
      loudness.gain.setValueAtTime(0.2, now);
      loudness.gain.exponentialRampToValueAtTime(0.001, now + TONE_S);
      tone.connect(loudness).connect(this.context.destination);
      tone.start(now);
      tone.stop(now + TONE_S);
    } catch {
      // A machine without a loudspeaker shows its alarms all the same.
    }
  }
}
