// ErrorCode of include/abut/error.h; 1 + code is the stream's status.
export const MALFORMED = 3;
export const UNSUPPORTED = 4;

/** A fault of a file, described in one line. */
export class Fault extends Error {
    constructor(code, text) {
        super(text);
        this.code = code;
    }
}
