// The map position of an IFC project: IfcMapConversion of IFC 4, or in IFC 2x3 the property sets
// ePSet_MapConversion and ePSet_ProjectedCRS, which replace it by convention.
//
//     (easting, northing, height) = offset + scale * (turned about z: (x, y, z) of the project)
//
// The offset is in units of the map. `Scale` is the ratio of the units times the scale of the map's
// projection.

import {Fault, MALFORMED} from './fault.mjs';
import {metresOf, metresOfName} from './units.mjs';

const PROPERTY_SETS = {conversion: 'EPSET_MAPCONVERSION', projection: 'EPSET_PROJECTEDCRS'};
// Metres on the map per metre of the project. Common projections stay within these bounds; the
// ratio of two different units of length does not.
const SMALLEST_SCALE = 0.4;
const LARGEST_SCALE = 2.5;
// A direction this near to an axis is that axis: in doubles, the cosine of 90 degrees is 6e-17.
const SAME_AXIS = 1e-15;

const isScale = value => value >= SMALLEST_SCALE && value <= LARGEST_SCALE;

const lines = (api, model, type) =>
    [...api.GetLineIDsWithType(model, api.GetTypeCodeFromName(type), true)].map(id => api.GetLine(model, id, true));

/** Returns a number, or undefined if the file has none. */
function numberOf(value, name) {
    if (value === undefined || value === null)
        return undefined;
    const number = Number(value);
    if (!Number.isFinite(number))
        throw new Fault(MALFORMED, `has a map conversion whose ${name} is not a number`);
    return number;
}

/** Returns the cosine and sine of the project's x axis on the map. */
function axisOf(abscissa, ordinate) {
    if (abscissa === undefined && ordinate === undefined)
        return [1, 0];
    const [x, y] = [abscissa ?? 0, ordinate ?? 0];
    const length = Math.hypot(x, y);
    if (!(length > 0))
        throw new Fault(MALFORMED, 'has a map conversion whose x axis has no direction');
    if (Math.abs(y) <= SAME_AXIS * length)
        return [Math.sign(x), 0];
    return Math.abs(x) <= SAME_AXIS * length ? [0, Math.sign(y)] : [x / length, y / length];
}

/**
 * Returns metres per unit of the map, and metres on the map per metre of the project.
 *
 * `scale` should include the ratio of the units. Well-known exporters omit that ratio, or the map's
 * unit. A value that would make a building a thousand times as large is therefore not used
 * literally.
 */
function unitAndScale(scale, mapUnit, projectUnit) {
    if (mapUnit !== undefined) {
        const literal = scale * mapUnit / projectUnit;
        if (isScale(literal) || isScale(scale))
            return [mapUnit, isScale(literal) ? literal : scale];
    } else {
        if (isScale(scale))
            return [projectUnit, scale]; // IFC 4: the map has the project's unit
        if (isScale(scale / projectUnit))
            return [1, scale / projectUnit]; // the scale implies that the map is in metres
    }
    throw new Fault(MALFORMED, `has a map conversion with the scale ${scale}, which no units explain; the map can be ignored ` +
                                   '(ReadOptions::map, --no-map)');
}

/**
 * Returns a column-major 4x4 matrix.
 *
 * In: attribute: attributes of IfcMapConversion; mapUnit: metres, or undefined.
 */
function matrixOf(attribute, mapUnit, projectUnit) {
    const number = name => numberOf(attribute(name), name);
    const [unit, scale] = unitAndScale(number('Scale') ?? 1, mapUnit, projectUnit);
    const [cosine, sine] = axisOf(number('XAxisAbscissa'), number('XAxisOrdinate'));
    const [x, y, z] = ['FactorX', 'FactorY', 'FactorZ'].map(name => scale * (number(name) ?? 1)); // IFC 4.3
    const offset = ['Eastings', 'Northings', 'OrthogonalHeight'].map(name => unit * (number(name) ?? 0));
    return [x * cosine, x * sine, 0, 0, -y * sine, y * cosine, 0, 0, 0, 0, z, 0, ...offset, 1];
}

function fromConversions(api, model, projectUnit) {
    const found = lines(api, model, 'IFCMAPCONVERSION')
                      .filter(line => line.SourceCRS?.CoordinateSpaceDimension?.value !== 2)
                      .map(line => {
                          const unit = line.TargetCRS?.MapUnit;
                          return matrixOf(name => line[name]?.value, unit ? metresOf(unit) : undefined, projectUnit);
                      });
    if (found.some(matrix => matrix.some((value, i) => value !== found[0][i])))
        throw new Fault(MALFORMED, `has ${found.length} map conversions that differ`);
    return found[0] ?? null;
}

/** Returns whether a file's text contains a word, in any case. */
function holds(file, word) {
    const BLOCK = 1 << 20;
    for (let at = 0; at < file.size; at += BLOCK)
        if (file.read(BLOCK + word.length, at).toString('latin1').toUpperCase().includes(word))
            return true;
    return false;
}

/** Returns the first property set of this name as a function of property names; null if none. */
function propertiesOf(sets, name) {
    const set = sets.find(set => set.Name?.value?.toUpperCase() === name);
    return set === undefined ? null : property => {
        const value = set.HasProperties?.find(each => each?.Name?.value === property)?.NominalValue?.value;
        return value === '' ? undefined : value;
    };
}

function fromPropertySets(api, model, file, projectUnit) {
    if (!holds(file, PROPERTY_SETS.conversion)) // saves reading up to 100,000 other property sets
        return null;
    const sets = lines(api, model, 'IFCPROPERTYSET');
    const conversion = propertiesOf(sets, PROPERTY_SETS.conversion);
    if (conversion === null)
        return null;
    const name = propertiesOf(sets, PROPERTY_SETS.projection)?.('MapUnit');
    const unit = name === undefined ? undefined : metresOfName(String(name));
    if (name !== undefined && unit === undefined)
        throw new Fault(MALFORMED, `has a map in units of '${name}', which is not a known length`);
    return matrixOf(conversion, unit, projectUnit);
}

/**
 * Returns the matrix from metres of the project, z up, to metres on its map (easting, northing,
 * height), column-major 4x4; null if the file has no map.
 *
 * In: file: {size, read} of zip.mjs; projectUnit: metres.
 */
export function mapFromProject(api, model, file, projectUnit) {
    return fromConversions(api, model, projectUnit) ?? fromPropertySets(api, model, file, projectUnit);
}
