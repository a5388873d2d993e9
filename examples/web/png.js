"use strict";
/* PNG files (ISO/IEC 15948): a canvas would multiply colours by alpha. */
const Png = (() => {
    const table = Uint32Array.from({length: 256}, (_, n) => {
        for (let k = 0; k < 8; k++)
            n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
        return n;
    });

    function crc(bytes) {
        let c = 0xffffffff;
        for (const byte of bytes)
            c = table[(c ^ byte) & 255] ^ (c >>> 8);
        return ~c >>> 0;
    }

    function chunk(name, data) {
        const bytes = new Uint8Array(12 + data.length), view = new DataView(bytes.buffer);
        view.setUint32(0, data.length);
        bytes.set(new TextEncoder().encode(name), 4);
        bytes.set(data, 8);
        view.setUint32(8 + data.length, crc(bytes.subarray(4, 8 + data.length)));
        return bytes;
    }

    function header(picture, channels) {
        const data = new Uint8Array(13), view = new DataView(data.buffer);
        view.setUint32(0, picture.width);
        view.setUint32(4, picture.height);
        data.set([8, channels === 4 ? 6 : 2, 0, 0, 0], 8);
        return chunk("IHDR", data);
    }

    /* Rows of bytes, each after filter type 0. */
    function rows({width, height, data}, channels) {
        const bytes = new Uint8Array(height * (1 + channels * width));
        for (let y = 0, to = 0, from = 0; y < height; y++) {
            to++;
            for (let x = 0; x < width; x++, from += 4)
                for (let c = 0; c < channels; c++)
                    bytes[to++] = data[from + c];
        }
        return bytes;
    }

    /* `texts`: keys and texts that the file keeps. */
    async function encode(picture, alpha, texts) {
        const channels = alpha ? 4 : 3;
        const stream = new Blob([rows(picture, channels)]).stream().pipeThrough(new CompressionStream("deflate"));
        const packed = new Uint8Array(await new Response(stream).arrayBuffer());
        const kept = Object.entries(texts).map(([key, text]) =>
            chunk("iTXt", new TextEncoder().encode(key + "\0\0\0\0\0" + text)));
        return new Blob([Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10), header(picture, channels), ...kept,
                         chunk("IDAT", packed), chunk("IEND", new Uint8Array(0))], {type: "image/png"});
    }

    return {encode, crc};
})();
