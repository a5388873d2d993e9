"use strict";
/* Why a pixel has its colour: what --probe tells of it, the directions of light over the picture, and what --show draws. All is
 * computed in a worker with a module of its own, from the texts and options that the page draws now. */
const Pixel = (() => {
    const {element} = Controls;
    const part = id => document.getElementById(id);
    const STILL = 150; /* ms without another picture */
    let of = null; /* the picture with the pixel that is explained */
    let worker = null, compiled = null, drawn = null, device = "", timer = 0, count = 0;
    let asked = null, next = null; /* pixels of the line */
    let open = null, said = null, shown = ""; /* the pixel that is explained, and how; the value that is shown */
    let layers = null, section = null;
    const DEVICES = ["llvmpipe", "llvmpipe-128", "softpipe", "nvidia", "half", "float"]; /* as --arithmetic names them */
    const COMPUTED = "computed"; /* of the values: the picture itself */
    const AS = new URLSearchParams(location.search).get("as"); /* the device of the page's address */
    const waiting = new Map();

    function work() {
        let ready = null, drawn = "";
        async function draw({compiled, task, device}) {
            const engine = await (ready ||= Engine.open(compiled, new OffscreenCanvas(1, 1)));
            const key = JSON.stringify([device, task.lines, task.seconds, [...task.texts]]);
            if (key === drawn)
                return engine;
            drawn = "";
            const capture = () => engine.module.ccall("page_capture", "number", ["string", "number"], [device, task.seconds || 0]) === 1;
            if (task.own && !engine.own)
                engine.own = Object.entries(task.own).every(([name, text]) => engine.putLab(task.lines[0] + "/" + name, text));
            /* A lab is open before it has texts. */
            const begun = task.lab ? engine.run(task.lines) === 0 && engine.replace(task.texts) :
                engine.replace(task.texts) && engine.run(task.lines) === 0;
            if (!begun || !capture())
                throw engine.message;
            drawn = key;
            return engine;
        }
        self.onmessage = async ({data}) => {
            try {
                const engine = await draw(data), {id, what, values} = data;
                const text = what === "probe" ? engine.module.ccall("page_probe", "string", ["number", "number"], values) :
                    engine.text(what, ...values);
                if (!text && engine.message)
                    throw engine.message;
                self.postMessage({id, text, picture: what === "show" ? engine.picture() : null});
            } catch (error) {
                self.postMessage({id: data.id, message: String(error)});
            }
        };
    }

    /* {text, picture} or {message}. */
    async function ask(what, values, task = of.task(), from = of) {
        const [used, source] = from?.module?.() || [await (compiled ||= compileLighting(PROBE)), PROBE];
        device ||= AS || Precision.device();
        const data = {id: ++count, compiled: used, task, device, what, values};
        if (drawn !== used) {
            worker?.terminate();
            waiting.clear();
            worker = null;
            drawn = used;
        }
        if (!worker) {
            worker = startWorker(work, source);
            worker.onmessage = ({data}) => { waiting.get(data.id)(data); waiting.delete(data.id); };
        }
        return new Promise(resolve => { waiting.set(data.id, resolve); worker.postMessage(data); });
    }

    /* What the page has not until now: layers over the picture, a legend, and the part that explains. */
    function make() {
        document.head.append(...document.querySelector("style") ? [] : [element("link", {rel: "stylesheet", href: "pixel.css"})]);
        layers = [element("canvas", {id: "shown", hidden: true, "aria-hidden": "true"}), svg("svg", {id: "directions", "aria-hidden": "true"}),
                  element("p", {id: "legend", role: "status"})];
        const close_ = element("button", {type: "button"}, "Close"), values = element("select", {id: "pixel-values"});
        const as = element("input", {id: "pixel-as", list: "devices", title: "A device, or what the page of a device's arithmetic says of it"});
        section = element("section", {id: "pixel", "aria-labelledby": "pixel-title", hidden: true},
            element("div", {class: "row"}, element("h2", {id: "pixel-title", tabindex: -1}), close_),
            element("div", {class: "row"}, element("label", {}, "Over the whole picture ", values),
                    element("label", {}, "As computed by ", as), element("datalist", {id: "devices"},
                            ...DEVICES.map(value => element("option", {value})))),
            element("div", {id: "pixel-said"}));
        close_.addEventListener("click", close);
        values.addEventListener("change", () => show(values.value));
        as.addEventListener("change", () => { device = as.value.trim() || Precision.device(); renew(of); });
    }

    /* This picture's, from now on. */
    function begin(page) {
        if (of === page)
            return;
        section || make();
        if (of)
            close(false);
        of = page;
        const [shown, directions, legend] = layers;
        of.canvas.parentNode.append(shown, directions);
        of.line.after(legend);
        of.put(section);
        part("pixel-values").replaceChildren();
    }

    const number = x => x === null ? "no number" : String(+x.toPrecision(7));
    const numbers = list => list.map(number).join(", ");
    const steps = list => list.slice(0, 3).map(x => (255 * Math.min(1, Math.max(0, x))).toFixed(1)).join(", ");

    /* The line under a picture. One question at a time: what was pointed at meanwhile is asked last. */
    async function tell(page, at) {
        next = {page, at};
        if (asked)
            return;
        asked = next;
        const answer = await ask("probe", at, page.task(), page);
        if (asked === next)
            page.say(answer.text ? line(JSON.parse(answer.text)) : answer.message);
        const again = asked !== next;
        asked = null;
        if (again)
            tell(next.page, next.at);
    }

    function line(said) {
        const drawn = said.drawn.map(x => Math.round(255 * x)), exact = said.exact_picture || said.verdict?.against || said.exact;
        const start = said.column + "," + said.row + ": " + drawn.join(", ");
        if (!exact)
            return start + ", the background";
        const apart = Math.max(...drawn.map((x, i) => Math.abs(x - 255 * Math.min(1, Math.max(0, exact[i])))));
        return start + (said.object ? ", " + said.object : "") + "; exactly " + steps(exact) + "; " +
            apart.toFixed(1) + " steps of 1/255 apart";
    }

    const cells = (tag, ...list) => element("tr", {}, ...list.map(text => element(tag, tag === "th" ? {scope: "col"} : {}, text)));

    const wide = (name, table) => element("div", {class: "wide", tabindex: 0, role: "region", "aria-label": name}, table);

    /* The editor's line of "line 15" or "group.glsl:124". */
    function goTo(place, line) {
        const file = place.startsWith("line ") ? ".frag" : place.replace(/:\d+$/, "");
        const editor = of.editor?.();
        const name = editor?.names.find(name => file === ".frag" ? name.endsWith(file) : ("/" + name).endsWith("/" + file));
        if (!name || place.startsWith("file "))
            return place;
        const button = element("button", {type: "button", class: "place"}, place);
        button.addEventListener("click", () => editor.go({name, line}));
        return button;
    }

    function trail(said) {
        const body = element("tbody");
        let before = "";
        for (const {place, line, source, name, filled, driver, exact, steps} of said.assignments) {
            if (place !== before || filled)
                body.append(element("tr", {class: "ran"},
                    element("td", {colspan: 4}, ...place === before ? [] : [goTo(place, line), " ", element("code", {}, source)],
                            ...filled ? [element("small", {}, name + " " + filled)] : [])));
            before = place;
            const row = cells("td", name, numbers(driver), exact ? numbers(exact) : "the exact one goes another way",
                              exact ? String(+steps.toPrecision(3)) : "");
            row.classList.toggle("off", steps >= 0.5);
            body.append(row);
        }
        return wide("The lines that ran", element("table", {class: "trail"},
            element("thead", {}, cells("th", "Name", "Driver", "Exact", "Steps")), body));
    }

    function vertices(said) {
        const names = Object.keys(said.vertices[0]).filter(name => !["vertex", "weight"].includes(name));
        const rows = said.vertices.map(corner =>
            cells("td", corner.vertex, corner.weight.toFixed(6), ...names.map(name => numbers(corner[name]))));
        return wide("Vertices", element("table", {}, element("thead", {}, cells("th", "Vertex", "Weight", ...names)),
                                        element("tbody", {}, ...rows)));
    }

    function swatches(said) {
        const list = [["Drawn", said.drawn], ["As this device computes", said.computed], ["The same text, exactly", said.exact],
                      ["The exact picture", said.exact_picture]].filter(([, color]) => color);
        return element("ul", {class: "swatches"}, ...list.map(([name, color]) => {
            const square = element("span", {class: "swatch", "aria-hidden": "true"});
            square.style.background = "rgb(" + color.slice(0, 3).map(x => 255 * x).join() + ")";
            return element("li", {}, square, name + ": " + steps(color).replace(name === "Drawn" ? /\.0/g : "", ""));
        }));
    }

    function fill(said) {
        const heading = text => element("h3", {}, text);
        const list = [swatches(said)];
        const verdict = [said.verdict?.text, said.remarks.trim()].filter(text => text).join("\n");
        list.push(element("p", {class: "verdict"}, verdict));
        if (said.equation)
            list.push(heading("The lighting equation here"), element("pre", {tabindex: 0}, said.equation +
                said.directions.map(({name, vector}) => name + " = " + vector.map(x => x.toFixed(4)).join(", ")).join("\n")));
        if (said.assignments)
            list.push(heading("The lines that ran"), trail(said), heading("Its triangle"), vertices(said));
        part("pixel-said").replaceChildren(...list);
        part("pixel-title").textContent = "Pixel " + said.column + "," + said.row;
    }

    function svg(name, attributes, text = "") {
        const made = document.createElementNS("http://www.w3.org/2000/svg", name);
        for (const [key, value] of Object.entries(attributes))
            made.setAttribute(key, value);
        made.textContent = text;
        return made;
    }

    /* A cross at a pixel, and the directions from there. */
    function mark(at, directions = []) {
        const {width, height, clientWidth} = of.canvas, map = part("directions");
        map.setAttribute("viewBox", "0 0 " + width + " " + height);
        map.replaceChildren();
        if (!at)
            return;
        const [x, y] = [at[0] + 0.5, at[1] + 0.5], unit = width / (clientWidth || width), size = 7 * unit;
        const put = (d, kind) => map.append(svg("path", {d, class: "halo"}), svg("path", {d, class: kind}));
        put(`M${x - size} ${y}h${2 * size}M${x} ${y - size}v${2 * size}`, "cross");
        for (const {name, to: [u, v]} of directions) {
            put(`M${x} ${y}L${u} ${v}`, "direction " + name[0]);
            const far = Math.hypot(u - x, v - y) || 1, off = 10 * unit;
            map.append(svg("text", {x: u + off * (u - x) / far, y: v + off * (v - y) / far, "font-size": 14 * unit, class: name[0]}, name));
        }
    }

    /* For what else shows numbers of the pixel (terms.js). */
    const explained = detail => of.canvas.dispatchEvent(new CustomEvent("explained", {bubbles: true, detail}));

    async function explain(at, focus) {
        const pressed = performance.now(), answer = await ask("probe", at);
        section.hidden = false;
        part("pixel-as").value = device;
        if (matchMedia("(max-width: 56rem)").matches)
            part("legend").after(section);
        open = at;
        part("pixel-title").textContent = "Pixel " + at.join(",");
        if (answer.text) {
            said = JSON.parse(answer.text);
            of.say(line(said));
            fill(said);
            mark(at, said.directions);
            explained(said);
        } else {
            part("pixel-said").replaceChildren(element("p", {class: "error"}, answer.message));
            mark(at);
        }
        part("pixel").dataset.milliseconds = performance.now() - pressed;
        if (focus)
            part("pixel-title").focus();
        part("pixel").scrollIntoView({block: "nearest"});
        if (part("pixel-values").options.length)
            return;
        await list();
        if (AS) {
            part("pixel-values").value = COMPUTED;
            await show(COMPUTED);
        }
    }

    /* The values of both shaders. */
    async function list() {
        const answer = await ask("names", []);
        if (!answer.text)
            return;
        const [fragment, vertex] = answer.text.split("\n\n").map(names => names.split("\n").filter(name => name));
        const option = value => element("option", {value}, value);
        const group = (label, values) => element("optgroup", {label}, ...values.map(option));
        const chosen = part("pixel-values").value;
        part("pixel-values").replaceChildren(element("option", {value: ""}, "the picture"),
            element("option", {value: COMPUTED}, "the picture as it is computed"), group("Errors", ["error", "blame"]),
            group("Fragment shader", fragment), group("Vertex shader", vertex.filter(name => !fragment.includes(name))),
            group("Error caused by", fragment.map(name => "error:" + name)));
        part("pixel-values").value = chosen;
        part("pixel-values").value ||= "";
    }

    async function show(what) {
        shown = what;
        if (!what) {
            part("shown").hidden = true;
            part("legend").textContent = "";
            return;
        }
        part("legend").textContent = what + ": is computed for all pixels.";
        const answer = await ask("show", [what === COMPUTED ? "" : what]);
        if (shown !== what)
            return;
        part("shown").hidden = !answer.picture;
        part("legend").textContent = answer.text || answer.message || "The picture as " + device + " computes it.";
        if (answer.picture)
            Controls.paint(part("shown"), answer.picture);
    }

    function close(leaves = true) {
        section.hidden = true;
        explained(null);
        open = null;
        part("pixel-values").value = "";
        show("");
        mark(null);
        if (leaves)
            of.canvas.focus();
    }

    /* What is open is that of the new picture, once that stays. */
    function renew(page) {
        if (page !== of || !open)
            return;
        clearTimeout(timer);
        const {width, height} = of.canvas;
        mark(null);
        if (open[0] >= width || open[1] >= height)
            return close();
        timer = setTimeout(async () => {
            await explain(open, false);
            await list();
            await show(part("pixel-values").value);
        }, STILL);
    }

    return {ask, begin, tell, explain, mark, renew, said: () => said};
})();
