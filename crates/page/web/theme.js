// Colours of the page, read from its style.

export function colours() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    text: of('text'), faint: of('faint'), grid: of('grid'), panel: of('panel'), body: of('body'), edge: of('edge'),
    series: [of('blue'), of('orange'), of('green'), of('purple'), of('red'), of('brown')],
    /** open, stick, slip forwards and backwards */
    states: [of('faint'), of('blue'), of('red'), of('orange')],
    /** open, stick, partial, slip */
    contact: [of('faint'), of('blue'), of('purple'), of('red')],
  };
}

export const dark = matchMedia('(prefers-color-scheme: dark)');

/** A canvas at the resolution of the screen: calls `draw(context, width, height)`. */
export function paint(canvas, draw) {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!width || !height) return;
  const ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = '12px system-ui, sans-serif';
  draw(context, width, height);
}
