// The properties and relations of parts, from the relationships of an IFC file (docs/properties.md).

import {disciplinesOf} from './disciplines.mjs';
import {Lines} from './lines.mjs';
import {textOf} from './products.mjs';
import {PropertySets} from './property_sets.mjs';
import {closure, Relations} from './relations.mjs';

// RelationKind of include/abut/properties.h.
const FILLS = 0;
const CONNECTED = 1;
const COVERS = 2;
const PART_OF = 3;
// Classes of spatial structures and of groups, and the property that their name becomes.
const SPATIAL = {IFCSPACE: 'space', IFCBUILDINGSTOREY: 'storey', IFCBUILDING: 'building', IFCFACILITY: 'building',
                 IFCBRIDGE: 'building', IFCROAD: 'building', IFCRAILWAY: 'building', IFCMARINEFACILITY: 'building',
                 IFCSITE: 'site', IFCSPATIALZONE: 'zone'};
// The attributes that lead from a material definition to its materials.
const MATERIALS = {IFCMATERIALLIST: 0, IFCMATERIALLAYERSETUSAGE: 0, IFCMATERIALLAYERSET: 0, IFCMATERIALLAYER: 0,
                   IFCMATERIALLAYERWITHOFFSETS: 0, IFCMATERIALPROFILESETUSAGE: 0, IFCMATERIALPROFILESETUSAGETAPERING: 0,
                   IFCMATERIALPROFILESET: 2, IFCMATERIALPROFILE: 2, IFCMATERIALPROFILEWITHOFFSETS: 2,
                   IFCMATERIALCONSTITUENTSET: 2, IFCMATERIALCONSTITUENT: 2};
const NO_TYPE = ['NOTDEFINED', 'USERDEFINED'];

/** Numbers, as many as memory holds. */
class Numbers {
    #array = new Uint32Array(1024);
    size = 0;

    push(...numbers) {
        if (this.size + numbers.length > this.#array.length) {
            const larger = new Uint32Array(Math.max(2 * this.#array.length, this.size + numbers.length));
            larger.set(this.#array);
            this.#array = larger;
        }
        for (const number of numbers)
            this.#array[this.size++] = number;
    }

    bytes() { return Buffer.from(this.#array.buffer, 0, 4 * this.size); }
}

const withCodes = (lines, table) => new Map(Object.entries(table).map(([name, value]) => [lines.code(name), value]));

export class Knowledge {
    #types = new Map();
    #places = new Map();
    #materials = new Map();
    #parts = new Map(); // express id: number of the part
    #entries = new Numbers();
    #counts = new Numbers();
    #related = new Numbers();

    constructor(api, model) {
        this.api = api;
        this.model = model;
        const lines = this.lines = new Lines(api, model);
        this.relations = new Relations(lines);
        this.sets = new PropertySets(lines);
        this.spatial = withCodes(lines, SPATIAL);
        this.materialLists = withCodes(lines, MATERIALS);
        this.material = lines.code('IFCMATERIAL');
        this.groups = new Set(lines.all('IFCGROUP'));
        this.systems = new Set(lines.all('IFCSYSTEM'));
        this.zones = new Set(lines.all('IFCZONE'));
        this.distribution = lines.codes(['IFCDISTRIBUTIONSYSTEM', 'IFCDISTRIBUTIONCIRCUIT']);
        this.references = lines.codes(['IFCCLASSIFICATIONREFERENCE']);
        this.classification = lines.code('IFCCLASSIFICATION');
    }

    /** Returns the GlobalId of the project; empty if it has none. */
    project() { return this.lines.all('IFCPROJECT').map(id => this.lines.globalId(this.lines.line(id)))[0] ?? ''; }

    /**
     * Returns what is known about parts.
     *
     * In: parts: the results of Products.about, in the order of the parts.
     * Returns {names, values: texts; counts: entries of each part; entries: name, value; relations:
     * a, b, kind}, the last three as bytes of 32-bit numbers.
     */
    of(parts) {
        parts.forEach(({expressID}, i) => this.#parts.set(expressID, i));
        const objects = parts.map(part => this.#object(part));
        const disciplines = disciplinesOf(objects);
        objects.forEach((object, i) => this.#properties(parts[i], object, disciplines[i]));
        this.#relate();
        return {names: this.sets.names.all(), values: this.sets.values.all(), counts: this.#counts.bytes(),
                entries: this.#entries.bytes(), relations: this.#related.bytes()};
    }

    #className(line) { return line === null ? '' : this.api.GetNameFromTypeCode(line.type) ?? ''; }

    /** Remembers the results of make for numbers of lines. */
    #once(known, id, make) {
        let result = known.get(id);
        if (result === undefined)
            known.set(id, result = make());
        return result;
    }

    /** A type object: its name, class, predefined type and property sets. */
    #type(id) {
        return this.#once(this.#types, id, () => {
            const line = this.lines.line(id);
            let predefined = null;
            try {
                const {PredefinedType: own, ElementType: other} = this.api.GetLine(this.model, id);
                predefined = textOf(own) === 'USERDEFINED' ? textOf(other) : textOf(own);
            } catch { // of a class that the schema does not have
            }
            return {id, name: this.lines.name(line), className: this.#className(line), predefined,
                    sets: this.lines.references(line?.arguments[5])};
        });
    }

    /** What several properties of a part need. */
    #object({expressID, type}) {
        const {relations, lines} = this;
        const types = relations.types.of(expressID).map(id => this.#type(id));
        const wholes = closure(expressID, id => relations.wholes.of(id)).map(id => lines.line(id))
                           .filter(line => line !== null && !this.spatial.has(line.type));
        const groups = closure(expressID, id => [...relations.groups.of(id), ...relations.wholes.of(id)])
                           .filter(id => this.groups.has(id));
        return {types, groups,
                classes: [...types.map(each => each.className), type],
                wholes: wholes.map(line => this.#className(line)),
                assemblies: wholes.map(line => lines.globalId(line)).filter(id => id !== null),
                systems: groups.map(id => this.#systemType(id)).filter(each => each !== null)};
    }

    /** The predefined type of a distribution system; null for all others. */
    #systemType(id) {
        const line = this.lines.line(id);
        return this.distribution.has(line?.type) ? this.lines.text(line.arguments[6]) : null;
    }

    /** The spatial structures of one and around it, the nearest first: [property, name, number]. */
    #place(id) {
        return this.#once(this.#places, id, () => [id, ...closure(id, each => this.relations.wholes.of(each))]
            .map(each => [this.lines.line(each), each])
            .filter(([line]) => this.spatial.has(line?.type))
            .map(([line, each]) => [this.spatial.get(line.type), this.#spatialName(line), each]));
    }

    #spatialName(line) {
        const longName = line.arguments[7];
        return this.lines.text(line.arguments[2]) ?? this.lines.text(longName) ?? this.lines.globalId(line) ?? '';
    }

    /** The places that contain an object; else those of its whole, or of the element that it fills. */
    #placesOf(expressID) {
        const {containers, wholes, filled} = this.relations;
        const around = id => [...wholes.of(id), ...filled.of(id)];
        const of = id => this.spatial.has(this.lines.line(id)?.type) ? [id] : containers.of(id);
        for (const id of [expressID, ...closure(expressID, id => containers.of(id).length > 0 ? [] : around(id))]) {
            const places = id === expressID ? containers.of(id) : of(id);
            if (places.length > 0)
                return places;
        }
        return [];
    }

    #materialNames(id) {
        return this.#once(this.#materials, id, () => [id, ...closure(id, each => {
            const line = this.lines.line(each);
            const attribute = this.materialLists.get(line?.type);
            return attribute === undefined ? [] : this.lines.references(line.arguments[attribute]);
        })].map(each => this.lines.line(each)).filter(line => line?.type === this.material)
            .map(line => this.lines.text(line.arguments[0])).filter(name => name !== null));
    }

    /** The code of a classification; if it has none, its name. */
    #classification(id) {
        const line = this.lines.line(id);
        const reference = this.references.has(line?.type);
        return reference ? this.lines.text(line.arguments[1]) ?? this.lines.text(line.arguments[2])
            : this.classification === line?.type ? this.lines.text(line.arguments[3]) : null;
    }

    /** Writes the properties of one part. */
    #properties(part, object, discipline) {
        const before = this.#entries.size;
        const {relations, sets} = this;
        const add = (name, value) => {
            if (value !== null && value !== '')
                this.#entries.push(sets.names.number(name), sets.values.number(value));
        };
        const own = this.#placesOf(part.expressID).flatMap(id => this.#place(id));
        const other = relations.referencing.of(part.expressID).flatMap(id => this.#place(id));
        for (const [name, value] of [...own, ...other])
            add(name, value);
        for (const [, , place] of own) // the zones of the spaces around it
            for (const group of relations.groups.of(place))
                if (this.zones.has(group))
                    add('zone', this.lines.name(this.lines.line(group)));
        for (const group of object.groups)
            add(this.zones.has(group) ? 'zone' : this.systems.has(group) ? 'system' : 'group',
                this.lines.name(this.lines.line(group)));
        const definedBy = (links, take) => [part.expressID, ...object.types.map(type => type.id)]
            .map(id => links.of(id).flatMap(take)).filter(found => found.length > 0);
        for (const material of definedBy(relations.materials, id => this.#materialNames(id))[0] ?? [])
            add('material', material);
        for (const code of definedBy(relations.classifications, id => [this.#classification(id)]).flat())
            add('classification', code);
        for (const type of object.types)
            add('type_object', type.name);
        for (const id of object.assemblies)
            add('assembly', id);
        add('discipline', discipline);
        add('object_type', part.objectType);
        add('predefined_type', this.#predefinedType(part, object.types));
        add('tag', part.tag);
        this.#propertySets(part.expressID, object.types);
        this.#counts.push((this.#entries.size - before) / 2);
    }

    #predefinedType({predefinedType, objectType}, types) {
        const known = [predefinedType, ...types.map(type => type.predefined)].find(
            each => each !== null && !NO_TYPE.includes(each));
        return known ?? (predefinedType === 'USERDEFINED' ? objectType : null);
    }

    /** A property of the type is left out where the part has one of that name in that set. */
    #propertySets(expressID, types) {
        const known = new Set();
        for (const id of this.relations.sets.of(expressID)) {
            const set = this.sets.of(id);
            for (let i = 0; i < set.length; i += 2) {
                known.add(set[i]);
                this.#entries.push(set[i], set[i + 1]);
            }
        }
        for (const id of types.flatMap(type => type.sets)) {
            const set = this.sets.of(id);
            for (let i = 0; i < set.length; i += 2)
                if (!known.has(set[i]))
                    this.#entries.push(set[i], set[i + 1]);
        }
    }

    /** The parts that show an object: itself and what it consists of. */
    #partsOf(id) {
        return [id, ...closure(id, each => this.relations.parts.of(each))]
            .map(each => this.#parts.get(each)).filter(part => part !== undefined);
    }

    #relate() {
        const relate = (pairs, kind) => {
            for (const [a, b] of pairs) {
                if (a === b)
                    continue;
                const others = this.#partsOf(b);
                for (const one of this.#partsOf(a))
                    for (const other of others)
                        if (one !== other)
                            this.#related.push(one, other, kind);
            }
        };
        relate(this.relations.fills, FILLS);
        relate(this.relations.connected, CONNECTED);
        relate(this.relations.covers, COVERS);
        for (const [id, part] of this.#parts)
            for (const whole of closure(id, each => this.relations.wholes.of(each)))
                if (this.#parts.has(whole))
                    this.#related.push(part, this.#parts.get(whole), PART_OF);
    }
}
