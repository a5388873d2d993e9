"use strict";
/* The compiled programs. lighting.js, which the build makes, has LIGHTING: `packed`, LZMA in base64, `size`, how long that is
 * unpacked, and factory(), which returns Emscripten's createLighting; probe.js has PROBE likewise. This file's functions also
 * run in a worker, as their own text. */

/* The decoder of LZMA (Igor Pavlov's specification, lc = 3, lp = pb = 0): a seventh smaller than gzip, which browsers have. */
class Lzma {
    constructor(packed, size) {
        Object.assign(this, {packed, at: 5, range: -1 >>> 0, code: 0, out: new Uint8Array(size)});
        for (let i = 1; i < 5; i++)
            this.code = (this.code << 8 | packed[i]) >>> 0;
    }

    static bits(count) { return new Uint16Array(count).fill(1024); }

    normalize() {
        if (this.range < 0x1000000) {
            this.range = this.range * 256 >>> 0;
            this.code = (this.code * 256 | this.packed[this.at++]) >>> 0;
        }
    }

    bit(model, i) {
        const bound = (this.range >>> 11) * model[i], one = this.code >= bound;
        if (one) {
            this.range -= bound;
            this.code -= bound;
            model[i] -= model[i] >>> 5;
        } else {
            this.range = bound;
            model[i] += 2048 - model[i] >>> 5;
        }
        this.normalize();
        return +one;
    }

    tree(model, count, from = 0) {
        let m = 1;
        for (let i = 0; i < count; i++)
            m = m << 1 | this.bit(model, from + m);
        return m - (1 << count);
    }

    /* The lowest bit first. */
    reversed(model, count, from = 0) {
        let m = 1, value = 0;
        for (let i = 0; i < count; i++) {
            const bit = this.bit(model, from + m);
            m = m << 1 | bit;
            value |= bit << i;
        }
        return value;
    }

    direct(count) {
        let value = 0;
        for (let i = 0; i < count; i++) {
            this.range >>>= 1;
            const one = this.code >= this.range;
            if (one)
                this.code -= this.range;
            this.normalize();
            value = value << 1 | +one;
        }
        return value;
    }

    static lengths() { return {choice: Lzma.bits(2), low: Lzma.bits(8), middle: Lzma.bits(8), high: Lzma.bits(256)}; }

    length(model) {
        if (!this.bit(model.choice, 0))
            return 2 + this.tree(model.low, 3);
        return this.bit(model.choice, 1) ? 18 + this.tree(model.high, 8) : 10 + this.tree(model.middle, 3);
    }

    distance(models, length) {
        const slot = this.tree(models.slots, 6, 64 * Math.min(length - 2, 3)), low = (slot >> 1) - 1;
        if (slot < 4)
            return slot;
        const base = (2 | slot & 1) << low;
        return slot < 14 ? base + this.reversed(models.near, low, base - slot)
            : base + 16 * this.direct(low - 4) + this.reversed(models.align, 4);
    }

    literal(model, at, state, distance) {
        const {out} = this, from = 0x300 * ((at && out[at - 1]) >> 5);
        let symbol = 1;
        for (let match = out[at - distance - 1], same = state >= 7; symbol < 256;) {
            const bit = match >> 7 & 1, one = this.bit(model, from + (same ? 256 * (1 + bit) : 0) + symbol);
            symbol = symbol << 1 | one;
            match <<= 1;
            same = same && one === bit;
        }
        out[at] = symbol;
    }

    unpack() {
        const {bits} = Lzma, literals = bits(0x300 * 8), match = bits(12), rep = bits(12), rep0 = bits(12), rep1 = bits(12);
        const rep2 = bits(12), long0 = bits(12), lengths = Lzma.lengths(), repeated = Lzma.lengths();
        const models = {slots: bits(256), near: bits(128), align: bits(16)}, {out} = this;
        let recent = [0, 0, 0, 0], state = 0;
        for (let at = 0; at < out.length;) {
            if (!this.bit(match, state)) {
                this.literal(literals, at++, state, recent[0]);
                state -= state < 4 ? state : state < 10 ? 3 : 6;
                continue;
            }
            let length = 1;
            if (!this.bit(rep, state)) {
                length = this.length(lengths);
                recent = [this.distance(models, length), ...recent.slice(0, 3)];
                state = state < 7 ? 7 : 10;
            } else {
                const which = !this.bit(rep0, state) ? 0 : !this.bit(rep1, state) ? 1 : 2 + this.bit(rep2, state);
                const short = which === 0 && !this.bit(long0, state);
                recent.unshift(...recent.splice(which, 1));
                length = short ? 1 : this.length(repeated);
                state = state < 7 ? (short ? 9 : 8) : 11;
            }
            for (let i = 0; i < length; i++, at++)
                out[at] = out[at - recent[0] - 1];
        }
        return out;
    }
}

/* Instances of the module share what is compiled. */
function compileLighting(module = programModule()) {
    return WebAssembly.compile(unpack(module));
}

function unpack({packed, size}) {
    return new Lzma(Uint8Array.from(atob(packed), letter => letter.charCodeAt(0)), size).unpack();
}

/* In one file PROBE does the work of both, and for files that were opened what reads them, `now`. */
function programModule() { return programModule.now || (typeof LIGHTING === "undefined" ? PROBE : LIGHTING); }

function loadScript(name) {
    return new Promise((resolve, reject) => {
        const made = document.createElement("script");
        made.src = name;
        made.onload = resolve;
        made.onerror = () => reject(name + ": is not beside this page");
        document.head.append(made);
    });
}

/* A worker that has Engine and runs a function. From a file none is allowed without a server, from a text one is. */
function startWorker(work, module = programModule()) {
    const text = ['"use strict";', "const LIGHTING = {factory: " + module.factory + "};", programModule, Engine,
                  "(" + work + ")();"].join("\n");
    const address = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
    const worker = new Worker(address);
    URL.revokeObjectURL(address);
    return worker;
}

/* One instance: examples/web/page.h in JavaScript. `canvas` gets the WebGL context, and is never shown. `compiled` may be
 * {module, files, answer}, of files.js. */
class Engine {
    static async open(compiled, canvas) {
        const engine = new Engine(), {module = compiled, files, answer} = compiled;
        Engine.drawColourless();
        engine.lines = [];
        /* Emscripten waits for done() for ever. */
        engine.module = await new Promise((resolve, reject) => programModule().factory()({
            canvas,
            print: line => engine.lines.push(line),
            printErr: line => engine.lines.push(line),
            instantiateWasm(imports, done) {
                WebAssembly.instantiate(module, imports).then(instance => done(instance)).catch(reject);
                return {};
            },
        }).then(resolve, reject));
        if (files)
            await engine.lay(files, answer);
        return engine;
    }

    /* Where the module looks for files, and what their reader answers (process_web.c). */
    async lay(files, answer) {
        const {FS} = this.module, bytes = async blob => new Uint8Array(await blob.arrayBuffer());
        FS.mkdir("/files");
        FS.chdir("/files");
        for (const {name, blob} of files) {
            FS.mkdirTree("/files/" + name.split("/").slice(0, -1).join("/"));
            FS.writeFile("/files/" + name, await bytes(blob));
        }
        FS.writeFile("/answer", await bytes(answer));
    }

    /* The context keeps the sources, vertex shader's first, of the last program with which it drew by lighting.vert. */
    static watchPrograms(context) {
        const {attachShader, useProgram} = context;
        context.attachShader = function (program, shader) {
            (program.sources ||= []).push(this.getShaderSource(shader));
            attachShader.call(this, program, shader);
        };
        context.useProgram = function (program) {
            if (program?.sources?.[0].includes("// lighting.vert:"))
                this.lighting = program.sources;
            useProgram.call(this, program);
        };
    }

    get lighting() { return this.module.canvas.getContext("webgl2")?.lighting || []; }

    /* A fragment shader that sets no colour draws whatever there is; WebGL fails instead. It draws nothing visible here. */
    static drawColourless() {
        const context = self.WebGL2RenderingContext && WebGL2RenderingContext.prototype;
        if (!context || Engine.source)
            return;
        const source = Engine.source = context.shaderSource;
        Engine.watchPrograms(context);
        context.shaderSource = function (shader, text) {
            const words = text.replace(/\/\/.*|\/\*[^]*?\*\//g, " ");
            const colourless = /\bmain\b/.test(words) && !/\bgl_Frag(Color|Data)\b/.test(words);
            source.call(this, shader, colourless && this.getShaderParameter(shader, this.SHADER_TYPE) === this.FRAGMENT_SHADER ?
                text.replace(/\bmain\b/g, "page_main") + "\nvoid main() { page_main(); gl_FragColor = vec4(0); }" : text);
        };
    }

    text(name, ...values) { return this.module.ccall("page_" + name, "string", values.map(() => "string"), values); }
    json(name) { return JSON.parse(this.text(name) || "null"); }
    get message() { return this.text("message"); }

    /* A name and its arguments; 0, 1 or 2. */
    run(lines) { return this.module.ccall("page_open", "number", ["string"], [lines.join("\n")]); }

    draw(seconds, orbit) {
        return this.module._page_draw(seconds, ...orbit) === 1;
    }

    /* A copy of the last picture. */
    picture() {
        const call = name => this.module.ccall("page_" + name, "number", [], []);
        const width = call("width"), height = call("height"), start = call("pixels");
        const bytes = this.module.HEAPU8.slice(start, start + 4 * width * height);
        return new ImageData(new Uint8ClampedArray(bytes.buffer), width, height);
    }

    explain(receipts = false) {
        this.lines = [];
        const done = this.module.ccall("page_explain", "number", ["number"], [+receipts]) === 1;
        return done ? this.lines.join("\n") : this.message;
    }

    /* Replaces shader files by a Map of texts; an empty one restores them. False if one is too long, and then none is
     * replaced. */
    replace(texts) {
        const longest = 1000000; /* is refused; texts go over the module's stack */
        const files = [...texts].map(([name, text]) => [name, new TextEncoder().encode(text)]);
        const put = ([name, bytes]) => this.module.ccall("page_replace", "number", ["string", "array", "number"],
                                                         [name, bytes.subarray(0, longest), bytes.length]) === 1;
        const long = files.find(([, bytes]) => bytes.length >= longest);
        if (long)
            return put(long);
        return files.length ? files.every(put) : put(["", new Uint8Array()]);
    }

    /* A file of a lab that is not the module's. */
    putLab(path, text) { return this.module.ccall("page_own", "number", ["string", "string"], [path, text]) === 1; }

    close() { this.module.ccall("page_close", null, [], []); }
}
