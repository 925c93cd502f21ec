// The drawing of the plant that the server has: of the cell's file, or one that follows from the plant's components.

// Throws an Error if there is none.
export async function plantDrawing(signal?: AbortSignal): Promise<string> {
  const response = await fetch('/api/drawing', { credentials: 'same-origin', cache: 'no-store', ...(signal ? { signal } : {}) });
  if (!response.ok) throw new Error(String(response.status));
  return response.text();
}
