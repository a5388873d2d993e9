"use strict";
/* Of a mistake that has a line: at which pixel, in which line and with which value it shows first, and pictures of that value, the
 * student's and the right one. What is right is the student's text with the change that was named, if that draws what is expected. */
const Wrong = (() => {
    const NEAR = 2; /* steps of 1/255 */
    const {element} = Controls;

    /* The pixel that is farthest from what is expected. */
    function farthest(drawn, expected, difference) {
        let most = 0, at = -1;
        for (let i = 0; i < drawn.data.length; i += 4)
            for (let c = i; c < i + 3; c++)
                if (difference.data[c] && Math.abs(drawn.data[c] - expected.data[c]) > most)
                    [most, at] = [Math.abs(drawn.data[c] - expected.data[c]), i / 4];
        return at < 0 ? null : [at % drawn.width, Math.floor(at / drawn.width)];
    }

    /* The texts with the mistake's change; null: it has none. */
    function changed(texts, {file, line, column, text, change}) {
        if (!line)
            return null;
        const lines = texts.get(file).split("\n"), start = lines.slice(0, line - 1).join("\n").length + (line > 1) + column - 1;
        return new Map(texts).set(file, texts.get(file).slice(0, start) + change + texts.get(file).slice(start + text.length));
    }

    const apart = (a, b) => Math.max(...a.slice(0, 3).map((x, i) => 255 * Math.abs(Math.min(1, Math.max(0, x)) - Math.min(1, Math.max(0, b[i])))));
    const differ = (a, b) => a.some((x, i) => Math.abs(x - b[i]) > 1e-4 * Math.max(1, Math.abs(b[i])));
    const text = numbers => numbers.map(x => x === null ? "no number" : String(+x.toPrecision(4))).join(", ");

    /* The first value that is another one: of a varying, else of an assignment, of the same name and as often assigned before. */
    function first(own, right) {
        for (const name of Object.keys(own.vertices[0]).filter(name => !["vertex", "weight", "gl_Position"].includes(name)))
            for (const [i, corner] of own.vertices.entries())
                if (right.vertices[i][name] && differ(corner[name], right.vertices[i][name]))
                    return {name, place: "of the vertex shader", own: corner[name], right: right.vertices[i][name]};
        const seen = new Map();
        for (const {name, place, driver} of own.assignments) {
            const before = seen.get(name) || 0, other = right.assignments.filter(assigned => assigned.name === name)[before];
            seen.set(name, before + 1);
            if (other && differ(driver, other.driver))
                return {name, place, own: driver, right: other.driver};
        }
        return null;
    }

    async function picture(task, name, title) {
        const shown = await Pixel.ask("show", [name], task), canvas = element("canvas", {role: "img", "aria-label": title + " of " + name});
        if (!shown.picture)
            throw shown.message;
        Controls.paint(canvas, shown.picture);
        return element("figure", {}, canvas, element("figcaption", {}, title, element("small", {}, shown.text)));
    }

    /* Nodes that say it; none where nothing is known. `task(texts)` is what the worker draws. */
    async function explain(mistakes, texts, pictures, task) {
        const pixel = farthest(...pictures);
        if (!pixel)
            return [];
        const probe = async changed => JSON.parse((await Pixel.ask("probe", pixel, task(changed))).text || "null");
        const own = await probe(texts);
        if (!own?.exact_picture)
            return [];
        const where = `Column ${pixel[0]}, row ${pixel[1]}: `;
        /* Of two mistakes the later one is changed first, so that places stay. */
        const all = [...mistakes].sort((a, b) => b.line - a.line || b.column - a.column);
        const mended = all.reduce((done, mistake) => done && changed(done, mistake), texts);
        if (mended) {
            const right = await probe(mended), value = right?.assignments && own.assignments && first(own, right);
            if (value && apart(right.computed, right.exact_picture) <= NEAR) {
                const said = `${where}${value.place}: ${value.name} is ${text(value.own)}; in a right program it is ${text(value.right)}.`;
                return [element("p", {class: "first"}, said), element("div", {class: "pictures"},
                    await picture(task(texts), value.name, "Yours"), await picture(task(mended), value.name, "Right"))];
            }
        }
        return [element("p", {class: "first"}, `${where}it is ${own.drawn.map(x => Math.round(255 * x)).join(", ")}; ` +
                        `right is ${own.exact_picture.map(x => Math.round(255 * Math.min(1, Math.max(0, x)))).join(", ")}.`)];
    }

    return {explain};
})();
