"use strict";
/* Archives of a few texts (PKWARE's APPNOTE 6.3): written as they are, read also where they are deflated. */
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

    const through = (bytes, stream) => new Blob([bytes]).stream().pipeThrough(stream);

    async function deflate(bytes) {
        return new Uint8Array(await new Response(through(bytes, new CompressionStream("deflate-raw"))).arrayBuffer());
    }

    /* Throws if they are damaged, or more than so many, and then they are not unpacked. */
    async function inflate(bytes, most) {
        const reader = through(bytes, new DecompressionStream("deflate-raw")).getReader(), chunks = [];
        for (let size = 0, next; !(next = await reader.read()).done; chunks.push(next.value))
            if ((size += next.value.length) > most) {
                reader.cancel();
                throw "more than " + most + " bytes";
            }
        return new Uint8Array(await new Blob(chunks).arrayBuffer());
    }

    /* Throws if they are not in UTF-8. */
    const decoded = bytes => new TextDecoder("utf-8", {fatal: true}).decode(bytes);

    /* The texts of those files whose name() is not null, by these names. Throws what is wrong. */
    async function decode(buffer, name, most) {
        const bytes = new Uint8Array(buffer), view = new DataView(buffer), texts = new Map();
        const short = at => view.getUint16(at, true), long = at => view.getUint32(at, true);
        let end = bytes.length - 22;
        while (end >= 0 && long(end) !== 0x06054b50)
            end--;
        if (end < 0)
            throw "no ZIP archive";
        for (let at = long(end + 16), left = short(end + 10); left > 0; left--) {
            const to = at + 46 + short(at + 28), known = name(new TextDecoder().decode(bytes.subarray(at + 46, to)));
            if (known !== null) {
                const method = short(at + 10), start = long(at + 42);
                const from = start + 30 + short(start + 26) + short(start + 28), packed = bytes.subarray(from, from + long(at + 20));
                if (method && method !== 8)
                    throw known + ": is neither stored nor deflated";
                if (!method && packed.length > most)
                    throw known + ": more than " + most + " bytes";
                const unpacked = method ? await inflate(packed, most) : packed;
                if (Png.crc(unpacked) !== long(at + 16))
                    throw known + ": is damaged";
                texts.set(known, decoded(unpacked));
            }
            at = to + short(at + 30) + short(at + 32);
        }
        return texts;
    }

    return {encode, decode, deflate, inflate, decoded};
})();
