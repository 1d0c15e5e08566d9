// The plan of a storey: what lies between two heights, seen straight from above.
import * as THREE from 'three';
import { LOOK } from './materials.js';

/**
 * Draws the parts between two heights into a canvas of the page.
 * frame: {middle, scale, axes} of the page's plan. level: {lower, upper} in the report's frame.
 */
export function drawPlanPicture(view, canvas, frame, { lower, upper }) {
  const before = { ...view.state };
  const unit = (axis, sign) => new THREE.Vector3().setComponent(axis, sign);
  const [right, ahead] = frame.axes.map(([axis, sign]) => unit(axis, sign));
  const middle = right.clone().multiplyScalar(frame.middle[0]).addScaledVector(ahead, frame.middle[1])
    .sub(right.clone().multiplyScalar(view.origin.dot(right))).sub(ahead.clone().multiplyScalar(view.origin.dot(ahead)));
  const [halfWidth, halfHeight] = [canvas.width / 2 / frame.scale, canvas.height / 2 / frame.scale];
  const camera = new THREE.OrthographicCamera(-halfWidth, halfWidth, halfHeight, -halfHeight, 0, 4 * view.camera.radius);
  camera.up.copy(ahead);
  camera.position.copy(middle).addScaledVector(view.up, 2 * view.camera.radius);
  camera.lookAt(middle);
  camera.updateMatrixWorld();
  view.state = { ...before, subject: null, section: false, rest: 'solid', slice: view.sliceOf(lower, upper), shown: [] };
  view.apply();
  view.model.looks.set(() => LOOK.solid);
  view.renderer.setPixelRatio(1);
  view.renderer.setSize(canvas.width, canvas.height, false);
  view.model.uniforms.insides.value = 0.5;
  view.drawWith(camera);
  view.model.uniforms.insides.value = 1;
  canvas.getContext('2d').drawImage(view.canvas, 0, 0);
  view.state = before;
  view.apply();
  view.resize();
}
