// Keeps a WebSocket to the server open for as long as the page is, and says when it cannot.

import type { ServerMessage } from './protocol';

// `closed`: nobody looks, as nobody who may has logged in.
export type LinkState = 'connecting' | 'live' | 'lost' | 'closed';

export interface ConnectionEvents {
  onMessage(message: ServerMessage): void;
  onState(state: LinkState): void;
  // A connection has ended or could not be opened; done once it is known who looks now.
  onLost(): Promise<void>;
  // The first that is said on a connection.
  greeting(): string;
  // Somebody else looks from now on.
  onOther(): void;
  // What the WebSocket offers: the token of the session, if there is one.
  protocols(): string[];
}

// The server says something at least every second.
const SILENCE_MS = 3_000;
const FIRST_RETRY_MS = 250;
const LAST_RETRY_MS = 4_000;
// With this code the server closes what belongs to a session that is over.
const SESSION_OVER = 4401;

export class Connection {
  private socket: WebSocket | null = null;
  private retryMs = FIRST_RETRY_MS;
  private retryTimer = 0;
  private silenceTimer = 0;
  private wanted = true;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
  ) {
    // A laptop that wakes up, or a network that comes back, should not wait for the timer.
    window.addEventListener('online', () => this.retryNow());
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'visible') this.retryNow();
    });
    this.open();
  }

  private open(): void {
    const socket = new WebSocket(this.url, this.events.protocols());
    this.socket = socket;
    this.watchSilence();
    socket.onopen = () => socket.send(this.events.greeting());
    socket.onmessage = (event: MessageEvent<string>) => {
      this.watchSilence();
      this.retryMs = FIRST_RETRY_MS;
      this.events.onState('live');
      this.events.onMessage(JSON.parse(event.data) as ServerMessage);
    };
    socket.onclose = ({ code }) => {
      if (this.socket !== socket) return;
      if (code === SESSION_OVER) this.askWhoLooks();
      else this.lose();
    };
  }

  // While it is not, there is nobody to tell; the next one begins with all there is to say.
  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  send(text: string): void {
    if (this.isOpen) this.socket?.send(text);
  }

  // Somebody else looks from now on, or nobody: what was open was for the one before.
  restart(open: boolean): void {
    window.clearTimeout(this.retryTimer);
    this.drop();
    this.wanted = open;
    this.retryMs = FIRST_RETRY_MS;
    this.events.onOther();
    this.events.onState(open ? 'connecting' : 'closed');
    if (open) this.open();
  }

  // A connection whose other end vanished without a word looks open for minutes.
  private watchSilence(): void {
    window.clearTimeout(this.silenceTimer);
    this.silenceTimer = window.setTimeout(() => this.lose(), SILENCE_MS);
  }

  private drop(): void {
    window.clearTimeout(this.silenceTimer);
    const socket = this.socket;
    this.socket = null;
    if (!socket) return;
    socket.onopen = null;
    socket.onclose = null;
    socket.onmessage = null;
    socket.close();
  }

  // The server is there, and says that somebody else looks from now on: nothing is lost.
  private askWhoLooks(): void {
    this.drop();
    this.events.onState('connecting');
    void this.events.onLost().then(() => this.retryNow());
  }

  private lose(): void {
    this.drop();
    this.events.onState('lost');
    void this.events.onLost();
    // Spread out, so that many pages do not all come back in the same instant.
    const delay = this.retryMs * (0.75 + Math.random() / 2);
    this.retryMs = Math.min(this.retryMs * 2, LAST_RETRY_MS);
    this.retryTimer = window.setTimeout(() => this.open(), delay);
  }

  private retryNow(): void {
    if (this.socket || !this.wanted) return;
    window.clearTimeout(this.retryTimer);
    this.retryMs = FIRST_RETRY_MS;
    this.open();
  }
}

export function liveUrl(location: Location): string {
  return `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live`;
}
