// Numbers with SI prefixes.

const PREFIXES = { '-18': 'a', '-15': 'f', '-12': 'p', '-9': 'n', '-6': 'µ', '-3': 'm', 0: '', 3: 'k', 6: 'M', 9: 'G', 12: 'T' };
/** Units that take prefixes as they stand. */
const TAKES = /^(m|s|N|J|W|V|A|Hz|Pa|m\/s|N\/m|N m|m\/s²|rad|rad\/s|C|F|Ω|Pa s|N s\/m)$/;
/** Units whose number is shown in another one: grams have the prefixes of mass. */
const AS = { kg: ['g', 1e3] };

/** The power of ten of the prefix for a largest value. */
export function exponent(largest, unit) {
  if (!(AS[unit] || TAKES.test(unit)) || !(largest > 0) || !Number.isFinite(largest)) return 0;
  const factor = AS[unit]?.[1] ?? 1;
  return Math.max(-18, Math.min(12, 3 * Math.floor(Math.log10(largest * factor * 1.0000001) / 3)));
}

/** Factor and name of a unit with the prefix for a largest value. */
export function scaled(largest, unit) {
  const [name, factor] = AS[unit] ?? [unit, 1];
  const power = exponent(largest, unit);
  return { factor: factor / 10 ** power, unit: PREFIXES[power] + name };
}

/** Digits without a tail of zeros. */
function digits(value, count) {
  if (!Number.isFinite(value)) return value > 0 ? '∞' : value < 0 ? '−∞' : '–';
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(count - 1) : value.toPrecision(count);
  const [mantissa, power] = text.split('e');
  const short = mantissa.includes('.') ? mantissa.replace(/\.?0+$/, '') : mantissa;
  return (power ? `${short}e${power.replace('+', '')}` : short).replace(/^-/, '−');
}

/** A quantity as text, such as "3.2 nm". */
export function words(value, unit = '', count = 4) {
  const { factor, unit: name } = scaled(Math.abs(value), unit);
  return `${digits(value * factor, count)}${name ? ` ${name}` : ''}`;
}

/** The same for a text field: a scenario reads it. */
export function field(value, unit) {
  return words(value, unit, 6).replace('−', '-').replace('µ', 'u').replace('²', '^2');
}

/** SI unit at the end of a name, such as `slider.x_m`. */
export function unitOf(name) {
  const known = { m: 'm', s: 's', N: 'N', J: 'J', W: 'W', V: 'V', A: 'A', rad: 'rad', Pa: 'Pa', Hz: 'Hz', m_s: 'm/s', rad_s: 'rad/s', N_m: 'N/m', m_s2: 'm/s²' };
  const found = /_(m_s2|m_s|rad_s|N_m|rad|Pa|Hz|[msNJWVA])$/.exec(name);
  return found ? known[found[1]] : '';
}

/** A name without its unit, in words. */
export function plain(name) {
  return name.replace(/_(m_s2|m_s|rad_s|N_m|rad|Pa|Hz|[msNJWVA])$/, '').replaceAll('_', ' ');
}
