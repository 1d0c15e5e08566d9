// The drawn model: the parts' geometry, their looks, and the passes that draw them.
import * as THREE from 'three';
import { meet } from './boxes.js';
import { DETAIL } from './decode.js';
import { Looks, makeNumberPass, makePasses, makeSidesPass, makeUniforms } from './materials.js';

export class BuildingModel {
  constructor(building, up) {
    this.building = building;
    this.parts = building.parts;
    this.looks = new Looks(this.parts);
    this.uniforms = makeUniforms(this.looks, up);
    this.positions = new THREE.BufferAttribute(building.positions, 3);
    this.partOf = new THREE.BufferAttribute(building.partOf, 1);
    this.partOf.gpuType = THREE.IntType;
    this.whole = this.geometryOf(new THREE.BufferAttribute(building.indices, 1));
    this.local = null; // geometry of the parts that a section box meets
    this.scene = new THREE.Scene();
    this.passes = makePasses(this.uniforms).map((pass, k) => this.mesh(pass, k));
    this.scene.add(...this.passes);
    this.numberScene = new THREE.Scene();
    this.numberMesh = this.mesh(makeNumberPass(this.uniforms), 0);
    this.numberScene.add(this.numberMesh);
    this.sidesScene = new THREE.Scene();
    this.sidesMesh = this.mesh(makeSidesPass(this.uniforms), 0);
    this.sidesScene.add(this.sidesMesh);
  }

  geometryOf(index) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', this.positions);
    geometry.setAttribute('part', this.partOf);
    geometry.setIndex(index);
    return geometry;
  }

  mesh(materials, order) {
    const mesh = new THREE.Mesh(this.whole, materials.cut);
    mesh.userData.materials = materials;
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    return mesh;
  }

  /** Returns an index of the corners of some parts. */
  indexOf(parts) {
    const indices = new Uint32Array(parts.reduce((sum, part) => sum + part.count, 0));
    let at = 0;
    for (const { first, count } of parts) {
      indices.set(this.building.indices.subarray(first, first + count), at);
      at += count;
    }
    return new THREE.BufferAttribute(indices, 1);
  }

  /**
   * Frees a geometry of geometryOf. three.js would free the points too, which all geometries share,
   * and send them to the graphics card again.
   */
  release(geometry) {
    geometry.deleteAttribute('position');
    geometry.deleteAttribute('part');
    geometry.dispose();
  }

  /** From now on only the parts that meet the box are drawn; null: all parts. */
  restrictTo(box) {
    if (this.local !== null)
      this.release(this.local);
    this.local = box === null ? null : this.geometryOf(this.indexOf(this.parts.filter((part) => meet(part.box, box))));
    for (const mesh of [...this.passes, this.numberMesh])
      mesh.geometry = this.local ?? this.whole;
  }

  /** Says whether the section box or the slice cuts something of what is drawn. */
  setCutting(isCut) {
    for (const mesh of this.passes)
      mesh.material = mesh.userData.materials[isCut ? 'cut' : 'whole'];
  }

  /** The parts around a box whose shapes are good enough to hide something. */
  partsNear(box) {
    return this.parts.filter((part) => part.detail !== DETAIL.rest && meet(part.box, box));
  }

  /** Tells which passes have something to draw; a look that no part has costs nothing. */
  skipEmptyPasses(used) {
    this.passes[0].visible = used.solid;
    this.passes[1].visible = this.passes[2].visible = used.shell;
    this.passes[3].visible = this.passes[4].visible = used.ghost;
  }

  /** Returns the triangle of a part that a ray meets first: {distance, corners}; null if none. */
  hit(part, origin, direction, isCut) {
    const { positions, indices } = this.building;
    const ray = new THREE.Ray(origin, direction);
    const corners = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    const point = new THREE.Vector3();
    let best = null;
    for (let i = part.first; i < part.first + part.count; i += 3) {
      corners.forEach((corner, k) => corner.fromArray(positions, 3 * indices[i + k]));
      if (!ray.intersectTriangle(corners[0], corners[1], corners[2], false, point) || isCut(point))
        continue;
      const distance = point.distanceTo(origin);
      if (best === null || distance < best.distance)
        best = { distance, point: point.clone(), corners: corners.map((corner) => corner.clone()) };
    }
    return best;
  }

  /** Lines along the sharp edges of a part. */
  edgesOf(part) {
    const geometry = this.geometryOf(this.indexOf([part]));
    geometry.deleteAttribute('part');
    const edges = new THREE.EdgesGeometry(geometry, 25);
    geometry.dispose();
    return edges;
  }
}
