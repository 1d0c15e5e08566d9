// How parts look: one shader for all passes. A texture has the look of each part, so that a
// selection changes a few bytes and no geometry.
import * as THREE from 'three';

/** The looks of a part. Those from SOLID on are drawn opaque. */
export const LOOK = { hidden: 0, ghost: 1, shell: 2, solid: 3, a: 4, b: 5 };
const LOOKS = 6;
const TEXTURE_WIDTH = 1024;

const VERTEX = `
in uint part;
uniform sampler2D looks;
uniform int lowest, highest;
out vec3 place;
out vec3 seen;
flat out int look;
flat out int model;
flat out uint partOut;
void main() {
  vec4 texel = texelFetch(looks, ivec2(int(part) % ${TEXTURE_WIDTH}, int(part) / ${TEXTURE_WIDTH}), 0);
  look = int(texel.r * 255.0 + 0.5);
  model = int(texel.g * 255.0 + 0.5);
  partOut = part;
  place = position;
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  seen = view.xyz;
  // A part of another pass goes behind the far plane.
  gl_Position = look < lowest || look > highest ? vec4(0.0, 0.0, 2.0, 1.0) : projectionMatrix * view;
}`;

/**
 * Discards what the section box and the storey slider cut off. A shader that may discard makes the
 * graphics card shade what is hidden too, layer by layer; so it does only where something is cut.
 */
const CUT = `
uniform vec3 boxLower, boxUpper;
uniform vec3 up;
uniform vec2 slice;
in vec3 place;
in vec3 seen;
flat in int look;
flat in int model;
flat in uint partOut;
out vec4 outColour;
void cut() {
#ifdef CUTS
  float height = dot(place, up);
  if (any(lessThan(place, boxLower)) || any(greaterThan(place, boxUpper)) || height < slice.x || height > slice.y)
    discard;
#endif
}`;

const SHADED = `${CUT}
uniform vec4 colours[${LOOKS}];
uniform vec3 tints[8];
uniform vec3 upInView;
uniform float insides;
void main() {
  cut();
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float facing = abs(normal.z);
  float sky = 0.5 + 0.5 * dot(normal, upInView);
  vec4 colour = colours[look];
  if (look <= ${LOOK.solid})
    colour.rgb *= tints[model % 8];
  if (!gl_FrontFacing)
    colour.rgb *= insides;
  float light = 0.42 + 0.34 * facing + 0.24 * sky;
  outColour = vec4(colour.rgb * light, look == ${LOOK.ghost} ? colour.a * (1.35 - 0.7 * facing) : colour.a);
}`;

const DEPTH = `${CUT}
void main() {
  cut();
  outColour = vec4(1.0);
}`;

const NUMBERED = `${CUT}
void main() {
  cut();
  uint n = partOut + 1u;
  outColour = vec4(float(n & 255u), float((n >> 8) & 255u), float((n >> 16) & 255u), 255.0) / 255.0;
}`;

/** Green where a part looks like A, blue for B: counted to find the best viewpoint. */
const SIDES = `${CUT}
void main() {
  cut();
  outColour = vec4(0.0, look == ${LOOK.a} ? 1.0 : 0.0, look == ${LOOK.b} ? 1.0 : 0.0, 1.0);
}`;

/** A byte for the look of each part and one for its model. */
export class Looks {
  constructor(parts) {
    this.parts = parts;
    const height = Math.max(1, Math.ceil(parts.length / TEXTURE_WIDTH));
    this.data = new Uint8Array(2 * TEXTURE_WIDTH * height);
    this.texture = new THREE.DataTexture(this.data, TEXTURE_WIDTH, height, THREE.RGFormat, THREE.UnsignedByteType);
    parts.forEach((part, p) => { this.data[2 * p + 1] = part.model; });
    this.texture.needsUpdate = true;
  }

  /** Sets looks: of(part) for each part. */
  set(of) {
    this.parts.forEach((part, p) => { this.data[2 * p] = of(part); });
    this.texture.needsUpdate = true;
  }

  get(part) {
    return this.data[2 * part.index];
  }
}

const FAR = 1e9;

/** Uniforms that all passes share. */
export function makeUniforms(looks, up) {
  return {
    looks: { value: looks.texture },
    boxLower: { value: new THREE.Vector3(-FAR, -FAR, -FAR) },
    boxUpper: { value: new THREE.Vector3(FAR, FAR, FAR) },
    up: { value: up },
    upInView: { value: new THREE.Vector3() },
    slice: { value: new THREE.Vector2(-FAR, FAR) },
    colours: { value: Array.from({ length: LOOKS }, () => new THREE.Vector4(1, 1, 1, 1)) },
    insides: { value: 1 }, // brightness of backs: less, and walls that a plan cuts are dark
    tints: { value: Array.from({ length: 8 }, () => new THREE.Color(1, 1, 1)) },
  };
}

export function setBox(uniforms, box) {
  uniforms.boxLower.value.fromArray(box ? box.slice(0, 3) : [-FAR, -FAR, -FAR]);
  uniforms.boxUpper.value.fromArray(box ? box.slice(3) : [FAR, FAR, FAR]);
}

export function setSlice(uniforms, slice) {
  uniforms.slice.value.set(slice?.[0] ?? -FAR, slice?.[1] ?? FAR);
}

/** A material that cuts, and one that draws everything: {cut, whole}. */
function material(uniforms, lowest, highest, fragment, options = {}) {
  const make = (defines) => new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, side: THREE.DoubleSide, vertexShader: VERTEX, fragmentShader: fragment, defines,
    uniforms: { ...uniforms, lowest: { value: lowest }, highest: { value: highest } }, ...options,
  });
  return { cut: make({ CUTS: 1 }), whole: make({}) };
}

/**
 * The passes of a picture, in their order. Ghosts are one layer of milk glass: their depth is drawn
 * first, and then only the nearest of them is blended over what lies behind.
 */
export function makePasses(uniforms) {
  const opaque = material(uniforms, LOOK.solid, LOOK.b, SHADED);
  const depthOnly = (lowest, highest) => material(uniforms, lowest, highest, DEPTH, { colorWrite: false, transparent: true });
  const blended = (lowest, highest) => material(uniforms, lowest, highest, SHADED,
    { transparent: true, depthWrite: false, depthFunc: THREE.LessEqualDepth });
  return [opaque, depthOnly(LOOK.shell, LOOK.shell), blended(LOOK.shell, LOOK.shell),
    depthOnly(LOOK.ghost, LOOK.ghost), blended(LOOK.ghost, LOOK.ghost)];
}

export const makeNumberPass = (uniforms) => material(uniforms, LOOK.ghost, LOOK.b, NUMBERED);
export const makeSidesPass = (uniforms) => material(uniforms, LOOK.shell, LOOK.b, SIDES);

/** Colours of the looks, for a light and a dark page. */
const PALETTE = {
  light: {
    ground: '#f3f5f7', ghost: ['#72839a', 0.28], shell: ['#ff8a1f', 0.35], solid: '#ccd3db', a: '#ef7d00', b: '#1766d8',
    line: '#c3162f', edge: '#20262d', box: '#5a6673', kinds: ['#c3262b', '#a86100', '#7a3bb5', '#00717e', '#3567a6'],
  },
  dark: {
    ground: '#101317', ghost: ['#a9bbd0', 0.3], shell: ['#ff9a3d', 0.32], solid: '#7d8894', a: '#ff9326', b: '#4a95ff',
    line: '#ff5a6e', edge: '#e4e8ed', box: '#8492a1', kinds: ['#ff7a75', '#e5a440', '#c79dff', '#4cc5d3', '#86b4ec'],
  },
};
const TINTS = ['#ffffff', '#e9f1ff', '#fff3e2', '#e8f7ee', '#f6e9f8', '#fffbdd', '#e4f6f9', '#f3ece6'];

/** Sets the colours, and returns those of the other elements of the picture. */
export function applyPalette(uniforms, dark) {
  const palette = dark ? PALETTE.dark : PALETTE.light;
  // The shader writes display values, so the colours are taken as they are.
  const set = (look, colour, alpha = 1) => {
    const { r, g, b } = new THREE.Color().setStyle(colour, THREE.LinearSRGBColorSpace);
    uniforms.colours.value[look].set(r, g, b, alpha);
  };
  set(LOOK.ghost, ...palette.ghost);
  set(LOOK.shell, ...palette.shell);
  set(LOOK.solid, palette.solid);
  set(LOOK.a, palette.a);
  set(LOOK.b, palette.b);
  TINTS.forEach((tint, i) => uniforms.tints.value[i].setStyle(tint, THREE.LinearSRGBColorSpace));
  return palette;
}
