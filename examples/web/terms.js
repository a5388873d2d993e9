"use strict";
/* The chapter's formulas with the numbers of the pixel that is explained. Below a formula stands what its data-at says: {NAME} is a term of
 * the lighting equation, named as in the book, or a variable of the shader; {NAME=} the line that assigns it; [...] is left out, and so
 * is the whole, where a name is not known; S(...) is added up over all lights or corners; after | is what else may be said. */
const Terms = (() => {
    const number = x => String(+x.toPrecision(3)).replace("-", "−");
    const grey = color => color.every(x => x === color[0]) ? [color[0]] : color;
    const put = value => typeof value === "string" ? value : value.length > 1 ? "(" + value.slice(0, 3).map(number).join(", ") + ")" :
        value[0] < 0 ? "(" + number(value[0]) + ")" : number(value[0]);
    const minus = (a, b) => a.map((x, i) => x - b[i]);

    /* What assigns in the shaders: {name: numbers, "name=": text} of the pixel, and of each corner. */
    function variables(said) {
        const all = {};
        for (const {name, driver, filled} of said.assignments || []) {
            all[name] = driver;
            if (filled?.startsWith("= "))
                all[name + "="] ||= filled.slice(2) + " = " + put(driver);
        }
        const corners = (said.vertices || []).map(({vertex, weight, ...values}) => ({label: "corner " + vertex, values: {...values, w: [weight]}}));
        const places = corners.map(({values}) => values.v_Position || values.position);
        if (places.length && places.every(place => place)) {
            const [A, B, C] = places, [u, v] = [minus(B, A), minus(C, A)];
            const cross = u.map((_, i) => u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]), size = Math.hypot(...cross);
            Object.assign(all, {A, B, C, ABC: cross.map(x => x / size)});
        }
        return {all, corners};
    }

    /* Of the exact picture: the names of the whole, and of each light. */
    function equation(said, all) {
        const {emission, sum, "global ambient": whole, lights: told = []} = said.terms || {};
        if (emission)
            all.e = grey(emission);
        if (whole)
            Object.assign(all, {g: grey(whole.light), k_g: grey(whole.material)});
        if (sum)
            all.I = grey(sum);
        const lights = told.map(light => {
            const values = light.share === 1 ? {} : {t: [light.share]}, cosine = ["R.V", "N.H"].find(name => name in light);
            for (const of of light.hidden ? ["ambient"] : ["ambient", "diffuse", "specular"])
                if (light[of])
                    Object.assign(values, {["i_" + of[0]]: grey(light[of].light), ["k_" + of[0]]: grey(light[of].material), ["I_" + of[0]]: grey(light[of].term)});
            if (values.i_d)
                values["N·L"] = [light["N.L"]];
            if (values.i_s)
                Object.assign(values, {[cosine.replace(".", "·")]: [light[cosine]], h: [light[cosine]], α: [light.exponent], f: [light["N.L"] > 0 ? 1 : 0]});
            return {label: "light " + light.light, values};
        });
        for (const {name, vector} of said.directions || [])
            if (/\d/.test(name))
                Object.assign(lights.find(({label}) => label === "light " + name.slice(1))?.values || {}, {[name[0]]: vector});
            else
                all[name] = vector;
        if (all.I)
            all.bytes = [all.I, all.I, all.I].map((I, i) => Math.round(255 * Math.min(1, Math.max(0, I[i] ?? I[0])))).join(", ");
        return lights;
    }

    /* The text, or null where something is not known. */
    function fill(text, values, scopes) {
        let known = true;
        const sums = text.replace(/S\(((?:[^()]|\([^()]*\))*)\)/g, (_, inner) => {
            const parts = scopes.map(some => some.map(scope => fill(inner, {...values, ...scope.values}, [])).filter(part => part).map(tidy))
                .find(some => some.length);
            known = known && !!parts;
            return parts ? parts.join(" + ") : "";
        });
        const options = sums.replace(/\[([^[\]]*)\]/g, (_, inner) => fill(inner, values, scopes) ?? "");
        const filled = options.replace(/\{(.*?)\}/g, (_, name) => {
            known = known && name in values;
            return known ? put(values[name]) : "";
        });
        return known && /[^ ()·+]/.test(filled) ? filled : null;
    }

    /* Without what is left of an addition of nothing. */
    const tidy = text => text.replace(/ \+ (?=\)|$|=)/g, " ").replace(/ +/g, " ").replace(/ (?=\)|$)|^ /g, "");

    /* Lines of the first of the ways to say it that is known: of the pixel, else of lights, else of corners; equal ones once. */
    function lines(text, values, scopes) {
        for (const way of text.split(" | ")) {
            const whole = fill(way, values, scopes);
            if (whole)
                return [tidy(whole)];
            for (const some of scopes) {
                const said = new Map();
                for (const {label, values: more} of some) {
                    const filled = fill(way, {...values, ...more}, []);
                    if (filled)
                        said.set(tidy(filled), [...said.get(tidy(filled)) || [], label]);
                }
                if (said.size)
                    return [...said].map(([filled, labels]) => (labels.length < some.length || said.size > 1 ? labels.join(", ") + ": " : "") + filled);
            }
        }
        return [];
    }

    /* x_d with its index, x^2 with its exponent. */
    const marked = text => text.split(/(\^\S+|\b[A-Za-z]_[a-z0-9]\b)/).flatMap((part, i) => i % 2 === 0 ? [part] : part[0] === "^" ?
        [Controls.element("sup", {}, part.slice(1))] : [part[0], Controls.element("sub", {}, part.slice(2))]);

    /* `said`: as --probe tells of it; null: of no pixel any more. `where`: the figure. */
    function show(said, where) {
        const {all, corners} = variables(said || {}), lights = equation(said || {}, all);
        const caption = where?.querySelector("strong")?.textContent.replace(/\.$/, "");
        for (const part of document.querySelectorAll("[data-at]")) {
            const found = lines(part.dataset.at, all, [lights, corners]);
            part.hidden = !found.length;
            part.replaceChildren(Controls.element("small", {}, `${caption}, pixel ${said?.column}, ${said?.row}:`),
                                 ...found.map(line => Controls.element("span", {}, ...marked(line))));
            if (found.length)
                repeat(part);
        }
    }

    /* The formula and its numbers once more, beside the figure, where one looks. */
    function repeat(part) {
        const copy = part.cloneNode(true);
        copy.removeAttribute("data-at");
        copy.firstChild.remove();
        document.querySelector("#pixel-said .swatches")?.before(part.previousElementSibling.cloneNode(true), copy);
    }

    document.addEventListener("explained", ({target, detail}) => show(detail, target.closest?.("figure")));
    return {show, lines};
})();
