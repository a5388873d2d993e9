"use strict";
/* The chapter's formulas with the numbers of the pixel that is explained. Below a formula stands what its data-at says: {NAME} is a term of
 * the lighting equation, named as in the book, or a variable of the shader; {NAME=} the line that assigns it; [...] is left out, and so
 * is the whole, where a name is not known; S(...) is added up over all lights or corners; after | is what else may be said. */
const Terms = (() => {
    const TERM = /^ *(global )?(ambient|diffuse|specular): \((.*?)\) \* \((.*?)\)(?: \* N\.L (\S+)| \* \((R\.V|N\.H) (\S+)\)\^([^\s,]+)(, behind)?.*?)? = (.*)$/;
    const list = text => text.split(", ").map(Number);
    const number = x => String(+x.toPrecision(3)).replace("-", "−");
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
        const lights = [];
        for (const row of (said.equation || "").split("\n")) {
            const light = /^light (\d+), (\S+) of it arrives(; in shadow)?/.exec(row), term = TERM.exec(row), other = /^(emission|sum): ([^, ]+(?:, [-\d][^, ]*)*)/.exec(row);
            if (light)
                lights.push({label: "light " + light[1], hidden: light[3], values: light[2] === "1" ? {} : {t: [Number(light[2])]}});
            if (other)
                all[other[1] === "sum" ? "I" : "e"] = list(other[2]);
            if (!term)
                continue;
            const [, whole, kind, i, k, cosine, name, power, exponent, behind, sum] = term, of = kind[0], {hidden, values} = lights.at(-1) || {};
            if (whole)
                Object.assign(all, {g: list(i), k_g: list(k)});
            else if (of === "a" || !hidden) {
                Object.assign(values, {["i_" + of]: list(i), ["k_" + of]: list(k), ["I_" + of]: list(sum)});
                if (cosine)
                    values["N·L"] = [Number(cosine)];
                if (name)
                    Object.assign(values, {[name.replace(".", "·")]: [Number(power)], h: [Number(power)], α: [Number(exponent)], f: [behind ? 0 : 1]});
            }
        }
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
