// node convert.mjs FILE.ifc spaces|no-spaces map|no-map: writes FILE's products to descriptor 3, as
// the scene stream of ../process/scene_stream.h.
//
// Each product with triangles becomes one part: id = GlobalId, name = Name, type = its IFC class.
// Coordinates are in metres with z up, as in IFC, and on the map that the file names unless
// `no-map` is given. Openings are left out; so are spaces and zones unless `spaces` is given. Every
// product with a body is a part or has a note with the reason why it is not. Products that are
// placed copies of the same geometry share a mesh. web-ifc computes the geometry: floats around the
// geometry's own centre, placed by a double matrix.

import crypto from 'node:crypto';
import fs from 'node:fs';

import {Colours} from './colours.mjs';
import {Fault, MALFORMED, UNSUPPORTED} from './fault.mjs';
import {Knowledge} from './knowledge.mjs';
import {LongTexts} from './long_texts.mjs';
import {mapFromProject} from './map.mjs';
import {Products} from './products.mjs';
import {edgeFaults, withClosedSlits} from './surface.mjs';
import {metresPerUnit, precisionOf} from './units.mjs';
import {plainFile, zippedFile} from './zip.mjs';

const RESULT = 3;
const MAGIC = Buffer.from('abutscn5');
const END = Buffer.from('abut-end');
const HEADER_BYTES = 56;
const Z_UP = 3; // 1 + UpAxis::z
const ENTRY_BYTES = 8;
const RELATION_BYTES = 12;
const ROUNDED_POSITIONS = 1n; // of scene_stream.h
const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
// NoteKind of include/abut/scene.h.
const SPACE = 0;
const CUT_AWAY = 1;
const NOT_BUILT = 2;
const NOT_CLOSED = 3;
// Holes of a surface are closed up to this width, or up to a few roundings of the largest
// coordinate.
const SLIT_METRES = 1e-6;
const SLIT_ROUNDINGS = 8 * 2 ** -24;
// Products share a mesh of several geometries if these are placed alike to within this. In survey
// coordinates, double arithmetic leaves errors of about 1e-9 m in a placement.
const SAME_PLACE_METRES = 1e-7;
const SAME_DIRECTION = 1e-9;

/**
 * Joins vertices at equal positions (-0 equals 0), in the order of their first occurrence, because
 * web-ifc separates vertices by their normals.
 */
function withJoinedVertices({positions, triangles}) {
    const distinct = positions.map(value => value + 0); // -0 + 0 is 0
    const words = new Uint32Array(distinct.buffer);
    const size = 3 * distinct.BYTES_PER_ELEMENT / words.BYTES_PER_ELEMENT;
    const vertices = positions.length / 3;
    const table = new Int32Array(2 ** Math.ceil(Math.log2(2 * vertices + 1))).fill(-1);
    const numberOf = new Uint32Array(vertices);
    let count = 0;
    const equal = (a, b) => {
        for (let k = 0; k < size; ++k)
            if (words[a * size + k] !== words[b * size + k])
                return false;
        return true;
    };
    for (let i = 0; i < vertices; ++i) {
        let hash = 0;
        for (let k = 0; k < size; ++k) {
            hash = Math.imul(hash ^ words[i * size + k], 0x9e3779b1);
            hash ^= hash >>> 15;
        }
        let place = hash & (table.length - 1);
        while (table[place] >= 0 && !equal(table[place], i))
            place = (place + 1) & (table.length - 1);
        if (table[place] < 0) {
            table[place] = count;
            distinct.copyWithin(3 * count, 3 * i, 3 * i + 3);
            ++count;
        }
        numberOf[i] = table[place];
    }
    return {positions: distinct.slice(0, 3 * count), triangles: triangles.map(index => numberOf[index] ?? index)};
}

class Output {
    /** Returns a text as it is written. */
    textOf = text => text;
    #parts = []; // buffers, several a part
    #partCount = 0;
    #notes = []; // buffers, several a note
    #noteCount = 0;
    #meshes = 0;
    #position = HEADER_BYTES;

    #write(bytes, position) {
        for (let done = 0; done < bytes.length;)
            done += fs.writeSync(RESULT, bytes, done, bytes.length - done, position + done);
    }

    #append(bytes) {
        this.#write(bytes, this.#position);
        this.#position += bytes.length;
    }

    /** positions: Float32Array or Float64Array; triangles: Uint32Array. Returns the mesh number. */
    mesh(positions, triangles) {
        const counts = Uint32Array.of(positions.length / 3, triangles.length / 3,
                                      positions.BYTES_PER_ELEMENT);
        for (const array of [counts, positions, triangles])
            this.#append(Buffer.from(array.buffer, array.byteOffset, array.byteLength));
        return this.#meshes++;
    }

    /** world: the twelve numbers of Transform; colour: four bytes, or null. */
    part(world, mesh, id, name, type, colour) {
        const texts = [id, name, type].map(text => Buffer.from(this.textOf(text)));
        const numbers = Uint32Array.of(mesh, ...texts.map(text => text.length), colour === null ? 0 : 1);
        this.#parts.push(Buffer.from(Float64Array.from(world).buffer), Buffer.from(numbers.buffer),
                         Buffer.from(colour ?? [0, 0, 0, 0]), ...texts);
        ++this.#partCount;
    }

    #header(status, textSize, meshes, parts, unit, notes) {
        const header = Buffer.alloc(HEADER_BYTES);
        MAGIC.copy(header);
        header.writeUInt32LE(status, 8);
        header.writeUInt32LE(textSize, 12);
        header.writeBigUInt64LE(BigInt(meshes), 16);
        header.writeBigUInt64LE(BigInt(parts), 24);
        header.writeDoubleLE(unit, 32);
        header.writeDoubleLE(1, 40); // web-ifc returns metres
        header.writeUInt32LE(Z_UP, 48);
        header.writeUInt32LE(notes, 52);
        this.#write(header, 0);
    }

    /** kind: a number of NoteKind of include/abut/scene.h. */
    note(kind, id, name, type, text) {
        const texts = [id, name, type, text].map(text => Buffer.from(this.textOf(text)));
        this.#notes.push(Buffer.from(Uint32Array.of(kind, ...texts.map(text => text.length)).buffer), ...texts);
        ++this.#noteCount;
    }

    /**
     * unit: metres per unit of the file; precision: metres; project: its GlobalId; map: twelve
     * numbers, or null; knowledge: the result of Knowledge.of.
     */
    end(unit, precision, project, map, {names, values, counts, entries, relations}) {
        const sized = text => [Buffer.from(Uint32Array.of(Buffer.byteLength(text)).buffer), Buffer.from(text)];
        const texts = [names, values].map(list => Buffer.concat(list.map(this.textOf).flatMap(sized)));
        const numbers = Uint32Array.of(names.length, values.length, relations.length / RELATION_BYTES,
                                       Buffer.byteLength(project));
        this.#append(Buffer.concat([...this.#parts, ...this.#notes]));
        for (const bytes of [Float64Array.from(map ?? IDENTITY), Float64Array.of(precision),
                             BigUint64Array.of(ROUNDED_POSITIONS), numbers, BigUint64Array.of(BigInt(entries.length / ENTRY_BYTES))])
            this.#append(Buffer.from(bytes.buffer));
        const properties = entries.length > 0 ? [counts, entries] : [];
        for (const bytes of [Buffer.from(project), ...texts, ...properties, relations, END])
            this.#append(bytes);
        this.#header(0, 0, this.#meshes, this.#partCount, unit, this.#noteCount);
    }

    error(code, text) {
        fs.ftruncateSync(RESULT, 0);
        const bytes = Buffer.from(text.split('\n')[0].slice(0, 500));
        this.#write(bytes, HEADER_BYTES);
        this.#header(1 + code, bytes.length, 0, 0, 1, 0);
    }
}

/** a times b of two column-major 4x4 affine matrices. */
function multiply(a, b) {
    const result = new Array(16).fill(0);
    for (let column = 0; column < 4; ++column)
        for (let row = 0; row < 4; ++row)
            for (let k = 0; k < 4; ++k)
                result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return result;
}

/** The inverse of an affine matrix, by cofactors; null if it is singular. */
function inverse(m) {
    const [a, b, c, , d, e, f, , g, h, i, , x, y, z] = m;
    const determinant = a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
    if (!(Math.abs(determinant) > 0))
        return null;
    const n = [e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g,
               c * d - a * f, d * h - e * g, b * g - a * h, a * e - b * d].map(v => v / determinant);
    return [n[0], n[1], n[2], 0, n[3], n[4], n[5], 0, n[6], n[7], n[8], 0,
            -(n[0] * x + n[3] * y + n[6] * z), -(n[1] * x + n[4] * y + n[7] * z),
            -(n[2] * x + n[5] * y + n[8] * z), 1];
}

/** web-ifc turns IFC's axes (z up) to y up. This turns them back, exactly. */
const zUp = m => m.map((v, i) => i % 4 === 1 ? 0 - m[i + 1] : i % 4 === 2 ? m[i - 1] : v);

const transformOf = m => [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]];

/** Reads a geometry: six floats a vertex (position, normal), three indices a triangle. */
function geometryOf(api, model, id, metresPerUnit) {
    const geometry = api.GetGeometry(model, id);
    const vertices = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const triangles =
        Uint32Array.from(api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize()));
    const positions = new Float32Array(vertices.length / 2);
    for (let from = 0, to = 0; from < vertices.length; from += 6, to += 3)
        positions.set(vertices.subarray(from, from + 3), to);
    geometry.delete();
    const whole = withJoinedVertices({positions, triangles});
    const reach = whole.positions.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    whole.triangles = withClosedSlits(whole.positions, whole.triangles,
                                      Math.max(SLIT_METRES / metresPerUnit, SLIT_ROUNDINGS * reach));
    // The express id does not identify a geometry: a wall has the same one with and without
    // openings.
    const hash =
        crypto.createHash('sha256').update(whole.positions).update(whole.triangles).digest('base64');
    return {hash, ...whole};
}

/** Joins several geometries to one mesh in the frame of the first, in doubles to avoid rounding. */
function joined(pieces) {
    const vertices = pieces.reduce((sum, piece) => sum + piece.geometry.positions.length, 0);
    const corners = pieces.reduce((sum, piece) => sum + piece.geometry.triangles.length, 0);
    const positions = new Float64Array(vertices);
    const triangles = new Uint32Array(corners);
    let vertex = 0;
    let corner = 0;
    for (const {geometry, place: m} of pieces) {
        const base = vertex / 3;
        const p = geometry.positions;
        for (let i = 0; i < p.length; i += 3)
            for (let row = 0; row < 3; ++row)
                positions[vertex++] =
                    m[row] * p[i] + m[4 + row] * p[i + 1] + m[8 + row] * p[i + 2] + m[12 + row];
        for (const index of geometry.triangles)
            triangles[corner++] = base + index;
    }
    return {positions, triangles};
}

/** A key that is equal for products with equal meshes: geometries and rounded placements. */
function keyOf(pieces, metresPerUnit) {
    const step = SAME_PLACE_METRES / metresPerUnit;
    return pieces
        .map(({geometry, place}) =>
                 [geometry.hash, ...place.map((v, i) => Math.round(v / (i >= 12 ? step : SAME_DIRECTION)) + 0)])
        .join(';');
}

/** The length of a column: metres per unit of the coordinates that the matrix places. */
const scaleOf = m => Math.hypot(m[0], m[1], m[2]);

class Converter {
    #meshOf = new Map();
    #seen = new Set(); // express ids of the products that web-ifc returns
    parts = []; // results of Products.about

    /** map: the result of mapFromProject, or null. */
    constructor(api, model, output, products, map) {
        this.colours = new Colours(api, model);
        this.map = map;
        this.api = api;
        this.model = model;
        this.output = output;
        this.products = products;
    }

    add(product) {
        const about = this.products.about(product.expressID);
        this.#seen.add(product.expressID);
        if (about.isLeftOut)
            return this.#note(about, SPACE, 'is a space or a zone, which is not built');
        const placed = [];
        for (let i = 0; i < product.geometries.size(); ++i) {
            const {color, geometryExpressID, flatTransformation} = product.geometries.get(i);
            const world = zUp([...flatTransformation]);
            const geometry = geometryOf(this.api, this.model, geometryExpressID, scaleOf(world));
            if (geometry.triangles.length > 0)
                placed.push({world, geometry, color});
        }
        if (placed.length === 0)
            return this.#missing(about);
        this.parts.push(about);
        const [mesh, world] = placed.length === 1 ? this.#single(placed[0]) : this.#several(placed);
        this.output.part(transformOf(this.map === null ? world : multiply(this.map, world)), mesh, about.id, about.name,
                         about.type, this.colours.largest(placed));
        const shapes = this.products.shapes(product.expressID);
        if (placed.length < shapes)
            this.#note(about, NOT_BUILT,
                       `of its ${shapes} shapes ${shapes - placed.length} could not be built, or are cut away`);
        if (this.products.isSolid(product.expressID))
            this.#checkClosed(about, placed);
    }

    /** Adds notes for the products with a body that web-ifc has not returned. */
    noteOthers() {
        for (const expressID of this.products.withBody())
            if (!this.#seen.has(expressID)) {
                const about = this.products.about(expressID);
                if (about.isLeftOut)
                    this.#note(about, SPACE, 'is a space or a zone, which is not built');
                else
                    this.#missing(about);
            }
    }

    #note({id, name, type}, kind, text) { this.output.note(kind, id, name, type, text); }

    #missing(about) {
        if (about.openings > 0)
            this.#note(about, CUT_AWAY,
                       `${about.openings === 1 ? 'its opening removes' : `its ${about.openings} openings remove`} all of it`);
        else
            this.#note(about, NOT_BUILT, 'has a body, but none of its triangles could be built');
    }

    #checkClosed(about, placed) {
        const sum = {open: 0, crowded: 0};
        for (const {geometry} of placed) {
            const {open, crowded} = edgeFaults(geometry.triangles);
            sum.open += open;
            sum.crowded += crowded;
        }
        const faults = [
            ...sum.open > 0 ? [`${sum.open} edges with one triangle`] : [],
            ...sum.crowded > 0 ? [`${sum.crowded} edges with more than two`] : []
        ];
        if (faults.length > 0)
            this.#note(about, NOT_CLOSED, `is a solid, but its surface has ${faults.join(' and ')}`);
    }

    #mesh(key, make) {
        let number = this.#meshOf.get(key);
        if (number === undefined) {
            const {positions, triangles} = withJoinedVertices(make());
            number = this.output.mesh(positions, triangles);
            this.#meshOf.set(key, number);
        }
        return number;
    }

    #single({world, geometry}) { return [this.#mesh(geometry.hash, () => geometry), world]; }

    #several(placed) {
        const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
        const back = inverse(placed[0].world);
        const world = back === null ? identity : placed[0].world;
        const pieces = placed.map(
            ({world: own, geometry}, i) =>
                ({geometry, place: back === null ? own : i === 0 ? identity : multiply(back, own)}));
        return [this.#mesh(keyOf(pieces, scaleOf(world)), () => joined(pieces)), world];
    }
}

/** Checks that the file is complete, because web-ifc also reads a truncated one, and its schema. */
function checkFile(file) {
    const read = (length, position) => file.read(length, position).toString('latin1');
    const header = read(1 << 16, 0);
    if (!header.includes('ISO-10303-21;'))
        throw new Fault(MALFORMED, 'is not an IFC file (STEP text)');
    if (!/END-ISO-10303-21\s*;\s*$/.test(read(1024, Math.max(0, file.size - 1024))))
        throw new Fault(MALFORMED, 'is truncated: it does not end with END-ISO-10303-21;');
    const schema = /FILE_SCHEMA\s*\(\s*\(\s*'([^']*)'/i.exec(header)?.[1];
    if (schema !== undefined && !/^IFC(2X3|4)/i.test(schema))
        throw new Fault(UNSUPPORTED, `has the schema ${schema}; only IFC2X3 and IFC4 are supported`);
}

/** The result of mapFromProject. A map that is not asked for may be wrong; it is none then. */
function mapOf(api, model, file, unit, isNeeded) {
    try {
        return mapFromProject(api, model, file, unit);
    } catch (fault) {
        if (isNeeded || !(fault instanceof Fault))
            throw fault;
        return null;
    }
}

async function convert(path, withSpaces, withMap, output) {
    const damaged = text => { throw new Fault(MALFORMED, text); };
    const file = new LongTexts(/\.ifczip$/i.test(path) ? zippedFile(path, damaged) : plainFile(path));
    checkFile(file);
    const {IfcAPI} = await import('web-ifc');
    const api = new IfcAPI();
    await api.Init(undefined, true);
    file.use(api);
    output.textOf = text => file.of(text);
    const model = api.OpenModelFromCallback((offset, size) => file.read(size, offset), {COORDINATE_TO_ORIGIN: false});
    if (model < 0)
        throw new Fault(MALFORMED, 'cannot be parsed as IFC');
    const unit = metresPerUnit(api, model);
    const map = mapOf(api, model, file, unit, withMap);
    const converter = new Converter(api, model, output, new Products(api, model, withSpaces), withMap ? map : null);
    let fault = null;
    const take = product => {
        try {
            fault ?? converter.add(product);
        } catch (error) {
            fault = error; // thrown later, not through the frames of WebAssembly
        }
    };
    api.StreamAllMeshes(model, take);
    if (withSpaces) // StreamAllMeshes returns the other types
        api.StreamAllMeshesWithTypes(model, [api.GetTypeCodeFromName('IFCSPACE')], take);
    if (fault !== null)
        throw fault;
    converter.noteOthers();
    const knowledge = new Knowledge(api, model);
    output.end(unit, precisionOf(api, model, unit), knowledge.project(), map === null ? null : transformOf(map), knowledge.of(converter.parts));
}

const output = new Output();
try {
    await convert(process.argv[2], process.argv[3] === 'spaces', process.argv[4] !== 'no-map', output);
} catch (error) {
    output.error(error instanceof Fault ? error.code : MALFORMED,
                 error instanceof Fault ? error.message : `cannot be read by web-ifc: ${error.message ?? error}`);
}
// Ends at once; otherwise web-ifc would first delete the model.
process.exit(0);
