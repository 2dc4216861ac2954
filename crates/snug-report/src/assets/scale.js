// Scales, ticks and numbers of the interactive figures.
const roundStep = (width, count) => {
  const raw = width / count, power = 10 ** Math.floor(Math.log10(raw)), ratio = raw / power - 1e-9;
  return power * (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10);
};
const minus = text => text.replace('-', '−');
// Round ticks, and the power of ten that is taken out of them and put into the axis' label.
const ticks = (low, high, count) => {
  const step = roundStep(high - low, count), large = Math.max(Math.abs(low), Math.abs(high));
  const power = large >= 1e5 || large < 1e-2 ? Math.floor(Math.log10(large)) : 0;
  const decimals = Math.min(12, Math.max(0, power - Math.floor(Math.log10(step) + 1e-9)));
  const list = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++)
    list.push([i * step, minus((i === 0 ? 0 : i * step / 10 ** power).toFixed(decimals))]);
  return { list, power };
};
const raised = power => [...String(power)].map(digit => digit === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[digit]).join('');
const scaledLabel = (label, power) => power === 0 ? label : label.replace('[', `[10${raised(power)} `);
// As many digits as help at a glance; a dash for what is missing.
const shown = value => {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return minus(value.toExponential(2));
  return minus(value.toPrecision(4));
};
