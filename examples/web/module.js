"use strict";
/* The compiled programs. lighting.js, which the build makes, has LIGHTING_WASM, gzip in base64, and lightingFactory(),
 * which returns Emscripten's createLighting. This file's functions also run in a worker, as their own text. */

/* Instances of the module share what is compiled. */
async function compileLighting() {
    const packed = Uint8Array.from(atob(LIGHTING_WASM), letter => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/* A worker that has Engine and runs a function. From a file none is allowed without a server, from a text one is. */
function startWorker(work) {
    const text = ['"use strict";', lightingFactory, Engine, "(" + work + ")();"].join("\n");
    const address = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
    const worker = new Worker(address);
    URL.revokeObjectURL(address);
    return worker;
}

/* One instance: examples/web/page.h in JavaScript. `canvas` gets the WebGL context, and is never shown. */
class Engine {
    static async open(compiled, canvas) {
        const engine = new Engine();
        Engine.drawColourless();
        engine.lines = [];
        /* Emscripten waits for done() for ever. */
        engine.module = await new Promise((resolve, reject) => lightingFactory()({
            canvas,
            print: line => engine.lines.push(line),
            printErr: line => engine.lines.push(line),
            instantiateWasm(imports, done) {
                WebAssembly.instantiate(compiled, imports).then(instance => done(instance)).catch(reject);
                return {};
            },
        }).then(resolve, reject));
        return engine;
    }

    /* A fragment shader that sets no colour draws whatever there is; WebGL fails instead. It draws nothing visible here. */
    static drawColourless() {
        const context = self.WebGL2RenderingContext && WebGL2RenderingContext.prototype;
        if (!context || Engine.source)
            return;
        const source = Engine.source = context.shaderSource;
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

    explain() {
        this.lines = [];
        const done = this.module.ccall("page_explain", "number", [], []) === 1;
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

    close() { this.module.ccall("page_close", null, [], []); }
}
