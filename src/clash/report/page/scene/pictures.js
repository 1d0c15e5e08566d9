// Pictures of clashes and groups, for paper.
import * as THREE from 'three';
import { FIELD_OF_VIEW } from './camera.js';

function cameraOf(view, subject, aspect) {
  const camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, aspect, 0.01, 1000);
  const halfAngle = Math.atan(Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2)) * Math.min(1, aspect));
  const distance = subject.radius / Math.sin(halfAngle);
  camera.up.copy(view.up);
  camera.position.copy(subject.middle).addScaledVector(view.viewpoints.get(subject.key)?.direction ?? view.finder.usual, distance);
  camera.lookAt(subject.middle);
  camera.near = distance / 100;
  camera.far = distance + 6 * subject.radius;
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  return camera;
}

/** Finds the viewpoints of subjects, for the pictures to come. The view goes on as it is. */
export async function findViewpoints(view, subjects) {
  for (const subject of subjects)
    await view.viewpointOf(subject);
}

/**
 * Draws subjects of the view into canvases of one size: [{subject, canvas}]. A subject whose viewpoint
 * is not known yet is seen from the usual direction. Afterwards the view is as before.
 */
export function drawPictures(view, pictures) {
  if (pictures.length === 0)
    return;
  const before = { ...view.state };
  const { width, height } = pictures[0].canvas;
  view.renderer.setPixelRatio(1);
  view.renderer.setSize(width, height, false);
  for (const { subject, canvas } of pictures) {
    view.state = { ...before, subject, slice: null, section: true, rest: 'ghost' };
    view.apply();
    view.drawWith(cameraOf(view, subject, width / height));
    canvas.getContext('2d').drawImage(view.canvas, 0, 0, width, height);
  }
  view.state = before;
  view.apply();
  view.resize();
}
