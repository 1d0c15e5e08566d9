// Units of length of an IFC file, in metres.

const SI_PREFIXES = {EXA: 1e18, PETA: 1e15, TERA: 1e12, GIGA: 1e9, MEGA: 1e6, KILO: 1e3, HECTO: 1e2, DECA: 1e1,
                     DECI: 1e-1, CENTI: 1e-2, MILLI: 1e-3, MICRO: 1e-6, NANO: 1e-9, PICO: 1e-12, FEMTO: 1e-15,
                     ATTO: 1e-18};

/** Returns the metres of an IfcNamedUnit of length. */
export function metresOf(unit) {
    if (unit?.Name?.value === 'METRE')
        return SI_PREFIXES[unit.Prefix?.value] ?? 1;
    const factor = unit?.ConversionFactor;
    return factor ? factor.ValueComponent.value * metresOf(factor.UnitComponent) : 1;
}

/** Returns the metres of a unit by its name ('METRE', 'FOOT'); undefined if it is not a length. */
export function metresOfName(name) {
    const word = name.toUpperCase().replaceAll(/[\s_-]/g, '').replace(/METER/, 'METRE').replace(/S$/, '');
    const metre = /^([A-Z]*)METRE$/.exec(word);
    if (metre !== null)
        return metre[1] === '' ? 1 : SI_PREFIXES[metre[1]];
    return {M: 1, MM: 0.001, CM: 0.01, KM: 1000, FOOT: 0.3048, FEET: 0.3048, FT: 0.3048, INCH: 0.0254,
            USSURVEYFOOT: 1200 / 3937, USSURVEYFEET: 1200 / 3937}[word];
}

/** Returns the project's unit of length; metres if the file has none. */
export function metresPerUnit(api, model) {
    const projects = api.GetLineIDsWithType(model, api.GetTypeCodeFromName('IFCPROJECT'));
    if (projects.size() === 0)
        return 1;
    const units = api.GetLine(model, projects.get(0), true).UnitsInContext?.Units ?? [];
    const unit = metresOf(units.find(unit => unit?.UnitType?.value === 'LENGTHUNIT'));
    return unit > 0 && Number.isFinite(unit) ? unit : 1;
}

// IFC has precisions from 1e-8 to 1e-5 in mind. A file that states none gets the coarsest of these.
const USUAL_PRECISION_METRES = 1e-5;
// Nothing is built to a larger one. A file that states it was written with another unit in mind.
const COARSEST_PRECISION_METRES = 1e-3;

/**
 * Returns the metres below which the file takes two points for one: the largest Precision of its
 * contexts for three-dimensional shapes.
 */
export function precisionOf(api, model, metresPerUnit) {
    const contexts = api.GetLineIDsWithType(model, api.GetTypeCodeFromName('IFCGEOMETRICREPRESENTATIONCONTEXT'));
    let precision = 0;
    for (let i = 0; i < contexts.size(); ++i) {
        const context = api.GetLine(model, contexts.get(i));
        const stated = context?.CoordinateSpaceDimension?.value === 2 ? 0 : context?.Precision?.value * metresPerUnit;
        if (stated > precision && stated <= COARSEST_PRECISION_METRES)
            precision = stated;
    }
    return precision > 0 ? precision : USUAL_PRECISION_METRES;
}
