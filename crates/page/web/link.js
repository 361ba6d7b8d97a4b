// A scenario in the address: `#s=` and the raw-deflated JSON in base64url.

/** Largest scenario that a link may unpack to, bytes. */
const MOST = 1 << 20;

const through = (bytes, stream) => new Blob([bytes]).stream().pipeThrough(stream);

/** `sign` tells what is packed: s a scenario, c a contact. */
export async function pack(text, sign = 's') {
  const packed = new Uint8Array(await new Response(through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'))).arrayBuffer());
  let binary = '';
  for (let k = 0; k < packed.length; k += 4096) binary += String.fromCharCode(...packed.subarray(k, k + 4096));
  return `#${sign}=${btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')}`;
}

/** The scenario in a fragment; throws an error in words. */
export async function unpack(fragment, sign = 's') {
  const coded = new RegExp(`^#${sign}=([A-Za-z0-9_-]*)$`).exec(fragment)?.[1];
  if (!coded) throw new Error('The link contains no scenario: expected #s= with letters, digits, - and _.');
  const parts = [];
  let size = 0;
  try {
    const packed = Uint8Array.from(atob(coded.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
    const reader = through(packed, new DecompressionStream('deflate-raw')).getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.length;
      if (size > MOST) {
        reader.cancel();
        break;
      }
      parts.push(value);
    }
  } catch {
    throw new Error('The scenario in the link is damaged: it cannot be unpacked. Copy the whole link.');
  }
  if (size > MOST) throw new Error('The scenario in the link is refused: it unpacks to more than 1 MB.');
  return new Blob(parts).text();
}
