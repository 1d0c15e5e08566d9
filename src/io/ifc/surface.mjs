// The edges of a triangle mesh, and the closing of holes without width.

// The edges of a larger mesh are not examined, because a Map holds at most 2^24 entries. Most edges
// have two triangles, but all may have one.
const MOST_TRIANGLES = 2 ** 23;
const MOST_EDGES = 2 ** 24;

/** Uses of edges by edgeKey: [uses, uses as low -> high minus uses as high -> low]. None if the mesh
 * is too large. */
function edgesOf(triangles) {
    const edges = new Map();
    if (triangles.length > 3 * MOST_TRIANGLES)
        return edges;
    for (let i = 0; i < triangles.length; i += 3)
        for (let k = 0; k < 3; ++k) {
            const a = triangles[i + k];
            const b = triangles[i + (k + 1) % 3];
            if (a === b)
                continue;
            const key = edgeKey(a, b);
            let edge = edges.get(key);
            if (edge === undefined) {
                if (edges.size === MOST_EDGES)
                    return new Map();
                edges.set(key, edge = [0, 0]);
            }
            ++edge[0];
            edge[1] += a < b ? 1 : -1;
        }
    return edges;
}

const KEY_BASE = 2 ** 26;
const edgeKey = (a, b) => Math.min(a, b) * KEY_BASE + Math.max(a, b);

/** Returns the numbers of edges with one triangle, and with more than two. */
export function edgeFaults(triangles) {
    let open = 0;
    let crowded = 0;
    for (const [uses] of edgesOf(triangles).values()) {
        open += uses === 1 ? 1 : 0;
        crowded += uses > 2 ? 1 : 0;
    }
    return {open, crowded};
}

/** Returns the half-edges a -> b that lack just one triangle with b -> a: [a, b, a, b, ...]. */
function openHalfEdges(edges) {
    const open = [];
    for (const [key, [, net]] of edges) {
        const low = Math.floor(key / KEY_BASE);
        const high = key % KEY_BASE;
        if (net === 1)
            open.push(low, high);
        if (net === -1)
            open.push(high, low);
    }
    return open;
}

/** Returns simple loops [v0, v1, ...] of half-edges; other half-edges are left out. */
function loopsOf(edges) {
    const next = new Map(); // vertex: ends of the half-edges from it
    for (let i = 0; i < edges.length; i += 2) {
        const ways = next.get(edges[i]);
        if (ways === undefined)
            next.set(edges[i], [edges[i + 1]]);
        else
            ways.push(edges[i + 1]);
    }
    const loops = [];
    for (const [start, ways] of next)
        while (ways.length > 0) {
            const path = [start];
            const at = new Map([[start, 0]]);
            for (let v = next.get(start).pop(); v !== undefined; v = next.get(v)?.pop()) {
                if (!at.has(v)) {
                    at.set(v, path.length);
                    path.push(v);
                    continue;
                }
                const loop = path.splice(at.get(v));
                for (const vertex of loop)
                    at.delete(vertex);
                loops.push(loop);
                if (path.length === 0)
                    break;
                at.set(v, path.length);
                path.push(v);
            }
        }
    return loops;
}

const difference = (p, a, b) => [p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]];

/** Returns the largest distance of a loop's vertices from the line through two distant ones. */
function widthOf(loop, positions) {
    let from = loop[0];
    let to = from;
    for (let pass = 0; pass < 2; ++pass) { // the vertex farthest from the first, then from that one
        let most = -1;
        for (const v of loop) {
            const length = Math.hypot(...difference(positions, v, from));
            if (length > most) {
                most = length;
                to = v;
            }
        }
        if (pass === 0)
            [from, to] = [to, from];
    }
    const along = difference(positions, to, from);
    const length = Math.hypot(...along);
    if (!(length > 0))
        return 0;
    let width = 0;
    for (const v of loop) {
        const [x, y, z] = difference(positions, v, from);
        const [dx, dy, dz] = along;
        width = Math.max(width, Math.hypot(y * dz - z * dy, z * dx - x * dz, x * dy - y * dx) / length);
    }
    return width;
}

// A longer loop is filled from any vertex, because the search for a better one takes quadratic
// time.
const MOST_APICES = 64;

/** Returns triangles that fill a loop and use each of its edges in the other direction. */
function fillOf(loop, edges) {
    // The diagonals from the apex should not already be edges.
    const apex = loop.length > MOST_APICES ? 0 : loop.findIndex((v, i) => loop.every((w, k) => {
        const apart = (k - i + loop.length) % loop.length;
        return apart < 2 || apart === loop.length - 1 || !edges.has(edgeKey(v, w));
    }));
    const from = [...loop.slice(Math.max(apex, 0)), ...loop.slice(0, Math.max(apex, 0))];
    const fill = [];
    for (let k = 1; k + 1 < from.length; ++k)
        fill.push(from[0], from[k + 1], from[k]);
    return fill;
}

/**
 * Returns the triangles, and triangles of zero area that close holes without width: loops of edges
 * whose vertices lie on one line to within `tolerance`. Such holes occur because web-ifc drops
 * triangles of zero area, and leaves T-junctions where it cuts solids.
 *
 * In: vertices joined by position. No vertex is added or moved.
 */
export function withClosedSlits(positions, triangles, tolerance) {
    const edges = edgesOf(triangles);
    const fill = [];
    for (const loop of loopsOf(openHalfEdges(edges)))
        if (loop.length > 2 && widthOf(loop, positions) <= tolerance)
            for (const vertex of fillOf(loop, edges))
                fill.push(vertex);
    if (fill.length === 0)
        return triangles;
    const whole = new Uint32Array(triangles.length + fill.length);
    whole.set(triangles);
    whole.set(fill, triangles.length);
    return whole;
}
