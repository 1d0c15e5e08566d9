// Colours of products, from the surface styles of their geometries.

const byteOf = value => Math.round(Math.min(Math.max(value, 0), 1) * 255);
const isWhite = ({x, y, z}) => x === 1 && y === 1 && z === 1;

export class Colours {
    #hasWhite; // whether the file states the colour white

    constructor(api, model) {
        const type = api.GetTypeCodeFromName('IFCCOLOURRGB');
        this.#hasWhite = [...api.GetLineIDsWithType(model, type)].some(id => {
            const {Red: red, Green: green, Blue: blue} = api.GetLine(model, id);
            return isWhite({x: red?.value, y: green?.value, z: blue?.value});
        });
    }

    /**
     * Returns the colour that covers the most triangles of the geometries, as four bytes; null if
     * there is none. Of equal shares the first wins.
     */
    largest(geometries) {
        const shares = new Map(); // key of a colour: [triangles, colour]
        for (const {color, geometry} of geometries) {
            const colour = this.#colourOf(color);
            const share = shares.get(String(colour)) ?? [0, colour];
            share[0] += geometry.triangles.length / 3;
            shares.set(String(colour), share);
        }
        return [...shares.values()].reduce((most, share) => share[0] > most[0] ? share : most)[1];
    }

    /** web-ifc returns opaque white for geometries without a style. */
    #colourOf(color) {
        const components = [color.x, color.y, color.z, color.w];
        if (components.some(value => !(value === Number(value))) ||
            (isWhite(color) && color.w === 1 && !this.#hasWhite))
            return null;
        return components.map(byteOf);
    }
}
