// What makes a page hard to use on a phone or by keyboard, found inside the page.

// What cannot be read: text beyond the page, and text that its own box or one around it cuts off. What scrolls in a region of its
// own can be read, sideways only if keys reach that region.
export function unreadable() {
  const wide = document.documentElement.clientWidth;
  const reached = (node) => node.matches('[tabindex="0"]') || node.querySelector('a, button, input, select, textarea, [tabindex="0"]') !== null;
  const scrolls = (node) => {
    for (let at = node.parentElement; at; at = at.parentElement) {
      const { overflowX } = getComputedStyle(at);
      if ((overflowX === 'auto' || overflowX === 'scroll') && at.scrollWidth > at.clientWidth) return reached(at);
    }
    return false;
  };
  // A box that neither shows what is larger than it nor scrolls, before one that does; a picture that keys move is such a one.
  const isCut = (node, box) => {
    for (let at = node.parentElement; at && at !== document.body; at = at.parentElement) {
      const { overflowX, overflowY, position } = getComputedStyle(at);
      const moves = [overflowX, overflowY].some((one) => one === 'auto' || one === 'scroll') || at.matches('[role=region][tabindex="0"]');
      if (moves || position === 'fixed') return false;
      const around = at.getBoundingClientRect();
      const hides = (overflow) => overflow === 'hidden' || overflow === 'clip';
      if (hides(overflowX) && (box.right > around.right + 1 || box.left < around.left - 1)) return true;
      if (hides(overflowY) && (box.bottom > around.bottom + 1 || box.top < around.top - 1)) return true;
    }
    return false;
  };
  const found = [];
  for (const node of document.querySelectorAll('body *')) {
    const text = [...node.childNodes].some((one) => one.nodeType === Node.TEXT_NODE && one.textContent.trim() !== '');
    if (!text || node.closest('.visually-hidden, svg, option')) continue;
    const box = node.getBoundingClientRect();
    if (box.width === 0 || box.height === 0) continue;
    const name = `${node.tagName.toLowerCase()} "${node.textContent.trim().slice(0, 50)}"`;
    if ((box.right > wide + 1 || box.left < -1) && !scrolls(node)) found.push(`beyond the page: ${name}`);
    const style = getComputedStyle(node);
    const cuts = style.overflowX === 'hidden' || style.overflowX === 'clip';
    if ((cuts && node.scrollWidth > node.clientWidth + 1) || isCut(node, box)) found.push(`cut off: ${name}`);
  }
  return found;
}

// What has the focus, if nobody can see that it has it or where it is.
export function hiddenFocus() {
  const node = document.activeElement;
  if (!node || node === document.body) return '';
  const style = getComputedStyle(node);
  const around = getComputedStyle(node.closest('label, tr, li, g') ?? node);
  const drawn = (one) => (one.outlineStyle !== 'none' && parseFloat(one.outlineWidth) > 0) || one.boxShadow !== 'none';
  // A vehicle of a picture has a ring instead.
  const ring = node.querySelector(':scope .ring');
  if (ring && getComputedStyle(ring).stroke !== 'none') return '';
  const label = node.id || node.ariaLabel || node.dataset.testid || node.textContent.trim().slice(0, 30);
  const name = `${node.tagName.toLowerCase()} ${label}`;
  if (!drawn(style) && !drawn(around)) return `${name}: nothing shows it`;
  const box = node.getBoundingClientRect();
  const inSight = box.right > 0 && box.left < innerWidth && box.bottom > 0 && box.top < innerHeight;
  return inSight ? '' : `${name}: out of sight`;
}
