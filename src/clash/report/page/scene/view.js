// The 3D view: what of the building is shown for the whole report, a clash or a group.
import * as THREE from 'three';
import { common, diagonalOf, distanceTo, grown, middleOf, ofPoints, thicknessOf } from './boxes.js';
import { SceneCamera } from './camera.js';
import { Marks } from './marks.js';
import { applyPalette, LOOK, setBox, setSlice } from './materials.js';
import { Measure } from './measure.js';
import { BuildingModel } from './model.js';
import { Picker } from './picking.js';
import { ViewpointFinder } from './viewpoint.js';

const UPS = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const LEAST_RADIUS = 0.6; // metres around a clash
const MOST_RADIUS = 3.5;
const THICKNESSES = 5; // of the thinner part that fit into the radius
/** Triangles that decide about a viewpoint; each is drawn for each of the candidates. */
const MOST_TRIANGLES = 40_000;
/** A side that takes a smaller share of the picture counts as hidden. */
const LEAST_SEEN = 0.002;
const SECTION = 1.35; // the section box is this much larger than what the camera looks at

export class BuildingView {
  /**
   * host: an element with a canvas. building: as decodeBuilding returns it. report: the page's data.
   * on: {clash(number), message(text), measured(metres or null)}
   */
  constructor(host, building, report, on) {
    this.host = host;
    this.report = report;
    this.on = on;
    this.canvas = host.querySelector('canvas');
    this.origin = new THREE.Vector3().fromArray(report.building.origin);
    this.up = new THREE.Vector3().fromArray(UPS[report.frame.up]);
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, powerPreference: 'high-performance' });
    this.renderer.debug.checkShaderErrors = false; // saves waiting for the compiler
    this.model = new BuildingModel(building, this.up);
    this.bounds = [...report.building.lower, ...report.building.upper].map((value, k) => value - report.building.origin[k % 3]);
    const radius = diagonalOf(this.bounds) / 2;
    this.camera = new SceneCamera(this.canvas, this.up, radius, () => this.redraw());
    this.marks = new Marks(this.model.scene, host);
    this.finder = new ViewpointFinder(this.renderer, this.model, this.up);
    this.picker = new Picker(this.renderer, this.model);
    this.measure = new Measure(this);
    this.state = { rest: 'ghost', section: true, slice: null, subject: null, shown: [] };
    this.viewpoints = new Map(); // those that have been found, by the key of their subject
    this.searches = new Map(); // promises of them
    this.pending = false;
    this.model.skipEmptyPasses({ solid: false, ghost: false, shell: false }); // nothing is shown yet
    this.frame(true);
    this.setTheme();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.setTheme());
    new ResizeObserver(() => {
      if (host.clientWidth !== this.size?.[0] || host.clientHeight !== this.size[1])
        this.resize();
    }).observe(host);
    this.resize();
    this.listen();
  }

  listen() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => { down = [event.offsetX, event.offsetY]; });
    this.canvas.addEventListener('pointerup', (event) => {
      const still = down !== null && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 5;
      down = null;
      if (still)
        this.click(event.offsetX, event.offsetY);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons === 0)
        this.hover(event.offsetX, event.offsetY);
    });
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.on.message('The graphics card was reset; reload the page for the 3D view.');
    });
  }

  setTheme() {
    this.palette = applyPalette(this.model.uniforms, matchMedia('(prefers-color-scheme: dark)').matches);
    this.marks.setPalette(this.palette);
    this.redraw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0)
      return;
    this.size = [width, height];
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height);
    if (this.state.subject === null && !this.camera.moved)
      this.frame(true); // the whole building fits into the new shape
    this.draw(); // at once, since a resized canvas is empty
  }

  redraw() {
    if (this.pending)
      return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      const flying = this.camera.advance(now);
      this.draw();
      if (flying)
        this.redraw();
    });
  }

  draw() {
    if (!this.size)
      return;
    this.camera.fitRange(new THREE.Vector3());
    this.drawWith(this.camera.camera);
    this.marks.placeLabels(this.camera.camera, ...this.size);
  }

  drawWith(camera) {
    const { uniforms } = this.model;
    uniforms.upInView.value.copy(this.up).transformDirection(camera.matrixWorldInverse);
    this.renderer.setClearColor(this.palette.ground, 1);
    this.renderer.render(this.model.scene, camera);
  }

  // ── subjects ──────────────────────────────────────────────────────────────────────────────────

  point(clash, side) {
    const point = this.report[`point_${side}`][clash];
    return new THREE.Vector3(...point.map((value) => value ?? 0)).sub(this.origin);
  }

  partOf(clash, side) {
    return this.model.building.numbered[this.report[side][clash]];
  }

  /** Shows the whole building with a dot for each of these clashes. */
  showAll(clashes, { fly = true, atOnce = false } = {}) {
    const wasAll = this.state.subject === null;
    if (!wasAll)
      this.camera.stay();
    this.state.subject = null;
    this.state.shown = clashes;
    this.apply();
    if (fly && (!wasAll || atOnce))
      this.frame(atOnce);
  }

  /** Shows one clash: A and B, the witness line, and what is around them. */
  showClash(clash, { atOnce = false } = {}) {
    const subject = this.subjectOfClash(clash);
    if (subject === null)
      return this.on.message('The parts of this clash are not in the 3D view.');
    return this.show(subject, atOnce);
  }

  subjectOfClash(clash) {
    const [a, b] = [this.partOf(clash, 'a'), this.partOf(clash, 'b')];
    if (!a || !b)
      return null;
    const places = [this.point(clash, 'a'), this.point(clash, 'b')];
    const gap = places[0].distanceTo(places[1]);
    const thickness = Math.min(thicknessOf(a.box), thicknessOf(b.box));
    const radius = Math.max(Math.min(Math.max(THICKNESSES * thickness, LEAST_RADIUS), MOST_RADIUS), 1.6 * gap);
    return {
      key: `clash ${clash}`, clash, sideA: new Set([a]), sideB: new Set([b]), radius,
      middle: places[0].clone().lerp(places[1], 0.5), places, inside: this.report.kind[clash] === 2, clashes: [clash],
    };
  }

  /** Shows all clashes of a group. key: tells groups apart. */
  showGroup(key, clashes, { atOnce = false } = {}) {
    this.show(this.subjectOfGroup(key, clashes), atOnce);
  }

  subjectOfGroup(key, clashes) {
    // The part that most of the clashes share has A's colour, all others have B's.
    const uses = new Map();
    for (const i of clashes)
      for (const side of ['a', 'b'])
        uses.set(this.partOf(i, side), (uses.get(this.partOf(i, side)) ?? 0) + 1);
    uses.delete(undefined);
    const [shared] = [...uses].reduce((best, entry) => (entry[1] > best[1] ? entry : best), [null, 0]);
    const places = clashes.flatMap((i) => [this.point(i, 'a'), this.point(i, 'b')]);
    const box = ofPoints(places.map((place) => place.toArray()));
    return {
      key: `group ${key}`, clash: null, sideA: new Set([shared]), sideB: new Set([...uses.keys()].filter((part) => part !== shared)),
      radius: Math.max(diagonalOf(box) / 2 + 0.6, 1), middle: new THREE.Vector3(...middleOf(box)), places: [], clashes, inside: false,
    };
  }

  show(subject, atOnce) {
    this.state.subject = subject;
    this.measure.clear();
    this.apply();
    this.frame(atOnce);
  }

  /** Flies to the subject. */
  async frame(atOnce = false) {
    const { subject } = this.state;
    if (subject === null) {
      this.camera.flyToBox(this.bounds, this.finder.usual, atOnce);
      return;
    }
    const ticket = this.camera.expectFlight();
    const direction = await this.viewpointOf(subject).then((found) => found.direction, () => this.finder.usual);
    if (this.camera.expected === ticket) // the user has neither moved nor asked for another view
      this.camera.flyTo(subject.middle, subject.radius, direction, atOnce);
  }

  /** The parts of a subject and, the nearest first, those that can hide it; not more than a search can draw quickly. */
  partsAround(subject) {
    const own = [...subject.sideA, ...subject.sideB].filter(Boolean);
    const middle = subject.middle.toArray();
    const near = this.model.partsNear(this.sectionOf(subject)).filter((part) => !subject.sideA.has(part) && !subject.sideB.has(part))
      .map((part) => ({ part, away: distanceTo(part.box, middle) })).sort((x, y) => x.away - y.away).map(({ part }) => part);
    const parts = [];
    let corners = 0;
    for (const part of [...own, ...near]) {
      if (parts.length > 0 && corners + part.count > 3 * MOST_TRIANGLES)
        continue;
      parts.push(part);
      corners += part.count;
    }
    return parts;
  }

  /** Returns the viewpoint of a subject. It is searched once; what the view shows has no part in it. */
  viewpointOf(subject) {
    if (!this.searches.has(subject.key))
      this.searches.set(subject.key, this.searchViewpoint(subject));
    return this.searches.get(subject.key);
  }

  async searchViewpoint(subject) {
    const parts = this.partsAround(subject);
    let found = null;
    for (const others of [LOOK.solid, LOOK.hidden]) { // behind the other parts no side may be visible
      found = await this.search(subject, others, parts);
      if ((subject.inside ? Math.max(found.a, found.b) : Math.min(found.a, found.b)) > LEAST_SEEN)
        break;
    }
    this.viewpoints.set(subject.key, found);
    return found;
  }

  /** Begins a search, for which the parts have other looks than in the view. */
  search(subject, others, parts) {
    const { uniforms, looks } = this.model;
    const outer = subject.inside ? this.outerOf(subject) : null;
    setBox(uniforms, this.sectionOf(subject));
    setSlice(uniforms, null);
    looks.set((part) => {
      if (part === outer)
        return LOOK.hidden;
      return subject.sideA.has(part) ? LOOK.a : subject.sideB.has(part) ? LOOK.b : others;
    });
    const found = this.finder.find(subject.middle, subject.radius, parts);
    this.applyCuts();
    return found;
  }

  /** The section box of a subject, in scene coordinates. */
  sectionOf(subject) {
    const box = grown(ofPoints([subject.middle.toArray()]), SECTION * subject.radius);
    return common(box, grown(this.bounds, 0.1));
  }

  /** Sets looks, cuts and marks as the state says. */
  apply() {
    const box = this.applyCuts();
    this.model.restrictTo(box);
    this.marks.setBox(box);
    this.applyMarks(this.state.subject);
    this.redraw();
  }

  /** Sets looks and cuts, and returns the section box. */
  applyCuts() {
    const { subject, rest, section, slice } = this.state;
    const box = subject !== null && section ? this.sectionOf(subject) : null;
    setBox(this.model.uniforms, box);
    setSlice(this.model.uniforms, slice);
    this.model.setCutting(box !== null || slice !== null);
    this.applyLooks(subject, rest);
    return box;
  }

  applyLooks(subject, rest) {
    const others = { ghost: LOOK.ghost, hidden: LOOK.hidden, solid: LOOK.solid }[rest];
    const outer = subject?.inside ? this.outerOf(subject) : null;
    const used = { solid: subject !== null || rest !== 'ghost', ghost: others === LOOK.ghost, shell: outer !== null };
    const clashing = new Set(subject === null ? this.state.shown.flatMap((i) => [this.report.a[i], this.report.b[i]]) : []);
    this.model.looks.set((part) => {
      if (part === outer)
        return LOOK.shell;
      if (subject?.sideA.has(part))
        return LOOK.a;
      if (subject?.sideB.has(part))
        return LOOK.b;
      if (subject === null && clashing.has(part.number))
        return rest === 'ghost' ? LOOK.ghost : LOOK.solid;
      return others;
    });
    this.model.skipEmptyPasses(used);
  }

  /** Of a part inside another one, the outer is the one whose box is larger. */
  outerOf({ sideA, sideB }) {
    const [[a], [b]] = [[...sideA], [...sideB]];
    return diagonalOf(a.box) > diagonalOf(b.box) ? a : b;
  }

  applyMarks(subject) {
    const { marks } = this;
    const dots = (clashes) => clashes.filter((i) => this.report.point_a[i][0] !== null && this.inSlice(this.point(i, 'a')))
      .map((i) => ({ place: this.point(i, 'a').lerp(this.point(i, 'b'), 0.5), kind: this.report.kind[i], clash: i }));
    const one = subject !== null && subject.clash !== null;
    marks.showDots(one ? [] : dots(subject?.clashes ?? this.state.shown));
    marks.setLine('witness', one ? subject.places : []);
    const [[a], [b]] = one ? [[...subject.sideA], [...subject.sideB]] : [[null], [null]];
    marks.setEdges(0, a && this.model.edgesOf(a));
    marks.setEdges(1, b && this.model.edgesOf(b));
    this.clipEdges(one && this.state.section ? this.sectionOf(subject) : null);
    this.updateLabels();
  }

  clipEdges(box) {
    const planes = box === null ? [] : [0, 1, 2].flatMap((k) => {
      const normal = new THREE.Vector3().setComponent(k, 1);
      return [new THREE.Plane(normal, -box[k]), new THREE.Plane(normal.clone().negate(), box[k + 3])];
    });
    this.renderer.localClippingEnabled = true;
    for (const edge of this.marks.edges)
      edge.material.clippingPlanes = planes;
  }

  updateLabels() {
    const { subject } = this.state;
    const labels = [...this.measure.labels()];
    if (subject !== null && subject.clash !== null) {
      const metres = this.report.distance[subject.clash];
      labels.push({ place: subject.middle, text: this.on.lengthText(metres), className: 'witness' });
      const [pa, pb] = subject.places;
      if (pa.distanceTo(pb) > 0.25 * subject.radius)
        labels.push({ place: pa, text: 'A', className: 'point a' }, { place: pb, text: 'B', className: 'point b' });
    }
    this.marks.setLabels(labels);
    this.redraw();
  }

  inSlice(place) {
    const height = place.dot(this.up);
    return this.state.slice === null || (height >= this.state.slice[0] && height <= this.state.slice[1]);
  }

  bottomOf(number) {
    const part = this.model.building.numbered[number];
    const k = this.up.toArray().indexOf(1);
    return part ? part.box[k] + this.origin.getComponent(k) : null;
  }

  set(changes) {
    Object.assign(this.state, changes);
    this.apply();
  }

  /** Heights above the origin of the report, as the slider shows them, to the scene's. */
  sliceOf(lower, upper) {
    const shift = this.origin.dot(this.up);
    return [lower - shift, upper - shift];
  }

  // ── pointing ──────────────────────────────────────────────────────────────────────────────────

  async click(x, y) {
    if (this.measure.on) {
      const { round } = this.measure;
      const point = await this.picker.pointAt(this.camera.camera, x, y, this.size);
      return round === this.measure.round && this.measure.take(point); // not a point of a scene that has gone
    }
    const dot = this.marks.dotAt(this.camera.camera, x, y, ...this.size);
    if (dot !== null)
      return this.on.clash(dot.clash);
    return this.on.part(await this.picker.partAt(this.camera.camera, x, y, this.size));
  }

  hover(x, y) {
    const dot = this.measure.on ? null : this.marks.dotAt(this.camera.camera, x, y, ...this.size);
    this.canvas.style.cursor = this.measure.on ? 'crosshair' : dot !== null ? 'pointer' : '';
  }
}
