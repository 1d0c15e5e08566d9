// Boxes as six numbers: [x0, y0, z0, x1, y1, z1].

export const EMPTY = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];

export const joined = (a, b) => [
  Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.min(a[2], b[2]),
  Math.max(a[3], b[3]), Math.max(a[4], b[4]), Math.max(a[5], b[5])];

export const common = (a, b) => [
  Math.max(a[0], b[0]), Math.max(a[1], b[1]), Math.max(a[2], b[2]),
  Math.min(a[3], b[3]), Math.min(a[4], b[4]), Math.min(a[5], b[5])];

export const meet = (a, b) =>
  a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];

export const ofPoints = (points) => points.reduce((box, p) => joined(box, [...p, ...p]), EMPTY);

export const grown = (box, by) => box.map((value, k) => (k < 3 ? value - by : value + by));

export const middleOf = (box) => [0, 1, 2].map((k) => (box[k] + box[k + 3]) / 2);

export const diagonalOf = (box) => Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);

/** The distance of a point from a box; 0 inside. */
export const distanceTo = (box, point) => Math.hypot(...point.map((value, k) => Math.max(box[k] - value, 0, value - box[k + 3])));

/** The middle one of the three lengths: the width of a pipe or a beam. */
export const thicknessOf = (box) => [box[3] - box[0], box[4] - box[1], box[5] - box[2]].sort((a, b) => a - b)[1];
