// The only IFC file in a ZIP archive (.ifczip), read at any position.
//
//     entry      local header "PK\3\4" … name, extra | bytes, raw or deflated
//     directory  one record "PK\1\2" an entry: method, sizes, name, where the entry begins
//     end        "PK\5\6" … how many records, where the directory begins | comment
//
// The archive is not trusted: sizes are compared with the file's, and the stated size of an entry
// with the most that its bytes can hold.

import fs from 'node:fs';
import zlib from 'node:zlib';

const END_BYTES = 22;
const RECORD_BYTES = 46;
const LOCAL_BYTES = 30;
const LARGEST_COMMENT = 0xffff;
const STORED = 0;
const DEFLATED = 8;
// IFC text is compressed by a factor of 4 to 15. A higher ratio means an archive made to fill
// memory.
const LARGEST_RATIO = 100;
const SMALLEST_BOUND = 1 << 26;

/** A file on disk. read(length, position) returns the bytes there, fewer at the file's end. */
export function plainFile(path) {
    const file = fs.openSync(path, 'r');
    const size = fs.fstatSync(file).size;
    const read = (length, position) => {
        const bytes = Buffer.alloc(Math.max(0, Math.min(length, size - position)));
        return bytes.subarray(0, fs.readSync(file, bytes, 0, bytes.length, position));
    };
    return {size, read};
}

/** Bytes in memory that can be read like a file. */
function fileOf(bytes) {
    return {size: bytes.length, read: (length, position) => bytes.subarray(position, position + length)};
}

function directoryOf(archive, fail) {
    const tail = archive.read(END_BYTES + LARGEST_COMMENT, Math.max(0, archive.size - END_BYTES - LARGEST_COMMENT));
    const end = tail.length < END_BYTES ? -1 : tail.lastIndexOf('PK\u0005\u0006', tail.length - END_BYTES, 'latin1');
    if (end < 0)
        fail('is not a ZIP archive, or is truncated');
    const count = tail.readUInt16LE(end + 10);
    const size = tail.readUInt32LE(end + 12);
    const at = tail.readUInt32LE(end + 16);
    if (count === 0xffff || size === 0xffffffff || at === 0xffffffff)
        fail('is a ZIP64 archive, which is not supported');
    if (at + size > archive.size)
        fail('is truncated: its directory lies beyond its end');
    return {count, bytes: archive.read(size, at)};
}

// Files that macOS adds to an archive beside each file.
const COMPANION = /(^|\/)(__MACOSX\/|\._[^/]*$)/;

/** Returns the entries whose names end in .ifc. */
function models({count, bytes}, fail) {
    const entries = [];
    for (let i = 0, at = 0; i < count; ++i) {
        if (at + RECORD_BYTES > bytes.length || bytes.readUInt32LE(at) !== 0x02014b50)
            fail('has a damaged directory');
        const nameSize = bytes.readUInt16LE(at + 28);
        const next = at + RECORD_BYTES + nameSize + bytes.readUInt16LE(at + 30) + bytes.readUInt16LE(at + 32);
        const name = bytes.toString('utf8', at + RECORD_BYTES, at + RECORD_BYTES + nameSize);
        if (/\.ifc$/i.test(name) && !COMPANION.test(name))
            entries.push({
                encrypted: (bytes.readUInt16LE(at + 8) & 1) === 1,
                method: bytes.readUInt16LE(at + 10),
                checksum: bytes.readUInt32LE(at + 16),
                packed: bytes.readUInt32LE(at + 20),
                size: bytes.readUInt32LE(at + 24),
                at: bytes.readUInt32LE(at + 42),
            });
        at = next;
    }
    return entries;
}

let table = null;
function checksumOf(bytes) {
    table ??= Uint32Array.from({length: 256}, (_, i) => {
        for (let k = 0; k < 8; ++k)
            i = i & 1 ? (i >>> 1) ^ 0xedb88320 : i >>> 1;
        return i;
    });
    let checksum = ~0;
    for (const byte of bytes)
        checksum = (checksum >>> 8) ^ table[(checksum ^ byte) & 0xff];
    return ~checksum >>> 0;
}

/** fail(text) throws an error that the archive is malformed. */
export function zippedFile(path, fail) {
    const archive = plainFile(path);
    const entries = models(directoryOf(archive, fail), fail);
    if (entries.length !== 1)
        fail(`contains ${entries.length} IFC files instead of one`);
    const {encrypted, method, checksum, packed, size, at} = entries[0];
    if (encrypted || (method !== STORED && method !== DEFLATED))
        fail('contains an IFC file that is encrypted, or has an unsupported compression');
    if (size > Math.max(SMALLEST_BOUND, LARGEST_RATIO * packed))
        fail(`claims ${size} bytes from ${packed}, more than IFC can be compressed`);
    const local = archive.read(LOCAL_BYTES, at);
    if (local.length < LOCAL_BYTES || local.readUInt32LE(0) !== 0x04034b50)
        fail('has a damaged directory');
    const bytes = archive.read(packed, at + LOCAL_BYTES + local.readUInt16LE(26) + local.readUInt16LE(28));
    let content = bytes;
    try {
        if (method === DEFLATED)
            content = size === 0 ? Buffer.alloc(0) : zlib.inflateRawSync(bytes, {maxOutputLength: size});
    } catch {
        fail('contains a damaged IFC file');
    }
    if (bytes.length !== packed || content.length !== size || checksumOf(content) !== checksum)
        fail('contains a damaged IFC file');
    return fileOf(content);
}
