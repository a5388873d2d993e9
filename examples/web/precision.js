"use strict";
/* What this device's fragment shaders compute with: what the driver says, and what a shader finds. */
const Precision = (() => {
    const VERTEX = "attribute vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }";
    /* Numbers come in as uniforms, and sums go through min or max, so that a compiler knows nothing and simplifies nothing.
     * Red: how many halves can be added to 1 and seen; green: how often 1 can be doubled; blue: how often halved. */
    const fragment = name => `precision ${name} float;
        uniform ${name} float one, half_;
        void main() {
            float bits = 0.0, up = 0.0, down = 0.0, part = one, large = one, small = one;
            for (int i = 0; i < 200; i++) {
                part *= half_;
                float sum = max(one + part, half_);
                if (sum > one && bits == float(i)) bits += 1.0;
            }
            for (int i = 0; i < 200; i++) {
                float next = min(large / half_, 1e38);
                if (next > large && next < next * 1.5) { large = next; up += 1.0; }
                float less = min(small * half_, one);
                if (less > 0.0 && less < small) { small = less; down += 1.0; }
            }
            gl_FragColor = vec4(bits, up, down, 255.0) / 255.0;
        }`;

    function shader(gl, kind, text) {
        const made = gl.createShader(kind);
        gl.shaderSource(made, text);
        gl.compileShader(made);
        return made;
    }

    function measure(gl, name) {
        const program = gl.createProgram();
        gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, VERTEX));
        gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, fragment(name)));
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            return null;
        gl.useProgram(program);
        gl.uniform1f(gl.getUniformLocation(program, "one"), 1);
        gl.uniform1f(gl.getUniformLocation(program, "half_"), 0.5);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
        const at = gl.getAttribLocation(program, "at");
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, 2, gl.FLOAT, false, 0, 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        const pixel = new Uint8Array(4);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return pixel;
    }

    const rendererOf = gl => {
        const info = gl.getExtension("WEBGL_debug_renderer_info");
        return String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    };

    function withContext(use) {
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = 1;
        const gl = canvas.getContext("webgl"), answer = gl && use(gl, rendererOf(gl));
        gl?.getExtension("WEBGL_lose_context")?.loseContext();
        return answer;
    }

    /* As --arithmetic reads it: "highp=24,-126,127;mediump=11,-14,15,kept". Some have no highp. */
    const numbers = gl => ["highp", "mediump"].map(name => {
        const [bits, most, least] = measure(gl, name) || measure(gl, "mediump");
        return name + "=" + [bits + 1, 1 - most, most, ...least > most - 1 ? ["kept"] : []].join();
    }).join(";");

    /* Of Mesa's llvmpipe the functions are known, too. null: no WebGL. */
    const measured = () => withContext((gl, renderer) => (/llvmpipe/.test(renderer) ? "llvmpipe;" : "") + numbers(gl));

    /* As --arithmetic names it: Mesa's by its name, others as they are measured. */
    const device = () => withContext((gl, renderer) =>
        /llvmpipe/.test(renderer) ? (/256 bits/.test(renderer) ? "llvmpipe" : "llvmpipe-128") :
            /softpipe/.test(renderer) ? "softpipe" : numbers(gl)) || "softpipe";

    function row(tag, cells) {
        const made = document.createElement("tr");
        for (const text of cells) {
            const cell = document.createElement(tag);
            cell.textContent = text;
            made.append(cell);
        }
        return made;
    }

    const fill = table => withContext((gl, renderer) => {
        table.append(row("th", ["precision", "bits of the significand, said", "found", "smallest power of 2, found", "largest power of 2, found"]));
        for (const name of ["highp", "mediump", "lowp"]) {
            const said = gl.getShaderPrecisionFormat(gl.FRAGMENT_SHADER, gl[{highp: "HIGH", mediump: "MEDIUM", lowp: "LOW"}[name] + "_FLOAT"]);
            const found = measure(gl, name);
            table.append(row("td", found ? [name, said.precision + 1, found[0] + 1, "2^−" + found[2], "2^" + found[1]] :
                [name, said.precision + 1, "no such shader here", "", ""]));
        }
        table.append(row("td", ["drawn by", renderer]));
        table.lastChild.lastChild.colSpan = 4;
    });

    const table = document.querySelector("figure table.precision");
    if (table)
        fill(table);
    return {device, measured, fill};
})();
