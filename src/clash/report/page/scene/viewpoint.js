// The direction from which most of both parts is seen. Each candidate is drawn as a small picture
// in which the pixels of A and of B are counted. The candidates and the score are those of the
// library's clash_viewpoints (src/clash/viewpoint), so that BCF files and the page look from the same
// sides. docs/decisions/0030-viewpoints-of-the-page.md says why it does not take the library's cameras.
import * as THREE from 'three';

const SIZE = 64; // pixels
/** How far above the target the eye is, in horizontal distances: as directions_around of the library. */
const HEIGHTS = [0.45, 0.85, 0.1, -0.4];
const AROUND = 12;
/** For each up axis, the horizontal axis along which the front view looks, with its sign. */
const FRONTS = [[2, -1], [2, -1], [1, 1]];

/** Unit vectors from the target to the eye. */
function candidates(up) {
  const [axis, sign] = FRONTS[up.toArray().indexOf(1)];
  const front = new THREE.Vector3().setComponent(axis, sign);
  const right = front.clone().cross(up);
  return HEIGHTS.flatMap((height) => Array.from({ length: AROUND }, (_, k) => {
    const angle = (2 * Math.PI * (k + 0.5)) / AROUND;
    return front.clone().multiplyScalar(-Math.cos(angle)).addScaledVector(right, -Math.sin(angle)).addScaledVector(up, height).normalize();
  }));
}

/** The best of the candidates by the pixels of their pictures, which lie side by side. */
function choose(pixels, candidates, across) {
  let best = null;
  candidates.forEach((direction, c) => {
    let a = 0;
    let b = 0;
    for (let y = 0; y < SIZE; ++y)
      for (let x = 0; x < SIZE; ++x) {
        const at = 4 * ((Math.floor(c / across) * SIZE + y) * across * SIZE + (c % across) * SIZE + x);
        a += pixels[at + 1] >> 7;
        b += pixels[at + 2] >> 7;
      }
    // Both must be seen, the smaller one more than the larger one; alone, one is better than none.
    const score = Math.cbrt(Math.min(a, b) ** 2 * Math.max(a, b)) + 1e-3 * Math.max(a, b);
    if (best === null || score > best.score)
      best = { score, direction, a: a / (SIZE * SIZE), b: b / (SIZE * SIZE) };
  });
  return best;
}

/** A direction that is good for most: from above and in front, not along an axis. */
const USUAL = 1;

export class ViewpointFinder {
  constructor(renderer, model, up) {
    this.renderer = renderer;
    this.model = model;
    this.candidates = candidates(up);
    this.usual = this.candidates[USUAL];
    this.across = Math.ceil(Math.sqrt(this.candidates.length));
    this.target = new THREE.WebGLRenderTarget(SIZE * this.across, SIZE * this.across);
    this.target.scissorTest = true;
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.01, 100);
    this.camera.up.copy(up);
  }

  /** Draws what the camera sees from a direction into the candidate's place. */
  drawCandidate(c, middle, radius) {
    const { camera, target } = this;
    const distance = radius / Math.sin(THREE.MathUtils.degToRad(22.5));
    camera.position.copy(middle).addScaledVector(this.candidates[c], distance);
    camera.near = distance / 100;
    camera.far = distance + 4 * radius;
    camera.lookAt(middle);
    camera.updateProjectionMatrix();
    const place = [(c % this.across) * SIZE, Math.floor(c / this.across) * SIZE, SIZE, SIZE];
    target.viewport.set(...place);
    target.scissor.set(...place);
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.model.sidesScene, camera);
  }

  drawAll(middle, radius, parts) {
    const geometry = this.model.geometryOf(this.model.indexOf(parts));
    this.model.sidesMesh.geometry = geometry;
    this.renderer.setClearColor(0x000000, 1);
    this.candidates.forEach((_, c) => this.drawCandidate(c, middle, radius));
    this.renderer.setRenderTarget(null);
    this.model.release(geometry);
  }

  /**
   * Returns the best direction from `middle` to the eye, and the shares of the picture that both
   * sides take there. The looks of the parts and the section box must be set when it is called; they
   * may change before it returns.
   */
  async find(middle, radius, parts) {
    this.drawAll(middle, radius, parts);
    const size = SIZE * this.across;
    const pixels = new Uint8Array(4 * size * size);
    await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, size, size, pixels);
    return choose(pixels, this.candidates, this.across);
  }
}
