// The distance between two points that the reader clicks.

export class Measure {
  constructor(view) {
    this.view = view;
    this.on = false;
    this.points = [];
    this.round = 0; // counts the measurements that were cleared away
  }

  turn(on) {
    this.on = on;
    if (!on)
      this.clear();
    this.view.canvas.style.cursor = on ? 'crosshair' : '';
  }

  clear() {
    ++this.round;
    this.points = [];
    this.show();
  }

  /** Takes a point of a surface; null, beside all parts, changes nothing. */
  take(point) {
    if (point === null)
      return;
    this.points = this.points.length === 2 ? [point] : [...this.points, point];
    this.show();
    this.view.on.measured(this.points.length === 2 ? this.length() : null);
  }

  length() {
    return this.points[0].distanceTo(this.points[1]);
  }

  show() {
    this.view.marks.setLine('measure', this.points.length === 2 ? this.points : []);
    this.view.updateLabels();
  }

  labels() {
    const ends = this.points.map((place) => ({ place, text: '', className: 'end' }));
    return this.points.length < 2 ? ends
      : [...ends, { place: this.points[0].clone().lerp(this.points[1], 0.5), text: this.view.on.lengthText(this.length()), className: 'measure' }];
  }
}
