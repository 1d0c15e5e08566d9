// Which part and which point of it is seen at a place of the picture.
import * as THREE from 'three';

export class Picker {
  constructor(renderer, model) {
    this.renderer = renderer;
    this.model = model;
    this.target = new THREE.WebGLRenderTarget(1, 1);
    this.pixel = new Uint8Array(4);
  }

  /** Draws one pixel with the numbers of parts. Returns the part; null if there is none. */
  async partAt(camera, x, y, [width, height]) {
    camera.setViewOffset(width, height, x, y, 1, 1);
    this.renderer.setRenderTarget(this.target);
    this.renderer.setClearColor(0x000000, 1);
    this.renderer.render(this.model.numberScene, camera);
    this.renderer.setRenderTarget(null);
    camera.clearViewOffset();
    await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, 1, 1, this.pixel);
    const number = this.pixel[0] | this.pixel[1] << 8 | this.pixel[2] << 16;
    return number === 0 ? null : this.model.parts[number - 1];
  }

  /** Returns the point of a surface, moved to a corner that is seen a few pixels away; null: none. */
  async pointAt(camera, x, y, size) {
    const part = await this.partAt(camera, x, y, size);
    if (part === null)
      return null;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * x) / size[0] - 1, 1 - (2 * y) / size[1]), camera);
    const { boxLower, boxUpper, up, slice } = this.model.uniforms;
    const section = new THREE.Box3(boxLower.value, boxUpper.value);
    const isCut = (point) => {
      const height = point.dot(up.value);
      return !section.containsPoint(point) || height < slice.value.x || height > slice.value.y;
    };
    const hit = this.model.hit(part, ray.ray.origin, ray.ray.direction, isCut);
    if (hit === null)
      return null;
    const onScreen = (point) => {
      const at = point.clone().project(camera);
      return [((at.x + 1) / 2) * size[0], ((1 - at.y) / 2) * size[1]];
    };
    const near = hit.corners.find((corner) => {
      const at = onScreen(corner);
      return Math.hypot(at[0] - x, at[1] - y) < 8;
    });
    return near ?? hit.point;
  }
}
