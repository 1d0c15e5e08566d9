// Unpacks the building: streams of meshoptimizer (src/clash/building/packed_building.h) become one
// list of triangles about the building's middle, in metres.
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

/** How finely a part is there, as PartDetail of the library. */
export const DETAIL = { clash: 0, near: 1, rest: 2 };
const NO_NUMBER = 0xffffffff;

function fromBase64(text) {
  if (Uint8Array.fromBase64)
    return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i)
    bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Reads the streams, one after the other. */
class Streams {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next(count) {
    const slice = this.bytes.subarray(this.at, this.at + count);
    this.at += count;
    return slice;
  }

  rows(Type, rows, width, bytes) {
    const result = new Type(rows * width);
    if (rows > 0)
      MeshoptDecoder.decodeVertexBuffer(new Uint8Array(result.buffer), rows, 4 * width, this.next(bytes));
    return result;
  }

  indices(count, bytes) {
    const result = new Uint32Array(count);
    if (count > 0)
      MeshoptDecoder.decodeIndexBuffer(new Uint8Array(result.buffer), count, 4, this.next(bytes));
    return result;
  }
}

/** Returns, by mesh, its points on the grid and its corners, which count from 0. */
function readMeshes(meta, streams) {
  const chunks = meta.chunks.map(([vertices, indices, vertexBytes, indexBytes]) => ({
    points: streams.rows(Uint32Array, vertices, 3, vertexBytes),
    corners: streams.indices(indices, indexBytes),
  }));
  const sizes = streams.rows(Uint32Array, meta.meshes, 2, meta.mesh_bytes);
  const meshes = [];
  let c = 0;
  let vertex = 0;
  let corner = 0;
  for (let m = 0; m < meta.meshes; ++m) {
    while (c + 1 < chunks.length && vertex === chunks[c].points.length / 3 && corner === chunks[c].corners.length) {
      ++c;
      vertex = 0;
      corner = 0;
    }
    const [vertices, corners] = [sizes[2 * m], sizes[2 * m + 1]];
    meshes.push({
      points: chunks[c].points.subarray(3 * vertex, 3 * (vertex + vertices)),
      corners: chunks[c].corners.subarray(corner, corner + corners),
      first: vertex,
    });
    vertex += vertices;
    corner += corners;
  }
  return meshes;
}

/** Places a mesh and returns the part's box: [x0, y0, z0, x1, y1, z1]. */
function place(points, t, o, positions, at) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    const [x, y, z] = [points[i], points[i + 1], points[i + 2]];
    for (let k = 0; k < 3; ++k) {
      const value = t[o + k] * x + t[o + k + 3] * y + t[o + k + 6] * z + t[o + k + 9];
      positions[at + i + k] = value;
      if (value < box[k])
        box[k] = value;
      if (value > box[k + 3])
        box[k + 3] = value;
    }
  }
  return box;
}

/** Whether a transform turns front faces into backs. */
const isMirrored = (t, o) => t[o] * (t[o + 4] * t[o + 8] - t[o + 5] * t[o + 7]) - t[o + 3] * (t[o + 1] * t[o + 8] - t[o + 2] * t[o + 7]) +
  t[o + 6] * (t[o + 1] * t[o + 5] - t[o + 2] * t[o + 4]) < 0;

/**
 * Returns {positions, partOf, indices, parts, numbered}: vertices with the index of their part,
 * corners, the parts {first, count (of corners), number, model, detail, box} in the order of their
 * corners, and the parts by their number in the report.
 */
export async function decodeBuilding(meta, text) {
  await MeshoptDecoder.ready;
  const streams = new Streams(fromBase64(text));
  const meshes = readMeshes(meta, streams);
  const rows = streams.rows(Uint32Array, meta.parts, 3, meta.part_bytes);
  const maps = streams.rows(Float32Array, meta.parts, 12, meta.transform_bytes);
  let vertices = 0;
  let corners = 0;
  for (let p = 0; p < meta.parts; ++p) {
    vertices += meshes[rows[3 * p]].points.length / 3;
    corners += meshes[rows[3 * p]].corners.length;
  }
  const positions = new Float32Array(3 * vertices);
  const partOf = new Uint32Array(vertices);
  const indices = new Uint32Array(corners);
  const parts = [];
  const numbered = [];
  let vertex = 0;
  let corner = 0;
  for (let p = 0; p < meta.parts; ++p) {
    const mesh = meshes[rows[3 * p]];
    const count = mesh.points.length / 3;
    const part = {
      index: p, first: corner, count: mesh.corners.length,
      number: rows[3 * p + 1] === NO_NUMBER ? null : rows[3 * p + 1],
      model: rows[3 * p + 2] & 0xffff, detail: rows[3 * p + 2] >>> 16,
      box: place(mesh.points, maps, 12 * p, positions, 3 * vertex),
    };
    partOf.fill(p, vertex, vertex + count);
    const shift = vertex - mesh.first;
    const mirrored = isMirrored(maps, 12 * p);
    for (let i = 0; i < mesh.corners.length; i += 3) {
      indices[corner + i] = mesh.corners[i] + shift;
      indices[corner + i + 1] = mesh.corners[i + (mirrored ? 2 : 1)] + shift;
      indices[corner + i + 2] = mesh.corners[i + (mirrored ? 1 : 2)] + shift;
    }
    vertex += count;
    corner += mesh.corners.length;
    parts.push(part);
    if (part.number !== null)
      numbered[part.number] = part;
  }
  return { positions, partOf, indices, parts, numbered };
}
