// The plan of a storey: its clashes as dots, seen from above, over a picture of the building.

/** The axes of the plan for each up axis: right, up on the page, each as [axis, sign]. */
const PLAN_AXES = { z: [[0, 1], [1, 1]], y: [[0, 1], [2, -1]], x: [[1, -1], [2, -1]] };
const MOST_LEVELS = 12;
/** How much of a storey's height the plan's picture shows: without the ceiling, which would hide the rest. */
const PLAN_CUT = 0.6;
const LEVEL_HEIGHT = 4; // metres, where the models name no storeys

let level = null; // index of the level that the plan shows

/** Storeys as the models name them, from the lowest: [{name, lower, upper}]. */
function namedLevels() {
  if (!report.property_names?.includes('storey'))
    return [];
  const heights = new Map();
  for (let i = 0; i < count; ++i)
    for (const part of [report.a[i], report.b[i]]) {
      const name = firstValue(part, 'storey');
      const bottom = building?.bottomOf(part) ?? heightOf(i);
      if (name === NO_VALUE || bottom === null)
        continue;
      if (!heights.has(name))
        heights.set(name, []);
      heights.get(name).push(bottom);
    }
  const floors = [...heights].map(([name, all]) => ({ name, lower: all.sort((a, b) => a - b)[Math.floor(all.length / 5)] }));
  floors.sort((a, b) => a.lower - b.lower);
  return floors.map((floor, k) => ({ ...floor, lower: k === 0 ? -Infinity : floor.lower, upper: floors[k + 1]?.lower ?? Infinity }));
}

/** Bands of about a storey's height. */
function evenLevels([lower, upper]) {
  const n = Math.max(1, Math.min(MOST_LEVELS, Math.round((upper - lower) / LEVEL_HEIGHT)));
  return Array.from({ length: n }, (_, k) => {
    const [from, to] = [k, k + 1].map((at) => lower + ((upper - lower) * at) / n);
    return { name: `from ${from.toFixed(1)} m`, lower: from, upper: to };
  });
}

/** The heights of the lowest and of the highest clash, with some space. */
const clashHeights = once(() => {
  const heights = Array.from({ length: count }, (_, i) => heightOf(i)).filter((height) => height !== null);
  return heights.length === 0 ? [0, 1] : [heights.reduce((a, b) => Math.min(a, b)) - 0.5, heights.reduce((a, b) => Math.max(a, b)) + 0.5];
});

/** The heights of the building or, without one, of the clashes. */
const heightRange = once(() => (report.building ? [report.building.lower[UP], report.building.upper[UP]] : clashHeights()));

let knownLevels = null;
function levels() {
  if (knownLevels === null) {
    const named = namedLevels();
    const [lower, upper] = named.length > 0 ? heightRange() : clashHeights();
    knownLevels = (named.length > 0 ? named : evenLevels([lower, upper]))
      .map((one) => ({ ...one, lower: Math.max(one.lower, lower - 0.5), upper: Math.min(one.upper, upper + 0.5) }));
  }
  return knownLevels;
}

const storeyName = ([lower, upper]) => levels().find((one) => Math.abs(one.lower - lower) < 1e-3 && Math.abs(one.upper - upper) < 1e-3)?.name ?? null;

const clashesOf = ({ lower, upper }) => shownRows.filter((i) => heightOf(i) >= lower && heightOf(i) < upper);

function showPlan() {
  const sizes = levels().map((one) => clashesOf(one).length);
  level ??= sizes.indexOf(Math.max(...sizes));
  byId('levels').replaceChildren(...levels().map((one, k) => {
    const button = make('button', { type: 'button', title: one.name }, make('span', {}, one.name), make('b', {}, wholeNumber.format(sizes[k])));
    button.setAttribute('aria-pressed', k === level);
    button.addEventListener('click', () => {
      level = k;
      showPlan();
      byId('levels').children[levels().length - 1 - k]?.focus();
    });
    return button;
  }).reverse()); // the highest on top, as in the building
  drawPlan();
}

/** The rectangle of the world that the plan shows: {middle: [right, up], scale: pixels per metre}. */
function planFrame(width, height) {
  const axes = PLAN_AXES[report.frame.up];
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  const add = (point) => axes.forEach(([axis, sign], k) => {
    low[k] = Math.min(low[k], sign * point[axis]);
    high[k] = Math.max(high[k], sign * point[axis]);
  });
  if (report.building)
    [report.building.lower, report.building.upper].forEach(add);
  else
    report.point_a.filter((point) => point[0] !== null).forEach(add);
  const scale = 0.94 * Math.min(width / Math.max(high[0] - low[0], 1), height / Math.max(high[1] - low[1], 1));
  return { middle: [0, 1].map((k) => (low[k] + high[k]) / 2), scale: isFinite(scale) ? scale : 1, axes };
}

function drawPlan() {
  const canvas = byId('plan-canvas');
  const box = canvas.parentElement.getBoundingClientRect();
  const ratio = Math.min(2, devicePixelRatio);
  Object.assign(canvas, { width: Math.max(1, Math.round(box.width * ratio)), height: Math.max(1, Math.round(box.height * ratio)) });
  const frame = planFrame(canvas.width, canvas.height);
  const chosen = levels()[level];
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, canvas.width, canvas.height);
  building?.drawPlan(canvas, frame, { lower: chosen.lower, upper: chosen.lower + PLAN_CUT * (chosen.upper - chosen.lower) });
  const style = getComputedStyle(document.documentElement);
  const colours = KINDS.map((kind) => style.getPropertyValue(`--${kind}`));
  const dots = [];
  for (const i of clashesOf(chosen)) {
    const [x, y] = frame.axes.map(([axis, sign], k) => (sign * report.point_a[i][axis] - frame.middle[k]) * frame.scale);
    dots.push({ i, x: canvas.width / 2 + x, y: canvas.height / 2 - y });
  }
  for (const { i, x, y } of dots) {
    context.beginPath();
    context.arc(x, y, (i === state.open ? 7 : 3.5) * ratio, 0, 7);
    context.fillStyle = colours[report.kind[i]];
    context.fill();
    context.lineWidth = ratio;
    context.strokeStyle = style.getPropertyValue('--paper');
    context.stroke();
  }
  canvas.setAttribute('aria-label', `Plan of ${chosen.name}: ${wholeNumber.format(dots.length)} clashes`);
  canvas.onclick = (event) => {
    const [x, y] = [event.offsetX * ratio, event.offsetY * ratio];
    const away = (dot) => Math.hypot(dot.x - x, dot.y - y);
    const nearest = dots.reduce((best, dot) => (best === null || away(dot) < away(best) ? dot : best), null);
    if (nearest !== null && away(nearest) < 12 * ratio)
      openClash(nearest.i);
  };
  byId('plan-filter').onclick = () => {
    state.heights = [chosen.lower, chosen.upper];
    state.view = 'list';
    apply();
  };
}
