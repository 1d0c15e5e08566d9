// Lines of an IFC file as web-ifc parses them, without classes: attributes by their position, which
// is the same in IFC 2x3 and 4 for all lines that are read this way.
//
// Nothing in a file is trusted: a line that does not exist, or whose attributes have other kinds
// than the schema says, gives no value.

// Kinds of attributes of web-ifc's raw lines.
const TYPED = 2;
const REAL = 4;
const REFERENCE = 5;
// Attributes of IfcRoot.
const GLOBAL_ID = 0;
const NAME = 2;
// Types of values whose text may look like a number but is none.
const TEXTS = ['IFCLABEL', 'IFCTEXT', 'IFCIDENTIFIER', 'IFCDATETIME', 'IFCDATE', 'IFCTIME', 'IFCDURATION',
               'IFCGLOBALLYUNIQUEID', 'IFCURIREFERENCE', 'IFCBINARY', 'IFCDESCRIPTIVEMEASURE'];

/** A real of a STEP file without a point at its end: "7." as "7", "1.E3" as "1E3". */
const withoutPoint = text => /^[-+]?\d+\.(E|$)/i.test(text) ? text.replace('.', '') : text;

export class Lines {
    #codes = new Map();
    #texts;
    #logical;

    constructor(api, model) {
        this.api = api;
        this.model = model;
        this.#texts = this.codes(TEXTS);
        this.#logical = this.code('IFCLOGICAL');
    }

    /** The number of a class. */
    code(name) {
        let code = this.#codes.get(name);
        if (code === undefined)
            this.#codes.set(name, code = this.api.GetTypeCodeFromName(name));
        return code;
    }

    codes(names) { return new Set(names.map(name => this.code(name))); }

    /** The numbers of all lines of a class and of those derived from it, in the file's order. */
    all(name) { return [...this.api.GetLineIDsWithType(this.model, this.code(name), true)]; }

    /** Returns {type, arguments}, or null if there is no such line or it cannot be read. */
    line(id) {
        if (id === null || id === undefined)
            return null;
        try {
            const raw = this.api.GetRawLineData(this.model, id);
            return raw?.arguments === undefined ? null : raw;
        } catch { // an integer beyond 64 bits
            return null;
        }
    }

    /** Returns line(id) for each of some numbers. One call of web-ifc reads them all. */
    lines(ids) {
        try {
            return this.api.GetRawLinesData(this.model, ids).map(raw => raw?.arguments === undefined ? null : raw);
        } catch { // one of them has an integer beyond 64 bits
            return ids.map(id => this.line(id));
        }
    }

    /** Returns the number of the line that a value refers to, or null. */
    reference(value) { return value?.type === REFERENCE ? value.value : null; }

    /** Returns the numbers of the lines that a reference, a list or a typed list refers to. */
    references(value) {
        const inner = value?.type === TYPED ? value.value : value;
        const list = Array.isArray(inner) ? inner : [inner];
        return list.map(each => this.reference(each)).filter(id => id !== null);
    }

    /** Returns a value as text; null if it is none, empty, a list or a reference. */
    text(value) {
        if (value === null || value === undefined || Array.isArray(value) || value.type === REFERENCE)
            return null;
        const inner = value.value;
        if (typeof inner === 'string') {
            const isNumber = value.type === REAL || (value.type === TYPED && !this.#texts.has(value.typecode));
            return inner === '' ? null : isNumber ? withoutPoint(inner) : inner;
        }
        if (typeof inner === 'number' || typeof inner === 'boolean')
            return String(inner);
        return value.type === TYPED && value.typecode === this.#logical ? 'unknown' : null;
    }

    /** Returns the texts of a value or of a list of values. */
    texts(value) {
        const list = Array.isArray(value) ? value : [value];
        return list.map(each => this.text(each)).filter(text => text !== null);
    }

    globalId(line) { return this.text(line?.arguments[GLOBAL_ID]); }

    /** Returns the name of a line derived from IfcRoot; if it has none, its GlobalId. */
    name(line) { return this.text(line?.arguments[NAME]) ?? this.globalId(line); }
}
