// Texts of more than 65,535 bytes in an IFC file.
//
// web-ifc keeps the length of a text in 16 bits, so that a longer one would lose its beginning
// without notice. The file is read with a short stand-in in the place of each such text:
//
//     'A text of 100,000 bytes …'   becomes   'abut-text-1f2e3d4c-0'                    (spaces)
//
// of() gives the text that a stand-in stands for. web-ifc decodes it, in pieces.

import crypto from 'node:crypto';

const LONGEST = 0xffff;
const PIECE = 60000;
const CHUNK = 1 << 20;
const QUOTE = 0x27;
const SLASH = 0x2f;
const STAR = 0x2a;
const SPACE = 0x20;
// "\s\". A quote that follows it is a character: "\S\'" is a paragraph sign.
const SHIFT = 0x5c735c;
const LOWER = 0x2000; // makes the letter small
// The units of an encoded text that must not be cut [ISO 10303-21, 6.4.3]; a run of hexadecimal
// characters may be.
const UNIT = /''|\\\\|\\[Ss]\\[\s\S]|\\X\\[\s\S]{2}|\\P[\s\S]\\|\\X([24])\\([0-9A-F]*)\\X0\\|[\xc0-\xff][\x80-\xbf]*|[\s\S]/gy;

/** Returns the long texts of a file: [position of the first byte, position of the closing quote]. */
function longTexts(file) {
    const found = [];
    let from = -1; // of the text; negative: outside of one
    let before = 0; // the byte before, outside of texts
    let isComment = false;
    let quote = -1; // a quote that ends the text unless another one follows
    let recent = 0; // the last three bytes of the text
    for (let position = 0; position < file.size;) {
        const bytes = file.read(CHUNK, position);
        if (bytes.length === 0)
            break;
        for (let i = 0; i < bytes.length; ++i) {
            const byte = bytes[i];
            if (from >= 0) {
                const isShifted = (recent | LOWER) === SHIFT;
                recent = (recent << 8 | byte) & 0xffffff;
                if (quote < 0) {
                    if (byte === QUOTE && !isShifted)
                        quote = position + i;
                    continue;
                }
                if (byte === QUOTE) { // a pair of quotes, which is one character
                    quote = -1;
                    continue;
                }
                if (quote - from > LONGEST)
                    found.push([from, quote]);
                from = quote = -1;
                before = byte;
            } else if (isComment) {
                isComment = !(before === STAR && byte === SLASH);
                before = isComment ? byte : 0;
            } else if (byte === QUOTE) {
                from = position + i + 1;
                recent = 0;
            } else {
                isComment = before === SLASH && byte === STAR;
                before = isComment ? 0 : byte;
            }
        }
        position += bytes.length;
    }
    return found;
}

/** Cuts an encoded text into pieces that can be decoded one by one. */
function piecesOf(text) {
    const pieces = [''];
    let page = ''; // the directive that says how \S\ is read
    const add = unit => {
        if (pieces.at(-1).length + unit.length > PIECE)
            pieces.push(page);
        pieces[pieces.length - 1] += unit;
    };
    for (const [unit, width, digits] of text.matchAll(UNIT)) {
        if (/^\\P[\s\S]\\$/.test(unit))
            page = unit;
        if (width === undefined) {
            add(unit);
            continue;
        }
        const most = PIECE / 2 - PIECE / 2 % 8; // whole characters; a pair of surrogates has 8 digits
        for (let at = 0; at === 0 || at < digits.length;) {
            let end = Math.min(at + most, digits.length);
            if (end < digits.length && width === '2' && /^D[89AB]/.test(digits.slice(end - 4, end)))
                end -= 4;
            add(`\\X${width}\\${digits.slice(at, end)}\\X0\\`);
            at = Math.max(end, 1);
        }
    }
    return pieces;
}

export class LongTexts {
    #texts;
    #key = `abut-text-${crypto.randomBytes(8).toString('hex')}-`;
    #standIn = new RegExp(`${this.#key}([0-9]+)`, 'g');
    #decoded = new Map();

    /** file: as plainFile returns it. */
    constructor(file) {
        this.file = file;
        this.size = file.size;
        this.#texts = file.size > LONGEST ? longTexts(file) : [];
    }

    /** Lets of() decode with web-ifc. */
    use(api) { this.api = api; }

    /** Returns bytes of the file, with stand-ins. */
    read(length, position) {
        let bytes = this.file.read(length, position);
        this.#texts.forEach(([from, to], number) => {
            const first = Math.max(from, position);
            const last = Math.min(to + 1, position + bytes.length);
            if (first >= last)
                return;
            bytes = Buffer.from(bytes); // the archive's bytes stay as they are
            const standIn = Buffer.from(`${this.#key}${number}'`);
            for (let i = first; i < last; ++i)
                bytes[i - position] = standIn[i - from] ?? SPACE;
        });
        return bytes;
    }

    /** Returns a text with the long texts in the place of their stand-ins. */
    of(text) {
        return this.#texts.length === 0 || !text.includes(this.#key)
            ? text
            : text.replace(this.#standIn, (standIn, number) => this.#once(standIn, this.#texts[number]));
    }

    #once(standIn, [from, to]) {
        let decoded = this.#decoded.get(standIn);
        if (decoded === undefined)
            this.#decoded.set(standIn, decoded = this.#decode(from, to));
        return decoded;
    }

    #decode(from, to) {
        const pieces = piecesOf(this.file.read(to - from, from).toString('latin1'));
        const lines = pieces.map((piece, i) => `#${i + 1}=IFCPROPERTYSINGLEVALUE('A',$,IFCTEXT('${piece}'),$);\n`);
        const bytes = Buffer.from(
            `ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n${lines.join('')}ENDSEC;\nEND-ISO-10303-21;\n`,
            'latin1');
        const model = this.api.OpenModelFromCallback((offset, size) => bytes.subarray(offset, offset + size), {});
        const texts = pieces.map((piece, i) => this.api.GetRawLineData(model, i + 1).arguments?.[2]?.value ?? '');
        this.api.CloseModel(model);
        return texts.join('');
    }
}
