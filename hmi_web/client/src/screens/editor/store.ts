// Screens and faces from the server, for whoever draws.

import type { Reply } from '../../access/api';
import type { Session } from '../../access/session.svelte';
import { pathOf, type Screen, type ScreenList } from '../screens';
import { svgOf, type Face, type Faces } from './model';
import { contentOf, faceOf } from './read';

export const START = '/api/screen-start';

export const fetchScreen = (session: Session, name: string): Promise<Reply<Screen>> => session.ask<Screen>('GET', pathOf(name));

export async function fetchFaces(session: Session, list: ScreenList): Promise<Faces> {
  const faces = new Map<string, Face>();
  for (const { name, symbol, removed } of list.screens) {
    if (!symbol || removed) continue;
    const reply = await fetchScreen(session, name);
    if (reply.ok) faces.set(name, faceOf(name, reply.data.svg));
  }
  return faces;
}

// Saves every screen anew in which the face stands; how many these are.
export async function redrawUses(session: Session, list: ScreenList, face: string, faces: Faces): Promise<number> {
  let count = 0;
  for (const { name, symbol, removed } of list.screens) {
    if (symbol || removed) continue;
    const reply = await fetchScreen(session, name);
    if (!reply.ok) continue;
    const content = contentOf(reply.data.svg);
    if (!content.items.some(({ symbol: kind, params }) => kind === 'face' && params.face === face)) continue;
    const saved = await session.ask('PUT', pathOf(name), { svg: svgOf(content, faces), version: reply.data.version, comment: face });
    count += saved.ok ? 1 : 0;
  }
  return count;
}
