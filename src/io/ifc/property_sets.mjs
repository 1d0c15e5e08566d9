// Property sets and quantities of an IFC file. Each set is read once, when the first part has it.

/** Distinct texts, numbered in the order of their first use. */
class Texts {
    #numbers = new Map();

    number(text) {
        let number = this.#numbers.get(text);
        if (number === undefined)
            this.#numbers.set(text, number = this.#numbers.size);
        return number;
    }

    all() { return [...this.#numbers.keys()]; }
}

// Maximum nesting of complex properties.
const DEEPEST = 8;

export class PropertySets {
    names = new Texts();
    values = new Texts();
    #sets = new Map(); // number of a set's line: [number of a name, number of a value, ...]
    #readers = new Map(); // class of a property: how it is read

    constructor(lines) {
        this.lines = lines;
        const code = name => lines.code(name);
        const read = (name, take) => this.#readers.set(code(name), take);
        read('IFCPROPERTYSINGLEVALUE', line => lines.texts(line[2]));
        read('IFCPROPERTYENUMERATEDVALUE', line => lines.texts(line[2]));
        read('IFCPROPERTYLISTVALUE', line => lines.texts(line[2]));
        // The lower bound, the set point, the upper bound.
        read('IFCPROPERTYBOUNDEDVALUE', line => [line[3], line[5], line[2]].flatMap(value => lines.texts(value)));
        for (const quantity of ['LENGTH', 'AREA', 'VOLUME', 'COUNT', 'WEIGHT', 'TIME', 'NUMBER'])
            read(`IFCQUANTITY${quantity}`, line => lines.texts(line[3]));
        this.complex = new Map([[code('IFCCOMPLEXPROPERTY'), 3], [code('IFCPHYSICALCOMPLEXQUANTITY'), 2]]);
        // The attribute that lists the content of a set.
        this.contents = new Map([[code('IFCPROPERTYSET'), 4], [code('IFCELEMENTQUANTITY'), 5]]);
    }

    /** Returns the properties of a set: numbers of names and values in turn. */
    of(id) {
        let set = this.#sets.get(id);
        if (set !== undefined)
            return set;
        this.#sets.set(id, set = []);
        const line = this.lines.line(id);
        const content = this.contents.get(line?.type);
        if (content !== undefined) {
            const name = this.lines.name(line);
            this.#addAll(this.lines.references(line.arguments[content]), name, set, 0);
        }
        return set;
    }

    #addAll(ids, path, set, depth) {
        for (const line of this.lines.lines(ids))
            this.#add(line, path, set, depth);
    }

    #add(line, path, set, depth) {
        const name = line === null ? null : this.lines.text(line.arguments[0]);
        if (name === null || depth === DEEPEST)
            return;
        const inner = this.complex.get(line.type);
        if (inner !== undefined) {
            return this.#addAll(this.lines.references(line.arguments[inner]), `${path}.${name}`, set, depth + 1);
        }
        const values = this.#readers.get(line.type)?.(line.arguments) ?? [];
        if (values.length === 0)
            return;
        const number = this.names.number(`${path}.${name}`);
        for (const value of values)
            set.push(number, this.values.number(value));
    }
}
