// Data of an IFC file about its products, besides their geometry.

// Volumes that contain things but are not things themselves.
const SPACES = ['IFCSPACE', 'IFCSPATIALZONE', 'IFCEXTERNALSPATIALELEMENT'];
// Volumes that are subtracted from other products.
const FEATURES = ['IFCFEATUREELEMENTSUBTRACTION'];
// Identifiers of representations that are not a body [IFC 4, IfcShapeRepresentation].
const NO_BODY = ['Axis', 'FootPrint', 'Profile', 'Surface', 'Reference', 'Box', 'Annotation', 'Plan', 'Boundary',
                 'WalkingLine', 'Clearance', 'Lighting', 'CoG', 'Coverage', 'SurveyPoints'];
// Types of representations that hold surfaces or solids.
const BODY_TYPES = ['SweptSolid', 'AdvancedSweptSolid', 'Brep', 'AdvancedBrep', 'CSG', 'Clipping', 'SolidModel',
                    'Tessellation', 'SurfaceModel', 'Surface3D', 'SectionedSpine', 'MappedRepresentation'];
const SOLIDS = ['IFCSOLIDMODEL', 'IFCBOOLEANRESULT', 'IFCCSGPRIMITIVE3D'];
// Maximum nesting of mapped items in a valid file.
const DEEPEST = 32;

/** Returns an attribute as text; null if it is none or empty. */
export const textOf = attribute =>
    typeof attribute?.value === 'string' && attribute.value !== '' ? attribute.value : null;

export class Products {
    #withBody = new Map(); // express id: representations of its body
    #leftOut = new Set();
    #openings = new Map(); // express id: number of its openings
    #solids;
    #shapes = new Map(); // express id of a representation or an item: its shapes
    #codeOf;

    constructor(api, model, withSpaces) {
        this.api = api;
        this.model = model;
        this.#codeOf = name => api.GetTypeCodeFromName(name);
        const all = name => [...api.GetLineIDsWithType(model, this.#codeOf(name), true)];
        this.#solids = new Set(SOLIDS.flatMap(all));
        if (!withSpaces)
            this.#leftOut = new Set(SPACES.flatMap(all));
        for (const relation of all('IFCRELVOIDSELEMENT')) {
            const element = api.GetLine(model, relation).RelatingBuildingElement?.value;
            this.#openings.set(element, (this.#openings.get(element) ?? 0) + 1);
        }
        const features = new Set(FEATURES.flatMap(all));
        for (const product of all('IFCPRODUCT')) {
            const body = features.has(product) ? [] : this.#bodyOf(product);
            if (body.length > 0)
                this.#withBody.set(product, body);
        }
    }

    /** Returns the express ids of products with a body. */
    withBody() { return this.#withBody.keys(); }

    about(expressID) {
        const line = this.api.GetLine(this.model, expressID);
        return {
            expressID,
            tag: textOf(line.Tag),
            objectType: textOf(line.ObjectType),
            predefinedType: textOf(line.PredefinedType),
            id: line.GlobalId?.value ?? `#${expressID}`,
            name: line.Name?.value ?? '',
            type: this.api.GetNameFromTypeCode(this.api.GetLineType(this.model, expressID)) ?? '',
            isLeftOut: this.#leftOut.has(expressID),
            openings: this.#openings.get(expressID) ?? 0,
        };
    }

    /** Returns whether all shapes of a body are solids, so that its surface should be closed. */
    isSolid(expressID) {
        const shapes = this.#shapesOfBody(expressID);
        return shapes.length > 0 && shapes.every(shape => this.#isSolidShape(shape));
    }

    /** Returns the number of shapes of a product's body. */
    shapes(expressID) { return this.#shapesOfBody(expressID).length; }

    #line(reference) { return this.api.GetLine(this.model, reference); }

    #bodyOf(product) {
        const shape = this.#line(product).Representation;
        if (!shape)
            return [];
        return (this.#line(shape.value).Representations ?? []).map(r => r.value).filter(id => {
            const {RepresentationIdentifier: name, RepresentationType: type} = this.#line(id);
            if (NO_BODY.includes(name?.value))
                return false;
            return name?.value === 'Body' || BODY_TYPES.includes(type?.value);
        });
    }

    #shapesOfBody(expressID) {
        return (this.#withBody.get(expressID) ?? []).flatMap(representation => this.#shapesOf(representation, 0));
    }

    /** Returns the items of a representation. Mapped items are replaced by those that they map. */
    #shapesOf(id, depth) {
        const known = this.#shapes.get(id);
        if (known !== undefined)
            return known;
        const line = this.#line(id);
        const within = Array.isArray(line.Items) ? line.Items.map(item => item.value)
            : line.MappingSource                 ? [this.#line(line.MappingSource.value).MappedRepresentation.value]
                                                 : null;
        const shapes =
            within === null || depth === DEEPEST ? [id] : within.flatMap(inner => this.#shapesOf(inner, depth + 1));
        this.#shapes.set(id, shapes);
        return shapes;
    }

    #isSolidShape(id) {
        if (this.#solids.has(id))
            return true;
        const {Closed: closed} = this.#line(id); // set for a tessellated face set
        return closed?.value === true || closed?.value === 'T';
    }
}
