// The direction from which most of both parts is seen. Each candidate is drawn as a small picture
// in which the pixels of A and of B are counted.
import * as THREE from 'three';

const SIZE = 64; // pixels
/** Heights above the horizon in degrees: a little from above is what people are used to. */
const HEIGHTS = [[28, 1], [8, 0.92], [55, 0.95], [-22, 0.7], [89, 0.75]];
const AROUND = 12;

/** Unit vectors from the target to the eye, each with how much people like it. */
function candidates(up) {
  const side = Math.abs(up.x) > 0.5 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
  const result = [];
  for (const [height, liked] of HEIGHTS)
    for (let k = 0; k < (height > 80 ? 1 : AROUND); ++k) {
      const angle = THREE.MathUtils.degToRad(15 + (360 / AROUND) * k);
      const flat = side.clone().applyAxisAngle(up, angle);
      const radians = THREE.MathUtils.degToRad(height);
      result.push({ direction: flat.multiplyScalar(Math.cos(radians)).addScaledVector(up, Math.sin(radians)), liked });
    }
  return result;
}

/** The best of the candidates by the pixels of their pictures, which lie side by side. */
function choose(pixels, candidates, across) {
  let best = null;
  candidates.forEach(({ direction, liked }, c) => {
    let a = 0;
    let b = 0;
    for (let y = 0; y < SIZE; ++y)
      for (let x = 0; x < SIZE; ++x) {
        const at = 4 * ((Math.floor(c / across) * SIZE + y) * across * SIZE + (c % across) * SIZE + x);
        a += pixels[at + 1] >> 7;
        b += pixels[at + 2] >> 7;
      }
    // Both must be seen: the geometric mean is 0 if one is hidden.
    const score = (Math.sqrt((a + 0.1) * (b + 0.1)) + 0.1 * (a + b)) * liked;
    if (best === null || score > best.score)
      best = { score, direction, a: a / (SIZE * SIZE), b: b / (SIZE * SIZE) };
  });
  return best;
}

/** A direction that is good for most: from above, not along an axis. */
const USUAL = 2;

export class ViewpointFinder {
  constructor(renderer, model, up) {
    this.renderer = renderer;
    this.model = model;
    this.candidates = candidates(up);
    this.usual = this.candidates[USUAL].direction;
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
    camera.position.copy(middle).addScaledVector(this.candidates[c].direction, distance);
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
   * sides take there. The looks of the parts and the section box must be set.
   */
  async find(middle, radius, parts) {
    this.drawAll(middle, radius, parts);
    const size = SIZE * this.across;
    const pixels = new Uint8Array(4 * size * size);
    await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, size, size, pixels);
    return choose(pixels, this.candidates, this.across);
  }
}
