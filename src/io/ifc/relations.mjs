// The relationships between the objects of an IFC file. Objects are numbers of lines.

/** A map from an object to several others, in the file's order. */
class Links {
    #links = new Map();
    static #none = [];

    add(from, to) {
        if (from === null || to === null)
            return;
        const known = this.#links.get(from);
        if (known === undefined)
            this.#links.set(from, [to]);
        else
            known.push(to);
    }

    of(from) { return this.#links.get(from) ?? Links.#none; }
}

/**
 * Returns all that can be reached from an object by a step, itself left out, the nearest first.
 * Cycles, which a damaged file may have, end.
 *
 * In: step: returns the next objects of an object.
 */
export function closure(start, step) {
    const found = new Set([start]);
    for (const object of found) // also visits what is added on the way
        for (const next of step(object))
            found.add(next);
    found.delete(start);
    return [...found];
}

export class Relations {
    wholes = new Links(); // what an object is aggregated or nested in
    parts = new Links(); // what is aggregated or nested in an object
    containers = new Links(); // the spatial structures that contain an object
    referencing = new Links(); // spatial structures that refer to an object without containing it
    groups = new Links();
    types = new Links();
    materials = new Links();
    classifications = new Links();
    sets = new Links(); // property sets and quantities
    filled = new Links(); // the elements whose openings an object fills
    fills = []; // [object, the element whose opening it fills]
    connected = []; // [object, object]
    covers = []; // [covering, what it covers]

    constructor(lines) {
        this.lines = lines;
        this.#eachPair('IFCRELAGGREGATES', 4, 5, (whole, part) => this.#decompose(whole, part));
        this.#eachPair('IFCRELNESTS', 4, 5, (whole, part) => this.#decompose(whole, part));
        this.#eachPair('IFCRELCONTAINEDINSPATIALSTRUCTURE', 5, 4,
                       (structure, element) => this.containers.add(element, structure));
        this.#eachPair('IFCRELREFERENCEDINSPATIALSTRUCTURE', 5, 4,
                       (structure, element) => this.referencing.add(element, structure));
        for (const [name, from, links] of [['IFCRELASSIGNSTOGROUP', 6, this.groups],
                                           ['IFCRELDEFINESBYTYPE', 5, this.types],
                                           ['IFCRELASSOCIATESMATERIAL', 5, this.materials],
                                           ['IFCRELASSOCIATESCLASSIFICATION', 5, this.classifications],
                                           ['IFCRELDEFINESBYPROPERTIES', 5, this.sets]])
            this.#eachPair(name, from, 4, (definition, object) => links.add(object, definition));
        this.#openings();
        this.#connections();
        this.#eachPair('IFCRELCOVERSBLDGELEMENTS', 4, 5,
                       (element, covering) => this.covers.push([covering, element]));
    }

    /** Calls take(a, b) with all references of two attributes of each line of a class. */
    #eachPair(name, first, second, take) {
        for (const id of this.lines.all(name)) {
            const line = this.lines.line(id)?.arguments ?? [];
            const others = this.lines.references(line[second]);
            for (const a of this.lines.references(line[first]))
                for (const b of others)
                    take(a, b);
        }
    }

    #decompose(whole, part) {
        this.wholes.add(part, whole);
        this.parts.add(whole, part);
    }

    #openings() {
        const voided = new Links(); // opening: the element that it is cut out of
        this.#eachPair('IFCRELVOIDSELEMENT', 5, 4, (opening, element) => voided.add(opening, element));
        this.#eachPair('IFCRELFILLSELEMENT', 4, 5, (opening, filling) => {
            for (const element of voided.of(opening)) {
                this.fills.push([filling, element]);
                this.filled.add(filling, element);
            }
        });
    }

    #connections() {
        const connect = (a, b) => this.connected.push([a, b]);
        const owners = new Links(); // port: its element
        this.#eachPair('IFCRELCONNECTSPORTTOELEMENT', 4, 5, (port, element) => owners.add(port, element));
        // In IFC 4 a port is nested in its element.
        const ownersOf = port => owners.of(port).length > 0 ? owners.of(port) : this.wholes.of(port);
        this.#eachPair('IFCRELCONNECTSPORTS', 4, 5, (a, b) => {
            for (const one of ownersOf(a))
                for (const other of ownersOf(b))
                    connect(one, other);
        });
        this.#eachPair('IFCRELCONNECTSELEMENTS', 5, 6, connect); // also connections of paths
        // A bolt or a weld is connected with both elements that it joins.
        for (const element of [5, 6])
            this.#eachPair('IFCRELCONNECTSWITHREALIZINGELEMENTS', 7, element, connect);
        this.#eachPair('IFCRELCONNECTSPORTS', 6, 4, (realizing, port) =>
            ownersOf(port).forEach(owner => connect(realizing, owner)));
        this.#eachPair('IFCRELCONNECTSPORTS', 6, 5, (realizing, port) =>
            ownersOf(port).forEach(owner => connect(realizing, owner)));
    }
}
