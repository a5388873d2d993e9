"use strict";
/* Archives of a few texts, not compressed (PKWARE's APPNOTE 6.3). */
const Zip = (() => {
    /* Both headers of a file have these fields; `start`: the signature and what is before them. */
    function header(start, size, name, bytes, crc) {
        const data = new Uint8Array(size + name.length), view = new DataView(data.buffer);
        start.forEach((value, i) => view.setUint16(2 * i, value, true));
        const at = 2 * start.length;
        view.setUint16(at + 4, 0x21, true); /* 1 January 1980: the same bytes for the same texts */
        view.setUint32(at + 6, crc, true);
        view.setUint32(at + 10, bytes.length, true);
        view.setUint32(at + 14, bytes.length, true);
        view.setUint16(at + 18, name.length, true);
        data.set(name, size);
        return data;
    }

    /* A Map of names and texts. */
    function encode(texts) {
        const utf8 = text => new TextEncoder().encode(text);
        const files = [], entries = [];
        let offset = 0, listed = 0;
        for (const [name, text] of texts) {
            const bytes = utf8(text), crc = Png.crc(bytes);
            const local = header([0x4b50, 0x0403, 20, 0x800], 30, utf8(name), bytes, crc);
            const entry = header([0x4b50, 0x0201, 20, 20, 0x800], 46, utf8(name), bytes, crc);
            new DataView(entry.buffer).setUint32(42, offset, true);
            files.push(local, bytes);
            entries.push(entry);
            offset += local.length + bytes.length;
            listed += entry.length;
        }
        const end = new Uint8Array(22), view = new DataView(end.buffer);
        [0x4b50, 0x0605, 0, 0, texts.size, texts.size].forEach((value, i) => view.setUint16(2 * i, value, true));
        view.setUint32(12, listed, true);
        view.setUint32(16, offset, true);
        return new Blob([...files, ...entries, end], {type: "application/zip"});
    }

    return {encode};
})();
