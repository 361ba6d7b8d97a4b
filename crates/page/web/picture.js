// The pictures of the page as one file.

const save = (blob, name) => {
  const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};

const escape = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

/** Saves what is shown in `place`: every canvas where it is, with the headings. SVG keeps the headings as text. */
export function picture(kind, title, place) {
  const frame = place.getBoundingClientRect();
  const shown = [...place.querySelectorAll('canvas')].filter((canvas) => canvas.clientWidth && canvas.id !== 'timeline');
  const boxes = shown.map((canvas) => ({ canvas, box: canvas.getBoundingClientRect() }));
  const heads = [...place.querySelectorAll('.picture h2')].filter((head) => head.parentNode.querySelector('canvas')).map((head) => ({ text: [head.firstChild.textContent, head.querySelector('select')?.selectedOptions[0]?.textContent, head.querySelector('output')?.textContent].filter(Boolean).join(' ').trim(), box: head.getBoundingClientRect() }));
  for (const entry of place.querySelectorAll('.u-series')) {
    const box = entry.getBoundingClientRect();
    if (box.width && entry.querySelector('.u-marker')) heads.push({ text: entry.textContent.trim(), box, colour: getComputedStyle(entry.querySelector('.u-marker')).borderColor });
  }
  const width = Math.max(...boxes.map(({ box }) => box.right - frame.left)) + 12;
  const height = Math.max(...boxes.map(({ box }) => box.bottom - frame.top)) + 40;
  const style = getComputedStyle(document.body);
  const name = title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '') || 'stickslip';
  if (kind === 'png') {
    const ratio = 2;
    const sheet = Object.assign(document.createElement('canvas'), { width: width * ratio, height: height * ratio });
    const g = sheet.getContext('2d');
    g.scale(ratio, ratio);
    g.fillStyle = style.backgroundColor;
    g.fillRect(0, 0, width, height);
    g.fillStyle = style.color;
    g.font = '600 16px system-ui, sans-serif';
    g.fillText(title, 12, 22);
    g.font = '600 13px system-ui, sans-serif';
    heads.forEach(({ text, box, colour }) => {
      g.fillStyle = colour ?? style.color;
      g.fillText(text, box.left - frame.left, box.top - frame.top + 42);
    });
    boxes.forEach(({ canvas, box }) => g.drawImage(canvas, box.left - frame.left, box.top - frame.top + 30, box.width, box.height));
    sheet.toBlob((blob) => save(blob, `${name}.png`));
    return;
  }
  const text = (x, y, size, words, colour = style.color) => `<text x="${x}" y="${y}" font-size="${size}" font-weight="600" fill="${colour}">${escape(words)}</text>`;
  const parts = boxes.map(({ canvas, box }) => `<image x="${box.left - frame.left}" y="${box.top - frame.top + 30}" width="${box.width}" height="${box.height}" href="${canvas.toDataURL()}"/>`);
  const lines = heads.map(({ text: words, box, colour }) => text(box.left - frame.left, box.top - frame.top + 42, 13, words, colour));
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" fill="${style.color}"><rect width="100%" height="100%" fill="${style.backgroundColor}"/>${text(12, 22, 16, title)}${lines.join('')}${parts.join('')}</svg>`;
  save(new Blob([svg], { type: 'image/svg+xml' }), `${name}.svg`);
}
