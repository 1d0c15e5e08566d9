// The camera: orbiting by mouse, touch and keys, and flights to a viewpoint.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { middleOf } from './boxes.js';

const FLIGHT = 650; // milliseconds
const KEY_STEP = Math.PI / 24;
export const FIELD_OF_VIEW = 45; // vertical, degrees
const FILLED = 0.94; // share of the picture's width or height that a whole building fills
const TOOLBAR = 40; // pixels at the top of the picture that the page's tools cover

export class SceneCamera {
  constructor(canvas, up, radius, redraw) {
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 1000);
    this.camera.up.copy(up);
    this.up = up;
    this.radius = radius;
    this.redraw = redraw;
    this.flight = null;
    this.height = Infinity; // pixels
    this.expected = null; // stands for a flight whose viewpoint is still being found
    this.moved = false; // by the user, since the last flight
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.minDistance = 0.05;
    this.controls.maxDistance = 12 * radius;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', redraw);
    this.controls.addEventListener('start', () => this.take());
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  resize(width, height) {
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** The distance from which a ball fills the picture. */
  distanceFor(radius) {
    const vertical = THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2);
    const narrow = Math.min(vertical, Math.atan(Math.tan(vertical) * this.camera.aspect));
    return radius / Math.sin(narrow);
  }

  /** Says that a flight comes; returns a ticket that holds until the user moves or another flight is expected. */
  expectFlight() {
    this.expected = {};
    return this.expected;
  }

  /**
   * The middle and the distance from which all corners of a box are in the picture, below the tools and with a
   * margin.
   *
   * A corner at (x, y) across the view and z towards the eye is in the picture of an eye at (cx, cy) and
   * the distance d if x - cx <= right (d - z) and cx - x <= left (d - z), where right and left are tangents,
   * and the same for y. So the largest of x + right z and of -x + left z bound cx and d.
   */
  placeForBox(box, direction) {
    const right = new THREE.Vector3().crossVectors(this.up, direction).normalize();
    const over = new THREE.Vector3().crossVectors(direction, right);
    const corners = Array.from({ length: 8 }, (_, i) => new THREE.Vector3(...[0, 1, 2].map((k) => box[k + 3 * (i >> k & 1)])));
    const tan = Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2)) * FILLED;
    const across = tan * this.camera.aspect;
    const above = tan * Math.max(0.2, 1 - 2 * TOOLBAR / this.height);
    const sides = [[right, across, across], [over, above, tan]].map(([axis, upper, lower]) => ({
      axis, upper, lower,
      most: Math.max(...corners.map((corner) => corner.dot(axis) + upper * corner.dot(direction))),
      least: Math.max(...corners.map((corner) => -corner.dot(axis) + lower * corner.dot(direction))),
    }));
    const distance = Math.max(...sides.map(({ most, least, upper, lower }) => (most + least) / (upper + lower)));
    const depth = new THREE.Vector3(...middleOf(box)).dot(direction);
    const middle = direction.clone().multiplyScalar(depth);
    for (const { axis, most, least, upper, lower } of sides)
      middle.addScaledVector(axis, (most - least + (lower - upper) * distance) / 2);
    return { middle, distance: distance - depth };
  }

  /** Ends the flight, and the wait for one. */
  stay() {
    this.flight = null;
    this.expected = null;
  }

  /** Says that the user moves the camera. */
  take() {
    this.stay();
    this.moved = true;
  }

  get flying() {
    return this.flight !== null || this.expected !== null;
  }

  /** Flies to where the ball about `middle` is seen from `direction`. */
  flyTo(middle, radius, direction, atOnce) {
    this.fly(middle, this.distanceFor(radius), direction, atOnce);
  }

  /** Flies to where the whole box is seen from `direction`. */
  flyToBox(box, direction, atOnce) {
    const { middle, distance } = this.placeForBox(box, direction);
    this.fly(middle, distance, direction, atOnce);
  }

  fly(middle, distance, direction, atOnce) {
    this.stay();
    this.moved = false;
    const eye = middle.clone().addScaledVector(direction, distance);
    if (atOnce || matchMedia('(prefers-reduced-motion: reduce)').matches) {
      this.set(eye, middle);
      return;
    }
    this.flight = {
      start: performance.now(), middle: middle.clone(), fromMiddle: this.controls.target.clone(),
      from: new THREE.Spherical().setFromVector3(this.upright(this.camera.position.clone().sub(this.controls.target))),
      to: new THREE.Spherical().setFromVector3(this.upright(eye.clone().sub(middle))),
    };
    const turn = this.flight.to.theta - this.flight.from.theta;
    this.flight.to.theta -= 2 * Math.PI * Math.round(turn / (2 * Math.PI)); // the short way round
    this.redraw();
  }

  /** Turns the up axis to y, as THREE.Spherical has it. */
  upright(vector) {
    return vector.applyQuaternion(new THREE.Quaternion().setFromUnitVectors(this.up, new THREE.Vector3(0, 1, 0)));
  }

  set(eye, middle) {
    this.controls.target.copy(middle);
    this.camera.position.copy(eye);
    this.controls.update();
    this.redraw();
  }

  /** Moves along the flight; returns whether there is one. */
  advance(now) {
    if (this.flight === null)
      return false;
    const { start, from, to, fromMiddle, middle } = this.flight;
    const t = Math.min(1, Math.max(0, now - start) / FLIGHT); // a frame may have begun before the flight
    const s = t * t * (3 - 2 * t);
    const mix = (a, b) => a + (b - a) * s;
    const at = new THREE.Spherical(Math.exp(mix(Math.log(from.radius), Math.log(to.radius))),
      mix(from.phi, to.phi), mix(from.theta, to.theta));
    const back = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.up);
    const target = fromMiddle.clone().lerp(middle, s);
    this.controls.target.copy(target);
    this.camera.position.copy(new THREE.Vector3().setFromSpherical(at).applyQuaternion(back).add(target));
    this.controls.update();
    if (t === 1)
      this.flight = null;
    return true;
  }

  /** Sets near and far so that the model about `middle` is inside. */
  fitRange(middle) {
    const { camera } = this;
    const distance = camera.position.distanceTo(middle);
    camera.far = distance + 2 * this.radius;
    camera.near = Math.max(camera.far / 20000, Math.min(camera.position.distanceTo(this.controls.target) / 50, distance));
    camera.updateProjectionMatrix();
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey)
      return;
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const zooms = { '+': 1 / 1.25, '=': 1 / 1.25, '-': 1.25 };
    if (event.key in turns)
      this.orbit(...turns[event.key].map((step) => step * KEY_STEP));
    else if (event.key in zooms)
      this.zoom(zooms[event.key]);
    else
      return;
    event.preventDefault();
  }

  orbit(around, over) {
    this.take();
    const offset = this.camera.position.clone().sub(this.controls.target);
    const toY = new THREE.Quaternion().setFromUnitVectors(this.up, new THREE.Vector3(0, 1, 0));
    const at = new THREE.Spherical().setFromVector3(offset.applyQuaternion(toY));
    at.theta += around;
    at.phi -= over;
    at.makeSafe();
    offset.setFromSpherical(at).applyQuaternion(toY.invert());
    this.set(this.controls.target.clone().add(offset), this.controls.target.clone());
  }

  zoom(factor) {
    this.take();
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.set(this.controls.target.clone().add(offset), this.controls.target.clone());
  }
}
