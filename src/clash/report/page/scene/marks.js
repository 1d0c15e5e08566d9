// What is drawn on top of the parts: a dot for each clash, the witness line, the section box, the
// edges of A and B, and the line of a measurement. Texts are elements of the page over the canvas.
import * as THREE from 'three';

const DOT = { vertex: `
attribute vec3 tint;
varying vec3 colour;
uniform float size;
void main() {
  colour = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = size;
}`, fragment: `
varying vec3 colour;
uniform vec3 ring;
void main() {
  float r = length(gl_PointCoord - 0.5);
  if (r > 0.5) discard;
  gl_FragColor = vec4(r > 0.4 ? ring : colour, 1.0);
}` };

const plainColour = (text) => new THREE.Color().setStyle(text, THREE.LinearSRGBColorSpace);
const sRgb = (text) => new THREE.Color(text);

export class Marks {
  constructor(scene, host) {
    this.scene = scene;
    this.host = host;
    this.dots = new THREE.Points(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
      vertexShader: DOT.vertex, fragmentShader: DOT.fragment, depthTest: false, transparent: true,
      uniforms: { size: { value: 8 }, ring: { value: new THREE.Color(1, 1, 1) } },
    }));
    this.dots.renderOrder = 20;
    this.dots.frustumCulled = false;
    this.lines = { witness: this.line(22, 2), measure: this.line(23, 2), box: this.line(15, 1, true) };
    this.edges = [this.line(10, 1, true), this.line(10, 1, true)];
    scene.add(this.dots);
    this.labels = [];
    this.shown = [];
  }

  line(order, width, depthTest = false) {
    const line = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ depthTest, transparent: true, linewidth: width }));
    line.renderOrder = order;
    line.frustumCulled = false;
    line.visible = false;
    this.scene.add(line);
    return line;
  }

  setPalette(palette) {
    this.palette = palette;
    this.dots.material.uniforms.ring.value = plainColour(palette.ground);
    this.lines.witness.material.color = sRgb(palette.line);
    this.lines.measure.material.color = sRgb(palette.edge);
    this.lines.box.material.color = sRgb(palette.box);
    for (const edge of this.edges)
      Object.assign(edge.material, { color: sRgb(palette.edge), opacity: 0.55 });
    if (this.shown.length > 0)
      this.showDots(this.shown);
  }

  /** Shows dots: [{place: Vector3, kind: number, clash}]. */
  showDots(dots) {
    this.shown = dots;
    const places = new Float32Array(3 * dots.length);
    const tints = new Float32Array(3 * dots.length);
    const colours = this.palette.kinds.map(plainColour);
    dots.forEach(({ place, kind }, i) => {
      place.toArray(places, 3 * i);
      colours[kind].toArray(tints, 3 * i);
    });
    this.dots.geometry.dispose();
    this.dots.geometry = new THREE.BufferGeometry();
    this.dots.geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    this.dots.geometry.setAttribute('tint', new THREE.BufferAttribute(tints, 3));
    this.dots.material.uniforms.size.value = (dots.length > 300 ? 7 : 10) * Math.min(2, devicePixelRatio);
  }

  setLine(name, points) {
    const line = this.lines[name];
    line.geometry.dispose();
    line.geometry = new THREE.BufferGeometry().setFromPoints(points);
    line.visible = points.length > 0;
  }

  setEdges(side, geometry) {
    this.edges[side].geometry.dispose();
    this.edges[side].geometry = geometry ?? new THREE.BufferGeometry();
    this.edges[side].visible = geometry !== null;
  }

  setBox(box) {
    if (box === null)
      return this.setLine('box', []);
    const corner = (i) => new THREE.Vector3(box[i & 1 ? 3 : 0], box[i & 2 ? 4 : 1], box[i & 4 ? 5 : 2]);
    const points = [];
    for (let i = 0; i < 8; ++i)
      for (const bit of [1, 2, 4])
        if (!(i & bit))
          points.push(corner(i), corner(i | bit));
    return this.setLine('box', points);
  }

  /** Sets the texts over the picture: [{place: Vector3, text, className}]. */
  setLabels(labels) {
    for (const { element } of this.labels)
      element.remove();
    this.labels = labels.map(({ place, text, className }) => {
      const element = document.createElement('span');
      element.className = `label ${className}`;
      element.textContent = text;
      element.setAttribute('aria-hidden', 'true'); // the detail has the same text
      this.host.append(element);
      return { place, element };
    });
  }

  /** Moves the texts to where their places are seen. */
  placeLabels(camera, width, height) {
    for (const { place, element } of this.labels) {
      const at = place.clone().project(camera);
      element.hidden = at.z > 1 || Math.abs(at.x) > 1.05 || Math.abs(at.y) > 1.05;
      element.style.transform = `translate(${((at.x + 1) / 2) * width}px, ${((1 - at.y) / 2) * height}px)`;
    }
  }

  /** Returns the dot that is seen within some pixels of a point; null if there is none. */
  dotAt(camera, x, y, width, height, reach = 9) {
    let best = null;
    let least = reach * reach;
    const at = new THREE.Vector3();
    for (const dot of this.dots.visible ? this.shown : []) {
      at.copy(dot.place).project(camera);
      const away = ((at.x + 1) / 2 * width - x) ** 2 + ((1 - at.y) / 2 * height - y) ** 2;
      if (at.z < 1 && away < least) {
        least = away;
        best = dot;
      }
    }
    return best;
  }
}
